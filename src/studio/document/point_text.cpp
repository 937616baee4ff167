#include "studio/document/point_text.h"

#include "espalier/base/error.h"

#include "geometry/side_files/side_files.h"
#include "language/side_files/side_files.h"

#include <fmt/format.h>

#include <cstddef>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_moved_points = 2000;

bool is_function(const fs::path& file) {
    return file.extension() == ".func" || file.extension() == ".fset";
}

std::vector<ControlPoints> points_of(const fs::path& file, const std::string& text) {
    std::vector<Diagnostic> ignored;
    if (is_function(file)) return language::read_function_points(text, file.string());
    if (file.extension() == ".s") return geometry::read_surface_points(text, file.string(), ignored);
    if (file.extension() != ".con") return {};
    if (language::is_curve_text(text)) return {language::read_curve_points(text, file.string())};
    const std::optional<ControlPoints> contour = geometry::read_contour_points(text, file.string(), ignored);
    return contour ? std::vector{*contour} : std::vector<ControlPoints>();
}

const char* name_of(geometry::Spline spline) {
    switch (spline) {
        case geometry::Spline::open:
            return "open";
        case geometry::Spline::closed:
            return "closed";
        case geometry::Spline::clamped:
            return "clamped";
        default:
            return "other";
    }
}

}  // namespace

std::vector<PointCurve> read_curves(const fs::path& file, const std::string& text) {
    std::vector<PointCurve> curves;
    std::size_t count = 0;
    try {
        for (const ControlPoints& read : points_of(file, text)) {
            PointCurve& curve = curves.emplace_back();
            curve.path = file.string();
            curve.name = read.name;
            curve.kind = is_function(file) ? "function" : file.extension() == ".s" ? "patch" : "contour";
            curve.spline = name_of(read.spline);
            for (const auto& [place, times, from, to] : read.points) {
                curve.points.push_back({place.x, place.y, place.z, times});
            }
            count += curve.points.size();
        }
    } catch (const UserError&) {
        return {};
    }
    return count > most_moved_points ? std::vector<PointCurve>() : curves;
}

std::string with_curve_points(const fs::path& file, const std::string& text, int number,
                              const std::vector<CurvePoint>& points) {
    const std::vector<ControlPoints> curves = points_of(file, text);
    if (number < 0 || static_cast<std::size_t>(number) >= curves.size()) {
        throw UserError(fmt::format("{} has no curve {}", file.filename().string(), number));
    }
    std::vector<ControlPoint> wanted;
    for (const CurvePoint& point : points) wanted.push_back({{point.x, point.y, point.z}, point.times});
    const std::string edited = geometry::with_points(text, curves[static_cast<std::size_t>(number)], wanted);
    points_of(file, edited);  // what cannot be read is no edit
    return edited;
}

}  // namespace espalier::studio

#include "environment/space/markers/point_file.h"

#include "espalier/base/file.h"
#include "espalier/base/map_origin.h"

#include "base/number.h"
#include "base/text.h"
#include "environment/space/shapes/mesh_formats.h"
#include "geometry/side_files/obj_mesh.h"
#include "language/measured/cells.h"
#include "language/measured/units.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace espalier::environment {
namespace {

constexpr double farthest = 1e12;

/// Rows of x, y, z and perhaps more, of which one may be names.
class PointRows {
public:
    PointRows(const std::filesystem::path& file, std::vector<Diagnostic>* warnings)
        : name_(file.string()), warnings_(warnings) {}

    std::vector<glm::dvec3> read(std::string_view text) {
        for (std::size_t begin = 0; begin < text.size();) {
            const std::string_view line = language::measured::next_line(text, begin);
            ++line_;
            if (line.starts_with('#') || line.starts_with("//")) continue;
            language::measured::split_cells(line, separator_of(line), cells_);
            if (!cells_.empty()) read_row();
        }
        if (warnings_ && longer_ > 0) {
            Diagnostic& warning = warnings_->emplace_back();
            warning.severity = Diagnostic::Severity::warning;
            warning.place = {name_, first_longer_, 1};
            warning.message = fmt::format("what stands behind x, y and z is not used ({} rows)", longer_);
        }
        return std::move(points_);
    }

private:
    static char separator_of(std::string_view line) {
        for (const char separator : {';', ','}) {
            if (line.find(separator) != std::string_view::npos) return separator;
        }
        return ' ';
    }

    void read_row() {
        glm::dvec3 point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::optional<double> value = axis < cells_.size() ? finite_number(cells_[axis]) : std::nullopt;
            if (!value && points_.empty() && !has_head_) {
                has_head_ = true;  // the names of columns, or the number of points
                return;
            }
            if (!value) {
                throw UserError(Place{name_, line_, static_cast<int>(axis) + 1},
                                "a row of points is x, y and z, which are numbers");
            }
            point[static_cast<int>(axis)] = *value;
        }
        if (cells_.size() > 3 && longer_++ == 0) first_longer_ = line_;
        points_.push_back(point);
    }

    std::string name_;
    std::vector<Diagnostic>* warnings_;
    int line_ = 0, first_longer_ = 0;
    std::size_t longer_ = 0;
    bool has_head_ = false;
    std::vector<std::string_view> cells_;
    std::vector<glm::dvec3> points_;
};

std::vector<glm::dvec3> points_of(const std::filesystem::path& file, const Place& place,
                                  std::vector<Diagnostic>* warnings) {
    if (!is_readable(file)) throw UserError(place, fmt::format("there is no file {} to read", file.string()));
    const std::string extension = file.extension().string();
    if (extension == ".obj") return geometry::read_obj_mesh(read_text(file), file.string()).positions;
    if (extension == ".ply") {
        try {
            return parse_ply(read_text(file)).points;
        } catch (const MeshFormatError& error) {
            throw UserError(place, fmt::format("{} is not a whole ply file: {}", file.string(), error.what()));
        }
    }
    for (const char* const known : {".xyz", ".txt", ".csv", ".asc", ".pts"}) {
        if (extension == known) return PointRows(file, warnings).read(read_text(file));
    }
    if (extension == ".las" || extension == ".laz") {
        throw UserError(place, fmt::format("{} is LAS, which is not read: write it as .xyz or .ply, as CloudCompare "
                                           "and PDAL do",
                                           file.string()));
    }
    throw UserError(place, fmt::format("{} holds no points that are read: its name must end in .ply, .obj, .xyz, .txt, "
                                       ".csv, .asc or .pts",
                                       file.string()));
}

bool is_mesh(const std::filesystem::path& file) {
    return file.extension() == ".obj" || file.extension() == ".ply";
}

}  // namespace

std::vector<glm::dvec3> read_point_file(const Settings& table, std::size_t most, std::vector<Diagnostic>* warnings) {
    const std::filesystem::path file = table.path("file");
    const Place place = table.place("file");
    const double metres =
        *language::measured::metres_of(table.choice_or("unit", "m", language::measured::length_units()));
    const glm::dmat3 upright = language::measured::upright(
        table.choice_or("up", is_mesh(file) ? "y" : "z", language::measured::upward_axes()));
    std::vector<glm::dvec3> points = points_of(file, place, warnings);
    if (points.empty()) throw UserError(place, fmt::format("{} has no points", file.string()));
    if (points.size() > most) {
        throw UserError(place, fmt::format("{} has {} points, more than the memory of the process holds ({}): raise "
                                           "--memory, or thin it out",
                                           file.string(), points.size(), most));
    }
    glm::dvec3 lower(INFINITY), upper(-INFINITY);
    for (glm::dvec3& point : points) {
        point = metres * (upright * point);
        const bool is_place =
            std::abs(point.x) < farthest && std::abs(point.y) < farthest && std::abs(point.z) < farthest;
        if (!is_place) throw UserError(place, fmt::format("a point of {} is nowhere", file.string()));
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    MapOrigin* const origin = MapOrigin::current();
    if (!origin) return points;
    const glm::dvec3 subtracted = origin->of(lower, upper, {file.string(), 1, 1});
    for (glm::dvec3& point : points) point = MapOrigin::shifted(point, subtracted);
    return points;
}

}  // namespace espalier::environment

#include "espalier/base/file.h"

#include "base/line_reader.h"
#include "language/side_files/side_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace espalier::language {
namespace {

constexpr std::size_t least_points = 4;
constexpr int most_samples = 100000;

const std::array<std::pair<std::string_view, SpaceCurve::Type>, 5> types{{
    {"bspline-closed", SpaceCurve::Type::closed},
    {"bspline-endpoint", SpaceCurve::Type::end_point},
    {"bspline-phantom", SpaceCurve::Type::phantom},
    {"bezier", SpaceCurve::Type::bezier},
    {"bezier-surface", SpaceCurve::Type::bezier},
}};

geometry::Spline spline_of(SpaceCurve::Type type) {
    switch (type) {
        case SpaceCurve::Type::b_spline:
            return geometry::Spline::open;
        case SpaceCurve::Type::closed:
            return geometry::Spline::closed;
        case SpaceCurve::Type::end_point:
            return geometry::Spline::clamped;
        default:
            return geometry::Spline::other;
    }
}

class CurveReader {
public:
    CurveReader(std::string_view text, const std::string& name) : lines_(TextCursor(text, name)) {}

    SpaceCurve read(int samples) {
        if (samples > most_samples) {
            lines_.text().fail(fmt::format("at most {} samples of a curve", most_samples));
        }
        std::vector<glm::dvec3> points = geometry::expanded<glm::dvec3>(read_points());
        // The language reaches only the first row of the first patch of a surface.
        if (is_surface_) points.resize(least_points);
        return SpaceCurve(std::move(points), type_, samples);
    }

    ControlPoints read_points() {
        const TextCursor start = lines_.text();
        while (!lines_.at_end() && !begins_with_number()) read_setting();
        if (!count_) lines_.text().fail("'points:' is expected here");
        for (int i = 0; i < *count_ && take_point(); ++i) {
        }
        if (curve_.total < least_points) {
            start.fail(fmt::format("a curve needs at least {} points, not {}", least_points, curve_.total));
        }
        curve_.spline = spline_of(type_);
        return curve_;
    }

private:
    bool begins_with_number() const {
        TextCursor text = lines_.text();
        text.skip(TextCursor::blanks);
        return text.number().has_value();
    }

    // The place, the range and the version of a curve are not used; unknown lines are ignored.
    void read_setting() {
        if (lines_.next_is("points:")) {
            TextCursor line = lines_.take_line("points:");
            curve_.count_at = line.offset();
            count_ = take_integer(line, "points:", 1, LineReader::most_lines);
        } else if (lines_.next_is("dimension:") || lines_.next_is("dim:")) {
            dimension_ = lines_.take_integer(lines_.next_is("dim:") ? "dim:" : "dimension:", 2, 4);
        } else if (lines_.next_is("type:")) {
            TextCursor line = lines_.take_line("type:");
            line.skip(TextCursor::blanks);
            const std::string_view word = line.word();
            type_ = SpaceCurve::Type::b_spline;
            for (const auto& [name, type] : types) {
                if (word == name) type_ = type;
            }
            is_surface_ = word == "bezier-surface";
        } else {
            lines_.take_line();
        }
    }

    // False for a line with another number of columns, which ends the points.
    bool take_point() {
        if (lines_.at_end()) return false;
        const TextCursor start = lines_.text();
        TextCursor line = lines_.take_line();
        std::size_t end = line.offset();
        std::vector<double> columns;
        while (const std::optional<double> number = line.number()) {
            columns.push_back(*number);
            end = line.offset();
            line.skip(TextCursor::blanks);
        }
        if (int(columns.size()) != dimension_) return false;
        curve_.coordinates = std::min(dimension_, 3);
        curve_.may_repeat = dimension_ == 4;
        if (!curve_.add(columns, start.offset(), end)) {
            start.fail(fmt::format("the multiplicity of a point is at least 1, and all together at most {}",
                                   LineReader::most_points));
        }
        return true;
    }

    LineReader lines_;
    std::optional<int> count_;
    int dimension_ = 2;
    SpaceCurve::Type type_ = SpaceCurve::Type::b_spline;
    bool is_surface_ = false;
    ControlPoints curve_;
};

}  // namespace

bool is_curve_text(std::string_view text) {
    return text.starts_with("version:") || text.starts_with("points:") || text.find("\nrange:") != text.npos ||
           text.find("\ntype: bspline") != text.npos;
}

ControlPoints read_curve_points(std::string_view text, const std::string& name) {
    return CurveReader(text, name).read_points();
}

SpaceCurve read_curve_text(std::string_view text, const std::string& name, int samples) {
    return CurveReader(text, name).read(samples);
}

SpaceCurve read_curve_file(const std::filesystem::path& path, int samples) {
    return read_curve_text(read_text(path), path.string(), samples);
}

}  // namespace espalier::language

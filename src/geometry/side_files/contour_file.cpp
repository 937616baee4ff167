#include "espalier/base/file.h"

#include "base/line_reader.h"
#include "geometry/side_files/side_files.h"

#include <fmt/format.h>

#include <utility>

namespace espalier::geometry {
namespace {

constexpr int most_dimensions = 3;

class ContourReader {
public:
    ContourReader(std::string_view text, const std::string& name, std::vector<Diagnostic>& diagnostics)
        : lines_(TextCursor(text, name)), start_(lines_.text()), diagnostics_(diagnostics) {}

    std::optional<ControlPoints> read() {
        if (!lines_.next_is("cver")) {
            read_oldest();
        } else if (!read_versioned()) {
            return std::nullopt;
        }
        if (curve_.total < (closed_ ? 3u : 4u)) {
            start_.fail(fmt::format("{} contour needs at least {} points, not {}", closed_ ? "a closed" : "an open",
                                    closed_ ? 3 : 4, curve_.total));
        }
        curve_.spline = closed_ ? Spline::closed : Spline::open;
        return std::move(curve_);
    }

private:
    bool refuse(const TextCursor& at, const std::string& why) {
        diagnostics_.push_back(at.diagnostic(why + "; the circle is drawn instead"));
        return false;
    }

    // "n dim closed", then the points.
    void read_oldest() {
        TextCursor line = lines_.take_line();
        curve_.count_at = line.offset();
        const int count = take_integer(line, "number of points", 3, LineReader::most_lines);
        curve_.coordinates = take_integer(line, "dimension", 2, most_dimensions);
        line.skip(TextCursor::blanks);
        const std::string_view word = line.word();
        if (word != "closed" && word != "open") line.fail("the first line of a contour ends with 'closed' or 'open'");
        closed_ = word == "closed";
        for (int i = 0; i < count; ++i) take_point();
    }

    bool read_versioned() {
        TextCursor line = lines_.take_line("cver");
        const std::vector<double> version = numbers_of(line);
        if (version.size() != 2 || version[0] != 1 || version[1] < 1 || version[1] > 3) {
            return refuse(line, "contours are read from 'cver 1 1' to 'cver 1 3' only");
        }
        read_name();
        const int count = read_count();
        if (!read_type(lines_.take_line("type:"), version[1] == 1)) return false;
        if (version[1] == 3) lines_.take_line();  // samples, which depend on the turtle instead
        lines_.skip_editor_lines();
        curve_.coordinates = most_dimensions;
        curve_.may_repeat = true;
        for (int i = 0; i < count; ++i) take_point();
        return true;
    }

    void read_name() {
        TextCursor line = lines_.take_line();
        if (line.accept("name:")) line.skip(TextCursor::blanks);
        curve_.name = line.word();
    }

    // Behind the number of points may stand how often all of them count.
    int read_count() {
        TextCursor line = lines_.take_line("points:");
        curve_.count_at = line.offset();
        const int count = take_integer(line, "points:", 1, LineReader::most_lines);
        line.skip(TextCursor::blanks);
        curve_.says_total = line.integer().has_value();
        return count;
    }

    bool read_type(TextCursor line, bool is_word) {
        line.skip(TextCursor::blanks);
        const TextCursor start = line;
        const std::string_view word = line.word();
        if (is_word) {
            closed_ = word != "open";
            return true;
        }
        const char form = word.size() > 0 ? word[0] : ' ', ends = word.size() > 1 ? word[1] : ' ';
        if ((form != 'c' && form != 'o') || (ends != 'r' && ends != 'e')) {
            return refuse(start, "the type of a contour is c (closed) or o (open) with r (regular) or e (end points)");
        }
        closed_ = form == 'c';
        if (ends == 'e') {
            diagnostics_.push_back(start.diagnostic(
                "type e is read as r: a point through which the contour shall go must have multiplicity 3",
                Diagnostic::Severity::warning));
        }
        return true;
    }

    void take_point() {
        const TextCursor start = lines_.take_line();
        TextCursor line = start;
        const std::vector<double> numbers = take_numbers(line);
        const auto coordinates = static_cast<std::size_t>(curve_.coordinates);
        if (numbers.size() != coordinates && !(curve_.may_repeat && numbers.size() == coordinates + 1)) {
            start.fail(fmt::format("a point of this contour is {} numbers{}", coordinates,
                                   curve_.may_repeat ? " and its multiplicity" : ""));
        }
        if (!curve_.add(numbers, start.offset(), line.offset())) {
            start.fail(fmt::format("the multiplicity of a point is at least 1, and all together at most {}",
                                   LineReader::most_points));
        }
    }

    LineReader lines_;
    TextCursor start_;
    std::vector<Diagnostic>& diagnostics_;
    ControlPoints curve_;
    bool closed_ = true;
};

}  // namespace

std::optional<ControlPoints> read_contour_points(std::string_view text, const std::string& name,
                                                 std::vector<Diagnostic>& diagnostics) {
    return ContourReader(text, name, diagnostics).read();
}

std::optional<Contour> read_contour_text(std::string_view text, const std::string& name,
                                         std::vector<Diagnostic>& diagnostics) {
    const std::optional<ControlPoints> points = read_contour_points(text, name, diagnostics);
    if (!points) return std::nullopt;
    return Contour(expanded<glm::dvec3>(*points), points->spline == Spline::closed);
}

std::optional<Contour> read_contour(const std::filesystem::path& path, std::vector<Diagnostic>& diagnostics) {
    return read_contour_text(read_text(path), path.string(), diagnostics);
}

}  // namespace espalier::geometry

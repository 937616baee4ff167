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

    std::optional<Contour> read() {
        if (!lines_.next_is("cver")) {
            read_oldest();
        } else if (!read_versioned()) {
            return std::nullopt;
        }
        if (points_.size() < (closed_ ? 3u : 4u)) {
            start_.fail(fmt::format("{} contour needs at least {} points, not {}", closed_ ? "a closed" : "an open",
                                    closed_ ? 3 : 4, points_.size()));
        }
        return Contour(std::move(points_), closed_);
    }

private:
    bool refuse(const TextCursor& at, const std::string& why) {
        diagnostics_.push_back(at.diagnostic(why + "; the circle is drawn instead"));
        return false;
    }

    // "n dim closed", then the points.
    void read_oldest() {
        TextCursor line = lines_.take_line();
        const int count = take_integer(line, "number of points", 3, LineReader::most_lines);
        const int dimension = take_integer(line, "dimension", 2, most_dimensions);
        line.skip(TextCursor::blanks);
        const std::string_view word = line.word();
        if (word != "closed" && word != "open") line.fail("the first line of a contour ends with 'closed' or 'open'");
        closed_ = word == "closed";
        for (int i = 0; i < count; ++i) take_point(std::size_t(dimension), false);
    }

    bool read_versioned() {
        TextCursor line = lines_.take_line("cver");
        const std::vector<double> version = numbers_of(line);
        if (version.size() != 2 || version[0] != 1 || version[1] < 1 || version[1] > 3) {
            return refuse(line, "contours are read from 'cver 1 1' to 'cver 1 3' only");
        }
        lines_.take_line();  // its name
        const int count = lines_.take_integer("points:", 1, LineReader::most_lines);
        if (!read_type(lines_.take_line("type:"), version[1] == 1)) return false;
        if (version[1] == 3) lines_.take_line();  // samples, which depend on the turtle instead
        lines_.skip_editor_lines();
        for (int i = 0; i < count; ++i) take_point(most_dimensions, true);
        return true;
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

    void take_point(std::size_t dimension, bool may_repeat) {
        const TextCursor line = lines_.take_line();
        std::vector<double> numbers = numbers_of(line);
        const bool repeats = may_repeat && numbers.size() == dimension + 1;
        if (numbers.size() != dimension && !repeats) {
            line.fail(fmt::format("a point of this contour is {} numbers{}", dimension,
                                  may_repeat ? " and its multiplicity" : ""));
        }
        const double multiplicity = repeats ? numbers.back() : 1;
        if (!(multiplicity >= 1 && double(points_.size()) + multiplicity <= LineReader::most_points)) {
            line.fail(fmt::format("the multiplicity of a point is at least 1, and all together at most {}",
                                  LineReader::most_points));
        }
        points_.insert(points_.end(), std::size_t(multiplicity),
                       {numbers[0], numbers[1], dimension == 3 ? numbers[2] : 0});
    }

    LineReader lines_;
    TextCursor start_;
    std::vector<Diagnostic>& diagnostics_;
    std::vector<glm::dvec3> points_;
    bool closed_ = true;
};

}  // namespace

std::optional<Contour> read_contour_text(std::string_view text, const std::string& name,
                                         std::vector<Diagnostic>& diagnostics) {
    return ContourReader(text, name, diagnostics).read();
}

std::optional<Contour> read_contour(const std::filesystem::path& path, std::vector<Diagnostic>& diagnostics) {
    return read_contour_text(read_text(path), path.string(), diagnostics);
}

}  // namespace espalier::geometry

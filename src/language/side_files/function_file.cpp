#include "espalier/base/file.h"

#include "base/line_reader.h"
#include "language/side_files/side_files.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace espalier::language {
namespace {

constexpr int least_points = 4;
constexpr int most_samples = 100000;
constexpr int most_functions = 10000;

/// x y, and how often the point counts.
void take_point(LineReader& lines, std::vector<glm::dvec2>& points) {
    TextCursor line = lines.take_line();
    const std::vector<double> numbers = numbers_of(line);
    if (numbers.size() != 2 && numbers.size() != 3) {
        line.fail("a point of a function is x, y and perhaps a multiplicity");
    }
    const double multiplicity = numbers.size() == 3 ? numbers[2] : 1;
    if (multiplicity < 1 || multiplicity != double(int(multiplicity))) {
        line.fail("the multiplicity of a point is a whole number, at least 1");
    }
    if (double(points.size()) + multiplicity > LineReader::most_points) {
        line.fail(fmt::format("more than {} points", LineReader::most_points));
    }
    points.insert(points.end(), std::size_t(multiplicity), {numbers[0], numbers[1]});
}

FunctionCurve take_points(LineReader& lines, int samples) {
    const int count = lines.take_integer("points:", least_points, LineReader::most_lines);
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) take_point(lines, points);
    return FunctionCurve(std::move(points), samples);
}

/// "fver 1 1" and what follows it.
NamedFunction take_function(LineReader& lines) {
    TextCursor version = lines.take_line("fver");
    if (numbers_of(version) != std::vector<double>{1, 1}) version.fail("functions are read as 'fver 1 1' only");
    TextCursor name = lines.take_line("name:");
    name.skip(TextCursor::blanks);
    NamedFunction function;
    function.name = name.word();
    function.name = function.name.substr(0, function.name.rfind('.'));
    const int samples = lines.take_integer("samples:", std::numeric_limits<int>::min() + 1, most_samples);
    lines.skip_editor_lines();
    lines.take_line();  // "flip: off", or any other
    function.function = take_points(lines, samples);
    return function;
}

}  // namespace

FunctionCurve read_function_text(std::string_view text, const std::string& name, int samples_if_old) {
    LineReader lines(TextCursor(text, name));
    if (lines.next_is("fver")) return take_function(lines).function;
    if (!lines.next_is("range:")) lines.text().fail("a function file begins with 'fver 1 1' (older ones: 'range:')");
    lines.take_line();
    if (samples_if_old > most_samples) {
        lines.text().fail(fmt::format("{} samples are too many; at most {}", samples_if_old, most_samples));
    }
    return take_points(lines, samples_if_old);
}

FunctionCurve read_function_file(const std::filesystem::path& path, int samples_if_old) {
    return read_function_text(read_text(path), path.string(), samples_if_old);
}

std::vector<NamedFunction> read_function_set_text(std::string_view text, const std::string& name) {
    LineReader lines(TextCursor(text, name));
    if (!lines.next_is("funcgalleryver")) lines.text().fail("a function set begins with 'funcgalleryver 1 1'");
    TextCursor version = lines.take_line("funcgalleryver");
    if (numbers_of(version) != std::vector<double>{1, 1}) {
        version.fail("function sets are read as 'funcgalleryver 1 1' only");
    }
    std::vector<NamedFunction> functions;
    for (int left = lines.take_integer("items:", 0, most_functions); left > 0; --left) {
        functions.push_back(take_function(lines));
    }
    return functions;
}

std::vector<NamedFunction> read_function_set(const std::filesystem::path& path) {
    return read_function_set_text(read_text(path), path.string());
}

}  // namespace espalier::language

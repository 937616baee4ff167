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

/// A function as its file writes it.
struct WrittenFunction {
    ControlPoints points;
    int samples = 0;

    FunctionCurve curve() const { return FunctionCurve(geometry::expanded<glm::dvec2>(points), samples); }
};

/// x y, and how often the point counts.
void take_point(LineReader& lines, ControlPoints& points) {
    TextCursor line = lines.take_line();
    const TextCursor start = line;
    const std::vector<double> numbers = take_numbers(line);
    if (numbers.size() != 2 && numbers.size() != 3) {
        start.fail("a point of a function is x, y and perhaps a multiplicity");
    }
    const double multiplicity = numbers.size() == 3 ? numbers[2] : 1;
    if (multiplicity < 1 || multiplicity != double(int(multiplicity))) {
        start.fail("the multiplicity of a point is a whole number, at least 1");
    }
    if (!points.add(numbers, start.offset(), line.offset())) {
        start.fail(fmt::format("more than {} points", LineReader::most_points));
    }
}

ControlPoints take_points(LineReader& lines) {
    ControlPoints points;
    points.spline = geometry::Spline::clamped;
    points.may_repeat = true;
    TextCursor line = lines.take_line("points:");
    points.count_at = line.offset();
    const int count = take_integer(line, "points:", least_points, LineReader::most_lines);
    for (int i = 0; i < count; ++i) take_point(lines, points);
    return points;
}

/// "fver 1 1" and what follows it.
WrittenFunction take_function(LineReader& lines) {
    TextCursor version = lines.take_line("fver");
    if (numbers_of(version) != std::vector<double>{1, 1}) version.fail("functions are read as 'fver 1 1' only");
    TextCursor title = lines.take_line("name:");
    title.skip(TextCursor::blanks);
    const std::string name(title.word());
    const int samples = lines.take_integer("samples:", std::numeric_limits<int>::min() + 1, most_samples);
    lines.skip_editor_lines();
    lines.take_line();  // "flip: off", or any other
    WrittenFunction function{take_points(lines), samples};
    function.points.name = name.substr(0, name.rfind('.'));
    return function;
}

WrittenFunction take_file(LineReader& lines, int samples_if_old) {
    if (lines.next_is("fver")) return take_function(lines);
    if (!lines.next_is("range:")) lines.text().fail("a function file begins with 'fver 1 1' (older ones: 'range:')");
    lines.take_line();
    if (samples_if_old > most_samples) {
        lines.text().fail(fmt::format("{} samples are too many; at most {}", samples_if_old, most_samples));
    }
    return {take_points(lines), samples_if_old};
}

std::vector<WrittenFunction> take_set(LineReader& lines) {
    if (!lines.next_is("funcgalleryver")) lines.text().fail("a function set begins with 'funcgalleryver 1 1'");
    TextCursor version = lines.take_line("funcgalleryver");
    if (numbers_of(version) != std::vector<double>{1, 1}) {
        version.fail("function sets are read as 'funcgalleryver 1 1' only");
    }
    std::vector<WrittenFunction> functions;
    for (int left = lines.take_integer("items:", 0, most_functions); left > 0; --left) {
        functions.push_back(take_function(lines));
    }
    return functions;
}

}  // namespace

std::vector<ControlPoints> read_function_points(std::string_view text, const std::string& name) {
    LineReader lines(TextCursor(text, name));
    if (!lines.next_is("funcgalleryver")) return {take_file(lines, 0).points};
    std::vector<ControlPoints> points;
    for (WrittenFunction& function : take_set(lines)) points.push_back(std::move(function.points));
    return points;
}

FunctionCurve read_function_text(std::string_view text, const std::string& name, int samples_if_old) {
    LineReader lines(TextCursor(text, name));
    return take_file(lines, samples_if_old).curve();
}

FunctionCurve read_function_file(const std::filesystem::path& path, int samples_if_old) {
    return read_function_text(read_text(path), path.string(), samples_if_old);
}

std::vector<NamedFunction> read_function_set_text(std::string_view text, const std::string& name) {
    LineReader lines(TextCursor(text, name));
    std::vector<NamedFunction> functions;
    for (const WrittenFunction& function : take_set(lines)) {
        functions.push_back({function.points.name, function.curve()});
    }
    return functions;
}

std::vector<NamedFunction> read_function_set(const std::filesystem::path& path) {
    return read_function_set_text(read_text(path), path.string());
}

}  // namespace espalier::language

#include "language/side_files/side_files.h"

#include "espalier/base/error.h"

#include "base/text_cursor.h"
#include "catch.h"
#include "replaced.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::language;

namespace {

const std::string hill = "fver 1 1\nname: hill\nsamples: 5\nflip: off\npoints: 4\n0 0\n0.333 1\n0.667 1\n1 0\n";

FunctionCurve function_of(const std::string& text, int samples_if_old = 0) {
    return read_function_text(text, "a.func", samples_if_old);
}

std::string complaint(const std::string& text) {
    try {
        function_of(text);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a function file gives points and samples", "[language]") {
    const FunctionCurve read = function_of(hill);
    const FunctionCurve made({{0, 0}, {0.333, 1}, {0.667, 1}, {1, 0}}, 5);
    for (int k = -2; k <= 12; ++k) CHECK(read(k / 10.0) == made(k / 10.0));
    CHECK(read(0.5) == Approx(0.75).margin(1e-3));
}

TEST_CASE("the samples of a function file count, not those of whoever names it", "[language]") {
    CHECK(function_of(hill, 100)(0.3) == function_of(hill)(0.3));
    CHECK(function_of(replaced(hill, "samples: 5", "samples: 0"), 5)(0.3) != function_of(hill)(0.3));
}

TEST_CASE("numbers of side files are kept with 32 bits", "[language]") {
    const double tenth = static_cast<float>(0.1);
    const FunctionCurve constant =
        function_of("fver 1 1\nname: c\nsamples: 0\nflip: off\npoints: 4\n0 0.1\n0.3 0.1\n0.6 0.1\n1 0.1\n");
    CHECK(std::abs(constant(0.4) - tenth) < 1e-15);
    CHECK(TextCursor("1e39", "a").number() == std::nullopt);
    CHECK(TextCursor("+2.5e-3x", "a").number() == double(static_cast<float>(0.0025)));
    for (const char* none : {"inf", "nan", "-", "+-1", "-+1", ".", "e5", ""}) {
        CHECK(TextCursor(none, "a").number() == std::nullopt);
        CHECK(TextCursor(none, "a").integer() == std::nullopt);
    }
    CHECK(TextCursor("-12.5", "a").integer() == -12);
    CHECK(TextCursor("99999999999", "a").integer() == std::nullopt);
}

TEST_CASE("the multiplicity of a function's point repeats it", "[language]") {
    const std::string text =
        "fver 1 1\nname: roof\nsamples: 0\nflip: off\npoints: 5\n"
        "0 0\n0.25 0.5\n0.5 1 3\n0.75 1 1\n1 1\n";
    const FunctionCurve made({{0, 0}, {0.25, 0.5}, {0.5, 1}, {0.5, 1}, {0.5, 1}, {0.75, 1}, {1, 1}}, 0);
    for (int k = 0; k <= 20; ++k) CHECK(function_of(text)(k / 20.0) == made(k / 20.0));
}

TEST_CASE("a function of the older form takes its samples from whoever names it, and its range is not used",
          "[language]") {
    const std::string text = "range: 3 17\npoints: 4\n0 0\n0.333 1\n0.667 1\n1 0\n";
    const FunctionCurve exact({{0, 0}, {0.333, 1}, {0.667, 1}, {1, 0}}, 0);
    CHECK(function_of(text)(0.3) == exact(0.3));
    CHECK(function_of(text, 5)(0.3) == function_of(hill)(0.3));
}

TEST_CASE("pictures and markers of editors, carriage returns and empty lines are passed over", "[language]") {
    std::string text = replaced(hill, "flip", "background: sketch.rgb\n1 2 3\nmarkers: 2\n0.1\n0.2\nflip");
    text = replaced(text, "points: 4\n", "points: 4\n\n");
    std::string with_returns;
    for (const char c : text) with_returns += c == '\n' ? "\r\n" : std::string(1, c);
    CHECK(function_of(text)(0.3) == function_of(hill)(0.3));
    CHECK(function_of(with_returns)(0.3) == function_of(hill)(0.3));
}

TEST_CASE("mistakes in function files are told with their place", "[language]") {
    CHECK(complaint("") == "a.func:1:1: a function file begins with 'fver 1 1' (older ones: 'range:')");
    CHECK(complaint(replaced(hill, "fver 1 1", "fver 1 2")) ==
          "a.func:1:6: functions are read as 'fver 1 1' only\n    fver 1 2\n         ^");
    CHECK(complaint(replaced(hill, "flip: off\n", "")) == "a.func:5:1: 'points:' is expected here\n    0 0\n    ^");
    CHECK(complaint(replaced(hill, "points: 4", "points: 3")) ==
          "a.func:5:9: 'points:' needs a whole number from 4 to 100000\n    points: 3\n            ^");
    CHECK(complaint(replaced(hill, "1 0\n", "")) == "a.func:9:1: the file ends too early");
    CHECK(complaint(replaced(hill, "0.333", "nan")) == "a.func:7:1: 'nan' is no number\n    nan 1\n    ^");
    CHECK(complaint(replaced(hill, "0.333 1", "0.333 1 0")) ==
          "a.func:7:1: the multiplicity of a point is a whole number, at least 1\n    0.333 1 0\n    ^");
    CHECK(complaint(replaced(hill, "0.333 1", "0.333 1 1e9")) ==
          "a.func:7:1: more than 1000000 points\n    0.333 1 1e9\n    ^");
    CHECK(complaint(replaced(hill, "0.333 1", "0.333")) ==
          "a.func:7:1: a point of a function is x, y and perhaps a multiplicity\n    0.333\n    ^");
    CHECK(complaint(replaced(hill, "samples: 5", "samples: many")) ==
          "a.func:3:10: 'samples:' needs a whole number, at most 100000\n    samples: many\n             ^");
}

TEST_CASE("a function set gives functions by name, each cut at its last dot", "[language]") {
    const std::string other = replaced(replaced(hill, "name: hill", "name: leaf.width.func"), "0.333 1", "0.333 2");
    const auto set = read_function_set_text("funcgalleryver 1 1\nitems: 2\n" + hill + other, "a.fset");
    REQUIRE(set.size() == 2);
    CHECK(set[0].name == "hill");
    CHECK(set[1].name == "leaf.width");
    CHECK(set[0].function(0.4) == function_of(hill)(0.4));
    CHECK(set[1].function(0.4) > set[0].function(0.4));
    CHECK(read_function_set_text("funcgalleryver 1 1\nitems: 0\n", "a.fset").empty());
    CHECK_THROWS_WITH(read_function_set_text("items: 1\n", "a.fset"),
                      Catch::StartsWith("a.fset:1:1: a function set begins with 'funcgalleryver 1 1'"));
    CHECK_THROWS_WITH(read_function_set_text("funcgalleryver 1 1\nitems: 2\n" + hill, "a.fset"),
                      Catch::StartsWith("a.fset:12:1: the file ends where 'fver' is expected"));
}

TEST_CASE("a curve file gives a curve of its type", "[language]") {
    const std::string head = "version: 1.4\n// drawn by hand\ncontact: 0 0 0\nend: 0 1 0\nsize: 1\n";
    const std::string points = "0 0 0\n1 2 0\n3 2 1\n4 0 1\n6 -1 0\n7 1 2\n";
    const auto read = [&](const std::string& type) {
        return read_curve_text(head + "points: 6\nrange: 0 1\ndimension: 3\ntype: " + type + "\n" + points, "a.con");
    };
    const std::vector<glm::dvec3> made{{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 1}, {6, -1, 0}, {7, 1, 2}};
    const std::vector<std::pair<std::string, SpaceCurve::Type>> types{
        {"bspline", SpaceCurve::Type::b_spline},        {"spiral", SpaceCurve::Type::b_spline},
        {"bspline-closed", SpaceCurve::Type::closed},   {"bspline-endpoint", SpaceCurve::Type::end_point},
        {"bspline-phantom", SpaceCurve::Type::phantom}, {"bezier", SpaceCurve::Type::bezier}};
    for (const auto& [word, type] : types) {
        INFO(word);
        CHECK(read(word).length() == SpaceCurve(made, type).length());
        CHECK(read(word)(0.3) == SpaceCurve(made, type)(0.3));
    }
}

TEST_CASE("curves in the plane are the default, and a fourth column is a multiplicity", "[language]") {
    const SpaceCurve plane = read_curve_text("points: 4\n0 0\n1 0\n2 0\n3 3\n", "a.con");
    CHECK(plane(1).z == 0);
    CHECK(plane(0).x == Approx(1));
    const SpaceCurve repeated =
        read_curve_text("points: 3\ndim: 4\ntype: bspline\n0 0 1 3\n1 0 1 1\n3 3 1 3\n", "a.con");
    CHECK(glm::distance(repeated(0), {0, 0, 1}) < 1e-9);
    CHECK(glm::distance(repeated(1), {3, 3, 1}) < 1e-4);
}

TEST_CASE("of a Bezier surface the first row of its first patch is the curve", "[language]") {
    std::string points;
    for (int i = 0; i < 16; ++i) points += std::to_string(i % 4) + " 0 " + std::to_string(i / 4) + "\n";
    const SpaceCurve row = read_curve_text("points: 16\ndimension: 3\ntype: bezier-surface\n" + points, "a.con");
    CHECK(row.length() == Approx(3).margin(1e-4));
    CHECK(row(1).z == 0);
}

TEST_CASE("a wrong number of columns ends the points of a curve", "[language]") {
    const std::string text = "points: 6\n0 0\n1 0\n2 0\n3 0\n4 0 0\n5 0\n";
    const SpaceCurve four({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, SpaceCurve::Type::b_spline);
    CHECK(read_curve_text(text, "a.con").length() == four.length());
    CHECK_THROWS_WITH(read_curve_text("points: 6\n0 0\n1 0\nzero 0\n", "a.con"),
                      Catch::StartsWith("a.con:1:1: a curve needs at least 4 points, not 2"));
    CHECK_THROWS_WITH(read_curve_text("type: bezier\n0 0\n", "a.con"),
                      Catch::StartsWith("a.con:2:1: 'points:' is expected here"));
    CHECK_THROWS_WITH(read_curve_text("points: 2\n0 0\n1 0\n", "a.con"),
                      Catch::StartsWith("a.con:1:1: a curve needs at least 4 points, not 2"));
}

TEST_CASE("files that are not there are named", "[language]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(read_function_file(folder.path() / "none.func"), Catch::Contains("none.func"));
    CHECK(read_function_file(folder.write("a.func", hill))(0.5) == function_of(hill)(0.5));
    CHECK(read_function_set(folder.write("a.fset", "funcgalleryver 1 1\nitems: 1\n" + hill)).at(0).name == "hill");
    CHECK(read_curve_file(folder.write("a.con", "points: 4\n0 0\n1 0\n2 0\n3 0\n")).length() == Approx(1).margin(1e-4));
}

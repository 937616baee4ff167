// Control points of side files: every form of file is read, and an edit changes the lines of its points and no others.
#include "studio/document/point_text.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "replaced.h"

#include <algorithm>
#include <filesystem>
#include <limits>

using namespace espalier;

namespace {

namespace fs = std::filesystem;

const std::string hill = "fver 1 1\nname: hill.func\nsamples: 0\nflip: off\npoints: 4\n0 0\n0.30 .5\n0.7 0.2 3\n1 1\n";
const std::string stem =
    "cver 1 3\nname: stem\npoints: 4 6\ntype: cr\nsamples: 10\n1 0 0 1\n0 1 0 3\n-1 0 0 1\n0 -1 0 1\n";

PointCurve curve_of(const std::string& name, const std::string& text) {
    const std::vector<PointCurve> curves = read_curves(name, text);
    REQUIRE(curves.size() == 1);
    return curves.front();
}

std::vector<CurvePoint> points_of(const std::string& name, const std::string& text) {
    return curve_of(name, text).points;
}

}  // namespace

TEST_CASE("all side files of the library have control points, which written back leave each byte", "[studio]") {
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / "models")) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".func" && extension != ".fset" && extension != ".con" && extension != ".s") continue;
        INFO(entry.path());
        ++files;
        const std::string text = read_text(entry.path());
        const std::vector<PointCurve> curves = read_curves(entry.path(), text);
        REQUIRE_FALSE(curves.empty());
        for (std::size_t i = 0; i < curves.size(); ++i) {
            CHECK(curves[i].points.size() >= 3);
            CHECK(with_curve_points(entry.path(), text, static_cast<int>(i), curves[i].points) == text);
        }
    }
    CHECK(files > 5);
}

TEST_CASE("a moved point changes its own line, and no other", "[studio]") {
    std::vector<CurvePoint> points = points_of("hill.func", hill);
    CHECK(curve_of("hill.func", hill).spline == "clamped");
    CHECK(points[2].times == 3);
    points[2].y = 0.25;
    const std::string changed = with_curve_points("hill.func", hill, 0, points);
    CHECK(changed == replaced(hill, "0.7 0.2 3", "0.7 0.25 3"));
    points[1].x = 0.35;
    CHECK(with_curve_points("hill.func", changed, 0, points) == replaced(changed, "0.30 .5", "0.35 0.5 1"));
}

TEST_CASE("a point that is added or taken out changes the counts", "[studio]") {
    std::vector<CurvePoint> points = points_of("stem.con", stem);
    CHECK(curve_of("stem.con", stem).spline == "closed");
    CHECK(curve_of("stem.con", stem).name == "stem");
    points.insert(points.begin() + 1, {0.5, 0.5, 0, 2});
    const std::string more = with_curve_points("stem.con", stem, 0, points);
    CHECK(more == replaced(replaced(stem, "4 6", "5 8"), "1 0 0 1\n", "1 0 0 1\n0.5 0.5 0 2\n"));
    points.erase(points.begin() + 1);
    CHECK(with_curve_points("stem.con", more, 0, points) == stem);

    points.insert(points.begin(), {2, 0, 0, 1});
    CHECK(with_curve_points("stem.con", stem, 0, points) ==
          replaced(replaced(stem, "4 6", "5 7"), "1 0 0 1\n", "2 0 0 1\n1 0 0 1\n"));
    points = points_of("stem.con", stem);
    points.pop_back();
    CHECK(with_curve_points("stem.con", stem, 0, points) == replaced(replaced(stem, "4 6", "3 5"), "0 -1 0 1\n", ""));
}

TEST_CASE("older forms, curves in space and ends of lines of other systems are kept", "[studio]") {
    const std::string oldest = "4 2 closed\n1 0\n0 1\n-1 0\n0 -1";
    std::vector<CurvePoint> points = points_of("old.con", oldest);
    points.push_back({0.5, -0.5, 0, 1});
    CHECK(with_curve_points("old.con", oldest, 0, points) == "5 2 closed\n1 0\n0 1\n-1 0\n0 -1\n0.5 -0.5");
    points.back().times = 2;
    CHECK_THROWS_AS(with_curve_points("old.con", oldest, 0, points), UserError);

    const std::string range = "range: 0 1\r\npoints: 4\r\n0 0\r\n0.2 1\r\n0.8 1\r\n1 0\r\n";
    points = points_of("old.func", range);
    points.insert(points.begin() + 2, {0.5, 2, 0, 1});
    CHECK(with_curve_points("old.func", range, 0, points) ==
          "range: 0 1\r\npoints: 5\r\n0 0\r\n0.2 1\r\n0.5 2\r\n0.8 1\r\n1 0\r\n");

    const std::string space =
        "version: 1.4\npoints: 4\nrange: 0 1\ndimension: 4\ntype: bspline-endpoint\n0 0 0 1\n1 2 0 1\n3 2 1 2\n4 0 1 "
        "1\n";
    const PointCurve curve = curve_of("path.con", space);
    CHECK((curve.spline == "clamped" && curve.kind == "contour"));
    CHECK((curve.points[2].z == 1 && curve.points[2].times == 2));
    CHECK(curve_of("path.con", replaced(space, "bspline-endpoint", "bezier")).spline == "other");
}

TEST_CASE("the functions of a set are edited by their numbers", "[studio]") {
    const std::string set = "funcgalleryver 1 1\nitems: 2\n" + hill + replaced(hill, "hill.func", "dale.func");
    const std::vector<PointCurve> curves = read_curves("all.fset", set);
    REQUIRE(curves.size() == 2);
    CHECK((curves[0].name == "hill" && curves[1].name == "dale" && curves[1].kind == "function"));
    std::vector<CurvePoint> points = curves[1].points;
    points[0].y = -1;
    const std::string changed = with_curve_points("all.fset", set, 1, points);
    CHECK(changed.starts_with("funcgalleryver 1 1\nitems: 2\n" + hill));
    CHECK(read_curves("all.fset", changed)[1].points[0].y == -1);
    CHECK_THROWS_AS(with_curve_points("all.fset", set, 2, points), UserError);
}

TEST_CASE("of a surface, only the numbers of the point that moves change", "[studio]") {
    const fs::path file = fs::path(ESPALIER_SOURCE_DIR) / "models/organs/leaf.s";
    const std::string text = read_text(file);
    std::vector<CurvePoint> points = read_curves(file, text).at(0).points;
    REQUIRE(points.size() == 16);
    points[5].z = 0.125;
    const std::string changed = with_curve_points(file, text, 0, points);
    CHECK(read_curves(file, changed)[0].points[5].z == 0.125);
    points[5].z = read_curves(file, text)[0].points[5].z;
    CHECK(read_curves(file, with_curve_points(file, changed, 0, points))[0].points[5].z == points[5].z);
    CHECK(std::count(changed.begin(), changed.end(), '\n') == std::count(text.begin(), text.end(), '\n'));
    points.pop_back();
    CHECK_THROWS_AS(with_curve_points(file, text, 0, points), UserError);
}

TEST_CASE("what a file could not say is refused, and a file with mistakes has no points", "[studio]") {
    std::vector<CurvePoint> points = points_of("hill.func", hill);
    points[1].y = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(with_curve_points("hill.func", hill, 0, points), UserError);
    points[1].y = 0;
    points[1].times = 0;
    CHECK_THROWS_AS(with_curve_points("hill.func", hill, 0, points), UserError);
    points.resize(3);
    points[1].times = 1;
    CHECK_THROWS_AS(with_curve_points("hill.func", hill, 0, points), UserError);
    CHECK(read_curves("a.func", "points: 3\n0 0\n1 1\n").empty());
    CHECK(read_curves("a.con", "cver 1\n").empty());
    CHECK(read_curves("a.l", "lsystem: 1\n").empty());
}

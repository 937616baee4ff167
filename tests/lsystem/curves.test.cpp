#include "espalier/base/error.h"
#include "espalier/lsystem/resources.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

using namespace espalier;
using namespace espalier::lsystem;

namespace {

using Points2 = std::vector<glm::dvec2>;
using Points3 = std::vector<glm::dvec3>;
using Type = SpaceCurve::Type;

// x(d) = d for four points, and the cubic Bezier polynomial of y.
const Points2 hill{{0, 0}, {1.0 / 3, 1}, {2.0 / 3, 1}, {1, 0}};

double bernstein_hill(double d) {
    return 3 * d * (1 - d) * (1 - d) + 3 * d * d * (1 - d);
}

const Points3 bow{{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 1}, {6, -1, 0}, {7, 1, 2}};

}  // namespace

TEST_CASE("a function of four points is a Bezier curve, found where its abscissa comes within 0.001", "[lsystem]") {
    const FunctionCurve function(hill, 0);
    // Halving meets these abscissae exactly.
    CHECK(function(0.5) == Approx(0.75).margin(1e-7));
    CHECK(function(0.25) == Approx(bernstein_hill(0.25)).margin(1e-7));
    // 0.3 is met by the first multiple of a power of a half that is near enough: 77/256 = 0.30078.
    CHECK(function(0.3) == Approx(bernstein_hill(77.0 / 256)).margin(1e-7));
    CHECK(std::abs(function(0.3) - bernstein_hill(0.3)) > 1e-4);
    // The ends are approached from inside: 1/1024 and 1023/1024.
    CHECK(function(0) == Approx(bernstein_hill(1.0 / 1024)).margin(1e-7));
    CHECK(function(1) == Approx(bernstein_hill(1023.0 / 1024)).margin(1e-7));
}

TEST_CASE("outside its domain a function has the values of its ends", "[lsystem]") {
    const FunctionCurve function({{0, 2}, {0.25, 3}, {0.75, 5}, {1, 7}}, 5);
    CHECK(function(-3) == function(0));
    CHECK(function(17) == function(1));
    CHECK(function(std::numeric_limits<double>::quiet_NaN()) == function(0));
    CHECK(function(std::numeric_limits<double>::infinity()) == function(1));
    CHECK(FunctionCurve()(0.5) == 0);
}

TEST_CASE("more than two samples are tabulated and joined by straight lines", "[lsystem]") {
    const FunctionCurve exact(hill, 2), sampled(hill, 5);
    for (int k = 0; k <= 4; ++k) CHECK(sampled(k / 4.0) == Approx(exact(k / 4.0)).margin(1e-12));
    CHECK(sampled(0.375) == Approx((exact(0.25) + exact(0.5)) / 2).margin(1e-12));
    CHECK(sampled(0.3) == Approx(0.8 * exact(0.25) + 0.2 * exact(0.5)).margin(1e-12));
    CHECK(exact(0.3) == FunctionCurve(hill, -4)(0.3));
}

TEST_CASE("the spline of a function has the knots 0 0 0 0 1 2 2 2 2 for five points", "[lsystem]") {
    // At the middle knot the points count 0, 1/4, 1/2, 1/4, 0, whatever they are.
    const FunctionCurve function({{0, 1}, {0.25, 8}, {0.5, -2}, {0.75, 4}, {1, 3}}, 0);
    CHECK(function(0.5) == Approx(8 / 4.0 - 2 / 2.0 + 4 / 4.0).margin(1e-7));
}

TEST_CASE("threefold points make corners of functions", "[lsystem]") {
    // A rise that ends in the corner (0.5, 1) and a plateau behind it.
    const FunctionCurve roof({{0, 0}, {0.25, 0.5}, {0.5, 1}, {0.5, 1}, {0.5, 1}, {0.75, 1}, {1, 1}}, 0);
    CHECK(roof(0.25) == Approx(0.5).margin(2e-3));
    CHECK(roof(0.5) == Approx(1).margin(2e-3));
    for (const double x : {0.51, 0.6, 0.9, 1.0}) CHECK(roof(x) == Approx(1).margin(1e-12));
    for (int k = 0; k < 50; ++k) CHECK(roof((k + 1) / 100.0) >= roof(k / 100.0));
}

TEST_CASE("a function that turns back is given some value, not an endless search", "[lsystem]") {
    const FunctionCurve jump({{0, 0}, {0, 0}, {0, 0}, {0, 0}, {5, 1}, {5, 1}, {5, 1}, {5, 1}}, 0);
    CHECK(std::isfinite(jump(0.5)));
    const FunctionCurve away({{3, 1}, {3, 1}, {3, 1}, {3, 2}}, 10);
    CHECK(away(0.5) == Approx(1).margin(1e-6));
}

TEST_CASE("functions and curves need four points", "[lsystem]") {
    CHECK_THROWS_WITH(FunctionCurve({{0, 0}, {1, 1}, {1, 1}}, 0), "a function needs at least 4 points, not 3");
    CHECK_THROWS_WITH(SpaceCurve({{0, 0, 0}}, Type::bezier), "a curve needs at least 4 points, not 1");
}

TEST_CASE("a straight curve is walked at constant speed", "[lsystem]") {
    const Points3 line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {6, 0, 0}};
    const SpaceCurve bezier(line, Type::bezier, 1000);
    CHECK(bezier.length() == Approx(6).margin(1e-4));
    for (const double t : {0.1, 0.33, 0.5, 0.9}) CHECK(bezier(t).x == Approx(6 * t).margin(1e-3));
    const SpaceCurve spline(line, Type::b_spline, 1000);
    CHECK(spline(0).x == Approx(1).margin(1e-12));  // (0 + 4 + 2) / 6
    CHECK(spline(1).x == Approx(15.0 / 6).margin(1e-5));
    CHECK(spline.length() == Approx(1.5).margin(1e-5));
}

TEST_CASE("curves begin and end where their type says", "[lsystem]") {
    const auto at = [](const SpaceCurve& curve, double t, glm::dvec3 point) {
        return glm::distance(curve(t), point) < 1e-4;
    };
    const auto knot = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
        return (p + 4.0 * q + r) / 6.0;
    };
    const SpaceCurve spline(bow, Type::b_spline);
    CHECK(at(spline, 0, knot(bow[0], bow[1], bow[2])));
    CHECK(at(spline, 1, knot(bow[3], bow[4], bow[5])));
    const SpaceCurve closed(bow, Type::closed);
    CHECK(at(closed, 0, knot(bow[0], bow[1], bow[2])));
    CHECK(at(closed, 1, knot(bow[0], bow[1], bow[2])));
    for (const Type type : {Type::end_point, Type::phantom}) {
        const SpaceCurve curve(bow, type);
        CHECK(at(curve, 0, bow.front()));
        CHECK(at(curve, 1, bow.back()));
    }
    // Six points make one Bezier piece; the last two are not reached.
    const SpaceCurve bezier(bow, Type::bezier);
    CHECK(at(bezier, 0, bow[0]));
    CHECK(at(bezier, 1, bow[3]));
}

TEST_CASE("pieces of a Bezier curve share their ends", "[lsystem]") {
    // Two straight pieces of lengths 3 and 5 around a corner.
    const Points3 corner{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 5. / 3, 0}, {3, 10. / 3, 0}, {3, 5, 0}};
    const SpaceCurve curve(corner, Type::bezier, 1001);
    CHECK(curve.length() == Approx(8).margin(1e-3));
    CHECK(glm::distance(curve(1.5 / 8), {1.5, 0, 0}) < 2e-3);
    CHECK(glm::distance(curve(5.5 / 8), {3, 2.5, 0}) < 2e-3);
}

TEST_CASE("few samples measure a curve by its chords, and its points still lie on it", "[lsystem]") {
    // A parabola y = 4x(1-x) over [0, 1], as a Bezier curve of degree raised: x(t) = t.
    const Points3 parabola{{0, 0, 0}, {1. / 3, 4. / 3, 0}, {2. / 3, 4. / 3, 0}, {1, 0, 0}};
    const SpaceCurve coarse(parabola, Type::bezier, 3);
    CHECK(coarse.length() == Approx(2 * std::sqrt(0.25 + 1)).margin(1e-5));
    for (const double t : {0.0, 0.2, 0.5, 0.7, 1.0}) {
        const glm::dvec3 point = coarse(t);
        CHECK(point.x == Approx(t).margin(1e-5));
        CHECK(point.y == Approx(4 * t * (1 - t)).margin(1e-5));
    }
    CHECK(coarse(-1) == coarse(0));
    CHECK(coarse(2) == coarse(1));
}

TEST_CASE("a curve of no length is a point", "[lsystem]") {
    const SpaceCurve point(Points3(4, {1, 2, 3}), Type::end_point);
    CHECK(point.length() < 1e-12);
    CHECK(glm::distance(point(0.3), {1, 2, 3}) < 1e-12);
}

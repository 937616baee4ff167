// What pictures are made of, without drawing any: cameras, visibility, colours, lengths.
#include "catch.h"
#include "picture/palette.h"
#include "picture/stage/camera_fit.h"
#include "picture/stage/colouring.h"
#include "picture/stage/legend.h"
#include "picture/stage/sky_visibility.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <random>

using namespace espalier;
using namespace espalier::picture;

namespace {

std::vector<glm::dvec3> cloud(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> within(-1, 1);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) points.emplace_back(3 * within(random), 2 + within(random), 0.5 * within(random));
    return points;
}

/// The largest distance from the middle of the frame, as a share of its half width and height: 1 touches its edge.
double reach(const std::vector<glm::dvec3>& points, const CameraView& view, double aspect, const Margins& margins) {
    const glm::dvec3 towards = glm::normalize(view.position - view.focus), right = glm::cross(view.up, towards);
    double most = 0;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 here = point - view.focus;
        const double depth = view.is_parallel ? 1 : view.distance - glm::dot(here, towards);
        const double half = view.is_parallel ? view.half_height : depth * std::tan(glm::radians(view.view_angle / 2));
        const double x = std::abs(glm::dot(here, right)) / half / aspect / (1 - margins.left - margins.right);
        const double y = std::abs(glm::dot(here, view.up)) / half / (1 - margins.bottom - margins.top);
        most = std::max({most, x, y});
    }
    return most;
}

struct Square {
    std::vector<glm::vec3> points;
    std::vector<std::int32_t> corners{0, 1, 2, 0, 2, 3};

    Square(float half, float height)
        : points{{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}} {}
    Occluder occluder() const { return {points, corners}; }
};

}  // namespace

TEST_CASE("camera: points touch the edge of the frame and none crosses it", "[pictures]") {
    const std::vector<glm::dvec3> points = cloud(200);
    for (const double aspect : {0.5, 1.0, 1.6}) {
        for (const CameraPlace place :
             {CameraPlace{0, 0}, CameraPlace{30, 12}, CameraPlace{111, -30}, CameraPlace{0, 90}}) {
            const Margins margins{0.04, 0.2, 0.1, 0.05};
            for (const bool is_parallel : {false, true}) {
                const CameraView view = fitted(points, place, false, is_parallel, aspect, margins);
                CHECK(reach(points, view, aspect, margins) == Approx(1).epsilon(1e-9));
                CHECK(glm::dot(view.up, view.position - view.focus) == Approx(0).margin(1e-9));
            }
        }
    }
}

TEST_CASE("camera: what turns stays in the frame at one distance", "[pictures]") {
    const std::vector<glm::dvec3> points = cloud(200);
    double distance = 0, most = 0;
    for (double azimuth = 0; azimuth < 360; azimuth += 15) {
        const CameraView view = fitted(points, {azimuth, 20}, true, false, 1.3, {});
        if (distance > 0) CHECK(view.distance == Approx(distance));
        distance = view.distance;
        most = std::max(most, reach(points, view, 1.3, {}));
    }
    CHECK(most <= 1 + 1e-9);
    CHECK(most > 0.95);
}

TEST_CASE("camera: nothing at all, one point, and zoom are no trouble", "[pictures]") {
    CHECK(fitted({}, {}, false, false, 1, {}).distance > 0);
    const std::vector<glm::dvec3> one{{1, 2, 3}};
    CHECK(std::isfinite(fitted(one, {}, false, false, 1, {}).position.x));
    const std::vector<glm::dvec3> points = cloud(50);
    CHECK(fitted(points, {0, 0, 2}, false, true, 1, {}).half_height ==
          Approx(fitted(points, {0, 0, 1}, false, true, 1, {}).half_height / 2));
    CHECK(reach(points, fitted(points, {0, 0, 2}, false, false, 1, {}), 1, {}) == Approx(2));
}

TEST_CASE("camera: an outline of few points stands for all", "[pictures]") {
    const std::vector<glm::dvec3> points = cloud(5000);
    Outline outline, halves[2];
    for (std::size_t i = 0; i < points.size(); ++i) {
        outline.add(points[i], 0);
        halves[i % 2].add(points[i], 0);
    }
    CHECK(outline.points().size() < 100);
    CHECK(reach(points, fitted(outline.points(), {40, 25}, false, false, 1.3, {}), 1.3, {}) < 1.03);
    halves[0].add(halves[1]);
    CHECK(halves[0].points() == outline.points());
}

TEST_CASE("visibility: under a roof it is dark, on it and far from it light", "[pictures]") {
    const Square roof(10, 1);
    const std::vector<Occluder> occluders{roof.occluder()};
    const SkyVisibility lit(occluders, glm::vec3(0, 1, 0));
    const glm::vec3 up(0, 1, 0);
    CHECK(lit.sky({0, 0, 0}, up, false) < 0.1);
    CHECK(lit.sun({0, 0, 0}, 1) == 0);
    CHECK(lit.sky({0, 1, 0}, up, true) > 0.99);
    CHECK(lit.sun({0, 1, 0}, 1) == 1);
    CHECK(lit.sky({40, 0, 0}, up, false) > 0.9);
    CHECK(lit.sun({11, 0, 0}, 1) == 1);
    // Under the edge half of the sky is seen.
    CHECK(lit.sky({10, 0, 0}, up, false) == Approx(0.5).margin(0.12));
}

TEST_CASE("visibility: a slanting sun throws the shadow sideways", "[pictures]") {
    const Square roof(1, 2);
    const std::vector<Occluder> occluders{roof.occluder()};
    const SkyVisibility lit(occluders, direction_at(90, 45));
    CHECK(lit.sun({-2, 0, 0}, 1) == 0);
    CHECK(lit.sun({0, 0, 0}, 1) == 1);
    CHECK(lit.sun({2, 0, 0}, 1) == 1);
    const float edge = lit.sun({-3, 0, 0}, 6);
    CHECK(edge > 0.2);
    CHECK(edge < 0.8);
}

TEST_CASE("visibility: nothing casts no shadow", "[pictures]") {
    const SkyVisibility lit({}, glm::vec3(0, 1, 0));
    CHECK(lit.sky({0, 0, 0}, {0, 1, 0}, false) == 1);
    CHECK(lit.sun({5, 0, 0}, 2) == 1);
}

TEST_CASE("palettes: ends and middles are their anchors, and what is beyond stays at the ends", "[pictures]") {
    CHECK(along(viridis(), 0) == Rgb{68, 1, 84});
    CHECK(along(viridis(), 0.5) == Rgb{33, 145, 140});
    CHECK(along(viridis(), 1) == Rgb{253, 231, 37});
    CHECK(along(viridis(), -3) == along(viridis(), 0));
    CHECK(along(viridis(), 7) == along(viridis(), 1));
    // Low values of fields look like the paper, whichever it is.
    CHECK(along(field_colours(0, false), 0)[0] > 200);
    CHECK(along(field_colours(0, true), 0)[0] < 50);
    CHECK(category_colour(0) != category_colour(1));
}

TEST_CASE("fields: between voxels they are linear, outside there is nothing", "[pictures]") {
    RecordedField field;
    field.size = {3, 2, 2};
    field.origin = {1, 2, 3};
    field.voxel = {0.5, 1, 2};
    for (int z = 0; z < 2; ++z) {
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) field.values.push_back(static_cast<float>(x + 10 * y + 100 * z));
        }
    }
    CHECK(sampled(field, {1, 2, 3}) == 0);
    CHECK(sampled(field, {2, 3, 5}) == 112);
    CHECK(sampled(field, {1.25, 2.5, 4}) == Approx(55.5));
    CHECK(sampled(field, {0.8, 2, 3}) == 0);  // still in the first voxel
    CHECK(std::isnan(sampled(field, {0.7, 2, 3})));
    CHECK(std::isnan(sampled(field, {1, 2, 6.1})));
    CHECK(std::isnan(sampled(field, {std::nan(""), 2, 3})));
}

TEST_CASE("scale bars: 1, 2 or 5, in a unit that reads well", "[pictures]") {
    CHECK(nice_length(3.7).text == "2 m");
    CHECK(nice_length(0.99).text == "50 cm");
    CHECK(nice_length(0.012).text == "1 cm");
    CHECK(nice_length(0.0061).text == "5 mm");
    CHECK(nice_length(2600).text == "2 km");
    CHECK(nice_length(5).metres == 5);
    CHECK(nice_length(0).metres == 0);
}

#include "timeline/measures/highest_point.h"

#include "catch.h"

#include <memory>
#include <utility>

using namespace espalier;
using namespace espalier::timeline;

TEST_CASE("a plant is as high as its highest point: an upright axis as its tip, a level one as its side",
          "[timeline]") {
    PlantGeometry geometry;
    CHECK(!highest_point(geometry));
    const auto add = [&](const glm::dvec3& base, const glm::dvec3& tip, double base_radius, double tip_radius) {
        geometry.internodes.push_back({0, 0, 0, 0, 0, base, tip, base_radius, tip_radius});
        return highest_point(geometry).value();
    };
    CHECK(add({0, 0, 0}, {0, 2, 0}, 0.5, 0.5) == 2);
    CHECK(add({0, 3, 0}, {0, 3, 0}, 9, 9) == 3);  // no length, no side
    CHECK(add({0, 3, 0}, {1, 3, 0}, 0.25, 0.5) == 3.5);
    CHECK(add({0, 3, 0}, {3, 7, 0}, 1, 1) == Approx(7.6));  // 3:4:5
    CHECK(add({0, 7, 0}, {3, 3, 0}, 2, 1) == Approx(8.2));  // downwards: its base is the top
    Organ organ{0, Organ::Shape::sphere, 0, 0, 0, Pose(), glm::dvec3(2)};
    organ.pose.position.y = 8;
    geometry.organs = {organ};
    CHECK(highest_point(geometry) == 9.0);
    geometry.organs[0].shape = Organ::Shape::disc;  // upright, as the turtle begins
    CHECK(highest_point(geometry) == 9.0);
    std::swap(geometry.organs[0].pose.up, geometry.organs[0].pose.heading);
    CHECK(highest_point(geometry) == Approx(8.2));
    geometry.vertices = {{0, 10, 0}};
    CHECK(highest_point(geometry) == 10.0);
}

TEST_CASE("a surface is as high as its control points, wherever it is turned", "[timeline]") {
    Surface leaf;
    leaf.triangles.push_back({SurfaceVertex{{0, 0, 0}, {}, {}}, {{1, 0, 0}, {}, {}}, {{0, 3, 0}, {}, {}}});
    Shapes shapes;
    shapes.surfaces['l'] = leaf;
    PlantGeometry geometry;
    geometry.shapes = std::make_shared<const Shapes>(shapes);
    Organ organ{0, Organ::Shape::surface, 0, 0, 'l', Pose(), glm::dvec3(2)};
    organ.pose.position.y = 1;
    geometry.organs = {organ};
    CHECK(highest_point(geometry) == 7.0);
    geometry.organs[0].pose.heading = {0, -1, 0};
    CHECK(highest_point(geometry) == 1.0);
    geometry.organs[0].pose = {{0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    CHECK(highest_point(geometry) == 3.0);
}

TEST_CASE("a surface that no view file describes is as high as the rhombus that is drawn for it", "[timeline]") {
    PlantGeometry geometry;
    Organ organ{0, Organ::Shape::surface, 0, 0, 'l', Pose(), glm::dvec3(4, 6, 1)};
    organ.pose.position.y = 1;
    geometry.organs = {organ};
    CHECK(highest_point(geometry) == 7.0);
    std::swap(geometry.organs[0].pose.heading, geometry.organs[0].pose.left);  // its widest place lies half-way
    CHECK(highest_point(geometry) == 2.0);
    geometry.organs[0].pose.left = {0, -1, 0};
    CHECK(highest_point(geometry) == 2.0);
}

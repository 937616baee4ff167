#include "espalier/geometry/plant_geometry.h"

#include "catch.h"

#include <numbers>

using namespace espalier;
using namespace espalier::geometry;

TEST_CASE("an empty box stays empty until something is added", "[geometry]") {
    Box box;
    CHECK(box.empty());
    box.add(Box{});
    CHECK(box.empty());
    box.add(glm::dvec3(1, -2, 3));
    CHECK_FALSE(box.empty());
    CHECK(box.lower == glm::dvec3(1, -2, 3));
    CHECK(box.upper == glm::dvec3(1, -2, 3));
}

TEST_CASE("a box contains the boxes added to it, and no more", "[geometry]") {
    Box box, other;
    box.add(glm::dvec3(0, 0, 0));
    other.add(glm::dvec3(-1, 2, 0));
    other.add(glm::dvec3(1, 3, -4));
    box.add(other);
    CHECK(box.lower == glm::dvec3(-1, 0, -4));
    CHECK(box.upper == glm::dvec3(1, 3, 0));
}

TEST_CASE("a plant's volume is that of its truncated cones", "[geometry]") {
    PlantGeometry geometry;
    geometry.internodes.push_back({0, 0, 0, 0, 0, {0, 0, 0}, {0, 3, 0}, 1, 1});
    geometry.internodes.push_back({1, 0, 0, 0, 0, {0, 3, 0}, {0, 6, 0}, 1, 0});
    CHECK(total_length(geometry) == Approx(6));
    CHECK(total_volume(geometry) == Approx(3 * std::numbers::pi + std::numbers::pi));
}

TEST_CASE("a cleared geometry is as new", "[geometry]") {
    PlantGeometry geometry;
    geometry.internodes.push_back({0, 0, 0, 0, 0, {0, 0, 0}, {0, 3, 0}, 1, 1});
    geometry.polygons.push_back({0, 0, 3, 0, 0});
    geometry.vertices.resize(3);
    geometry.organs.emplace_back();
    geometry.axes = 4;
    geometry.bounds.add(glm::dvec3(1));
    geometry.clear();
    CHECK(geometry.internodes.empty());
    CHECK(geometry.polygons.empty());
    CHECK(geometry.vertices.empty());
    CHECK(geometry.organs.empty());
    CHECK(geometry.axes == 0);
    CHECK(geometry.bounds.empty());
}

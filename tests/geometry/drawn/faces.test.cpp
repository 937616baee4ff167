// What light meets of a drawn plant: areas, owners and both sides of its faces.
#include "geometry/drawn/faces.h"

#include "espalier/geometry/generalized_cylinder.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <memory>
#include <numbers>

using namespace espalier;

namespace {

double area_of(const DrawnFaces& faces) {
    double area = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i].for_triangles([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            area += glm::length(glm::cross(b - a, c - a)) / 2;
        });
    }
    return area;
}

/// An organ whose surface is a flat square of 1 m: one patch with colours of its own.
PlantGeometry square_leaf(int top, int bottom) {
    Surface surface;
    surface.precision_s = surface.precision_t = 1;
    BicubicPatch& patch = surface.patches.emplace_back();
    patch.top_colour = top;
    patch.bottom_colour = bottom;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            patch.points[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = {row / 3.0, column / 3.0,
                                                                                             0};
        }
    }
    auto shapes = std::make_shared<Shapes>();
    shapes->surfaces['l'] = surface;
    PlantGeometry geometry;
    geometry.shapes = shapes;
    Organ& organ = geometry.organs.emplace_back();
    organ.module = 7;
    organ.shape = Organ::Shape::surface;
    organ.surface = 'l';
    organ.size = {2, 3, 1};
    organ.colour = 4;
    organ.look.back_colour = 5;
    return geometry;
}

}  // namespace

TEST_CASE("a stem has the surface of its cone, and its front outside", "[geometry]") {
    PlantGeometry geometry;
    geometry.internodes.push_back({3, 0, 0, 9, 0, {1, 2, 3}, {1, 2, 7}, 0.2, 0.1});
    DrawnFaces faces;
    faces.add_stems(2, geometry);
    REQUIRE(faces.size() == 12);
    // The mantle of a prism that narrows little: its perimeter is that of the circle.
    CHECK(area_of(faces) == Approx(std::numbers::pi * (0.2 + 0.1) * 4).epsilon(1e-3));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const DrawnFace face = faces[i];
        CHECK(face.owner.plant == 2);
        CHECK(face.owner.module == 3);
        CHECK(face.owner.colour == 9);
        CHECK(face.owner.of == FaceOf::stem);
        CHECK(glm::dot(face.area(), face.middle() - glm::dvec3(1, 2, face.middle().z)) > 0);
    }
}

TEST_CASE("internodes without length or thickness are no stems", "[geometry]") {
    PlantGeometry geometry;
    geometry.internodes.push_back({0, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 1, 1});
    geometry.internodes.push_back({1, 0, 0, 0, 1, {0, 0, 0}, {0, 1, 0}, 0, 0});
    DrawnFaces faces;
    faces.add_stems(0, geometry);
    CHECK(faces.size() == 0);
}

TEST_CASE("a disc is a leaf of its area", "[geometry]") {
    PlantGeometry geometry;
    Organ& disc = geometry.organs.emplace_back();
    disc.shape = Organ::Shape::disc;
    disc.size = {0.3, 0, 0};
    DrawnFaces faces;
    faces.add_leaves(0, geometry);
    REQUIRE(faces.size() == 1);
    CHECK(area_of(faces) == Approx(std::numbers::pi * 0.15 * 0.15));
}

TEST_CASE("a surface is a leaf as large as it was stretched, with the colours of both sides", "[geometry]") {
    DrawnFaces faces;
    faces.add_leaves(0, square_leaf(0, 0));
    CHECK(area_of(faces) == Approx(6));
    CHECK(faces[0].owner.module == 7);
    CHECK(faces[0].owner.of == FaceOf::leaf);
    CHECK(faces[0].owner.colour == 4);
    CHECK(faces[0].owner.back_colour == 5);

    const Palette colour_map;
    faces.clear();
    faces.add_leaves(0, square_leaf(11, 12), &colour_map);
    CHECK(faces[0].owner.colour == 11);
    CHECK(faces[0].owner.back_colour == 12);

    Palette materials;
    materials.of_materials = true;
    faces.clear();
    faces.add_leaves(0, square_leaf(11, 12), &materials);
    CHECK(faces[0].owner.colour == 4);
}

TEST_CASE("a surface that no view file describes is the rhombus that pictures show", "[geometry]") {
    PlantGeometry geometry = square_leaf(0, 0);
    geometry.shapes.reset();
    DrawnFaces faces;
    faces.add_leaves(0, geometry);
    REQUIRE(faces.size() == 1);
    CHECK(area_of(faces) == Approx(0.5 * (0.5 * 2) * 3));  // half as wide as its scale says
    CHECK(glm::dot(faces[0].area(), geometry.organs[0].pose.up) > 0);
}

TEST_CASE("a sphere is a body with its surface, turned outward, whatever its sides", "[geometry]") {
    for (const std::uint16_t sides : {3, 8, 31}) {
        PlantGeometry geometry;
        Organ& sphere = geometry.organs.emplace_back();
        sphere.module = 4;
        sphere.shape = Organ::Shape::sphere;
        sphere.size = {0.3, 0, 0};
        sphere.sides = sides;
        sphere.pose.position = {5, 6, 7};
        DrawnFaces faces;
        faces.add_leaves(0, geometry);
        CHECK(faces.size() == 0);
        faces.add_bodies(0, geometry);
        double surface = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            CHECK(faces[i].owner.of == FaceOf::body);
            CHECK(faces[i].owner.module == 4);
            CHECK(glm::dot(faces[i].area(), faces[i].middle() - sphere.pose.position) > 0);
            surface += glm::length(faces[i].area());
        }
        CHECK(surface == Approx(std::numbers::pi * 0.09));
    }
}

TEST_CASE("a closed cylinder is a stem, and one with an open contour is a leaf", "[geometry]") {
    const Contour half(std::vector<glm::dvec3>{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, false);
    for (const Contour* const contour : {static_cast<const Contour*>(nullptr), &half}) {
        PlantGeometry geometry;
        GeneralizedCylinder cylinder;
        cylinder.sides = 40;
        for (const double y : {0.0, 2.0}) {
            CylinderPoint& point = cylinder.points.emplace_back();
            point.module = 3;
            point.pose.position = {0, y, 0};
            point.width = 0.2;
            point.contour = contour;
        }
        draw(cylinder, geometry);
        DrawnFaces leaves, bodies;
        leaves.add_leaves(0, geometry);
        bodies.add_bodies(0, geometry);
        const DrawnFaces &some = contour ? leaves : bodies, &none = contour ? bodies : leaves;
        CHECK(none.size() == 0);
        REQUIRE(some.size() > 0);
        CHECK(some[0].owner.module == 3);
        CHECK(some[0].owner.of == (contour ? FaceOf::leaf : FaceOf::stem));
        if (contour) continue;
        // The mantle and both ends.
        CHECK(area_of(some) == Approx(std::numbers::pi * (0.2 * 2 + 0.02)).epsilon(0.005));
    }
}

TEST_CASE("the triangles of a polygon are as large as the polygon", "[geometry]") {
    PlantGeometry geometry;
    geometry.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 0, -2}, {2, 0, -3}, {0, 0, -2}};
    geometry.polygons.push_back({1, 0, 5, 0, 6, {8, 1}});
    DrawnFaces faces;
    faces.add_leaves(0, geometry);
    REQUIRE(faces.size() == 1);
    CHECK(glm::length(faces[0].area()) == Approx(10));
    CHECK(area_of(faces) == Approx(10));
    CHECK(faces[0].area().y > 0);  // seen from above the corners run counter-clockwise
    CHECK(faces[0].owner.back_colour == 8);
    CHECK(faces[0].owner.texture == 1);
}

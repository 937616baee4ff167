#include "espalier/geometry/generalized_cylinder.h"

#include "catch.h"
#include "geometry/mesh_checks.h"

#include <cmath>
#include <functional>
#include <numbers>

using namespace espalier;
using namespace espalier::geometry;
using std::numbers::pi;

namespace {

using Curve = GeneralizedCylinder::Curve;

CylinderPoint point(glm::dvec3 position, glm::dvec3 heading = {0, 1, 0}, double width = 1) {
    CylinderPoint result;
    result.pose.position = position;
    result.pose.heading = glm::normalize(heading);
    const glm::dvec3 other = std::abs(result.pose.heading.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(1, 0, 0);
    result.pose.left = glm::normalize(glm::cross(result.pose.heading, other));
    result.pose.up = glm::cross(result.pose.left, result.pose.heading);
    result.width = width;
    result.strips = 8;
    return result;
}

/// Points on a curve, with its derivative as heading.
GeneralizedCylinder along(const std::function<glm::dvec3(double)>& curve, double from, double to, int points) {
    GeneralizedCylinder cylinder;
    for (int i = 0; i < points; ++i) {
        const double t = from + (to - from) * i / (points - 1);
        cylinder.points.push_back(point(curve(t), curve(t + 1e-5) - curve(t - 1e-5), 0.3));
    }
    return cylinder;
}

glm::dvec3 helix(double t) {
    return {std::cos(t), 0.4 * t, std::sin(t)};
}

glm::dvec3 snake(double t) {
    return {std::sin(t), t, 0.05 * t * t};
}

PlantGeometry drawn(const GeneralizedCylinder& cylinder) {
    PlantGeometry geometry;
    draw(cylinder, geometry);
    return geometry;
}

/// How far the frames turn about the curve from ring to ring, summed over the rings.
double total_twist(const std::vector<CylinderRing>& rings) {
    double sum = 0;
    for (std::size_t i = 1; i < rings.size(); ++i) {
        const Pose &a = rings[i - 1].frame, &b = rings[i].frame;
        // Carry `up` over by the smallest rotation that takes one heading to the other.
        const glm::dvec3 axis = glm::cross(a.heading, b.heading);
        const glm::dvec3 moved = a.up + glm::cross(axis, a.up) +
                                 glm::cross(axis, glm::cross(axis, a.up)) / (1 + glm::dot(a.heading, b.heading));
        sum += std::abs(std::atan2(glm::dot(glm::cross(moved, b.up), b.heading), glm::dot(moved, b.up)));
    }
    return sum;
}

}  // namespace

TEST_CASE("ring normals are parallel to the curve's tangent", "[geometry]") {
    const GeneralizedCylinder cylinder = along(helix, 0, 6, 40);
    const auto rings = rings_of(cylinder);
    REQUIRE(rings.size() == 39 * 8 + 1);
    for (std::size_t i = 1; i + 1 < rings.size(); ++i) {
        const glm::dvec3 chord = rings[i + 1].frame.position - rings[i - 1].frame.position;
        CHECK(glm::dot(glm::normalize(chord), rings[i].frame.heading) > 1 - 1e-6);
    }
    for (std::size_t i = 0; i < cylinder.points.size(); ++i) {  // at control points they are the turtle's headings
        CHECK(glm::distance(rings[8 * i].frame.heading, cylinder.points[i].pose.heading) < 1e-12);
    }
}

TEST_CASE("ring points lie in the ring's plane at half the width", "[geometry]") {
    GeneralizedCylinder cylinder = along(helix, 0, 6, 10);
    cylinder.sides = 6;
    const auto rings = rings_of(cylinder);
    const PlantGeometry geometry = drawn(cylinder);
    double off_plane = 0, off_radius = 0, off_angle = 0;
    // The first cap's 8 vertices follow the first ring's 7.
    const auto vertex = [&](std::size_t ring, std::size_t k) {
        return geometry.mesh.vertices[7 * ring + k + (ring > 0 ? 8 : 0)].position - rings[ring].frame.position;
    };
    for (std::size_t i = 0; i < rings.size(); ++i) {
        for (std::size_t k = 0; k < 6; ++k) {
            const glm::dvec3 a = vertex(i, k), b = vertex(i, k + 1);
            off_plane = std::max(off_plane, std::abs(glm::dot(a, rings[i].frame.heading)));
            off_radius = std::max(off_radius, std::abs(glm::length(a) - rings[i].width / 2));
            off_angle = std::max(off_angle, std::abs(glm::dot(glm::normalize(a), glm::normalize(b)) - 0.5));
        }
    }
    CHECK(off_plane < 1e-9);
    CHECK(off_radius < 1e-9);
    CHECK(off_angle < 1e-9);  // six sides: 60 degrees
}

TEST_CASE("frames twist less than Frenet's, to the order of the step", "[geometry]") {
    const auto rings = rings_of(along(helix, 0, 6, 60));
    // The Frenet frame turns by the torsion 0.4 / (1 + 0.16) per unit of length.
    const double frenet = 0.4 / 1.16 * rings.back().along;
    CHECK(frenet > 2);
    CHECK(total_twist(rings) < 1e-3 * frenet);
}

TEST_CASE("frames do not flip where the curve changes its bend", "[geometry]") {
    const auto rings = rings_of(along(snake, -6, 6, 30));
    for (std::size_t i = 1; i < rings.size(); ++i) CHECK(glm::dot(rings[i].frame.up, rings[i - 1].frame.up) > 0.95);
}

TEST_CASE("frames are orthonormal, up = left x heading", "[geometry]") {
    for (const CylinderRing& ring : rings_of(along(helix, 0, 20, 50))) {
        CHECK(glm::distance(ring.frame.up, glm::cross(ring.frame.left, ring.frame.heading)) < 1e-12);
        CHECK(glm::length(ring.frame.left) == Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("a curve straight down, and one back on itself, have frames too", "[geometry]") {
    GeneralizedCylinder down;
    down.points = {point({0, 0, 0}, {0, -1, 0}), point({0, -2, 0}, {0, -1, 0})};
    for (const CylinderRing& ring : rings_of(down)) CHECK(ring.frame.heading == glm::dvec3(0, -1, 0));
    CHECK(enclosed_volume(drawn(down).mesh) > 0);
    GeneralizedCylinder turning;  // on the spot, about
    turning.points = {point({0, 0, 0}, {0, 1, 0}), point({0, 0, 0}, {1, 0, 0}), point({0, 0, 0}, {-1, 0, 0})};
    for (const CylinderRing& ring : rings_of(turning)) {
        CHECK(glm::length(ring.frame.heading) == Approx(1));
        CHECK(glm::dot(ring.frame.heading, ring.frame.up) == Approx(0).margin(1e-9));
    }
    CHECK(glm::distance(rings_of(turning)[8].frame.up, glm::dvec3(0, 0, -1)) < 1e-9);  // across the plane of the turn
}

TEST_CASE("a straight tube has the volume of its polygon", "[geometry]") {
    for (const int sides : {3, 6, 8, 60}) {
        GeneralizedCylinder cylinder;
        cylinder.sides = sides;
        cylinder.points = {point({0, 0, 0}), point({0, 2, 0}), point({0, 5, 0})};
        const PlantGeometry geometry = drawn(cylinder);
        const double r = 0.5;
        CHECK(enclosed_volume(geometry.mesh) == Approx(sides / 2.0 * r * r * std::sin(2 * pi / sides) * 5));
        CHECK(EdgeCount(geometry.mesh).closed);
        CHECK(worst_normal(geometry.mesh) > std::cos(pi / sides) - 1e-9);
        CHECK(geometry.bounds.upper.y == Approx(5));
    }
}

TEST_CASE("tubes are watertight with two sides, closed or open, whatever their curve", "[geometry]") {
    for (const Curve curve : {Curve::open_hermite, Curve::closed_hermite, Curve::open_spline, Curve::closed_spline}) {
        GeneralizedCylinder cylinder = along(
            [](double t) { return glm::dvec3(std::cos(t), std::sin(t), 0.2 * std::sin(2 * t)); }, 0, 2 * pi * 7 / 8, 8);
        cylinder.curve = curve;
        const PlantGeometry geometry = drawn(cylinder);
        const EdgeCount edges(geometry.mesh);
        INFO(int(curve));
        CHECK(edges.closed);
        // Euler's characteristic: 2 for a capped tube, 0 for a ring.
        const auto faces = long(edges.edges) * 2 / 3;
        CHECK(long(edges.places) - long(edges.edges) + faces == (cylinder.closed() ? 0 : 2));
        CHECK(enclosed_volume(geometry.mesh) > 0.3);
        CHECK(worst_normal(geometry.mesh) > 0.85);
        CHECK(geometry.mesh.pieces.size() == (cylinder.closed() ? 8 : 7));
    }
}

TEST_CASE("Hermite tubes go through their points, splines begin and end at theirs", "[geometry]") {
    GeneralizedCylinder cylinder = along(snake, 0, 6, 7);
    auto rings = rings_of(cylinder);
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK(glm::distance(rings[8 * i].frame.position, cylinder.points[i].pose.position) < 1e-12);
    }
    cylinder.curve = Curve::open_spline;
    rings = rings_of(cylinder);
    CHECK(glm::distance(rings.front().frame.position, cylinder.points.front().pose.position) < 1e-12);
    CHECK(glm::distance(rings.back().frame.position, cylinder.points.back().pose.position) < 1e-12);
    const glm::dvec3 knot =
        (cylinder.points[1].pose.position + 4.0 * cylinder.points[2].pose.position + cylinder.points[3].pose.position) /
        6.0;
    CHECK(glm::distance(rings[16].frame.position, knot) < 1e-12);
}

TEST_CASE("a Hermite stretch has the tangents its factors say", "[geometry]") {
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0}, {0, 1, 0}), point({3, 4, 0}, {1, 0, 0})};
    cylinder.points[1].strips = 2;
    cylinder.points[0].tangent_after = 2;
    cylinder.points[1].tangent_before = 0.5;
    // p(1/2) = (P0 + P1) / 2 + (T0 - T1) / 8 with |P1 - P0| = 5.
    const glm::dvec3 expected = glm::dvec3(1.5, 2, 0) + (glm::dvec3(0, 10, 0) - glm::dvec3(2.5, 0, 0)) / 8.0;
    CHECK(glm::distance(rings_of(cylinder)[1].frame.position, expected) < 1e-12);
}

TEST_CASE("widths go smoothly from point to point and do not overshoot", "[geometry]") {
    GeneralizedCylinder cylinder;
    const double widths[] = {4, 3, 1, 1, 2};
    for (int i = 0; i < 5; ++i) cylinder.points.push_back(point({0, double(i), 0}, {0, 1, 0}, widths[i]));
    const std::size_t strips = 64;
    for (CylinderPoint& p : cylinder.points) p.strips = int(strips);
    const auto rings = rings_of(cylinder);
    for (std::size_t i = 0; i < 5; ++i) CHECK(rings[strips * i].width == Approx(widths[i]));
    for (std::size_t i = 1; i < rings.size(); ++i) {
        CHECK(rings[i].width >= 1 - 1e-12);
        CHECK((i > 2 * strips || rings[i].width < rings[i - 1].width));
    }
    // The slope does not jump where two stretches meet.
    const double before = rings[strips].width - rings[strips - 1].width;
    const double after = rings[strips + 1].width - rings[strips].width;
    CHECK(before < -0.01);
    CHECK(std::abs(before - after) < 0.1 * std::abs(before));
}

TEST_CASE("radius tangents set the slopes of the radius", "[geometry]") {
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0}), point({0, 2, 0})};
    RadiusTangents tangents;
    tangents.angle_after = tangents.angle_before = pi / 2;
    tangents.length_after = tangents.length_before = 0.25;
    for (CylinderPoint& p : cylinder.points) p.radius = tangents;
    cylinder.points[1].strips = 4;
    // Width 1 at both ends and dw/du = 0.5 there: at u = 1/4 the Hermite weights of the tangents are 9/64 and -3/64.
    CHECK(rings_of(cylinder)[1].width == Approx(1 + 0.5 * (9.0 / 64 - 3.0 / 64)));
    for (CylinderPoint& p : cylinder.points) p.radius->scaled = true;  // times the distance 2
    CHECK(rings_of(cylinder)[1].width == Approx(1 + 1.0 * (9.0 / 64 - 3.0 / 64)));
}

TEST_CASE("a cylinder that follows the roll turns with the turtle", "[geometry]") {
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0}), point({0, 1, 0})};
    Pose& end = cylinder.points[1].pose;
    end.up = {1, 0, 0};
    end.left = glm::cross(end.heading, end.up);
    CHECK(rings_of(cylinder).back().frame.up.z == -1);
    cylinder.points[1].follows_roll = true;
    const auto rings = rings_of(cylinder);
    CHECK(glm::distance(rings.back().frame.up, {1, 0, 0}) < 1e-12);
    CHECK(glm::distance(rings[4].frame.up, glm::normalize(glm::dvec3(1, 0, -1))) < 1e-12);
}

TEST_CASE("a contour stands with its x along up and its y to the right, in half widths", "[geometry]") {
    const Contour diamond({{1, 0, 0}, {0, 2, 0}, {-1, 0, 0}, {0, -2, 0}}, true);
    GeneralizedCylinder cylinder;
    cylinder.sides = 4;
    cylinder.points = {point({0, 0, 0}, {0, 1, 0}, 2), point({0, 1, 0}, {0, 1, 0}, 2)};
    for (CylinderPoint& p : cylinder.points) p.contour = &diamond;
    const auto& vertices = drawn(cylinder).mesh.vertices;
    CHECK(glm::distance(vertices[0].position, {0, 0, -4.0 / 3}) < 1e-12);
    CHECK(glm::distance(vertices[1].position, {2.0 / 3, 0, 0}) < 1e-12);
    CHECK(glm::distance(vertices[2].position, {0, 0, 4.0 / 3}) < 1e-12);
    CHECK(glm::distance(vertices[3].position, {-2.0 / 3, 0, 0}) < 1e-12);
}

TEST_CASE("between different contours vertices are interpolated linearly", "[geometry]") {
    const Contour diamond({{3, 0, 0}, {0, 3, 0}, {-3, 0, 0}, {0, -3, 0}}, true);  // radius 2 at its corners
    GeneralizedCylinder cylinder;
    cylinder.sides = 4;
    cylinder.points = {point({0, 0, 0}, {0, 1, 0}, 2), point({0, 4, 0}, {0, 1, 0}, 2)};
    cylinder.points[1].contour = &diamond;
    cylinder.points[1].strips = 4;
    const PlantGeometry geometry = drawn(cylinder);
    CHECK(EdgeCount(geometry.mesh).closed);
    // Vertices of ring i: 5 of ring 0, 6 of the cap, then 5 a ring.
    for (std::size_t ring = 1; ring <= 4; ++ring) {
        CHECK(geometry.mesh.vertices[11 + 5 * (ring - 1)].position.z == Approx(-(1 + 0.25 * double(ring))));
    }
}

TEST_CASE("a clockwise contour makes a tube that faces outward too", "[geometry]") {
    const Contour clockwise({{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}}, true);
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0}), point({0, 1, 0})};
    for (CylinderPoint& p : cylinder.points) p.contour = &clockwise;
    const PlantGeometry geometry = drawn(cylinder);
    CHECK(enclosed_volume(geometry.mesh) > 0.1);
    CHECK(worst_normal(geometry.mesh) > 0.9);
    CHECK(EdgeCount(geometry.mesh).closed);
}

TEST_CASE("an open contour makes a sheet without caps", "[geometry]") {
    const Contour arc({{-1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 1, 0}}, false);
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0}), point({0, 1, 0})};
    for (CylinderPoint& p : cylinder.points) p.contour = &arc;
    const PlantGeometry geometry = drawn(cylinder);
    CHECK_FALSE(EdgeCount(geometry.mesh).closed);
    CHECK(geometry.mesh.vertices.size() == 9 * 9);
    CHECK(worst_normal(geometry.mesh) > 0.9);
}

TEST_CASE("textures go round once and along by circumferences", "[geometry]") {
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0}), point({0, 2, 0})};
    cylinder.texture_ratio = 2;
    const auto& vertices = drawn(cylinder).mesh.vertices;
    CHECK(vertices[0].uv.x == 0);
    CHECK(vertices[4].uv.x == 0.5);
    CHECK(vertices[8].uv.x == 1);
    const SurfaceVertex& last_of_tube = vertices[vertices.size() - 1 - 10];
    CHECK(last_of_tube.position.y == Approx(2));
    CHECK(last_of_tube.uv.y == Approx(2 / (pi * 1) / 2));
}

TEST_CASE("pieces belong to the control points they lead to", "[geometry]") {
    GeneralizedCylinder cylinder;
    for (unsigned i = 0; i < 3; ++i) {
        cylinder.points.push_back(point({0, double(i), 0}));
        cylinder.points.back().module = 10 + i;
        cylinder.points.back().colour = std::uint16_t(i);
    }
    const auto& mesh = drawn(cylinder).mesh;
    REQUIRE(mesh.pieces.size() == 2);
    CHECK(mesh.pieces[0].module == 11);
    CHECK(mesh.pieces[1].module == 12);
    CHECK(mesh.pieces[1].colour == 2);
    CHECK(mesh.pieces[0].count == 3 * (8 + 8 * 8 * 2));  // a cap and eight strips
    CHECK(mesh.pieces[1].first == mesh.pieces[0].count);
    CHECK(mesh.pieces[1].first + mesh.pieces[1].count == mesh.triangles.size());
}

TEST_CASE("one control point draws nothing", "[geometry]") {
    GeneralizedCylinder cylinder;
    cylinder.points = {point({0, 0, 0})};
    CHECK(drawn(cylinder).mesh.vertices.empty());
    CHECK(rings_of(GeneralizedCylinder{}).empty());
}

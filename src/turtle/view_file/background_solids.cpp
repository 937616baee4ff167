#include "turtle/view_file/background_solids.h"

#include "espalier/base/math.h"

#include <glm/geometric.hpp>

#include <numbers>

namespace espalier::turtle {
namespace {

constexpr std::uint32_t sides = 24, stacks = 12;

void add_quadrilateral(Solid& solid, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    solid.triangles.insert(solid.triangles.end(), {a, b, c, a, c, d});
}

glm::dvec3 around(std::uint32_t k) {
    const double angle = 2 * std::numbers::pi * (k % sides) / sides;
    return {math::sin(angle), 0, math::cos(angle)};
}

void add_disc(Solid& solid, double radius, double height, double side) {
    if (radius == 0) return;
    const auto centre = std::uint32_t(solid.vertices.size());
    const glm::dvec3 up(0, height, 0), normal(0, side, 0);
    solid.vertices.push_back({up, normal, {}});
    for (std::uint32_t k = 0; k < sides; ++k) solid.vertices.push_back({up + radius * around(k), normal, {}});
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t here = centre + 1 + k, next = centre + 1 + (k + 1) % sides;
        solid.triangles.insert(solid.triangles.end(), {centre, side > 0 ? here : next, side > 0 ? next : here});
    }
}

}  // namespace

Solid solid_box(const glm::dvec3& size) {
    Solid box;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 u(0), v(0), w(0);
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        w[axis] = size[axis];
        glm::dvec3 normal(0);
        for (const bool far : {false, true}) {
            normal[axis] = far ? 1 : -1;
            const auto first = std::uint32_t(box.vertices.size());
            for (const glm::dvec3& corner : {glm::dvec3(0), far ? u : v, u + v, far ? v : u}) {
                box.vertices.push_back({(far ? w : glm::dvec3(0)) + corner, normal, {}});
            }
            add_quadrilateral(box, first, first + 1, first + 2, first + 3);
        }
    }
    return box;
}

Solid solid_cone(double base_radius, double top_radius, double height) {
    Solid cone;
    for (std::uint32_t k = 0; k <= sides; ++k) {
        const glm::dvec3 out = around(k);
        const glm::dvec3 slope = height * out + glm::dvec3(0, base_radius - top_radius, 0);
        const glm::dvec3 normal = glm::length(slope) > 0 ? glm::normalize(slope) : out;
        cone.vertices.push_back({base_radius * out, normal, {}});
        cone.vertices.push_back({top_radius * out + glm::dvec3(0, height, 0), normal, {}});
    }
    for (std::uint32_t k = 0; k < sides; ++k) add_quadrilateral(cone, 2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1);
    add_disc(cone, base_radius, 0, -1);
    add_disc(cone, top_radius, height, 1);
    return cone;
}

Solid solid_sphere(double radius) {
    Solid sphere;
    for (std::uint32_t i = 0; i <= stacks; ++i) {
        const double latitude = std::numbers::pi * (double(i) / stacks - 0.5);
        for (std::uint32_t k = 0; k <= sides; ++k) {
            const glm::dvec3 normal = math::cos(latitude) * around(k) + glm::dvec3(0, math::sin(latitude), 0);
            sphere.vertices.push_back({radius * normal, normal, {}});
        }
    }
    for (std::uint32_t i = 0; i < stacks; ++i) {
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t here = i * (sides + 1) + k, above = here + sides + 1;
            add_quadrilateral(sphere, here, here + 1, above + 1, above);
        }
    }
    return sphere;
}

glm::dvec3 fan_normal(const std::vector<SurfaceVertex>& vertices) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        sum += glm::cross(vertices[i].position, vertices[(i + 1) % vertices.size()].position);
    }
    const double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec3(0, 0, 1);
}

}  // namespace espalier::turtle

#include "environment/rays/lit_triangles.h"

#include "espalier/base/math.h"

#include "environment/rays/solid_surface.h"
#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace espalier::environment {

void LitTriangles::clear() {
    corners_.clear();
    owners_.clear();
    parts_.clear();
    bounds_ = {};
}

void LitTriangles::add(const PlantGeometry& geometry, std::uint32_t first_slot, std::uint32_t plant,
                       const Optics& optics) {
    parts_.push_back({owners_.size(), {}});
    leaves_.collect(geometry);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        const auto& [module, colour, corners] = leaves_[i];
        const Owner owner{first_slot + module, optics.require_material(LitKind::leaf, colour, plant), LitKind::leaf};
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) add(corners[0], corners[k], corners[k + 1], owner);
    }
    for (const Internode& internode : geometry.internodes) {
        const std::uint16_t material = optics.require_material(LitKind::stem, internode.colour, plant);
        add_stem(internode, {first_slot + internode.module, material, LitKind::stem});
    }
}

void LitTriangles::add(const Shape& solid, double voxel) {
    parts_.push_back({owners_.size(), {}});
    const TriangleMesh mesh = surface_of(solid, voxel);
    for (const auto& [a, b, c] : mesh.triangles) {
        add(mesh.points[a], mesh.points[b], mesh.points[c], {0, 0, LitKind::solid});
    }
}

void LitTriangles::add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Owner owner) {
    for (const glm::dvec3& corner : {a, b, c}) {
        corners_.emplace_back(corner);
        bounds_.add(corner);
        parts_.back().bounds.add(corner);
    }
    owners_.push_back(owner);
}

void LitTriangles::add_stem(const Internode& internode, Owner owner) {
    const glm::dvec3 along = internode.tip - internode.base;
    const double length = glm::length(along);
    if (!(length > 0) || !(internode.base_radius + internode.tip_radius > 0)) return;
    constexpr int sides = 6;
    constexpr double same_perimeter = std::numbers::pi / 3;  // six chords of a circle of this radius are 2 pi long
    const glm::dvec3 x = any_across(along / length), y = glm::cross(along / length, x);
    std::array<glm::dvec3, sides + 1> low, high;
    for (int i = 0; i <= sides; ++i) {
        const double angle = 2 * std::numbers::pi * (i % sides) / sides;
        const glm::dvec3 out = same_perimeter * (math::cos(angle) * x + math::sin(angle) * y);
        low[i] = internode.base + internode.base_radius * out;
        high[i] = internode.tip + internode.tip_radius * out;
    }
    for (int i = 0; i < sides; ++i) {
        add(low[i], low[i + 1], high[i + 1], owner);
        add(low[i], high[i + 1], high[i], owner);
    }
}

std::vector<RayScene::Part> LitTriangles::parts(const std::optional<Box>& period) const {
    std::vector<RayScene::Part> parts;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const std::size_t end = k + 1 < parts_.size() ? parts_[k + 1].first : owners_.size();
        const std::size_t first = parts_[k].first;
        RayScene::Part part{std::span(corners_).subspan(3 * first, 3 * (end - first)), {}};
        if (!period || end == first) {
            part.shifts.emplace_back(0, 0, 0);
        } else {
            const glm::dvec3 size = period->upper - period->lower;
            const glm::dvec3 from = glm::ceil((period->lower - parts_[k].bounds.upper) / size);
            const glm::dvec3 to = glm::floor((period->upper - parts_[k].bounds.lower) / size);
            for (double x = from.x; x <= to.x; ++x) {
                for (double z = from.z; z <= to.z; ++z) part.shifts.emplace_back(x * size.x, 0, z * size.z);
            }
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

glm::dvec3 LitTriangles::area_vector_of(std::size_t triangle) const {
    const glm::dvec3 a(corners_[3 * triangle]), b(corners_[3 * triangle + 1]), c(corners_[3 * triangle + 2]);
    return 0.5 * glm::cross(b - a, c - a);
}

glm::dvec3 LitTriangles::normal(std::size_t triangle) const {
    return unit_or(area_vector_of(triangle), glm::dvec3(0));
}

}  // namespace espalier::environment

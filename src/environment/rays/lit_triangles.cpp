#include "environment/rays/lit_triangles.h"

#include "espalier/base/math.h"

#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace espalier::environment {

void LitTriangles::clear(std::size_t slots) {
    corners_.clear();
    owners_.clear();
    leaf_areas_.assign(slots, 0);
    bounds_ = {};
}

void LitTriangles::add(const PlantGeometry& geometry, std::uint32_t first_slot) {
    leaves_.collect(geometry);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        const auto& [module, corners] = leaves_[i];
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
            const glm::dvec3 &a = corners[0], &b = corners[k], &c = corners[k + 1];
            add(a, b, c, {first_slot + module, LitKind::leaf});
            leaf_areas_[first_slot + module] += glm::length(glm::cross(b - a, c - a)) / 2;
        }
    }
    for (const Internode& internode : geometry.internodes) add_stem(internode, first_slot + internode.module);
}

void LitTriangles::add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Owner owner) {
    for (const glm::dvec3& corner : {a, b, c}) {
        corners_.emplace_back(corner);
        bounds_.add(corner);
    }
    owners_.push_back(owner);
}

void LitTriangles::add_stem(const Internode& internode, std::uint32_t slot) {
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
        add(low[i], low[i + 1], high[i + 1], {slot, LitKind::stem});
        add(low[i], high[i + 1], high[i], {slot, LitKind::stem});
    }
}

void LitTriangles::repeat(const Box& period) {
    const glm::dvec3 size = period.upper - period.lower;
    const std::size_t count = owners_.size();
    std::vector<glm::vec3> corners;
    std::vector<Owner> owners;
    for (std::size_t i = 0; i < count; ++i) {
        const std::span<const glm::vec3> own = std::span(corners_).subspan(3 * i, 3);
        const glm::dvec3 low(glm::min(glm::min(own[0], own[1]), own[2])),
            high(glm::max(glm::max(own[0], own[1]), own[2]));
        // Shifts by which the triangle touches the period.
        const glm::dvec3 first = glm::ceil((period.lower - high) / size),
                         last = glm::floor((period.upper - low) / size);
        for (double x = first.x; x <= last.x; ++x) {
            for (double z = first.z; z <= last.z; ++z) {
                const glm::dvec3 shift(x * size.x, 0, z * size.z);
                for (const glm::vec3& corner : own) corners.emplace_back(glm::dvec3(corner) + shift);
                owners.push_back(owners_[i]);
            }
        }
    }
    corners_ = std::move(corners);
    owners_ = std::move(owners);
}

glm::dvec3 LitTriangles::normal(std::size_t triangle) const {
    const glm::dvec3 a(corners_[3 * triangle]), b(corners_[3 * triangle + 1]), c(corners_[3 * triangle + 2]);
    return unit_or(glm::cross(b - a, c - a), glm::dvec3(0));
}

}  // namespace espalier::environment

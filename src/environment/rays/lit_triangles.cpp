#include "environment/rays/lit_triangles.h"

#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace espalier::environment {

void LitTriangles::clear(std::size_t slots) {
    corners_.clear();
    owners_.clear();
    leaf_areas_.assign(slots, 0);
    bounds_ = {};
}

void LitTriangles::add(const PlantGeometry& geometry, std::uint32_t first_slot) {
    faces_.clear();
    faces_.add_leaves(0, geometry);
    faces_.add_stems(0, geometry);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const DrawnFace face = faces_[i];
        const std::uint32_t slot = first_slot + face.owner.module;
        const LitKind kind = face.owner.is_stem() ? LitKind::stem : LitKind::leaf;
        face.for_triangles([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            add(a, b, c, {slot, kind});
            if (kind == LitKind::leaf) leaf_areas_[slot] += glm::length(glm::cross(b - a, c - a)) / 2;
        });
    }
}

void LitTriangles::add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Owner owner) {
    for (const glm::dvec3& corner : {a, b, c}) {
        corners_.emplace_back(corner);
        bounds_.add(corner);
    }
    owners_.push_back(owner);
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

#include "environment/canopy/leaves.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {

void CanopyLeaves::clear() {
    pieces_.clear();
    bounds_ = {};
}

void CanopyLeaves::add(const LeafPiece& piece) {
    pieces_.push_back(piece);
    bounds_.add(piece.middle);
}

void CanopyLeaves::add(std::uint32_t plant, std::uint32_t module, const glm::dvec3& place, double area) {
    if (area > 0) add({plant, module, place, glm::vec3(static_cast<float>(area), 0, 0), true});
}

void CanopyLeaves::add(std::uint32_t plant, const PlantGeometry& geometry, double longest) {
    drawn_.clear();
    drawn_.add_leaves(plant, geometry);
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
        const DrawnFace face = drawn_[i];
        const std::uint32_t module = face.owner.module;
        const glm::dvec3 middle = face.middle();
        const bool is_small = std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& corner) {
            return glm::distance(corner, middle) <= longest / 2;
        });
        if (is_small) {
            add({plant, module, middle, glm::vec3(face.area()), false});
            continue;
        }
        face.for_triangles([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            cut(plant, module, a, b, c, longest);
        });
    }
}

// Halves the longest side until all are short.
void CanopyLeaves::cut(std::uint32_t plant, std::uint32_t module, const glm::dvec3& a, const glm::dvec3& b,
                       const glm::dvec3& c, double longest) {
    const double ab = glm::distance(a, b), bc = glm::distance(b, c), ca = glm::distance(c, a);
    if (std::max({ab, bc, ca}) <= longest) {
        add({plant, module, (a + b + c) / 3.0, glm::vec3(0.5 * glm::cross(b - a, c - a)), false});
    } else if (ab >= bc && ab >= ca) {
        const glm::dvec3 middle = 0.5 * (a + b);
        cut(plant, module, a, middle, c, longest);
        cut(plant, module, middle, b, c, longest);
    } else {
        cut(plant, module, b, c, a, longest);
    }
}

void CanopyLeaves::sort_into(const CanopyVoxels& voxels) {
    for (LeafPiece& piece : pieces_) piece.voxel = voxels.number_of(piece.middle);
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [](const LeafPiece& a, const LeafPiece& b) { return a.voxel < b.voxel; });
}

template <class AreaOf>
std::vector<float> CanopyLeaves::per_volume(const CanopyVoxels& voxels, const AreaOf& area_of) const {
    std::vector<float> values(voxels.count(), 0.0f);
    const double volume = voxels.edge * voxels.edge * voxels.edge;
    for (std::size_t i = 0; i < pieces_.size();) {
        const std::size_t voxel = pieces_[i].voxel;
        double sum = 0;
        for (; i < pieces_.size() && pieces_[i].voxel == voxel; ++i) sum += area_of(pieces_[i]);
        values[voxel] = static_cast<float>(sum / volume);
    }
    return values;
}

std::vector<float> CanopyLeaves::densities(const CanopyVoxels& voxels) const {
    return per_volume(voxels, [](const LeafPiece& piece) { return area_of(piece); });
}

std::vector<float> CanopyLeaves::depths(const CanopyVoxels& voxels, const glm::dvec3& towards,
                                        const LeafAngles& angles) const {
    const double projection = angles.projection(towards.y);
    return per_volume(voxels, [&](const LeafPiece& piece) { return seen_area(piece, towards, projection); });
}

double seen_area(const LeafPiece& piece, const glm::dvec3& towards, double projection) {
    const glm::dvec3 area(piece.area);
    return piece.undirected ? area.x * projection : std::abs(glm::dot(area, towards));
}

double area_of(const LeafPiece& piece) {
    return glm::length(glm::dvec3(piece.area));
}

}  // namespace espalier::environment

#include "environment/light/rays/lit_triangles.h"

#include "environment/light/rays/solid_surface.h"
#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::environment {
namespace {

/// Where parts overlap more, a ray that looks into each of them costs more than building all triangles anew.
constexpr double most_crowded = 1.5;

double volume(const glm::dvec3& size) {
    return size.x * size.y * size.z;
}

}  // namespace

void LitTriangles::clear() {
    corners_.clear();
    owners_.clear();
    parts_.clear();
    bounds_ = {};
}

void LitTriangles::add(const PlantGeometry& geometry, std::uint32_t first_slot, std::uint32_t plant,
                       const Optics& optics) {
    parts_.push_back({owners_.size(), {}});
    faces_.clear();
    faces_.add_leaves(plant, geometry);
    faces_.add_stems(plant, geometry);
    faces_.add_bodies(plant, geometry);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const DrawnFace face = faces_[i];
        const LitKind kind = lit_kind(face.owner.of);
        const Owner owner{first_slot + face.owner.module, optics.require_material(kind, face.owner.colour, plant),
                          kind};
        face.for_triangles([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { add(a, b, c, owner); });
    }
}

void LitTriangles::add(std::span<const Corners> triangles, std::span<const Owner> owners) {
    parts_.push_back({owners_.size(), {}});
    for (std::size_t i = 0; i < triangles.size(); ++i)
        add(triangles[i][0], triangles[i][1], triangles[i][2], owners[i]);
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

std::vector<RayScene::Part> LitTriangles::parts(const std::optional<Box>& period) const {
    std::vector<RayScene::Part> parts = separate_parts(period);
    if (crowding(parts, period) <= most_crowded) return parts;
    RayScene::Part all{corners_, {}};
    for (const RayScene::Part& part : parts) {
        for (const glm::mat4x3& place : part.places) {
            if (std::find(all.places.begin(), all.places.end(), place) == all.places.end()) all.places.push_back(place);
        }
    }
    return {std::move(all)};
}

std::vector<RayScene::Part> LitTriangles::separate_parts(const std::optional<Box>& period) const {
    std::vector<RayScene::Part> parts;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const std::size_t end = k + 1 < parts_.size() ? parts_[k + 1].first : owners_.size();
        const std::size_t first = parts_[k].first;
        RayScene::Part part{std::span(corners_).subspan(3 * first, 3 * (end - first)), {}};
        if (!period || end == first) {
            part.places.push_back(moved_by({0, 0, 0}));
        } else {
            const glm::dvec3 size = period->upper - period->lower;
            const glm::dvec3 from = glm::ceil((period->lower - parts_[k].bounds.upper) / size);
            const glm::dvec3 to = glm::floor((period->upper - parts_[k].bounds.lower) / size);
            for (double x = from.x; x <= to.x; ++x) {
                for (double z = from.z; z <= to.z; ++z) part.places.push_back(moved_by({x * size.x, 0, z * size.z}));
            }
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

/// In how many boxes of parts a place lies in the mean: their volumes over that of the whole.
double LitTriangles::crowding(const std::vector<RayScene::Part>& parts, const std::optional<Box>& period) const {
    Box whole = bounds_;
    for (const int axis : {0, 2}) {
        if (!period) continue;
        whole.lower[axis] = period->lower[axis];
        whole.upper[axis] = period->upper[axis];
    }
    double sum = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (parts[k].corners.empty()) continue;
        for (const glm::mat4x3& place : parts[k].places) {
            const glm::dvec3 shift(place[3]);
            const glm::dvec3 lower = glm::max(parts_[k].bounds.lower + shift, whole.lower),
                             upper = glm::min(parts_[k].bounds.upper + shift, whole.upper);
            sum += volume(glm::max(upper - lower, 0.0));
        }
    }
    const double all = volume(whole.upper - whole.lower);
    return all > 0 ? sum / all : 0;
}

glm::dvec3 LitTriangles::area_vector(std::size_t triangle) const {
    const glm::dvec3 a(corners_[3 * triangle]), b(corners_[3 * triangle + 1]), c(corners_[3 * triangle + 2]);
    return 0.5 * glm::cross(b - a, c - a);
}

glm::dvec3 LitTriangles::normal(std::size_t triangle) const {
    return unit_or(area_vector(triangle), glm::dvec3(0));
}

}  // namespace espalier::environment

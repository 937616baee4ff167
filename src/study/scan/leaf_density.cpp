#include "study/scan/leaf_density.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::study {
namespace {

class Voxels {
public:
    Voxels(const ScannedPlants& plants, double edge) : edge_(edge) {
        lower_ = glm::floor(glm::dvec3(plants.lowest()) / edge) * edge;
        const std::array<long, 3> last = place_of(plants.highest());  // what lies on a wall belongs to the voxel behind
        for (std::size_t axis = 0; axis < 3; ++axis) size_[axis] = last[axis] + 1;
        voxels_.resize(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]));
        for (long z = 0; z < size_[2]; ++z) {
            for (long y = 0; y < size_[1]; ++y) {
                for (long x = 0; x < size_[0]; ++x) {
                    at({x, y, z})->middle = lower_ + edge * (glm::dvec3(x, y, z) + 0.5);
                }
            }
        }
    }

    /// Null outside.
    VoxelDensity* at(const std::array<long, 3>& place) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (place[axis] < 0 || place[axis] >= size_[axis]) return nullptr;
        }
        return &voxels_[static_cast<std::size_t>((place[2] * size_[1] + place[1]) * size_[0] + place[0])];
    }
    std::array<long, 3> place_of(const glm::dvec3& point) const {
        const glm::dvec3 place = glm::floor((point - lower_) / edge_);
        return {static_cast<long>(place.x), static_cast<long>(place.y), static_cast<long>(place.z)};
    }

    /// From where to where a beam is within the box; the first not below the second: nowhere.
    std::array<double, 2> within(const Beam& beam) const {
        double from = 0, to = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double low = lower_[axis],
                         high = low + edge_ * static_cast<double>(size_[static_cast<std::size_t>(axis)]);
            const double a = (low - beam.origin[axis]) / beam.direction[axis];
            const double b = (high - beam.origin[axis]) / beam.direction[axis];
            if (beam.direction[axis] == 0) {
                if (beam.origin[axis] < low || beam.origin[axis] > high) return {1, 0};
                continue;
            }
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return {from, to};
    }

    /// Adds the path of a beam up to `end`, and what it met there (Amanatides & Woo 1987).
    void pass(const Beam& beam, double begin, double end, bool meets_leaf) {
        constexpr double inwards = 1e-9;
        const double rounding = 1e-5 * edge_ + 1e-6 * end;  // distances have 32 bits: a leaf on a wall is met before it
        std::array<long, 3> place = place_of(beam.origin + beam.direction * (begin + inwards));
        for (double at_now = begin; at_now < end;) {
            int axis = 0;
            double next = std::numeric_limits<double>::infinity();
            for (int k = 0; k < 3; ++k) {
                if (beam.direction[k] == 0) continue;
                const long wall = place[static_cast<std::size_t>(k)] + (beam.direction[k] > 0 ? 1 : 0);
                const double reach =
                    (lower_[k] + edge_ * static_cast<double>(wall) - beam.origin[k]) / beam.direction[k];
                if (reach < next) next = reach, axis = k;
            }
            VoxelDensity* const voxel = at(place);
            if (!voxel) return;
            ++voxel->entered;
            voxel->path += std::min(next, end) - at_now;
            if (next >= end - rounding) {
                voxel->met += meets_leaf ? 1 : 0;
                voxel->path_of_contacts += meets_leaf ? end - at_now : 0;
                return;
            }
            at_now = std::max(next, at_now + inwards);
            place[static_cast<std::size_t>(axis)] += beam.direction[axis] > 0 ? 1 : -1;
        }
    }

    std::vector<VoxelDensity>& all() { return voxels_; }
    double volume() const { return edge_ * edge_ * edge_; }

private:
    double edge_;
    glm::dvec3 lower_{0};
    std::array<long, 3> size_{};
    std::vector<VoxelDensity> voxels_;
};

/// Each triangle in pieces that are small against a voxel.
void add_real_area(const ScannedPlants& plants, double edge, Voxels& voxels) {
    const std::vector<glm::vec3>& corners = plants.corners();
    for (std::size_t i = 0; i < plants.organ_of_triangle().size(); ++i) {
        if (!plants.organs()[plants.organ_of_triangle()[i]].is_leaf) continue;
        const glm::dvec3 a = corners[3 * i], b = corners[3 * i + 1], c = corners[3 * i + 2];
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        const int parts = std::clamp(static_cast<int>(std::ceil(8 * longest / edge)), 1, 64);
        const double area = glm::length(glm::cross(b - a, c - a)) / 2 / (parts * parts);
        for (int u = 0; u < parts; ++u) {
            for (int v = 0; v < 2 * (parts - u) - 1; ++v) {
                const double third = v % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
                const double x = (u + third) / parts, y = (v / 2 + third) / parts;
                if (auto* voxel = voxels.at(voxels.place_of(a + x * (b - a) + y * (c - a)))) voxel->real += area;
            }
        }
    }
}

}  // namespace

DensityResult leaf_density(const ScannedPlants& plants, std::span<const Beam> beams, double range, double voxel,
                           double projection) {
    Voxels voxels(plants, voxel);
    std::size_t came = 0, free = 0;
    for (const Beam& beam : beams) {
        const auto [from, to] = voxels.within(beam);
        if (!(from < to)) continue;
        const auto touch = plants.touch(glm::vec3(beam.origin), glm::vec3(beam.direction), static_cast<float>(range));
        const double met = touch ? touch->distance : std::numeric_limits<double>::infinity();
        if (met < from) continue;
        ++came;
        free += met >= to ? 1 : 0;
        const bool meets_leaf = touch && touch->organ && plants.organs()[*touch->organ].is_leaf && met < to;
        voxels.pass(beam, from, std::min(met, to), meets_leaf);
    }
    add_real_area(plants, voxel, voxels);
    DensityResult result;
    result.gap_fraction = came > 0 ? static_cast<double>(free) / static_cast<double>(came) : std::nan("");
    for (VoxelDensity& one : voxels.all()) {
        if (one.entered == 0 && one.real == 0) continue;
        result.unseen_area += one.entered == 0 ? one.real : 0;
        const double contacts = static_cast<double>(one.met) - one.path_of_contacts / one.path;
        one.estimated = one.path > 0 ? std::max(0.0, contacts) / (projection * one.path) : std::nan("");
        result.estimated_area += one.entered > 0 ? one.estimated * voxels.volume() : 0;
        result.real_area += one.entered > 0 ? one.real : 0;
        one.real /= voxels.volume();
        result.voxels.push_back(one);
    }
    return result;
}

}  // namespace espalier::study

#include "environment/light/shade/light.h"

#include "espalier/base/error.h"

#include "base/prefetch.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

// Far enough from the ends of int that pyramids around a voxel can be numbered too.
constexpr double farthest_voxel = 1 << 29;

int modulo(int value, int period) {
    const int rest = value % period;
    return rest < 0 ? rest + period : rest;
}

// a + t (b - a) and not (1 - t) a + t b: between equal values it gives that value exactly.
double mixed(double a, double b, double t) {
    return a + t * (b - a);
}

// As std::floor, for what fits into an int; without a call.
int floored(double value) {
    const int whole = static_cast<int>(value);
    return whole - (value < whole);
}

}  // namespace

glm::dvec3 ShadeLattice::index_of(const glm::dvec3& point) const {
    glm::dvec3 index = (point - centre) / voxel;
    if (flat) index.z = 0;
    return index;
}

bool ShadeLattice::reaches(const glm::dvec3& index) const {
    if (!fixed) return true;
    constexpr double half = 0.5 + 1e-9;
    for (int axis = 0; axis < 3; ++axis) {
        if (periodic && axis != 1) continue;
        if (index[axis] < domain.lower[axis] - half || index[axis] > domain.upper[axis] + half) return false;
    }
    return true;
}

glm::ivec3 ShadeLattice::voxel_of(const glm::dvec3& point) const {
    const glm::dvec3 at = index_of(point) + 0.5;
    glm::ivec3 result;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(at[axis] >= 1 - farthest_voxel && at[axis] < farthest_voxel)) {
            throw RunError(fmt::format("a query at ({:g}, {:g}, {:g}) is too far away for voxels of {:g} m", point.x,
                                       point.y, point.z, voxel));
        }
        result[axis] = floored(at[axis]);
    }
    if (fixed && reaches(at - 0.5)) stay_inside(result);
    return result;
}

void ShadeLattice::stay_inside(glm::ivec3& at) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (!periodic || axis == 1) at[axis] = std::clamp(at[axis], domain.lower[axis], domain.upper[axis]);
    }
}

glm::ivec3 ShadeLattice::wrapped(glm::ivec3 v) const {
    if (!periodic) return v;
    const glm::ivec3 period = domain.upper - domain.lower + 1;
    v.x = domain.lower.x + modulo(v.x - domain.lower.x, period.x);
    v.z = domain.lower.z + modulo(v.z - domain.lower.z, period.z);
    return v;
}

double ShadeLight::at(const glm::dvec3& point, std::span<const ShadeCast> own) const {
    if (lattice_.fixed && !lattice_.reaches(lattice_.index_of(point))) return casts_.rule().full_light;
    return lattice_.trilinear ? interpolated(point, own) : of_voxel(lattice_.voxel_of(point), own);
}

glm::dvec3 ShadeLight::gradient(const glm::dvec3& point, double radius, std::span<const ShadeCast> own) const {
    glm::dvec3 result(0);
    for (int axis = 0; axis < (lattice_.flat ? 2 : 3); ++axis) {
        glm::dvec3 step(0);
        step[axis] = radius;
        result[axis] = (at(point + step, own) - at(point - step, own)) / (2 * radius);
    }
    return result;
}

double ShadeLight::of_voxel(const glm::ivec3& voxel, std::span<const ShadeCast> own) const {
    const glm::ivec3 stored = lattice_.wrapped(voxel);
    if (!casts_.clip().has(stored)) return casts_.rule().full_light;
    return left_by(field_.at(stored), stored, own);
}

double ShadeLight::left_by(Shade shade, const glm::ivec3& voxel, std::span<const ShadeCast> own) const {
    for (const ShadeCast& cast : own) shade -= casts_.at(cast, voxel);
    return light_under(casts_.rule(), shade);
}

double ShadeLight::interpolated(const glm::dvec3& point, std::span<const ShadeCast> own) const {
    const Corner corner = corner_of(point);
    if (const Shade* sums = sums_around(corner.voxel))
        return interpolated(corner, [&](const glm::ivec3& v) { return left_by(sums[ShadeBricks::offset(v)], v, own); });
    return interpolated(corner, [&](const glm::ivec3& v) { return of_voxel(v, own); });
}

template <class LightOf>
double ShadeLight::interpolated(const Corner& corner, const LightOf& light_of) const {
    const glm::ivec3& voxel = corner.voxel;
    const glm::dvec3& t = corner.part;
    const auto along_x = [&](int y, int z) {
        const glm::ivec3 v(voxel.x, voxel.y + y, z);
        return mixed(light_of(v), light_of(v + glm::ivec3(1, 0, 0)), t.x);
    };
    const auto plane = [&](int z) { return mixed(along_x(0, z), along_x(1, z), t.y); };
    return lattice_.flat ? plane(0) : mixed(plane(voxel.z), plane(voxel.z + 1), t.z);
}

ShadeLight::Corner ShadeLight::corner_of(const glm::dvec3& point) const {
    const glm::dvec3 at = lattice_.index_of(point);
    Corner corner;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(at[axis]) < farthest_voxel - 1)) static_cast<void>(lattice_.voxel_of(point));  // throws
        corner.voxel[axis] = floored(at[axis]);
        corner.part[axis] = at[axis] - corner.voxel[axis];
    }
    if (!lattice_.fixed) return corner;
    const glm::ivec3 found = corner.voxel;
    lattice_.stay_inside(corner.voxel);
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_last = corner.voxel[axis] == lattice_.domain.upper[axis] && !(lattice_.periodic && axis != 1);
        if (corner.voxel[axis] != found[axis] || is_last) corner.part[axis] = 0;
    }
    return corner;
}

// The sums of the one brick that all voxels around the corner lie in, or null.
const Shade* ShadeLight::sums_around(const glm::ivec3& voxel) const {
    const auto within = [](int v) { return (v & 7) != 7; };
    if (lattice_.periodic || lattice_.flat) return nullptr;
    if (!casts_.clip().has(voxel) || !casts_.clip().has(voxel + 1)) return nullptr;
    if (!within(voxel.x) || !within(voxel.y) || !within(voxel.z)) return nullptr;
    const std::int32_t brick = field_.bricks().find(ShadeBricks::brick_of(voxel));
    return brick < 0 ? nullptr : field_.bricks().sums(static_cast<std::size_t>(brick));
}

void ShadeLight::fetch(const glm::dvec3& point) const {
    if (!lattice_.trilinear) return;
    const glm::dvec3 at = lattice_.index_of(point);
    if (!(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < farthest_voxel - 1)) return;
    const glm::ivec3 voxel(floored(at.x), floored(at.y), floored(at.z));
    const Shade* around = sums_around(voxel);
    for (int corner = 0; corner < (around == nullptr ? 8 : 4); ++corner) {
        const glm::ivec3 other = voxel + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const std::int32_t brick = around == nullptr ? field_.bricks().find(ShadeBricks::brick_of(other)) : 0;
        if (brick == ShadeBricks::none) continue;
        const Shade* sums = around == nullptr ? field_.bricks().sums(static_cast<std::size_t>(brick)) : around;
        prefetch(sums + ShadeBricks::offset(other));
    }
}

}  // namespace espalier::environment

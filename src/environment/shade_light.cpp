#include "environment/shade_light.h"

#include "espalier/base/error.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <cmath>

namespace espalier {
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

}  // namespace

glm::ivec3 ShadeLattice::voxel_of(const glm::dvec3& point) const {
    glm::dvec3 at = glm::floor(point / voxel + 0.5);
    if (flat) at.z = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(at[axis]) < farthest_voxel) continue;
        throw RunError(fmt::format("a query at ({:g}, {:g}, {:g}) is too far away for voxels of {:g} m", point.x,
                                   point.y, point.z, voxel));
    }
    return glm::ivec3(at);
}

glm::ivec3 ShadeLattice::wrapped(glm::ivec3 v) const {
    if (!periodic) return v;
    const glm::ivec3 period = domain.upper - domain.lower + 1;
    v.x = domain.lower.x + modulo(v.x - domain.lower.x, period.x);
    v.z = domain.lower.z + modulo(v.z - domain.lower.z, period.z);
    return v;
}

double ShadeLight::at(const glm::dvec3& point, std::span<const ShadeCast> own) const {
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
    if (!field_.clip().has(stored)) return casts_.rule().full_light;
    Shade shade = field_.at(stored);
    for (const ShadeCast& cast : own) shade -= casts_.at(cast, stored);
    return light_under(casts_.rule(), shade);
}

double ShadeLight::interpolated(const glm::dvec3& point, std::span<const ShadeCast> own) const {
    static_cast<void>(lattice_.voxel_of(point));  // throws if it cannot be numbered
    glm::dvec3 at = point / lattice_.voxel;
    if (lattice_.flat) at.z = 0;
    const glm::dvec3 low = glm::floor(at);
    const glm::dvec3 t = at - low;
    const glm::ivec3 corner(low);
    const auto along_x = [&](int y, int z) {
        const glm::ivec3 v(corner.x, corner.y + y, z);
        return mixed(of_voxel(v, own), of_voxel(v + glm::ivec3(1, 0, 0), own), t.x);
    };
    const auto plane = [&](int z) { return mixed(along_x(0, z), along_x(1, z), t.y); };
    return lattice_.flat ? plane(0) : mixed(plane(corner.z), plane(corner.z + 1), t.z);
}

}  // namespace espalier

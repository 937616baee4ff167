#include "environment/canopy/medium.h"

#include "espalier/base/math.h"

#include "base/parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace espalier::environment {
namespace {

/// A sum of whole multiples of 2^-bits, which does not depend on the order of the threads that add to it.
template <int bits>
class ExactSum {
public:
    void add(double value) {
        std::atomic_ref(sum_).fetch_add(static_cast<std::int64_t>(value * unit), std::memory_order_relaxed);
    }
    double value() const { return static_cast<double>(sum_) / unit; }

private:
    static constexpr double unit = double(std::int64_t{1} << bits);
    std::int64_t sum_ = 0;
};

/// In units of voxels, from the lower corner on.
struct Beam {
    glm::dvec3 from, direction;
    double begin, end;  ///< the part inside the voxels
};

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Where the beam enters and leaves the sides; a periodic canopy has none.
void clip(Beam& beam, const CanopyVoxels& voxels) {
    for (const int axis : {0, 2}) {
        if (voxels.periodic) continue;
        const double at = beam.from[axis], along = beam.direction[axis];
        if (along == 0) {
            if (at < 0 || at >= voxels.size[axis]) beam.end = beam.begin;
            continue;
        }
        const double one = -at / along, other = (voxels.size[axis] - at) / along;
        beam.begin = std::max(beam.begin, std::min(one, other));
        beam.end = std::min(beam.end, std::max(one, other));
    }
}

/// Calls visit(number of voxel, length in it) along the beam (Amanatides & Woo 1987).
template <class Visit>
void walk(const Beam& beam, const CanopyVoxels& voxels, const Visit& visit) {
    const glm::dvec3 enters = beam.from + beam.begin * beam.direction;
    glm::ivec3 cell, step;
    glm::dvec3 next, period;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = beam.direction[axis];
        const bool onward = along > 0;
        // Light that falls on a face belongs to the voxel it goes into.
        cell[axis] = int(onward ? std::floor(enters[axis]) : std::ceil(enters[axis]) - 1);
        if (along == 0) cell[axis] = int(std::floor(enters[axis]));
        if (!voxels.periodic || axis == 1) cell[axis] = std::clamp(cell[axis], 0, voxels.size[axis] - 1);
        step[axis] = onward ? 1 : -1;
        period[axis] = along == 0 ? infinite : 1 / std::abs(along);
        next[axis] = along == 0 ? infinite : (cell[axis] + (onward ? 1 : 0) - beam.from[axis]) / along;
    }
    const auto wrapped = [&](int axis) {
        if (!voxels.periodic) return cell[axis];
        const int beyond = cell[axis] % voxels.size[axis];
        return beyond < 0 ? beyond + voxels.size[axis] : beyond;
    };
    for (double at = beam.begin; at < beam.end;) {
        const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        const double leaves = std::min(next[axis], beam.end);
        const std::size_t number =
            (std::size_t(wrapped(2)) * std::size_t(voxels.size.y) + std::size_t(cell.y)) * std::size_t(voxels.size.x) +
            std::size_t(wrapped(0));
        if (leaves > at) visit(number, leaves - at);
        at = std::max(at, leaves);
        cell[axis] += step[axis];
        next[axis] += period[axis];
        if ((!voxels.periodic || axis == 1) && (cell[axis] < 0 || cell[axis] >= voxels.size[axis])) return;
    }
}

/// Mean of exp(-k s) for s from 0 to 1.
double mean_along(double k) {
    return k < 1e-5 ? 1 - k / 2 : (1 - math::exp(-k)) / k;
}

/// From where on the top beams must begin, in voxels, so that all that meet the voxels are among them.
std::array<double, 2> first_and_last(double shift, int size, bool periodic) {
    if (periodic) return {0, double(size)};
    return {std::floor(std::min(0.0, -shift)), std::ceil(size + std::max(0.0, -shift))};
}

}  // namespace

std::size_t CanopyVoxels::number_of(const glm::dvec3& place) const {
    glm::ivec3 cell = glm::ivec3(glm::floor((place - corner) / edge));
    for (int axis = 0; axis < 3; ++axis) {
        if (periodic && axis != 1) cell[axis] = (cell[axis] % size[axis] + size[axis]) % size[axis];
        cell[axis] = std::clamp(cell[axis], 0, size[axis] - 1);
    }
    return (std::size_t(cell.z) * std::size_t(size.y) + std::size_t(cell.y)) * std::size_t(size.x) +
           std::size_t(cell.x);
}

BeamLight send_beams(const CanopyVoxels& voxels, std::span<const float> depth, const glm::dvec3& towards, int beams) {
    const glm::dvec3 direction = -towards;
    const double length = voxels.size.y / towards.y;
    const double spacing = 1.0 / beams, across = spacing * spacing * towards.y;  // a beam's, in voxels
    const auto [first_x, last_x] = first_and_last(direction.x * length, voxels.size.x, voxels.periodic);
    const auto [first_z, last_z] = first_and_last(direction.z * length, voxels.size.z, voxels.periodic);
    const auto rows = static_cast<std::int64_t>((last_z - first_z) * beams);
    const auto columns = static_cast<std::int64_t>((last_x - first_x) * beams);
    std::vector<ExactSum<44>> flux(voxels.count());  // at most 1
    ExactSum<32> sent, passed;                       // numbers of beams
    for_in_parallel(std::int64_t{0}, rows, [&](std::int64_t row) {
        for (std::int64_t column = 0; column < columns; ++column) {
            const glm::dvec3 from(first_x + (double(column) + 0.5) * spacing, voxels.size.y,
                                  first_z + (double(row) + 0.5) * spacing);
            Beam beam{from, direction, 0, length};
            clip(beam, voxels);
            if (beam.begin >= beam.end) continue;
            double left = 1;
            walk(beam, voxels, [&](std::size_t number, double along) {
                const double k = double(depth[number]) * voxels.edge * along;
                const double mean = left * mean_along(k);
                flux[number].add(mean * along * across);
                left -= mean * k;
            });
            sent.add(1);
            passed.add(left);
        }
    });
    BeamLight light;
    light.flux.reserve(flux.size());
    for (const ExactSum<44>& sum : flux) light.flux.push_back(sum.value());
    light.met = (sent.value() - passed.value()) * across * voxels.edge * voxels.edge;
    light.passed = sent.value() > 0 ? passed.value() / sent.value() : 1;
    return light;
}

}  // namespace espalier::environment

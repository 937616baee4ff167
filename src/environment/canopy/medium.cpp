#include "environment/canopy/medium.h"

#include "espalier/base/math.h"

#include "environment/canopy/worth_sharing.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace espalier::environment {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Beams that begin at the same place of their voxels go the same way through all others, shifted: this is a part of
/// it, in one voxel.
struct Stretch {
    int x, y, z;   ///< voxels from the beginning on; y counts from the bottom
    double along;  ///< in voxels
    bool moved_x, moved_z;
};

/// The way of a beam through the layers (Amanatides & Woo 1987). `at_x` and `at_z` are its place in the first voxel.
std::vector<Stretch> way_through(const CanopyVoxels& voxels, const glm::dvec3& direction, double at_x, double at_z) {
    const bool down = direction.y < 0;
    const glm::dvec3 from(at_x, down ? voxels.size.y : 0, at_z);
    const double end = voxels.size.y / std::abs(direction.y);
    glm::ivec3 cell(0, down ? voxels.size.y - 1 : 0, 0), step;
    glm::dvec3 next, period;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = direction[axis];
        step[axis] = along > 0 ? 1 : -1;
        period[axis] = along == 0 ? infinite : 1 / std::abs(along);
        next[axis] = along == 0 ? infinite : (cell[axis] + (along > 0 ? 1 : 0) - from[axis]) / along;
    }
    std::vector<Stretch> way;
    glm::ivec3 before = cell;
    for (double at = 0; cell.y >= 0 && cell.y < voxels.size.y;) {
        const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        const double leaves = std::min(next[axis], end);
        if (leaves > at) {
            way.push_back({cell.x, cell.y, cell.z, leaves - at, cell.x != before.x, cell.z != before.z});
            before = cell;
        }
        at = std::max(at, leaves);
        cell[axis] += step[axis];
        next[axis] += period[axis];
    }
    return way;
}

int wrapped(int i, int size) {
    const int beyond = i % size;
    return beyond < 0 ? beyond + size : beyond;
}

/// Mean of exp(-k s) for s from 0 to 1.
double mean_along(double k) {
    return k < 1e-5 ? 1 - k / 2 : (1 - math::exp(-k)) / k;
}

/// (1 - mean_along(k)) / k.
double mean_of_added(double k, double mean) {
    return k < 1e-3 ? 0.5 - k / 6 + k * k / 24 : (1 - mean) / k;
}

/// All beams of a light that begin at the same place of their voxels.
class Beams {
public:
    Beams(const CanopyVoxels& voxels, const ParallelLight& light, const std::vector<char>& is_clear, BeamLight& result)
        : voxels_(voxels),
          light_(light),
          is_clear_(is_clear),
          result_(result),
          flux_(voxels.ground_count(), light.outside),
          entered_(std::size_t(voxels.size.z), 0),
          left_(entered_) {
        if (!light.floor.empty()) std::copy(light.floor.begin(), light.floor.end(), flux_.begin());
    }

    /// `across` is the area of one beam, in voxels.
    void follow(const std::vector<Stretch>& way, double across) {
        const double entering = std::accumulate(flux_.begin(), flux_.end(), 0.0);
        // Rows of beams never meet in a voxel until they move to the next row of voxels.
        for (std::size_t first = 0; first < way.size();) {
            std::size_t end = first + 1;
            while (end < way.size() && way[end].z == way[first].z) ++end;
            const std::span<const Stretch> part(&way[first], end - first);
            for_each_if_worth(std::size_t(voxels_.size.z), part.size() * flux_.size(),
                              [&](std::size_t row) { follow_row(int(row), part, across); });
            first = end;
        }
        result_.entered += across * (entering + std::accumulate(entered_.begin(), entered_.end(), 0.0));
        result_.left += across * (std::accumulate(flux_.begin(), flux_.end(), 0.0) +
                                  std::accumulate(left_.begin(), left_.end(), 0.0));
        if (light_.towards.y > 0) fall_on_ground(way.back(), across);
    }

private:
    void follow_row(int row, std::span<const Stretch> part, double across) {
        const glm::ivec3 size = voxels_.size;
        double* const beams = &flux_[std::size_t(row) * std::size_t(size.x)];
        const int z = wrapped(row + part.front().z, size.z);
        if (part.front().moved_z && !voxels_.periodic && z == (light_.towards.z < 0 ? 0 : size.z - 1)) {
            for (int x = 0; x < size.x; ++x) replace(beams[x], row);
        }
        for (const Stretch& stretch : part) {
            const int shift = wrapped(stretch.x, size.x);  // of the first beam
            if (stretch.moved_x && !voxels_.periodic) {
                const int side = light_.towards.x < 0 ? 0 : size.x - 1;
                replace(beams[wrapped(side - shift, size.x)], row);
            }
            const std::size_t line = std::size_t(z) * std::size_t(size.y) + std::size_t(stretch.y);
            const std::size_t voxel = line * std::size_t(size.x);
            const int until_side = size.x - shift;
            pass(beams, voxel + std::size_t(shift), until_side, stretch.along, across, line);
            pass(beams + until_side, voxel, shift, stretch.along, across, line);
        }
    }

    /// A beam leaves through a side, and another comes in opposite.
    void replace(double& beam, int row) {
        left_[std::size_t(row)] += beam;
        entered_[std::size_t(row)] += light_.outside;
        beam = light_.outside;
    }

    void pass(double* beams, std::size_t voxel, int count, double along, double across, std::size_t line) {
        double* const flux = &result_.flux[voxel];
        const double weight = along * across, length = along * voxels_.edge;
        if (is_clear_[line]) {
            for (int i = 0; i < count; ++i) flux[i] += weight * beams[i];
            return;
        }
        const float* const depth = &light_.depth[voxel];
        const float* const added = light_.added.empty() ? nullptr : &light_.added[voxel];
        for (int i = 0; i < count; ++i) {
            const double k = double(depth[i]) * length, more = added ? double(added[i]) * length : 0;
            if (k == 0 && more == 0) {
                flux[i] += weight * beams[i];
                continue;
            }
            const double mean = mean_along(k), own = more * mean_of_added(k, mean);
            const double met = beams[i] * mean + own;
            flux[i] += weight * met;
            beams[i] += more - met * k;
        }
    }

    void fall_on_ground(const Stretch& last, double across) {
        const glm::ivec3 size = voxels_.size;
        for (int row = 0; row < size.z; ++row) {
            const int z = wrapped(row + last.z, size.z);
            for (int x = 0; x < size.x; ++x) {
                const std::size_t square =
                    std::size_t(z) * std::size_t(size.x) + std::size_t(wrapped(x + last.x, size.x));
                result_.arrived[square] += across * flux_[std::size_t(row) * std::size_t(size.x) + std::size_t(x)];
            }
        }
    }

    const CanopyVoxels& voxels_;
    const ParallelLight& light_;
    const std::vector<char>& is_clear_;
    BeamLight& result_;
    std::vector<double> flux_;            ///< of the beam from each square
    std::vector<double> entered_, left_;  ///< through the sides, by row
};

/// For each line of voxels along x, whether nothing is met there and nothing added.
std::vector<char> clear_lines(const CanopyVoxels& voxels, const ParallelLight& light) {
    const auto length = std::size_t(voxels.size.x), lines = std::size_t(voxels.size.y) * std::size_t(voxels.size.z);
    std::vector<char> clear(lines);
    const auto is_nothing = [&](std::span<const float> values, std::size_t line) {
        const auto part = values.empty() ? values : values.subspan(line * length, length);
        return std::all_of(part.begin(), part.end(), [](float value) { return value == 0; });
    };
    for_each_if_worth(lines, voxels.count(), [&](std::size_t line) {
        clear[line] = is_nothing(light.depth, line) && is_nothing(light.added, line) ? 1 : 0;
    });
    return clear;
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

BeamLight send_beams(const CanopyVoxels& voxels, const ParallelLight& light, int beams) {
    BeamLight result;
    result.flux.assign(voxels.count(), 0);
    if (light.towards.y > 0) result.arrived.assign(voxels.ground_count(), 0);
    const std::vector<char> clear = clear_lines(voxels, light);
    const double spacing = 1.0 / beams, across = spacing * spacing * std::abs(light.towards.y);
    for (int i = 0; i < beams; ++i) {
        for (int j = 0; j < beams; ++j) {
            const auto way = way_through(voxels, -light.towards, (i + 0.5) * spacing, (j + 0.5) * spacing);
            Beams(voxels, light, clear, result).follow(way, across);
        }
    }
    const double square = voxels.edge * voxels.edge;
    result.entered *= square;
    result.left *= square;
    result.met = result.entered - result.left;
    result.passed = result.entered > 0 ? result.left / result.entered : 1;
    return result;
}

BeamLight send_beams(const CanopyVoxels& voxels, std::span<const float> depth, const glm::dvec3& towards, int beams) {
    ParallelLight light;
    light.towards = towards;
    light.depth = depth;
    return send_beams(voxels, light, beams);
}

}  // namespace espalier::environment

#include "environment/light/canopy/medium.h"

#include "espalier/base/math.h"

#include "base/parallel.h"

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

/// The voxels of each line along x in which something is met or added.
class FilledVoxels {
public:
    FilledVoxels(const CanopyVoxels& voxels, const ParallelLight& light)
        : starts_(std::size_t(voxels.size.y) * std::size_t(voxels.size.z) + 1, 0) {
        const auto length = std::size_t(voxels.size.x), lines = starts_.size() - 1;
        const auto is_filled = [&](std::size_t v) {
            return light.depth[v] != 0 || (!light.added.empty() && light.added[v] != 0);
        };
        for_each_if_worth(lines, voxels.count(), [&](std::size_t line) {
            std::uint32_t count = 0;
            for (std::size_t x = 0; x < length; ++x) count += is_filled(line * length + x) ? 1 : 0;
            starts_[line + 1] = count;
        });
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        places_.resize(starts_.back());
        for_each_if_worth(lines, voxels.count(), [&](std::size_t line) {
            std::uint32_t next = starts_[line];
            for (std::size_t x = 0; next < starts_[line + 1]; ++x) {
                if (is_filled(line * length + x)) places_[next++] = static_cast<std::int32_t>(x);
            }
        });
    }
    std::span<const std::int32_t> operator[](std::size_t line) const {
        return std::span(places_).subspan(starts_[line], starts_[line + 1] - starts_[line]);
    }

private:
    std::vector<std::uint32_t> starts_;
    std::vector<std::int32_t> places_;
};

/// All beams of a light that begin at the same place of their voxels.
class Beams {
public:
    Beams(const CanopyVoxels& voxels, const ParallelLight& light, const FilledVoxels& filled, BeamLight& result)
        : voxels_(voxels),
          light_(light),
          filled_(filled),
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
            const int until_side = size.x - shift;
            pass(beams, shift, until_side, stretch.along, across, line);
            pass(beams + until_side, 0, shift, stretch.along, across, line);
        }
    }

    /// A beam leaves through a side, and another comes in opposite.
    void replace(double& beam, int row) {
        left_[std::size_t(row)] += beam;
        entered_[std::size_t(row)] += light_.outside;
        beam = light_.outside;
    }

    /// `count` beams through voxels of a line from `first` on.
    void pass(double* beams, int first, int count, double along, double across, std::size_t line) {
        const std::size_t voxel = line * std::size_t(voxels_.size.x);
        double* const flux = &result_.flux[voxel] + first;
        const double weight = along * across, length = along * voxels_.edge;
        for (int i = 0; i < count; ++i) flux[i] += weight * beams[i];  // as if nothing were there
        const std::span<const std::int32_t> filled = filled_[line];
        for (auto x = std::lower_bound(filled.begin(), filled.end(), first); x != filled.end() && *x < first + count;
             ++x) {
            const std::size_t v = voxel + std::size_t(*x);
            double& beam = beams[*x - first];
            const double k = light_.depth[v] * length;
            const double more = light_.added.empty() ? 0 : light_.added[v] * length;
            const double mean = mean_along(k), met = beam * mean + more * mean_of_added(k, mean);
            flux[*x - first] += weight * (met - beam);
            beam += more - met * k;
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
    const FilledVoxels& filled_;
    BeamLight& result_;
    std::vector<double> flux_;            ///< of the beam from each square
    std::vector<double> entered_, left_;  ///< through the sides, by row
};

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
    const FilledVoxels filled(voxels, light);
    const double spacing = 1.0 / beams, across = spacing * spacing * std::abs(light.towards.y);
    for (int i = 0; i < beams; ++i) {
        for (int j = 0; j < beams; ++j) {
            const auto way = way_through(voxels, -light.towards, (i + 0.5) * spacing, (j + 0.5) * spacing);
            Beams(voxels, light, filled, result).follow(way, across);
        }
    }
    const double square = voxels.edge * voxels.edge;
    result.entered *= square;
    result.left *= square;
    result.met = result.entered - result.left;
    result.passed = result.entered > 0 ? result.left / result.entered : 1;
    return result;
}

BeamLight send_beams(const CanopyVoxels& voxels, std::span<const double> depth, const glm::dvec3& towards, int beams) {
    ParallelLight light;
    light.towards = towards;
    light.depth = depth;
    return send_beams(voxels, light, beams);
}

}  // namespace espalier::environment

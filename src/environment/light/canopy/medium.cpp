#include "environment/light/canopy/medium.h"

#include "base/math_columns.h"
#include "base/parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

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

/// The filled voxels, with what takes a division. Sums that choose between two formulas by a factor of 0 or 1 become
/// vectors, which branches do not.
struct Thickness {
    std::vector<double> inverse;  ///< of the depth; 0 of a thin voxel
    std::vector<double> thin;     ///< 1 if what an edge of it takes away follows from the first terms of a series, or 0

    Thickness(std::span<const double> depth, double edge) : inverse(depth.size(), 0), thin(depth.size(), 0) {
        for (std::size_t i = 0; i < depth.size(); ++i) {
            const bool is_thin = depth[i] * edge < 1e-3;
            inverse[i] = is_thin ? 0 : 1 / depth[i];
            thin[i] = is_thin ? 1 : 0;
        }
    }
};

/// What beams do in voxels of a line on stretches of one length. Sums of light that is added, and its share that is met
/// in the voxel itself, follow from integrals of exp(-k s), s from 0 to 1.
class Attenuation {
public:
    static constexpr std::size_t most = 64;

    std::array<double, most> k;      ///< optical depth
    std::array<double, most> mean;   ///< of exp(-k s)
    std::array<double, most> more;   ///< flux that is added
    std::array<double, most> extra;  ///< the mean of what of it is met

    void find(std::size_t count, const double* depth, const double* inverse, const double* thin, double length) {
        const std::size_t padded = (count + lanes - 1) / lanes * lanes;
        for (std::size_t i = 0; i < count; ++i) {
            k[i] = depth[i] * length;
            mean[i] = -k[i];
        }
        std::fill(mean.begin() + std::ptrdiff_t(count), mean.begin() + std::ptrdiff_t(padded), 0.0);
        math::exp({mean.data(), padded}, mean.data());
        const double per_length = 1 / length;
        for (std::size_t i = 0; i < count; ++i) {
            const double of_thin = 1 - k[i] * (0.5 - k[i] * (1.0 / 6 - k[i] * (1.0 / 24)));
            mean[i] = thin[i] * of_thin + (1 - mean[i]) * (inverse[i] * per_length);
        }
    }
    void find_more(std::size_t count, const double* added, const double* inverse, const double* thin, double length) {
        const double per_length = 1 / length;
        for (std::size_t i = 0; i < count; ++i) {
            const double of_thin = 0.5 - k[i] * (1.0 / 6 - k[i] * (1.0 / 24 - k[i] * (1.0 / 120)));
            more[i] = added[i] * length;
            extra[i] = more[i] * (thin[i] * of_thin + (1 - mean[i]) * (inverse[i] * per_length));
        }
    }
    void add_none(std::size_t count) {
        std::fill_n(more.begin(), count, 0.0);
        std::fill_n(extra.begin(), count, 0.0);
    }

private:
    static constexpr std::size_t lanes = 8;  // of the widest vectors; whole ones are fastest
};

/// All beams of a light that begin at the same place of their voxels.
class Beams {
public:
    Beams(const CanopyVoxels& voxels, const ParallelLight& light, const FilledVoxels& filled,
          const Thickness& thickness, BeamLight& result)
        : voxels_(voxels),
          light_(light),
          filled_(filled),
          thickness_(thickness),
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
            pass(beams, shift, stretch.along, across, line);
        }
    }

    /// A beam leaves through a side, and another comes in opposite.
    void replace(double& beam, int row) {
        left_[std::size_t(row)] += beam;
        entered_[std::size_t(row)] += light_.outside;
        beam = light_.outside;
    }

    /// All beams of a row through the voxels of a line, the first one through voxel `shift`.
    void pass(double* beams, int shift, double along, double across, std::size_t line) {
        const int size = voxels_.size.x, until_side = size - shift;
        double* const flux = &result_.flux[line * std::size_t(size)];
        const double weight = along * across, length = along * voxels_.edge;
        // As if nothing were there.
        for (int i = 0; i < until_side; ++i) flux[shift + i] += weight * beams[i];
        for (int i = 0; i < shift; ++i) flux[i] += weight * beams[until_side + i];
        const std::size_t end = filled_.first_of(line + 1);
        Attenuation met_here;
        for (std::size_t at = filled_.first_of(line); at < end; at += Attenuation::most) {
            const std::size_t count = std::min(Attenuation::most, end - at);
            const double *const inverse = &thickness_.inverse[at], *const thin = &thickness_.thin[at];
            met_here.find(count, &light_.depth[at], inverse, thin, length);
            light_.added.empty() ? met_here.add_none(count)
                                 : met_here.find_more(count, &light_.added[at], inverse, thin, length);
            for (std::size_t i = 0; i < count; ++i) {
                const int x = filled_.x(at + i), from = x - shift;
                double& beam = beams[from < 0 ? from + size : from];
                const double met = beam * met_here.mean[i] + met_here.extra[i];
                flux[x] += weight * (met - beam);
                beam += met_here.more[i] - met * met_here.k[i];
            }
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
    const Thickness& thickness_;
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

FilledVoxels::FilledVoxels(const CanopyVoxels& voxels, std::vector<std::size_t> numbers)
    : numbers_(std::move(numbers)), starts_(std::size_t(voxels.size.y) * std::size_t(voxels.size.z) + 1, 0) {
    const auto length = std::size_t(voxels.size.x);
    x_.reserve(numbers_.size());
    for (const std::size_t number : numbers_) {
        x_.push_back(static_cast<std::int32_t>(number % length));
        ++starts_[number / length + 1];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
}

BeamLight send_beams(const CanopyVoxels& voxels, const FilledVoxels& filled, const ParallelLight& light, int beams) {
    BeamLight result;
    result.flux.assign(voxels.count(), 0);
    if (light.towards.y > 0) result.arrived.assign(voxels.ground_count(), 0);
    const Thickness thickness(light.depth, voxels.edge);
    const double spacing = 1.0 / beams, across = spacing * spacing * std::abs(light.towards.y);
    for (int i = 0; i < beams; ++i) {
        for (int j = 0; j < beams; ++j) {
            const auto way = way_through(voxels, -light.towards, (i + 0.5) * spacing, (j + 0.5) * spacing);
            Beams(voxels, light, filled, thickness, result).follow(way, across);
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
    std::vector<std::size_t> numbers;
    std::vector<double> of_filled;
    for (std::size_t v = 0; v < depth.size(); ++v) {
        if (depth[v] == 0) continue;
        numbers.push_back(v);
        of_filled.push_back(depth[v]);
    }
    ParallelLight light;
    light.towards = towards;
    light.depth = of_filled;
    return send_beams(voxels, FilledVoxels(voxels, std::move(numbers)), light, beams);
}

}  // namespace espalier::environment

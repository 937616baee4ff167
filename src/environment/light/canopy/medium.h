// Light through voxels that are partly filled with leaves, evenly and at random: a turbid medium.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

/// Cubic voxels, numbered with x fastest and z slowest.
struct CanopyVoxels {
    glm::dvec3 corner{0, 0, 0};  ///< the lower one of voxel (0, 0, 0), metres
    glm::ivec3 size{0, 0, 0};
    double edge = 1;        ///< metres
    bool periodic = false;  ///< what leaves through a side comes in again opposite

    std::size_t count() const { return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z); }
    /// Squares of the ground below, with x fastest.
    std::size_t ground_count() const { return std::size_t(size.x) * std::size_t(size.z); }
    /// A periodic one wraps x and z; a place outside has the number of the nearest voxel.
    std::size_t number_of(const glm::dvec3& place) const;
};

/// The voxels in which something may be met or added.
class FilledVoxels {
public:
    FilledVoxels() = default;
    /// `numbers` ascend.
    FilledVoxels(const CanopyVoxels& voxels, std::vector<std::size_t> numbers);

    std::size_t size() const { return numbers_.size(); }
    /// Of all voxels.
    std::size_t number(std::size_t filled) const { return numbers_[filled]; }
    /// Where it stands on its line along x.
    std::int32_t x(std::size_t filled) const { return x_[filled]; }
    /// The first of a line; those of the next one follow its last.
    std::size_t first_of(std::size_t line) const { return starts_[line]; }

private:
    std::vector<std::size_t> numbers_, starts_;
    std::vector<std::int32_t> x_;
};

/// Parallel light through the voxels. Fluxes are per area across the direction.
struct ParallelLight {
    glm::dvec3 towards{0, 1, 0};      ///< unit vector to where it comes from: from below, y is negative
    std::span<const double> depth;    ///< leaf area per volume of each filled voxel, seen from that direction, 1/m
    std::span<const double> added;    ///< flux that each metre of a filled voxel adds to it; empty: none
    double outside = 1;               ///< flux that enters through the sides, and through the top from above
    std::span<const double> floor{};  ///< from below: flux that enters from each square of the ground
};

/// What parallel light leaves behind.
struct BeamLight {
    std::vector<double> flux;     ///< for each voxel, the mean flux that its leaves meet
    std::vector<double> arrived;  ///< for each square of the ground, what falls on it per m2 of it; only from above
    double entered = 0;           ///< m2 of flux 1, across the direction, that come into the voxels
    double left = 0;              ///< the same that goes out of them, through the bottom too
    double met = 0;               ///< entered less left, where nothing is added
    double passed = 1;            ///< left over entered
};

/// Follows parallel beams, `beams` x `beams` from each voxel of the top or bottom, along exact lengths through the
/// voxels. A leaf of voxel v whose area A is seen from there meets A * flux[v]; so what all leaves meet is what the
/// beams lose, to rounding. The same bytes with any number of threads. `towards` is not nearer to the horizon than
/// `least_rise`.
BeamLight send_beams(const CanopyVoxels& voxels, const FilledVoxels& filled, const ParallelLight& light, int beams);
/// With the depth of every voxel.
BeamLight send_beams(const CanopyVoxels& voxels, std::span<const double> depth, const glm::dvec3& towards, int beams);

/// Sine of the least elevation of light: of what comes from below 2 degrees, leaves meet nothing.
constexpr double least_rise = 0.0349;

}  // namespace espalier::environment

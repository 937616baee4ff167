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
    /// A periodic one wraps x and z; a place outside has the number of the nearest voxel.
    std::size_t number_of(const glm::dvec3& place) const;
};

/// What parallel light of flux 1 across its direction leaves behind.
struct BeamLight {
    std::vector<double> flux;  ///< for each voxel, the mean flux that its leaves meet, 0 to 1
    double met = 0;            ///< m2: the area across the light whose light the leaves have met, all in all
    double passed = 0;         ///< share of the light that comes to the voxels and that no leaf has met
};

/// Follows parallel beams, `beams` x `beams` from each voxel of the top, along exact lengths through the voxels.
/// `depth` is the leaf area per volume, as seen from that direction, 1/m. A leaf of voxel v whose area A is seen from
/// there meets A * flux[v]; so what all leaves meet is what the beams lose, to rounding. The same bytes with any number
/// of threads. `towards` is the unit vector to the light, and rises at least by `least_rise`.
BeamLight send_beams(const CanopyVoxels& voxels, std::span<const float> depth, const glm::dvec3& towards, int beams);

/// Sine of the least elevation of light: of what comes from below 2 degrees, leaves meet nothing.
constexpr double least_rise = 0.0349;

}  // namespace espalier::environment

// Leaf area density back from the beams of a scan, by voxels, and how it truly is.
#pragma once

#include "study/scan/scan.h"

#include <array>
#include <span>
#include <vector>

namespace espalier::study {

struct VoxelDensity {
    glm::dvec3 middle;
    std::size_t entered = 0, met = 0;  ///< beams that came into it, and those that met a leaf in it
    double path = 0;                   ///< m, of all beams within it, up to what they met
    double path_of_contacts = 0;       ///< m, of those that met a leaf in it
    double estimated = 0;              ///< m2/m3; NaN where no beam came
    double real = 0;                   ///< m2/m3, one side
};

struct DensityResult {
    std::vector<VoxelDensity> voxels;  ///< that beams entered, or that have leaves; x first, then y, then z
    double estimated_area = 0;         ///< m2, in voxels that beams entered
    double real_area = 0;              ///< m2, in the same
    double unseen_area = 0;            ///< m2, where no beam came
    /// Share of the beams into the box of the plants that meet nothing there.
    double gap_fraction = 0;
};

/// Contacts over path lengths: density = (contacts - path of contacts / path) / (G path). The second term takes away
/// what few beams would tell too much, so that one beam that meets a leaf at the wall of a voxel tells nothing (Pimont
/// et al. 2018, the modified contact frequency, corrected for bias). G, the mean projection of a unit of leaf area, is
/// 0.5 for leaves that stand at random. A beam counts by its middle ray.
DensityResult leaf_density(const ScannedPlants& plants, std::span<const Beam> beams, double range, double voxel,
                           double projection);

}  // namespace espalier::study

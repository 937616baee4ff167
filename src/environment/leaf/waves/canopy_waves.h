// Long waves among sky, leaves, stems and soil, by the beams that light follows through a canopy.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/leaf/leaves/plant_leaves.h"
#include "environment/light/canopy/canopy_space.h"
#include "environment/light/canopy/scattering.h"

#include <memory>
#include <span>
#include <vector>

namespace espalier::environment::leaf {

/// What surrounds the leaves. Stems are as warm as the air.
struct WavesAround {
    double sky = 0;  ///< W m-2 on open level ground, from all of the sky alike
    double air = 20, soil = 20;
    double leaf_emissivity = 0.97;
};

/// Long waves of a moment, W. What leaves and soil reflect is in none of them.
struct WaveLedger {
    double from_plants = 0, from_soil = 0, from_sky = 0;  ///< the last with the ground beside the voxels
    double to_plants = 0, to_soil = 0, to_sky = 0;

    /// All that is absorbed over all that is sent, less 1.
    double closure() const;
};

/// Sides of leaves and stems send as Lambert's law says, and meet what beams of all directions bring: in an enclosure
/// of one temperature a leaf gets exactly what it sends.
class CanopyWaves {
public:
    /// Reads the table `long_waves`.
    CanopyWaves(const Settings& table, const EnvironmentContext& context);

    /// The leaves of a step among voxels; leaves that are not drawn are not there. Throws RunError where voxels would
    /// take more than the memory of the context.
    void lay(const WorldView& world, std::span<const PlantLeaves> leaves);
    /// From what leaves send (PlantLeaves::sent) to what meets their sides (PlantLeaves::thermal); of what was met the
    /// time before, they reflect their share. Returns the greatest change, as a share of what is met.
    double exchange(std::span<PlantLeaves> leaves, const WavesAround& around);

    const WaveLedger& ledger() const { return ledger_; }
    double soil_emissivity() const { return soil_emissivity_; }
    std::optional<double> sky() const { return sky_; }

private:
    CanopyScattering::Emission emission(std::span<const PlantLeaves> leaves, const WavesAround& around);
    void find_rows(std::span<const PlantLeaves> leaves);
    void require_memory(const CanopySpace::Extent& extent, double pieces) const;

    CanopySpace space_;
    CanopyScattering::Options options_;
    double soil_emissivity_;
    std::optional<double> sky_;  ///< W m-2 on level ground, in place of the weather's
    bool stems_;
    std::size_t memory_;
    Optics optics_;
    LeafAngles angles_;
    // Of the step.
    CanopyLeaves leaves_;
    CanopyVoxels voxels_;
    std::unique_ptr<CanopyScattering> scattering_;
    CanopyFlux of_sky_;                 ///< of a sky that brings 1 W m-2 to level ground
    std::vector<LeafRow> rows_;         ///< of pieces; plant -1: of no leaf
    std::vector<double> front_, back_;  ///< what sides of pieces met the last time, W
    std::vector<double> ground_;        ///< W m-2
    WaveLedger ledger_;
};

/// What users read of the table.
const std::string& canopy_waves_help();

}  // namespace espalier::environment::leaf

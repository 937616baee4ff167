// Water in single internodes, of which the faces of voxels make several pieces.
#pragma once

#include "environment/soil/roots/uptake.h"

#include <memory>
#include <string>
#include <vector>

namespace espalier::environment {

struct InternodeWater {
    double xylem = 0;     ///< pressure head in it, mean over its length, cm
    double uptake = 0;    ///< cm3/d
    double surface = 0;   ///< pressure head of the soil at its surface, mean over its length, cm
    double fraction = 0;  ///< of the uptake from uniform soil
};

/// All zero for an internode that is no root.
InternodeWater water_in(const PlantUptake& plant, std::uint32_t internode);

/// What `root_values` knows of each internode in the soil.
std::vector<OrganQuantity> root_quantities();
/// By the modules of the plant's string; NaN for those that are no roots. Null for an unknown name.
std::shared_ptr<const std::vector<float>> root_values(const PlantUptake& plant, const std::string& name);

}  // namespace espalier::environment

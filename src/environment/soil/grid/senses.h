// What the queries of a step sense in the water, and what they wish of it.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/soil/grid/direction.h"
#include "environment/soil/grid/grid.h"
#include "environment/soil/grid/parameters.h"
#include "environment/soil/grid/uptake.h"

#include <span>
#include <vector>

namespace espalier::environment {

/// The soil that is sensed.
struct WaterSenses {
    const WaterGrid& grid;
    const WaterFaces& faces;
    const WaterSolids& solids;
    const WaterParameters& parameters;
    const WaterBrick& contents;
    bool joined_x = false, joined_z = false;  ///< sides with those across
};

/// Writes what each query senses into its answer; returns what each wishes. Throws RunError for a parameter that is not
/// finite.
std::vector<WaterWish> sense_water(const WaterSenses& soil, std::span<const Query> queries, std::span<Answer> answers);

}  // namespace espalier::environment

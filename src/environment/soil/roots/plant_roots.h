// The roots of one plant in the soil's voxels.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/soil/richards/cells.h"
#include "environment/soil/roots/conductances.h"
#include "environment/soil/roots/hydraulic_tree.h"
#include "environment/soil/roots/said_of_roots.h"

#include <optional>
#include <vector>

namespace espalier::environment {

/// Along what the curves of conductances are read.
enum class RootMeasure { age, distance_from_tip };

struct PlantRoots {
    std::vector<RootPiece> pieces;          ///< as they are drawn: bearers first
    std::vector<std::size_t> cells;         ///< of each piece; `no_cell` outside the soil or in a stone
    std::vector<double> radii;              ///< cm
    std::vector<double> depths;             ///< of each piece's middle below the surface, cm
    std::vector<std::uint32_t> internodes;  ///< of each piece
    std::vector<std::uint32_t> modules;     ///< of each piece, in the plant's string
    std::size_t modules_in_string = 0;
    double collar_height = 0;  ///< cm, as heights of total heads
    std::optional<glm::dvec3>
        left_at;  ///< the first place, in the order of the string, where a root is outside the soil

    static constexpr std::size_t no_cell = std::size_t(-1);
};

/// Cuts the internodes below the soil's surface at the faces of voxels. A root that leaves the soil through a side or
/// the floor does what the soil says of it (OutsideSoil); where that is an error, throws RunError. `days`: what a unit
/// of time is. What a model says of an internode counts instead of `orders` and of the steps since its birth.
PlantRoots roots_in_soil(const PlantView& plant, const WorldView& world, double days, const SoilLayout& soil,
                         const std::vector<RootConductances>& orders, RootMeasure measure,
                         const SaidOfRoots& said = {});

}  // namespace espalier::environment

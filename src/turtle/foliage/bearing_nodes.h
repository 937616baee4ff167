// Where leaves, blossoms and fruit can stand.
#pragma once

#include "espalier/turtle/geometry_stage.h"

#include <cstdint>
#include <vector>

namespace espalier::turtle {

/// The internodes that one module drew, or those of them that may bear: they follow each other.
struct BearingNode {
    std::uint32_t first, count;  ///< range of PlantGeometry::internodes
    std::uint32_t number;        ///< number of nodes before it, from the base of the plant
    Identity identity;           ///< identity of the module; its index if the string keeps no lineage
    glm::dvec3 reference;        ///< a unit vector across the first, which turns along a branch as little as it must
};

/// A point of a node, and the direction of the internode there.
struct BearingPlace {
    std::uint32_t internode;
    glm::dvec3 position, direction;
};

/// The nodes whose internodes are no thicker than `thickest` at their tips, in the string's order.
std::vector<BearingNode> bearing_nodes(const StagedPlant& plant, double thickest);

/// At a share of a node's length.
BearingPlace place_on(const BearingNode& node, const PlantGeometry& geometry, double share);

}  // namespace espalier::turtle

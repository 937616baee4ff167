// Axes that a file draws one by one become a plant: each begins on the axis that bears it.
#pragma once

#include "espalier/language/measured_plants.h"

#include <optional>
#include <vector>

namespace espalier::language::measured {

/// An axis as a file has it.
struct LooseAxis {
    std::string label;
    std::size_t plant = 0;
    std::optional<std::size_t> bearer;   ///< an axis before it
    std::optional<std::size_t> on_node;  ///< of the bearer's nodes, where the file says one
    std::vector<MeasuredNode> nodes;     ///< none: what it bears is borne by its bearer
    std::vector<MeasuredOrgan> organs;   ///< on these nodes
    Place place;
};

/// Joins axes to those that bear them. An axis that begins on its bearer's line divides the segment there. One that
/// begins beside it hangs on the node that the file says, or else on the nearest point of the line, by a link. Axes
/// without nodes are left out, and do not count in orders. What is returned is sorted by plant. The current origin of a
/// scene is subtracted first, so that what is computed of places does not depend on it.
std::vector<MeasuredAxis> joined(std::vector<LooseAxis> axes);

}  // namespace espalier::language::measured

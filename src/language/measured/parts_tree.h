// Parts of plants that each name the one that bears them, in any order, become axes.
#pragma once

#include "espalier/base/error.h"

#include "language/measured/joining.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace espalier::language::measured {

/// A part, and which part bears it.
struct NamedPart {
    static constexpr double largest = 2e9;

    std::int32_t id = 0;
    std::int32_t parent = 0;  ///< a number that no part has, of those that bear none
    int line = 0;
};

/// Axes as parts, each after the one that bears it.
struct PartAxis {
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::uint32_t bearer = none;       ///< an axis
    std::uint32_t on_part = none;      ///< that bears its first part
    std::vector<std::uint32_t> parts;  ///< from its base to its tip
};

/// `is_root(parent)` tells the numbers that mean none; `next(part, borne)` chooses which of the parts that a part bears
/// continues its axis, as an index into `borne`, or one beyond. Throws UserError for a number twice, an unknown parent
/// and parts that bear each other in a ring.
std::vector<PartAxis> axes_of_parts(
    const std::vector<NamedPart>& parts, const std::function<bool(std::int32_t parent)>& is_root,
    const std::function<std::size_t(std::uint32_t part, const std::vector<std::uint32_t>& borne)>& next,
    const std::string& file);

/// Appends the axis, without nodes: on the one that bears it, or as the first of a plant of its own.
LooseAxis& begin_axis(const PartAxis& axis, Place place, std::vector<LooseAxis>& axes, MeasuredPlants& plants);

/// For each part, the part that bears it; PartAxis::none for roots. Throws as above.
std::vector<std::uint32_t> bearers_of(const std::vector<NamedPart>& parts,
                                      const std::function<bool(std::int32_t parent)>& is_root, const std::string& file);

/// The parts in an order in which each stands after the one that bears it. Throws as above for rings.
std::vector<std::uint32_t> bearers_first(const std::vector<NamedPart>& parts, const std::vector<std::uint32_t>& bearers,
                                         const std::string& file);

}  // namespace espalier::language::measured

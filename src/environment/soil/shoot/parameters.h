// How well shoots lead water, as a scene says it.
#pragma once

#include "espalier/base/settings.h"

#include "environment/soil/shoot/vulnerability.h"

#include <optional>

namespace espalier::environment {

struct ShootKind {
    double stem_conductivity = 0;  ///< of the cross-section of an internode, cm/d
    double stem_capacity = 0;      ///< water that a volume of it gives as its head falls, 1/cm
    Vulnerability stem;
    double leaf_conductance = 0;  ///< from the internode into the leaf, cm/d per head of one cm, times its area: 1/d
    double leaf_capacity = 0;     ///< of its area, cm3 per cm2 and cm of head: without unit
    Vulnerability leaf;

    /// Of the tables `stem` and `leaf`; none where the scene has no `stem`. Throws UserError.
    static std::optional<ShootKind> read(const Settings& settings);
};

}  // namespace espalier::environment

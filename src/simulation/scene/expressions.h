// Expressions of a scene in the settings of its models: influence = "= 3 * LENGTH".
#pragma once

#include "espalier/simulation/scene.h"

namespace espalier::simulation {

/// Replaces the expressions of a scene by numbers. Those of a plant read the #defines of its model, those of
/// [simulation], [environment] and [timeline] the first plant's. Throws UserError.
std::vector<ComputedValue> evaluate_expressions(const Settings& root);

/// The error, saying of which settings the values follow that it speaks of.
std::vector<Diagnostic> explained(std::vector<Diagnostic> diagnostics, const std::vector<ComputedValue>& computed);
UserError explained(const UserError& error, const std::vector<ComputedValue>& computed);

}  // namespace espalier::simulation

// Expressions of a scene in the settings of its models: influence = "= 3 * LENGTH".
#pragma once

#include "espalier/base/settings.h"

namespace espalier::simulation {

/// Replaces the expressions of a scene by numbers. Those of a plant's stages and turtle read the #defines of its model,
/// those of [simulation], [environment] and [timeline] the first plant's. Throws UserError.
void evaluate_expressions(const Settings& root);

}  // namespace espalier::simulation

// What is known of one module of a growth: who it is, where it comes from, what it was told.
#pragma once

#include "espalier/simulation/scene.h"

#include "studio/growth/kept_steps.h"
#include "studio/protocol/picked.h"

#include <cstdint>
#include <string>
#include <vector>

namespace espalier::studio {

/// The answer to `pick`. `module` is counted through all plants. Throws UserError if there
/// is no such step or module.
Picked module_info(const Scene& scene, const KeptSteps& steps, int step, std::uint32_t module);

/// What modules can be coloured by.
std::vector<std::string> column_names(const Scene& scene);
/// The message `ESC1` with one number a module. Throws UserError if there is no such step or column.
std::string column(const Scene& scene, const KeptSteps& steps, std::uint32_t growth, int step, const std::string& name);

}  // namespace espalier::studio

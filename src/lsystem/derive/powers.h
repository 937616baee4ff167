// Several steps at once, where nothing but its letter decides what becomes of a module.
#pragma once

#include "lsystem/compile/compiled_model.h"

#include <cstddef>

namespace espalier {

/// True if the model can be derived without knowing the strings between: no parameters, draws, contexts, cuts, blocks
/// or decomposition.
bool has_powers(const CompiledModel& model);

/// Writes what `from` becomes in so many steps. False, with `to` as it was, if its letters have parameters, or if one
/// of the steps would not fit into `memory`, so that it must be told which.
bool raise_to_power(const CompiledSystem& model, const ModuleString& from, int steps, std::size_t memory,
                    ModuleString& to);

}  // namespace espalier

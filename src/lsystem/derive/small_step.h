// A step of a small string whose letters tell all. What a step of any string looks after, from chunks to forecasts,
// takes longer than so few modules.
#pragma once

#include "lsystem/compile/compiled_model.h"

#include <cstdint>

namespace espalier {

/// Nothing but writing modules is done in a step of the model's strings.
bool has_small_steps(const CompiledModel& model);

/// Writes the string that `from`, which has a lineage, becomes in this step. False, and anything in `to`, where that is
/// not for such a step to do: letters do not tell all, strings are large, memory is short, or a value is not finite.
bool rewrite_small(const Plans& plans, const ModuleString& from, std::uint32_t step, std::size_t memory,
                   ModuleString& to);

}  // namespace espalier

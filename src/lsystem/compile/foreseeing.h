// What the writing of a string tells of its next step: where it will change.
#pragma once

#include "lsystem/derive/rewriting.h"

namespace espalier {

/// Says of all plans how the string grows by them and, where letters alone tell, what will change of what they write.
void plan_ahead(const CompiledSystem& system, Plans& plans);

/// Lists the changes of what replaces a chunk, and adds up the letters of its stretches.
void foresee(const StepInput& input, Scratch& scratch, const Chunk& chunk, const ModuleString& to);

/// True if the letters of a chunk are those that its stretches were written with.
bool is_as_written(const StepInput& input, const Chunk& chunk);

}  // namespace espalier

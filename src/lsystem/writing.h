// Writes what measuring found: the pass that decides how fast a plant grows.
#pragma once

#include "rewriting.h"

namespace espalier {

/// Writes the part of `to` that replaces a chunk; the columns have their final size.
/// False if the chunk's measure does not fit its modules: then nothing outside the chunk's part was written.
bool write(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to);

/// Writes identities, parents and births of a chunk whose letters are written.
void write_lineage(const StepInput& input, const Scratch& scratch, const Chunk& chunk, ModuleString& to);

}  // namespace espalier

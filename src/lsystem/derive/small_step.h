// A small string in one pass, where letters alone decide what replaces its modules: what a step spends on chunks and
// lists of replacements would be as much again for each of ten thousand small plants.
#pragma once

#include "lsystem/compile/compiled_model.h"

namespace espalier::lsystem {

/// Writes the step from a small string that has its lineage to `to`. False if that is not so simple, and where the step
/// fails: then `to` is to be written by another way, which says why.
bool rewrite_small(const CompiledSystem& system, const ModuleString& from, std::uint32_t step, std::size_t memory,
                   ModuleString& to);

}  // namespace espalier::lsystem

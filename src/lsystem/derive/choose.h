// Finds the modules that are replaced, and chooses a production for each, so that writing never matches again.
#pragma once

#include "lsystem/derive/step.h"

namespace espalier::lsystem {

/// Where letters alone do not decide: fills in what a chunk's modules are replaced by, and what it becomes.
void choose_replacements(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine);

/// Where letters alone decide: writes what a chunk's modules are replaced by to `replacements`; returns how many they
/// are.
std::size_t list_known_replacements(const StepInput& input, const Chunk& chunk, Column<Replacement>& replacements);

/// Adds a module to those that wait, with its neighbours if productions may read their parameters.
void add_to(Batch& batch, const StepInput& input, std::size_t module, const double* values);

}  // namespace espalier::lsystem

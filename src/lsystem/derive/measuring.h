// Chooses the production of every module and measures what it will write, so that writing never matches again.
#pragma once

#include "lsystem/derive/rewriting.h"

namespace espalier {

/// A module of the step's string, whose parameters begin at `values`; so many of those that come to draw stand before.
inline Site site_of(const StepInput& input, std::size_t module, const double* values, std::size_t drawers) {
    const auto at = static_cast<std::size_t>(values - input.from.parameters.data());
    const std::size_t named = input.ancestry == Ancestry::drawers ? drawers : module;
    const Column<Identity>& identities = input.from.identities;
    return {module, at, input.from.letters[module], values, named < identities.size() ? identities[named] : 0, 0};
}

/// Finds a chunk's changes, chooses their plans, and measures what it will become (`out_end` and the like, counted from
/// its beginning).
void measure(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine);
/// The same where its changes were foreseen.
void measure_changes(const StepInput& input, Chunk& chunk, Machine& machine);

}  // namespace espalier

// Chooses the production of every module and measures what it will write, so that writing never matches again.
#pragma once

#include "rewriting.h"

namespace espalier {

/// A module of the step's string, whose parameters begin at `values`.
inline Site site_of(const StepInput& input, std::size_t module, const double* values) {
    const auto at = static_cast<std::size_t>(values - input.from.parameters.data());
    return {module,
            at,
            input.from.letters[module],
            values,
            input.from.identities.empty() ? 0 : input.from.identities[module],
            0};
}

/// Sets the choices of a chunk's modules whose letters have plans to choose from, and the chunk's measure
/// (`out_end`, `out_parameters_end`, counted from its beginning).
void measure(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine);

}  // namespace espalier

// How the production of every letter is chosen, worked out when the model is compiled: what depends on the letter and
// its neighbours' letters alone is a table.
#pragma once

#include "lsystem/compile/plans.h"
#include "lsystem/contexts/neighbours.h"

#include <cstdint>
#include <vector>

namespace espalier::lsystem {

class CompiledSystem;

/// What becomes of a letter between two classes of neighbours.
struct Outcome {
    enum class Way : std::uint8_t {
        known,    ///< plan `index` of Plans::choices
        sampled,  ///< one of pool `index`, by a random number
        matched,  ///< by trying the candidates `index`
        spelled,  ///< the first of the candidates `index` whose strict predecessor stands there
        tested,   ///< by the conditions of the candidates `index`, and by their weights if the model is stochastic,
                  ///< which can be evaluated for many modules at once
    };
    Way way = Way::known;
    std::uint32_t index = 0;
};

/// Productions that may apply, in file order: Choosing::candidates[begin] to candidates[end].
struct Candidates {
    std::uint32_t begin = 0, end = 0;
};

/// Productions of constant weights that all apply. The choice is that after as many limits as are not above the random
/// number, in units of 2^-53.
struct Pool {
    std::vector<std::uint64_t> limits;
    std::vector<std::uint32_t> plans;  ///< one more than limits: among Plans::choices
};

struct Choosing {
    ContextSides sides;
    /// A pattern ends branches with `=`, or names brackets to its left: they are followed by their partners.
    bool needs_partners = false;

    // Tables by letter * places + left class * right_classes + right class.
    std::vector<Lookup> lookups;
    std::vector<Outcome> outcomes;
    std::uint32_t left_classes = 1, right_classes = 1;

    std::uint32_t places() const { return left_classes * right_classes; }

    std::vector<Candidates> trials;
    std::vector<std::uint32_t> candidates;  ///< candidates of all trials: indices of productions
    std::vector<LetterId> ranks;            ///< choice of each production, among its letter's
    std::vector<Pool> pools;
};

/// For `system.rules`, whose plans are made. Neighbours are also those that its decomposition asks for.
Choosing make_choosing(const CompiledSystem& system);

}  // namespace espalier::lsystem

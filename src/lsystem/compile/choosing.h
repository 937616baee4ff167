// How the production of every letter is chosen, worked out when the model is compiled: what depends on the letter and
// its neighbours' letters alone is a table.
#pragma once

#include "lsystem/compile/plans.h"
#include "lsystem/contexts/neighbours.h"

#include <cstdint>
#include <vector>

namespace espalier {

class CompiledSystem;

/// What a letter between two classes of neighbours becomes, where the table of choices does not tell.
struct Outcome {
    enum class Way : std::uint8_t {
        known,    ///< choice `index`
        drawn,    ///< by lottery `index`
        matched,  ///< by trying the productions of trial `index`
        tested,   ///< by the conditions of trial `index`, which can be evaluated for many modules at once
        spelled,  ///< the first of trial `index` whose strict predecessor's letters stand there
    };
    Way way = Way::known;
    std::uint32_t index = 0;
};

/// Productions that may apply, in file order: trials[begin] to trials[end].
struct Trial {
    std::uint32_t begin = 0, end = 0;
};

/// Productions of constant weights that all apply. The choice is that after as many limits as are not above the draw,
/// in units of 2^-53.
struct Lottery {
    std::vector<std::uint64_t> limits;
    std::vector<std::uint32_t> prizes;  ///< one more than limits: plans, among Plans::choices
};

/// What the table tells of a letter between two classes of neighbours.
struct Told {
    std::uint64_t holding = 0;  ///< Plans::holdings of the letter
    bool changes = false;       ///< the module does not simply live on, for all that is told
};

struct Choosing {
    Gazes gazes;
    /// A pattern ends branches with `=`, or names brackets to its left: they are followed by their partners.
    bool needs_partners = false;

    // Tables by letter * places + left class * right_classes + right class.
    std::vector<Told> told;
    std::vector<Outcome> outcomes;
    std::vector<const Plan*> plans;      ///< of outcomes that are known
    std::vector<std::uint32_t> lengths;  ///< of the same
    std::uint32_t left_classes = 1, right_classes = 1;
    bool tells_all = true;

    std::uint32_t places() const { return left_classes * right_classes; }

    std::vector<Trial> trials;
    std::vector<std::uint32_t> tried;  ///< indices of productions
    std::vector<LetterId> ranks;       ///< choice of each production, among its letter's
    std::vector<Lottery> lotteries;
};

/// For `system.rules`, whose plans are made. Neighbours are also those that its decomposition asks for.
Choosing make_choosing(const CompiledSystem& system);

}  // namespace espalier

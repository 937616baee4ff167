// How the production of every letter is chosen, worked out when the model is compiled: what depends on the letter and
// its neighbours' letters alone is a table.
#pragma once

#include "neighbours.h"

#include <cstdint>
#include <vector>

namespace espalier {

class CompiledSystem;

/// What a letter between two classes of neighbours becomes.
struct Outcome {
    enum class Way : std::uint8_t {
        known,    ///< `choice`
        drawn,    ///< by lottery `more`
        matched,  ///< by trying the productions of trial `more`
    };
    std::uint32_t length = 0, parameters = 0;  ///< of what a known choice writes
    std::uint32_t more = 0;
    LetterId choice = 0;  ///< among its letter's Plan::choices
    Way way = Way::known;
};

/// Productions that may apply, in file order: trials[begin] to trials[end].
struct Trial {
    std::uint32_t begin = 0, end = 0;
};

/// Productions of constant weights that all apply. The choice is that after as many limits as are not above the draw,
/// in units of 2^-53.
struct Lottery {
    std::vector<std::uint64_t> limits;
    std::vector<LetterId> choices;  ///< one more than limits
};

struct Choosing {
    Gazes gazes;
    /// A pattern ends branches with `=`, or names brackets to its left: they are followed by their partners.
    bool needs_partners = false;

    /// A letter's outcomes: outcomes[first + (place & mask)], where `place` is left class * right_classes + right
    /// class.
    struct Row {
        std::uint32_t first = 0, mask = 0;
    };
    std::vector<Row> rows;  ///< by letter
    std::vector<Outcome> outcomes;
    std::uint32_t left_classes = 1, right_classes = 1;
    bool matches = false;  ///< some way is `matched`
    bool draws = false;    ///< some way is `drawn`

    std::vector<Trial> trials;
    std::vector<std::uint32_t> tried;  ///< indices of productions
    std::vector<LetterId> choices;     ///< of each production, among its letter's
    std::vector<Lottery> lotteries;
};

/// For `system.rules`, whose plans are made. Neighbours are also those that its decomposition asks for.
Choosing make_choosing(const CompiledSystem& system);

}  // namespace espalier

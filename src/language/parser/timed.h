// Timed productions: modules that carry their ages, and are replaced when they reach their terminal age.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "language/text/source.h"

#include <optional>
#include <vector>

namespace espalier::language {

/// The section `timed` of an L-system: Prusinkiewicz & Lindenmayer 1990, section 6.1. The first parameter of a timed
/// module is its age. A step lets it grow by the time step; a module that reaches its terminal age is replaced by
/// modules that are as much older than their first age as it is older than its terminal age.
struct TimedRules {
    RuleSet rules;  ///< X(age, ...) : age == terminal age --> successor
    std::optional<Expression> time_step;
    std::vector<SymbolId> ageing;  ///< modules that are never replaced

    /// Throws SyntaxError for a production that does not tell a terminal age.
    static void require_terminal_age(const Production& production, Location at);
    /// Writes the section as the productions and the decomposition that it stands for.
    void add_to(LSystem& system, const Alphabet& alphabet) const;
};

}  // namespace espalier::language

#include "expansion.h"

namespace espalier {

void Expansion::push_successor(const CompiledProduction& production, const Lineage* strict, std::uint32_t step,
                               std::uint32_t depth, ModuleStack& stack) {
    if (!production.after.empty()) machine_.run(production.after);
    machine_.run(production.successor);
    successor_.resize(production.parameters);
    for (std::size_t k = 0; k < production.parameters; ++k) {
        successor_[k] = machine_.value(production.successor.results[k]);
    }
    require_finite(production, successor_.data());
    const Brood brood(strict[0].identity, step);
    const double* end = successor_.data() + production.parameters;
    for (std::size_t k = production.length; k-- > 0;) {
        const Descent& descent = production.descents[k];
        ModuleStack::Entry entry{production.letters[k], production.arities[k], depth, {}};
        if (descent.heir_of != Descent::born)
            entry.lineage = strict[descent.heir_of];
        else
            entry.lineage = {brood.born(descent.place, depth), strict[0].identity, step};
        end -= entry.arity;
        stack.push(entry, end);
    }
}

}  // namespace espalier

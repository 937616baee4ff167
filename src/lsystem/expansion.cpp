#include "expansion.h"

namespace espalier {

const ModuleStack::Entry* Expansion::replace(ModuleStack& stack, const Site& origin, std::uint32_t step) {
    entry_ = stack.pop(values_);
    letter_ = entry_.letter;
    if (!rules_.has(entry_.letter)) return &entry_;
    if (entry_.depth >= rules_.maximum_depth) {
        reached_limit_ |= entry_.depth > 0 && rules_.always[entry_.letter] >= 0;
        return &entry_;
    }
    Site site = origin;
    site.letter = entry_.letter;
    site.values = values_.data();
    site.drawer = mix(entry_.lineage.identity, entry_.depth + 1);
    const CompiledProduction* production = matcher_.choose(rules_, site);
    if (!production) return &entry_;
    matcher_.begin_successor(*production, site);
    push_successor(*production, &entry_.lineage, step, entry_.depth + 1, stack);
    return nullptr;
}

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

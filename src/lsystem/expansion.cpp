#include "expansion.h"

#include <algorithm>

namespace espalier {

/// What replaces the module that was taken from the stack, alone or with those that follow it there.
const CompiledProduction* Expansion::choose(const ModuleStack& stack, Site& site) {
    if (rules_.several_strict) {
        const std::size_t followers = std::min(stack.size(), rules_.widest - 1);
        following_.assign(1, no_letter);  // never empty, so that it has an address
        for (std::size_t k = 0; k < followers; ++k) following_.push_back(stack.below(k).letter);
        stack.copy_values(followers, values_);
        site.following = following_.data() + 1;
        site.followers = followers;
    }
    site.values = values_.data();
    return matcher_.choose(rules_, site);
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

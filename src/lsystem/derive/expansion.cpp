#include "lsystem/derive/expansion.h"

#include "lsystem/derive/lanes.h"

#include <algorithm>

namespace espalier::lsystem {

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

void Expansion::evaluate(const CompiledProduction& production, const double* values) {
    if (!production.after.empty()) machine_.run(production.after);
    successor_.resize(production.parameters);
    // Blocks may have changed what the formals are bound to.
    const bool in_lanes = production.affine && production.before.empty() && production.after.empty();
    if (in_lanes && write_lanes_exactly(production, values, successor_.data())) return;
    machine_.run(production.successor);
    for (std::size_t k = 0; k < production.parameters; ++k) {
        successor_[k] = machine_.value(production.successor.results[k]);
    }
    require_finite(production, successor_.data());
}

void Expansion::begin_births(const CompiledProduction& production, const Lineage* strict, std::uint32_t step,
                             std::uint32_t depth) {
    const Siblings born{strict[0].identity, step, depth, 0};
    origin_ = born.origin();
    if (siblings_ && production.descent.born > 0) row_ = siblings_->add(born);
}

void Expansion::push_successor(const CompiledProduction& production, const double* values, const Lineage* strict,
                               std::uint32_t step, std::uint32_t depth, ModuleStack& stack) {
    evaluate(production, values);
    begin_births(production, strict, step, depth);
    const double* end = successor_.data() + production.parameters;
    for (std::size_t k = production.length; k-- > 0;) {
        const std::uint16_t arity = production.arities[k];
        end -= arity;
        stack.push({production.letters[k], arity, depth, lineage(production.descent, k, strict)}, end);
    }
}

}  // namespace espalier::lsystem

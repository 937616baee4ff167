#include "lsystem/compile/plans.h"

#include "lsystem/compile/compiled_model.h"

#include <algorithm>

namespace espalier::lsystem {

void Lanes::push_back(const Lane& lane) {
    sources.push_back(lane.source);
    scales.push_back(lane.scale);
    offsets.push_back(lane.offset);
}

void Lanes::pad() {
    while (sources.size() % value_block != 0) push_back({});
}

std::uint64_t PackedSizes::pack(const Plan& plan, bool simple) {
    return std::uint64_t{plan.length} | std::uint64_t{plan.parameters} << bits | std::uint64_t{plan.reads} << 2 * bits |
           std::uint64_t{plan.bears} << 3 * bits | std::uint64_t{!simple} << (3 * bits + flag_bits);
}

namespace {

Plan::Kind kind_of(const CompiledProduction& production) {
    if (!production.after.empty()) return Plan::Kind::program;
    if (production.parameters == 0) return Plan::Kind::bare;
    if (production.affine) return Plan::Kind::lanes;
    return production.rest_places.empty() ? Plan::Kind::program : Plan::Kind::mixed;
}

Plan plan_of(const CompiledProduction& production) {
    Plan plan;
    std::copy_n(production.letters.begin(), std::min(production.letters.size(), letter_block), plan.block.begin());
    plan.letters = production.letters.data();
    plan.length = static_cast<std::uint32_t>(production.length);
    plan.parameters = static_cast<std::uint32_t>(production.parameters);
    plan.width = static_cast<std::uint16_t>(production.strict.size());
    for (const CompiledPattern& pattern : production.strict) plan.reads += pattern.arity;
    plan.lanes = &production.lanes;
    plan.production = &production;
    plan.kind = kind_of(production);
    plan.bears = production.descent.born > 0;
    plan.moves = plan.width > 1 || !production.descent.in_place();
    return plan;
}

Plan copy_of(LetterId letter, std::uint16_t arity) {
    Plan copy;
    copy.block[0] = letter;
    copy.length = 1;
    copy.reads = copy.parameters = arity;
    return copy;
}

void measure(Plans& plans) {
    for (const Plan& plan : plans.choices) {
        plans.longest = std::max<std::size_t>(plans.longest, plan.length);
        plans.most_parameters = std::max<std::size_t>(plans.most_parameters, plan.parameters);
        plans.most_read = std::max<std::size_t>(plans.most_read, plan.reads);
    }
    const std::size_t most = std::max({plans.longest, plans.most_parameters, plans.most_read});
    plans.sizes.at_once = std::min<std::size_t>(PackedSizes::most_at_once, PackedSizes::mask / most);
    for (std::size_t l = 0; l < plans.known.size(); ++l) {
        const Plan& plan = plans.of_letter(static_cast<LetterId>(l));
        const bool decided = plan.kind != Plan::Kind::copy || !plans.lookups[l].replaced;
        const bool computes = plan.kind == Plan::Kind::mixed || plan.kind == Plan::Kind::program;
        plans.sizes.of_letter.push_back(PackedSizes::pack(plan, decided && !computes));
    }
}

}  // namespace

Plans make_plans(const CompiledSystem& system) {
    const CompiledRules& rules = system.rules;
    const std::span<const std::uint16_t> arities = system.source->alphabet.arities();
    Plans plans;
    for (std::size_t l = 0; l < arities.size(); ++l) {
        const auto letter = static_cast<LetterId>(l);
        plans.first.push_back(static_cast<std::uint32_t>(plans.choices.size()));
        plans.known.push_back(plans.first.back());
        plans.choices.push_back(copy_of(letter, arities[l]));
        for (std::uint32_t k = rules.first[l]; k < rules.first[l + 1]; ++k) {
            const std::uint32_t candidate = rules.candidates[k];
            if (rules.always[l] == static_cast<std::int32_t>(candidate))
                plans.known.back() = static_cast<std::uint32_t>(plans.choices.size());
            plans.choices.push_back(plan_of(rules.productions[candidate]));
        }
        plans.lookups.push_back({arities[l], rules.has(letter)});
        plans.all_known &= !rules.has(letter) || rules.always[l] >= 0;
    }
    measure(plans);
    return plans;
}

}  // namespace espalier::lsystem

#include "lsystem/compile/plans.h"

#include "lsystem/compile/compiled_model.h"

#include <algorithm>

namespace espalier {

void Lanes::push_back(const Lane& lane) {
    sources.push_back(lane.source);
    scales.push_back(lane.scale);
    offsets.push_back(lane.offset);
}

void Lanes::pad() {
    while (sources.size() % value_block != 0) push_back({});
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
    plan.arity = production.strict[0].arity;
    plan.width = static_cast<std::uint16_t>(production.strict.size());
    if (plan.width > 1) plan.second = production.strict[1].letter;
    for (const CompiledPattern& pattern : production.strict) plan.reads += pattern.arity;
    plan.drawers = static_cast<std::uint32_t>(production.drawers.length);
    plan.read_drawers = static_cast<std::uint32_t>(production.drawers.heirs.size());
    plan.lanes = &production.lanes;
    plan.production = &production;
    plan.kind = kind_of(production);
    plan.inherits = production.kin.same;
    return plan;
}

Plan copy_of(LetterId letter, std::uint16_t arity, bool draws) {
    Plan copy;
    copy.block[0] = letter;
    copy.length = 1;
    copy.arity = arity;
    copy.reads = arity;
    copy.parameters = arity;
    copy.drawers = copy.read_drawers = draws;
    copy.kind = arity <= value_block ? Plan::Kind::copy : Plan::Kind::wide_copy;
    return copy;
}

void measure(Plans& plans) {
    const auto include = [&](const Plan& plan) {
        plans.longest = std::max<std::size_t>(plans.longest, plan.length);
        plans.most_parameters = std::max<std::size_t>(plans.most_parameters, plan.parameters);
        plans.most_read = std::max<std::size_t>(plans.most_read, plan.reads);
    };
    for (const Plan& plan : plans.of_letter) {
        include(plan);
        plans.lengths.push_back(plan.length);
        plans.parameters.push_back(plan.parameters);
        plans.rewritten.push_back(plan.depends() || (plan.production && !plan.inherits));
    }
    for (const Plan& plan : plans.choices) include(plan);
}

std::uint64_t packed_sizes(const Plan& plan) {
    const bool runs = plan.kind == Plan::Kind::program || plan.kind == Plan::Kind::mixed;
    const bool fits = std::max({plan.reads, plan.length, plan.parameters}) <= PackedSizes::most;
    if (runs || plan.depends() || !fits) return PackedSizes::unknown;
    return PackedSizes::pack(plan.reads, plan.length, plan.parameters);
}

/// What the next step will make of letters that stand alone.
std::uint64_t measure_of(const Plans& plans, const LetterId* letters, const LetterId* end) {
    std::uint64_t measure = 0;
    while (letters != end) {
        const Plan& plan = spelled_plan(plans.of_letter[*letters], letters, end);
        measure += std::uint64_t{plan.parameters} << 32 | plan.length;
        letters += plan.width;
    }
    return measure;
}

/// What the next step will make of what each plan writes. Where symbols are spelled across what two plans write, the
/// next step will find out that this is wrong.
void look_ahead(Plans& plans) {
    const std::uint64_t most = std::max(plans.longest, plans.most_parameters);
    plans.looks_ahead = plans.all_known && most < (std::uint64_t{1} << 32) / (longest_stretch + plans.longest);
    if (!plans.looks_ahead) return;
    for (std::vector<Plan>* const each : {&plans.of_letter, &plans.choices}) {
        for (Plan& plan : *each) {
            const LetterId* const letters = plan.production ? plan.letters : plan.block.data();
            plan.next = measure_of(plans, letters, letters + plan.length);
        }
    }
}

}  // namespace

bool spells_rest(const Plan& plan, const LetterId* letters) {
    const std::vector<CompiledPattern>& strict = plan.production->strict;
    for (std::size_t k = 2; k < strict.size(); ++k) {
        if (letters[k] != strict[k].letter) return false;
    }
    return true;
}

Plans make_plans(const CompiledSystem& model) {
    const CompiledRules& rules = model.rules;
    const std::span<const std::uint16_t> arities = model.source->alphabet.arities();
    Plans plans;
    plans.choices.reserve(rules.productions.size() + arities.size());  // never moved, since plans point to it
    for (std::size_t l = 0; l < arities.size(); ++l) {
        const auto letter = static_cast<LetterId>(l);
        const bool known = rules.always[l] >= 0, draws = model.drawers[l];
        Plan plan = known ? plan_of(rules.productions[static_cast<std::size_t>(rules.always[l])])
                          : copy_of(letter, arities[l], draws);
        plans.choices.push_back(plan);
        plan.choices = &plans.choices.back();
        if (rules.has(letter) && !known) {
            bool spelled = !rules.stochastic;
            for (std::uint32_t k = rules.first[l]; k < rules.first[l + 1]; ++k) {
                const CompiledProduction& production = rules.productions[rules.candidates[k]];
                spelled &= production.spelled();
                plans.choices.push_back(plan_of(production));
            }
            plan.kind = spelled ? Plan::Kind::spelled : Plan::Kind::choose;
            plan.productions = static_cast<LetterId>(rules.first[l + 1] - rules.first[l]);
            plans.all_known &= spelled;
            plans.spelled |= spelled;
        }
        plans.of_letter.push_back(plan);
        plans.holdings.push_back(std::uint64_t{arities[l]} << 32 | draws);
        plans.draws |= draws;
    }
    measure(plans);
    for (const Plan& plan : plans.of_letter) plans.sizes.push_back(packed_sizes(plan));
    if (model.may_cut) plans.sizes[Alphabet::cut] = PackedSizes::unknown;
    look_ahead(plans);
    return plans;
}

}  // namespace espalier

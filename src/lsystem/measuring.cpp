#include "measuring.h"

#include <algorithm>

namespace espalier {
namespace {

/// The place of a production among the plans its letter chooses from.
LetterId choice_of(const CompiledRules& rules, LetterId letter, const CompiledProduction& production) {
    const auto index = static_cast<std::uint32_t>(&production - rules.productions.data());
    const auto first = rules.candidates.begin() + rules.first[letter];
    const auto last = rules.candidates.begin() + rules.first[letter + 1];
    return static_cast<LetterId>(std::lower_bound(first, last, index) - first + 1);
}

}  // namespace

void measure(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine) {
    const CompiledSystem& model = input.model;
    Matcher matcher(model, input.view, machine);
    matcher.set_draws(input.key, input.step);
    const double* values = input.from.parameters.data() + chunk.parameters_at;
    std::size_t modules = 0, parameters = 0, i = chunk.begin;
    try {
        for (; i < chunk.end; ++i) {
            const LetterId letter = input.from.letters[i];
            const Plan* plan = &model.plans.of_letter[letter];
            if (plan->kind == Plan::Kind::choose) {
                const CompiledProduction* chosen = matcher.choose(model.rules, site_of(input, i, values));
                const LetterId choice = chosen ? choice_of(model.rules, letter, *chosen) : 0;
                scratch.choices[i] = choice;
                plan = plan->choices + choice;
            }
            modules += plan->length;
            parameters += plan->parameters;
            values += plan->arity;
        }
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, model.source->alphabet, input.from.letters[i], values, input.step));
    }
    chunk.out_end = modules;
    chunk.out_parameters_end = parameters;
}

}  // namespace espalier

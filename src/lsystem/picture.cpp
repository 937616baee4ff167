// Homomorphism: the picture of a module, for interpretation. Looking never changes growth.
#include "derivation_state.h"

#include <fmt/format.h>

namespace espalier {
namespace {

constexpr std::size_t most_modules = 100'000'000;  // of one picture, whatever memory there is
constexpr std::size_t modules_between_looks = 4096;

/// A homomorphism that multiplies at every depth is caught before it has eaten the machine.
void require_bounds(const ModuleString& picture, std::size_t memory, const CompiledProduction& production) {
    if (picture.size() % modules_between_looks != 0) return;
    if (picture.size() < most_modules && picture.bytes() <= memory) return;
    throw RunError(
        fmt::format("{}: the picture of one module grows beyond {} modules; look at the maximum depth of "
                    "the homomorphism",
                    to_string(production.source->place), picture.size()));
}

/// Expands the module at `site` with the painter; false if no production applies.
bool paint(Painter& painter, const CompiledRules& rules, const Site& site, std::uint32_t step, std::size_t memory,
           ModuleString& picture) {
    const CompiledProduction* production = painter.matcher.choose(rules, site);
    if (!production) return false;
    const Lineage lineage{site.drawer, 0, 0};
    painter.matcher.begin_successor(*production, site);
    painter.stack.clear();
    painter.expansion.push_successor(*production, &lineage, step, 1, painter.stack);
    painter.expansion.run(painter.stack, site, step, [&](const ModuleStack::Entry& entry, const double* values) {
        picture.append(entry.letter, {values, entry.arity});
        require_bounds(picture, memory, *production);
    });
    return true;
}

}  // namespace

bool Derivation::has_homomorphism() const {
    return !state_->model->homomorphism.empty();
}

bool Derivation::may_have_picture(LetterId letter) const {
    return state_->model->homomorphism.has(letter) && state_->model->homomorphism.maximum_depth > 0;
}

bool Derivation::picture(const ModuleString& string, const std::vector<std::size_t>* offsets, const BranchLinks& links,
                         std::size_t module, std::size_t parameters_at, ModuleString& picture) const {
    if (!may_have_picture(string.letters[module])) return false;
    State& state = *state_;
    const CompiledModel& model = *state.model;
    const CompiledRules& rules = model.homomorphism;
    std::unique_ptr<Painter>& painter = state.painters.local();
    if (!painter) painter = std::make_unique<Painter>(model);
    painter->matcher.view({&string, links.partner.data(), offsets ? offsets->data() : nullptr});
    painter->matcher.set_draws(RandomKey(state.settings.seed, state.settings.plant, Stream::homomorphism,
                                         rules.salt.value_or(state.services.salt)),
                               state.step);
    const double* values = string.parameters.data() + parameters_at;
    const Identity identity = string.has_lineage() ? string.identities[module] : mix(module);
    const Site site{module, parameters_at, string.letters[module], values, identity, 1};
    try {
        if (!rules.effects.assigns && !rules.effects.ordered) {
            painter->machine.attach(&state.variables, &state.services, Stream::homomorphism);
            return paint(*painter, rules, site, state.step, state.settings.memory, picture);
        }
        painter->variables = state.variables;
        painter->services = state.services;
        painter->machine.attach(&painter->variables, &painter->services, Stream::homomorphism);
        return paint(*painter, rules, site, state.step, state.settings.memory, picture);
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, model.source->alphabet, site.letter, values, state.step));
    }
}

}  // namespace espalier

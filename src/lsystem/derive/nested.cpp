// One step of a string that holds sub-L-systems: from left to right, each part by the rules of its own L-system.
#include "lsystem/derive/derivation_state.h"
#include "lsystem/derive/one_pass.h"

#include <fmt/format.h>

namespace espalier {
namespace {

/// Who lives in a string: identities of `?` with the L-system they ask for.
std::set<std::pair<Identity, const CompiledSystem*>> inhabitants(const CompiledModel& model,
                                                                 const ModuleString& string) {
    std::set<std::pair<Identity, const CompiledSystem*>> all;
    const auto arities = model.source->alphabet.arities();
    std::size_t at = 0;
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (model.enclosure.opens(string.letters[i])) {
            all.emplace(string.identities[i], model.labelled(string.parameters[at]));
        }
        at += arities[string.letters[i]];
    }
    return all;
}

/// What one L-system needs to rewrite its parts of the string.
struct Part {
    Part(const CompiledSystem& system, const StepInput& whole, Services& services, GrowingString& out)
        : input{system, whole.from, whole.view, whole.key, whole.step, whole.ancestry, whole.memory, whole.kept},
          machine(system.machine()),
          pass(input, machine, services, out) {}

    StepInput input;
    Machine machine;
    OnePass pass;
};

class NestedStep {
public:
    NestedStep(Derivation::State& state, const StepInput& input, ModuleString& to)
        : state_(state), model_(*state.model), bytes_(bytes_before(input)), out_(to, input, bytes_) {
        for (const auto& system : model_.systems) {
            parts_.push_back(std::make_unique<Part>(*system, input, state.services, out_));
        }
    }

    void run(const ModuleString& from, const ModuleString& to);

private:
    Part& part(std::uint32_t scope) { return *parts_[scopes_.all()[scope].system->index]; }
    void rewrite(const Passage& passage);
    void enter(std::uint32_t scope);
    void leave(std::uint32_t scope);
    void end_what_is_gone(const ModuleString& to);
    void run_block(std::uint32_t scope, const Program& block, const char* name);
    Variables* lent(std::uint32_t scope) { return state_.sub_systems.lend(scopes_.all(), scope, state_.variables); }

    Derivation::State& state_;
    const CompiledModel& model_;
    std::atomic<std::size_t> bytes_;
    GrowingString out_;
    std::vector<std::unique_ptr<Part>> parts_;
    Scopes scopes_;
    std::vector<Variables*> variables_;  ///< of each scope that was entered
};

void NestedStep::run(const ModuleString& from, const ModuleString& to) {
    scopes_.find(model_, from, state_.step);
    variables_.assign(scopes_.all().size(), nullptr);
    variables_[0] = &state_.variables;
    for (const Passage& passage : scopes_.passages()) {
        if (passage.kind == Passage::Kind::rewrite) rewrite(passage);
        if (passage.kind == Passage::Kind::enter) enter(passage.scope);
        if (passage.kind == Passage::Kind::leave) leave(passage.scope);
    }
    end_what_is_gone(to);
    for (const auto& part : parts_) {
        if (part->pass.reached_limit()) state_.depth_limit = true;
    }
    state_.follow_length();
    state_.warn_of_depth();
}

void NestedStep::rewrite(const Passage& passage) {
    Part& worker = part(passage.scope);
    worker.machine.attach(variables_[passage.scope], &state_.services, Stream::derivation);
    worker.pass.run_within(passage.begin, passage.end, passage.parameters_at, model_.enclosure);
}

void NestedStep::enter(std::uint32_t scope) {
    const Scope& entered = scopes_.all()[scope];
    if (entered.cut) return;
    const bool first = !state_.sub_systems.find(entered);
    if (first) state_.sub_systems.make(entered, state_.settings.memory);
    variables_[scope] = lent(scope);
    if (first) run_block(scope, entered.system->start, "Start");
    run_block(scope, entered.system->start_each, "StartEach");
}

void NestedStep::leave(std::uint32_t scope) {
    if (variables_[scope]) run_block(scope, scopes_.all()[scope].system->end_each, "EndEach");
}

// In the order in which they are left; those that a `%` cut off too.
void NestedStep::end_what_is_gone(const ModuleString& to) {
    const auto alive = inhabitants(model_, to);
    const bool last = static_cast<int>(state_.step) == state_.length;
    std::vector<std::uint32_t> gone;
    for (const Passage& passage : scopes_.passages()) {
        if (passage.kind != Passage::Kind::leave) continue;
        const Scope& scope = scopes_.all()[passage.scope];
        const bool lives = alive.contains({scope.identity, scope.system});
        if (!lives) gone.push_back(passage.scope);
        if (lives && !last) continue;
        variables_[passage.scope] = lent(passage.scope);
        if (variables_[passage.scope]) run_block(passage.scope, scope.system->end, "End");
    }
    for (const std::uint32_t scope : gone) state_.sub_systems.erase(scopes_.all()[scope]);
}

void NestedStep::run_block(std::uint32_t scope, const Program& block, const char* name) {
    if (block.empty()) return;
    Part& worker = part(scope);
    worker.machine.attach(variables_[scope], &state_.services, Stream::blocks);
    const std::string& label = scopes_.all()[scope].system->system->label;
    state_.in_block(worker.machine, fmt::format("the {} block of L-system {}", name, label),
                    [&] { worker.machine.run(block); });
    state_.follow_length();
}

}  // namespace

void Derivation::State::rewrite_nested(const ModuleString& from, ModuleString& to) {
    const StepInput input = prepare(from);
    if (from.size() <= grain) to = {};  // how much room a string begins with is not for its growth to depend on
    NestedStep(*this, input, to).run(from, to);
}

}  // namespace espalier

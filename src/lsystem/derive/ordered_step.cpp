// One step in the order of the string, one module after the other, each by the rules of the L-system it belongs to. It
// does whatever a model may ask for, and is what the faster ways are compared with.
#include "lsystem/derive/appending.h"
#include "lsystem/derive/derivation_state.h"

#include <fmt/format.h>

namespace espalier::lsystem {
namespace {

/// Who lives in a string: identities of `?` with the L-system they ask for.
std::set<std::pair<Identity, const CompiledSystem*>> inhabitants(const CompiledModel& model,
                                                                 const ModuleString& string) {
    std::set<std::pair<Identity, const CompiledSystem*>> all;
    const auto arities = model.source->alphabet.arities();
    std::size_t at = 0;
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (model.enclosure.opens(string.letters[i])) {
            all.emplace(string.identity(i), model.labelled(string.parameters[at]));
        }
        at += arities[string.letters[i]];
    }
    return all;
}

/// What one L-system needs to rewrite its parts of the string.
struct Worker {
    Worker(const CompiledSystem& system, const StepInput& whole, Services& services, GrowingPart& out)
        : input{system, whole.from, whole.view, whole.key, whole.step, whole.lineage, whole.memory, whole.kept},
          machine(system.machine()),
          appending(input, machine, services, out) {}

    StepInput input;
    Machine machine;
    Appending appending;
};

class OrderedStep {
public:
    OrderedStep(Derivation::State& state, const StepInput& input, GrowingPart& out)
        : state_(state), model_(*state.model) {
        for (const auto& system : model_.systems) {
            workers_.push_back(std::make_unique<Worker>(*system, input, state.services, out));
            if (!model_.nested) break;
        }
    }

    void run(const ModuleString& from);
    /// When the new string is written: ends the instances that are gone.
    void end(const ModuleString& to);

private:
    Worker& worker(std::uint32_t scope) { return *workers_[scopes_.all()[scope].system->index]; }
    void rewrite(const Passage& passage);
    void enter(std::uint32_t scope);
    void leave(std::uint32_t scope);
    void end_what_is_gone(const ModuleString& to);
    void run_block(std::uint32_t scope, const Program& block, const char* name);
    Variables* lent(std::uint32_t scope) { return state_.sub_systems.lend(scopes_.all(), scope, state_.variables); }

    Derivation::State& state_;
    const CompiledModel& model_;
    std::vector<std::unique_ptr<Worker>> workers_;
    Scopes scopes_;
    std::vector<Variables*> variables_;  ///< variables of each scope that was entered
    std::size_t rewritten_ = 0;          ///< modules before this one, by productions that reached beyond a cut
};

void OrderedStep::run(const ModuleString& from) {
    scopes_.find(model_, from, state_.step);
    variables_.assign(scopes_.all().size(), nullptr);
    variables_[0] = &state_.variables;
    for (const Passage& passage : scopes_.passages()) {
        if (passage.kind == Passage::Kind::rewrite) rewrite(passage);
        if (passage.kind == Passage::Kind::enter) enter(passage.scope);
        if (passage.kind == Passage::Kind::leave) leave(passage.scope);
    }
}

void OrderedStep::end(const ModuleString& to) {
    if (model_.nested) end_what_is_gone(to);
    for (const auto& worker : workers_) {
        if (worker->appending.reached_limit()) state_.depth_limit = true;
    }
}

void OrderedStep::rewrite(const Passage& passage) {
    Worker& by = worker(passage.scope);
    by.machine.attach(variables_[passage.scope], &state_.services, Stream::derivation);
    if (model_.nested)
        return by.appending.run_within(passage.begin, passage.end, passage.parameters_at, model_.enclosure);
    const auto arities = model_.source->alphabet.arities();
    std::size_t begin = passage.begin, parameters_at = passage.parameters_at;
    for (; begin < std::min(rewritten_, passage.end); ++begin) {
        parameters_at += arities[by.input.from.letters[begin]];
    }
    if (begin < passage.end) rewritten_ = by.appending.run(begin, passage.end, parameters_at);
}

void OrderedStep::enter(std::uint32_t scope) {
    const Scope& entered = scopes_.all()[scope];
    if (entered.cut) return;
    const bool first = !state_.sub_systems.find(entered);
    if (first) state_.sub_systems.make(entered, state_.memory);
    variables_[scope] = lent(scope);
    if (first) run_block(scope, entered.system->start, "Start");
    run_block(scope, entered.system->start_each, "StartEach");
}

void OrderedStep::leave(std::uint32_t scope) {
    if (variables_[scope]) run_block(scope, scopes_.all()[scope].system->end_each, "EndEach");
}

// In the order in which they are left; those that a `%` cut off too.
void OrderedStep::end_what_is_gone(const ModuleString& to) {
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

void OrderedStep::run_block(std::uint32_t scope, const Program& block, const char* name) {
    if (block.empty()) return;
    Worker& by = worker(scope);
    by.machine.attach(variables_[scope], &state_.services, Stream::blocks);
    const std::string& label = scopes_.all()[scope].system->system->label;
    state_.in_block(by.machine, fmt::format("the {} block of L-system {}", name, label),
                    [&] { by.machine.run(block); });
    state_.follow_length();
}

}  // namespace

void Derivation::State::rewrite_in_order(const StepInput& input, ModuleString& to) {
    std::atomic<std::size_t> bytes = bytes_before(input);
    if (scratch->pieces.empty()) scratch->pieces.resize(1);
    // A small string is written to the thread's memory first, so that the plant's has no more room than it needs.
    const bool is_small = input.from.size() <= grain;
    ModuleString& written = is_small ? scratch->pieces[0] : to;
    const auto runs = is_small ? GrowingPart::Runs::joined : GrowingPart::Runs::copied;
    std::deque<GrowingPart> parts;
    OrderedStep ordered(*this, input, parts.emplace_back(written, input, bytes, runs));
    ordered.run(input.from);
    if (is_small)
        join(input, scratch->pieces, parts, bytes_before(input), to);
    else
        add_siblings(input, parts[0], to);
    ordered.end(to);
}

}  // namespace espalier::lsystem

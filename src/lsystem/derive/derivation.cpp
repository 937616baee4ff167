// The order of a derivation: Start and axiom; then in each step StartEach, cut, match, choose, write or decompose,
// EndEach; and End after the last.
#include "base/prefetch.h"
#include "lsystem/derive/derivation_state.h"
#include "lsystem/derive/small_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::lsystem {

// --- Start ------------------------------------------------------------------------------------------------------

// A seed or a length that reads variables means those of the Start block.
void Derivation::start(ModuleString& string) {
    State& state = *state_;
    state.reset();
    state.begin_memory();
    const double length = state.variables.globals[1];
    state.run_block(state.main.start, "the Start block");
    if (state.main.seed.reads_variables()) state.evaluate_seed();
    if (state.main.length.reads_variables() && state.variables.globals[1] == length) state.evaluate_length();
    state.evaluate_axiom(string);
    state.files.flush_all();
}

void Derivation::State::evaluate_axiom(ModuleString& string) {
    const CompiledSystem& compiled = main;
    const ModuleString* const given = compiled.system->given_axiom.get();
    const Extent extent{given ? given->size() : compiled.axiom_letters.size(),
                        given ? given->parameters.size() : compiled.axiom.results.size(), 1};
    const std::size_t bytes = bytes_needed(extent, lineage);
    if (bytes > memory) {
        throw RunError(fmt::format("the axiom takes {} bytes, more than the memory of {}", bytes, memory));
    }
    resize(string, extent, lineage);
    if (given) {
        std::copy(given->letters.begin(), given->letters.end(), string.letters.begin());
        std::copy(given->parameters.begin(), given->parameters.end(), string.parameters.begin());
    } else {
        run_axiom(string);
    }
    if (lineage) bear_axiom(string);
}

void Derivation::State::run_axiom(ModuleString& string) {
    const CompiledSystem& compiled = main;
    std::copy(compiled.axiom_letters.begin(), compiled.axiom_letters.end(), string.letters.begin());
    const std::vector<ModuleTemplate>& modules = compiled.system->axiom;
    in_block(block_machine, "the axiom", [&] {
        block_machine.run(compiled.axiom);
        std::size_t k = 0;
        for (const ModuleTemplate& module : modules) {
            for (const Expression& argument : module.arguments) {
                const double value = block_machine.value(compiled.axiom.results[k]);
                if (!std::isfinite(value)) {
                    throw EvaluationError(
                        argument.place,
                        fmt::format("a parameter of {} is {:g}", compiled.source->alphabet.name(module.letter), value));
                }
                string.parameters[k++] = value;
            }
        }
    });
}

void Derivation::State::bear_axiom(ModuleString& string) const {
    string.siblings = SiblingTable().grown(1);
    string.siblings.added(0) = {mix(0x6573'7061'6c69'6572, settings.plant), 0, Siblings::axiom, 0};
    for (std::uint32_t i = 0; i < string.births.size(); ++i) string.births[i] = {0, i};
}

// --- Each step ----------------------------------------------------------------------------------------------------

void Derivation::step(const ModuleString& from, ModuleString& to) {
    State& state = *state_;
    state.variables.globals[0] = ++state.step;
    ++state.generation;
    if (state.model->has_memory) state.begin_memory();
    state.run_block(state.main.start_each, "the StartEach block");
    state.rewrite(from, to);
    state.run_block(state.main.end_each, "the EndEach block");
    if (steps_done() == length()) state.run_block(state.main.end, "the End block");
    if (state.model->uses_files) state.files.flush_all();
}

void Derivation::State::rewrite(const ModuleString& from, ModuleString& to) {
    if (may_be_simple && lineage && rewrite_small(main, from, step, memory, to)) return;
    const ScratchLease lease(from.size(), own_scratch);
    scratch = &lease.scratch();
    const StepInput input = prepare(from);
    if (in_order)
        rewrite_in_order(input, to);
    else if (!main.decomposition.empty())
        rewrite_and_decompose(input, *scratch, machines, services, to, depth_limit);
    else
        rewrite_in_parallel(input, *scratch, machines, to);
    if (in_order) follow_length();
    warn_of_depth();
}

// --- Cut ----------------------------------------------------------------------------------------------------------

// `%` deletes everything from itself to the end of its branch, to `$`, or to the end of the string.
std::size_t Derivation::State::end_of_cut(const ModuleString& from, std::size_t cut) const {
    const auto& partner = scratch->links.partner;
    const std::uint32_t open = partner[cut];
    const std::uint32_t close = open == BranchLinks::none ? BranchLinks::none : partner[open];
    const std::size_t stop = close == BranchLinks::none ? from.size() : close;
    if (model->enclosure.close == no_letter) return stop;
    for (std::size_t i = cut + 1; i < stop; ++i) {
        if (from.letters[i] == model->enclosure.close) return i;
        if (from.letters[i] != Alphabet::open_bracket) continue;
        if (partner[i] == BranchLinks::none) return stop;
        i = partner[i];
    }
    return stop;
}

void Derivation::State::cut(const ModuleString& from) {
    scratch->kept.clear();
    std::size_t begin = 0;
    const LetterId* const letters = from.letters.data();
    const LetterId* const end = letters + from.size();
    if (main.may_cut) {
        const LetterId* at = std::find(letters, end, Alphabet::cut);
        if (at != end) link_branches(from, scratch->links);
        while (at != end) {
            const auto cut = static_cast<std::size_t>(at - letters);
            if (cut > begin) scratch->kept.emplace_back(begin, cut);
            begin = end_of_cut(from, cut);
            at = std::find(letters + begin, end, Alphabet::cut);
        }
    }
    if (begin < from.size()) scratch->kept.emplace_back(begin, from.size());
}

// --- Match: what productions may ask of the string ----------------------------------------------------------------

/// One by one, and where several L-systems share the string, contexts are looked for step by step.
void Derivation::State::find_contexts(const ModuleString& from, StringView& view) {
    if (!model->uses_context) return;
    const bool step_by_step = model->nested || settings.one_by_one;
    if (step_by_step || main.choosing.needs_partners) {
        link_branches(from, scratch->links);
        view.partner = scratch->links.partner.data();
    }
    if (!step_by_step) {
        scratch->neighbours.find(main.choosing.sides, from);
        view.neighbours = &scratch->neighbours;
    }
    if (model->binds_context && (step_by_step || main.choosing.sides.positions)) {
        if (scratch->places.find(from, model->source->alphabet.arities().data()) != from.parameters.size()) {
            throw RunError("the string's parameters do not fit its modules");
        }
        view.places = &scratch->places;
    }
}

StepInput Derivation::State::prepare(const ModuleString& from) {
    if (lineage && from.births.size() != from.size()) {
        throw RunError("the string has no lineage: derive from a string that start() or step() made");
    }
    if (from.size() >= BranchLinks::none) throw RunError("the string has more than 4,294,967,294 modules");
    cut(from);
    StringView view{&from};
    find_contexts(from, view);
    const RandomKey random = model->samples ? key(Stream::derivation) : RandomKey();
    return {main, from, view, random, step, lineage, memory, scratch->kept};
}

// --- What others ask of a derivation --------------------------------------------------------------------------------

Derivation::Derivation(std::shared_ptr<const CompiledModel> model, DerivationSettings settings)
    : state_(std::make_unique<State>(std::move(model), std::move(settings))) {}

Derivation::~Derivation() = default;
Derivation::Derivation(Derivation&&) noexcept = default;
Derivation& Derivation::operator=(Derivation&&) noexcept = default;

// What a step of a small string touches.
void Derivation::prefetch() const {
    const State& state = *state_;
    const auto* const begin = reinterpret_cast<const char*>(&state.services.stopped);
    const auto* const end = reinterpret_cast<const char*>(&state.variables.globals + 1);
    espalier::prefetch(begin, static_cast<std::size_t>(end - begin));
}

// What lasts, and what a step needs besides; what small strings need is their thread's.
std::size_t Derivation::working_memory(const ModuleString& string) const {
    const State& state = *state_;
    const CompiledSystem& main = state.main;
    const std::size_t lasting = state.model->has_memory ? state.lasting_memory() : 0;
    if (string.size() <= grain) return lasting;
    std::size_t of_module = 0;
    const bool chooses = !state.in_order && main.decomposition.empty() && !main.plans.all_known;
    if (chooses) of_module += sizeof(LetterId) + sizeof(Replacement);
    if (state.model->uses_context) of_module += bytes_of_neighbours(main.choosing.sides);
    if (state.model->uses_context && main.choosing.needs_partners) of_module += sizeof(std::uint32_t);
    if (state.model->binds_context) of_module += sizeof(std::uint32_t);
    const std::size_t pieces = state.in_order || main.decomposition.empty() ? 0 : string.content();
    return lasting + pieces + of_module * string.size();
}

void Derivation::set_memory(std::size_t bytes) {
    state_->memory = bytes;
}

void Derivation::set_lineage(bool kept) {
    state_->lineage = state_->keeps_lineage(kept);
}

int Derivation::steps_done() const {
    return static_cast<int>(state_->step);
}

int Derivation::length() const {
    return state_->length;
}

void Derivation::set_length(int steps) {
    state_->length = steps;
    state_->length_is_set = true;
    state_->variables.globals[1] = steps;
}

bool Derivation::stopped() const {
    return state_->services.stopped;
}

}  // namespace espalier::lsystem

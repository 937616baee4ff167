#include "espalier/base/excerpt.h"
#include "espalier/base/prefetch.h"

#include "lsystem/homomorphism/picture_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace espalier {
namespace {

constexpr double most_steps = 1e9;

bool keeps_lineage(const CompiledModel& model, const DerivationSettings& settings) {
    return settings.lineage || model.nested || model.samples || model.any(&CompiledSystem::picture_samples);
}

std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

Derivation::State::State(std::shared_ptr<const CompiledModel> compiled, DerivationSettings given)
    : model(std::move(compiled)),
      main(model->main()),
      machines(main, variables, services),
      in_order(given.one_by_one || model->nested || main.serial()),
      lineage(keeps_lineage(*model, given)),
      settings(std::move(given)),
      files(settings.input_folder, settings.output_folder),
      block_machine(main.machine()),
      serial(next_serial()) {
    if (!settings.print) settings.print = [](const std::string& text) { std::fputs(text.c_str(), stderr); };
    services.print = settings.print;
    services.warn = [this](const Place& place, const std::string& message) { warn_once(place, message); };
    services.resources = model->source->resources.get();
    services.files = &files;
    services.seed = settings.seed;
    services.plant = settings.plant;
    block_machine.attach(&variables, &services, Stream::blocks);
    const std::size_t bytes = main.bytes_of_variables();
    if (bytes > settings.memory) {
        throw RunError(fmt::format("{}: the arrays take {} MiB, more than the memory of {} MiB", model->source->name,
                                   bytes >> 20, settings.memory >> 20));
    }
    reset();
    if (!main.length.reads_variables()) {
        evaluate_length();
    } else {
        rehearse([&](Services& silent) {
            block_machine.attach(&variables, &silent, Stream::blocks);
            run_block(main.start, "the Start block");
            evaluate_length();
        });
        block_machine.attach(&variables, &services, Stream::blocks);
        reset();
    }
}

void Derivation::State::rehearse(const std::function<void(Services& silent)>& work) {
    ModelFiles scratch_files(settings.input_folder, {});
    Services silent = services;
    silent.print = [](const std::string&) {};
    silent.warn = [](const Place&, const std::string&) {};
    silent.files = &scratch_files;
    work(silent);
}

void Derivation::State::evaluate_length() {
    if (main.length.empty() || length_is_set) return;
    double steps = 0;
    in_block(block_machine, "the derivation length", [&] { steps = block_machine.evaluate(main.length); });
    if (!(steps >= 0 && steps <= most_steps)) {
        throw RunError(fmt::format("{}: a derivation length of {:g} is out of range", model->source->name, steps));
    }
    length = static_cast<int>(steps);
    variables.globals[1] = length;
}

void Derivation::State::evaluate_seed() {
    double seed = 0;
    in_block(block_machine, "the seed", [&] { seed = block_machine.evaluate(main.seed); });
    services.salt = std::bit_cast<std::uint64_t>(seed);
    block_random = RandomDraws(key(Stream::blocks), 0, 0);
}

void Derivation::State::reset() {
    variables = main.variables();
    variables.globals[1] = length;
    sub_systems.clear();
    files.reset();
    ++generation;
    step = 0;
    services.stopped = false;
    services.salt = 0;
    block_random = RandomDraws(key(Stream::blocks), 0, 0);
    if (!main.seed.empty() && !main.seed.reads_variables()) evaluate_seed();
}

void Derivation::State::in_block(Machine& machine, const std::string& name, const std::function<void()>& work) {
    machine.sample_with(block_random);
    try {
        work();
    } catch (const EvaluationError& error) {
        throw RunError(fmt::format("{}{}{}, in {} at step {}{}", to_string(error.place),
                                   error.place.known() ? ": " : "", error.what(), name, step, excerpt(error.place)));
    }
    block_random = machine.random_numbers();
}

void Derivation::State::run_block(const Program& block, const char* name) {
    if (block.empty()) return;
    in_block(block_machine, name, [&] { block_machine.run(block); });
    follow_length();
}

void Derivation::State::warn_once(const Place& place, const std::string& message) {
    const std::lock_guard lock(warning);
    if (!warned.insert({place.file, {place.line, place.column}}).second) return;
    settings.print(fmt::format("{}{}warning: {}\n", to_string(place), place.known() ? ": " : "", message));
}

// A model may assign Z itself, and anything.
void Derivation::State::follow_length() {
    const double steps = variables.globals[1];
    if (!(steps >= 0 && steps <= most_steps)) {
        throw RunError(fmt::format("{}: a derivation length (Z) of {:g} is out of range, at step {}",
                                   model->source->name, steps, step));
    }
    length = static_cast<int>(steps);
}

void Derivation::State::evaluate_axiom(ModuleString& string) {
    const CompiledSystem& compiled = main;
    const std::size_t parameters = compiled.axiom.results.size();
    const Extent extent{compiled.axiom_letters.size(), parameters, 1};
    const std::size_t bytes = bytes_needed(extent, lineage);
    if (bytes > settings.memory) {
        throw RunError(fmt::format("the axiom takes {} bytes, more than the memory of {}", bytes, settings.memory));
    }
    resize(string, extent, lineage);
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
    if (lineage) bear_axiom(string);
}

void Derivation::State::bear_axiom(ModuleString& string) const {
    string.siblings = SiblingTable().grown(1);
    string.siblings.added(0) = {mix(0x6573'7061'6c69'6572, settings.plant), 0, Siblings::axiom};
    for (std::uint32_t i = 0; i < string.births.size(); ++i) string.births[i] = {0, i};
}

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

void Derivation::State::find_what_lives_on(const ModuleString& from) {
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

StepInput Derivation::State::read(const ModuleString& from) {
    if (lineage && from.births.size() != from.size()) {
        throw RunError("the string has no lineage: derive from a string that start() or step() made");
    }
    if (from.size() >= BranchLinks::none) throw RunError("the string has more than 4,294,967,294 modules");
    find_what_lives_on(from);
    StringView view{&from};
    find_contexts(from, view);
    const RandomKey random = model->samples ? key(Stream::derivation) : RandomKey();
    return {main, from, view, random, step, lineage, settings.memory, scratch->kept};
}

void Derivation::State::warn_of_depth() {
    if (!depth_limit || warned_of_depth) return;
    for (const auto& system : model->systems) {
        const CompiledRules& rules = system->decomposition;
        if (rules.empty() || !rules.warnings || !rules.explicit_depth) continue;
        warned_of_depth = true;
        settings.print(fmt::format("{}: warning: decomposition stopped at its maximum depth of {} in step {}\n",
                                   model->source->name, rules.maximum_depth, step));
        return;
    }
}

void Derivation::State::rewrite(const ModuleString& from, ModuleString& to) {
    const Workplace workplace(from.size(), own_scratch);
    scratch = &workplace.scratch();
    const StepInput input = read(from);
    if (in_order)
        rewrite_in_order(input, to);
    else if (!main.decomposition.empty())
        rewrite_and_decompose(input, *scratch, machines, services, to, depth_limit);
    else
        rewrite_in_parallel(input, *scratch, machines, to);
    if (in_order) follow_length();
    warn_of_depth();
}

Derivation::Derivation(std::shared_ptr<const CompiledModel> model, DerivationSettings settings)
    : state_(std::make_unique<State>(std::move(model), std::move(settings))) {}

Derivation::~Derivation() = default;
Derivation::Derivation(Derivation&&) noexcept = default;
Derivation& Derivation::operator=(Derivation&&) noexcept = default;

// A seed or a length that reads variables means those of the Start block.
void Derivation::start(ModuleString& string) {
    State& state = *state_;
    state.reset();
    const double length = state.variables.globals[1];
    state.run_block(state.main.start, "the Start block");
    if (state.main.seed.reads_variables()) state.evaluate_seed();
    if (state.main.length.reads_variables() && state.variables.globals[1] == length) state.evaluate_length();
    state.evaluate_axiom(string);
    state.files.flush_all();
}

void Derivation::step(const ModuleString& from, ModuleString& to) {
    State& state = *state_;
    state.variables.globals[0] = ++state.step;
    ++state.generation;
    state.run_block(state.main.start_each, "the StartEach block");
    state.rewrite(from, to);
    state.run_block(state.main.end_each, "the EndEach block");
    if (steps_done() == length()) state.run_block(state.main.end, "the End block");
    if (state.model->uses_files) state.files.flush_all();
}

// What a step of a small string touches.
void Derivation::prefetch() const {
    const State& state = *state_;
    constexpr std::size_t head = 96;  // up to the variables
    espalier::prefetch(&state, head);
    espalier::prefetch(&state.services.stopped, sizeof(bool));
    espalier::prefetch(&state.settings.memory, sizeof(std::size_t));
}

// What small strings need is their thread's.
std::size_t Derivation::working_memory(const ModuleString& string) const {
    const State& state = *state_;
    const CompiledSystem& main = state.main;
    if (string.size() <= grain) return 0;
    std::size_t of_module = 0;
    const bool chooses = !state.in_order && main.decomposition.empty() && !main.plans.all_known;
    if (chooses) of_module += sizeof(LetterId) + sizeof(Replacement);
    if (state.model->uses_context) of_module += bytes_of_neighbours(main.choosing.sides);
    if (state.model->uses_context && main.choosing.needs_partners) of_module += sizeof(std::uint32_t);
    if (state.model->binds_context) of_module += sizeof(std::uint32_t);
    const std::size_t pieces = state.in_order || main.decomposition.empty() ? 0 : string.content();
    return pieces + of_module * string.size();
}

void Derivation::set_memory(std::size_t bytes) {
    state_->settings.memory = bytes;
}

void Derivation::set_lineage(bool kept) {
    state_->settings.lineage = kept;
    state_->lineage = keeps_lineage(*state_->model, state_->settings);
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

}  // namespace espalier

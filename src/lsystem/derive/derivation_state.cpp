#include "lsystem/derive/derivation_state.h"

#include "base/excerpt.h"

#include <fmt/format.h>

#include <bit>

namespace espalier::lsystem {
namespace {

constexpr double most_steps = 1e9;

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
      may_be_simple(!in_order && main.decomposition.empty() && !model->uses_context && !main.may_cut),
      lineage(keeps_lineage(given.lineage)),
      memory(given.memory),
      settings(std::move(given)),
      files(settings.input_folder, settings.output_folder),
      block_machine(main.machine()),
      serial(next_serial()) {
    if (!settings.printout) settings.printout = std::make_shared<Printout>();
    services.print = [this](const std::string& text) { settings.printout->print(text); };
    services.warn = [this](const Place& place, const std::string& message) { warn_once(place, message); };
    services.resources = model->source->resources.get();
    services.files = &files;
    services.seed = settings.seed;
    services.plant = settings.plant;
    block_machine.attach(&variables, &services, Stream::blocks);
    require_arrays(main, 1, memory);
    reset();
    if (!main.length.reads_variables()) {
        evaluate_length();
    } else {
        dry_run([&](Services& silent) {
            block_machine.attach(&variables, &silent, Stream::blocks);
            run_block(main.start, "the Start block");
            evaluate_length();
        });
        block_machine.attach(&variables, &services, Stream::blocks);
        reset();
    }
}

bool Derivation::State::keeps_lineage(bool asked) const {
    return asked || model->nested || model->samples || model->any(&CompiledSystem::picture_samples);
}

void Derivation::State::dry_run(const std::function<void(Services& silent)>& work) {
    const std::filesystem::path nowhere;
    ModelFiles scratch_files(settings.input_folder, nowhere);
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
    block_random = RandomSamples(key(Stream::blocks), 0, 0);
}

void Derivation::State::reset() {
    variables = {};  // first, so that there are never two
    variables = main.variables();
    variables.globals[1] = length;
    sub_systems.clear();
    files.reset();
    ++generation;
    step = 0;
    services.stopped = false;
    services.salt = 0;
    block_random = RandomSamples(key(Stream::blocks), 0, 0);
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
    settings.printout->say(fmt::format("{}{}warning: {}\n", to_string(place), place.known() ? ": " : "", message));
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

std::size_t Derivation::State::lasting_memory() const {
    const std::size_t arrays = main.bytes_of_arrays() + sub_systems.bytes();
    const std::size_t copies = model->any(&CompiledSystem::picture_changes) ? 2 : 1;
    return copies * arrays + files.bytes();
}

void Derivation::State::begin_memory() {
    sub_systems.begin_step();
    files.leave(memory);
}

void Derivation::State::warn_of_depth() {
    if (!depth_limit || warned_of_depth) return;
    for (const auto& system : model->systems) {
        const CompiledRules& rules = system->decomposition;
        if (rules.empty() || !rules.warnings || !rules.explicit_depth) continue;
        warned_of_depth = true;
        settings.printout->say(fmt::format("{}: warning: decomposition stopped at its maximum depth of {} in step {}\n",
                                           model->source->name, rules.maximum_depth, step));
        return;
    }
}

}  // namespace espalier::lsystem

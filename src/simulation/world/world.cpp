#include "espalier/simulation/world.h"

#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "simulation/plant/plant_bytes.h"
#include "simulation/scene/scene_keyframes.h"
#include "simulation/world/every_plant.h"
#include "simulation/world/world_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace espalier::simulation {
namespace {

constexpr std::uint64_t checkpoint_signature = 0x36'646c'726f'57;  // "World6"

/// Adds the seconds of its life.
class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds), begin_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

private:
    double& seconds_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace

void World::start() {
    state_->begin_step();
    state_->grow(&GrowingPlant::write_axiom);
    exchange();
    record();
}

void World::step() {
    state_->begin_step();
    ++state_->step;
    state_->grow(&GrowingPlant::derive);
    exchange();
    record();
}

// All plants at once, or part by part those that wait on disk.
void World::State::grow(Stage stage) {
    if (!store) {
        rewrite(plants, stage);
        place_births();
        return interpret(plants);
    }
    is_drawn = reads_plants(ends_at_will || is_at_end());
    for (std::size_t part = 0; part < store->parts().size(); ++part) {
        const std::span<GrowingPlant> some = store->parts()[part];
        wake(some);
        rewrite(some, stage);
        interpret(some);
        rest(some);
        store->gather_queries(part);
    }
    place_births();
    store->turn();
}

// Step by step, plant by plant: so numbers are the same whoever holds the plants. Those that wait on disk get theirs
// when they are fetched.
void World::State::place_births() {
    if (!is_seen || (spread && !what_is_recorded().anything)) return;
    std::vector<double> born;
    if (spread) born = spread->of_each(plants, [](const GrowingPlant& plant) { return double(plant.born); });
    for (GrowingPlant& plant : plants) {
        plant.births_before = births;
        births += spread ? static_cast<std::uint64_t>(born[plant.number]) : plant.born;
    }
}

void World::State::begin_step() {
    times = {};
    if (!spread) return;
    if (std::exchange(is_saved, false)) {
        gathered.reset();
        spread->balance(plants, std::exchange(busy, 0), memory.bytes());
        all_do([&] { memory.check_drawn(plants, step); });
    }
    sent_messages = spread->ranks().messages();
    sent_bytes = spread->ranks().bytes();
}

void World::State::end_step() {
    if (!spread) return;
    times.messages = spread->ranks().messages() - sent_messages;
    times.bytes = spread->ranks().bytes() - sent_bytes;
}

void World::write_axioms() {
    state_->times = {};
    state_->rewrite(state_->plants, &GrowingPlant::write_axiom);
}

void World::derive() {
    state_->times = {};
    ++state_->step;
    state_->rewrite(state_->plants, &GrowingPlant::derive);
}

void World::State::rewrite(std::span<GrowingPlant> some, Stage stage) {
    const Stopwatch stopwatch(times.derive);
    const bool is_plentiful = memory.is_plentiful();
    if (spread) spread->forget(plants);
    all_do([&] {
        const Stopwatch busy_time(busy);
        for_every_plant(some, plants.size() == 1, reads,
                        {&GrowingPlant::prefetch_string, &GrowingPlant::prefetch_for_derivation},
                        [&](GrowingPlant& plant, ModuleString& spare) {
                            if (!plant.is_here || !memory.has_room()) return;
                            memory.limit_strings(plant);
                            (plant.*stage)(is_plentiful ? &spare : nullptr);
                            if (is_seen) plant.count_births();
                            memory.count_strings(plant);
                        });
        memory.check_strings(plants, step);
        note_ends();
    });
    if (spread) agree_on_ends();
}

void World::State::agree_on_ends() {
    const Ends ends = spread->agreed({longest, stopped, memory.modules()});
    longest = ends.longest;
    stopped = ends.stopped;
    modules_of_all = ends.modules;
}

void World::State::note_ends() {
    longest = 0;
    stopped = false;
    for (const GrowingPlant& plant : plants) {
        if (!plant.is_here) continue;
        longest = std::max(longest, plant.length);
        stopped = stopped || plant.stopped;
    }
}

void World::interpret() {
    state_->interpret(state_->plants);
}

void World::State::interpret(std::span<GrowingPlant> some) {
    if (!is_seen) return;
    const Stopwatch stopwatch(times.interpret);
    all_do([&] {
        const Stopwatch busy_time(busy);
        take_fields();
        for_every_plant(some, plants.size() == 1, reads,
                        {&GrowingPlant::prefetch_values, &GrowingPlant::prefetch_for_interpretation},
                        [&](GrowingPlant& plant, ModuleString&) {
                            if (!plant.is_here) return;
                            if (!store) plant.number_births();
                            plant.interpret(fields, time());
                            memory.count_drawn(plant, step, plants.size() > 1);
                        });
        fields.forget();  // so that processes may write the next values over these
        memory.check_drawn(plants, step);
        warn_of_ignored();
    });
}

template <class Action>
void World::State::for_waiting(std::span<GrowingPlant> some, const Action& action) {
    for_every_plant(some, plants.size() == 1, reads,
                    {&GrowingPlant::prefetch_values, &GrowingPlant::prefetch_for_interpretation},
                    [&](GrowingPlant& plant, ModuleString&) { action(plant); });
}

void World::State::wake(std::span<GrowingPlant> some) {
    const Stopwatch stopwatch(times.derive);
    for_waiting(some, [&](GrowingPlant& plant) { store->wake(plant); });
}

void World::State::rest(std::span<GrowingPlant> some) {
    const Stopwatch stopwatch(times.interpret);
    for_waiting(some, [&](GrowingPlant& plant) {
        store->rest(plant, is_drawn);
        memory.count_waiting(plant);
    });
    memory.check_drawn(plants, step);
}

// What processes left after the step before; a restarted world has it from its checkpoint.
void World::State::take_fields() {
    if (!std::exchange(has_restored_fields, false)) fields.take(environment->fields(), fields_read);
}

void World::State::find_fields_read() {
    std::set<std::string> names;
    for (const GrowingPlant& plant : plants) {
        for (std::string& name : fields_read_by(plant.model())) names.insert(std::move(name));
    }
    fields_read.assign(names.begin(), names.end());
}

void World::exchange() {
    if (!state_->is_seen) return;
    const Stopwatch stopwatch(state_->times.exchange);
    if (const auto& in_time = state_->scene.environment.in_time) in_time->set(*state_->environment, state_->time());
    if (state_->spread) {
        state_->spread->share(state_->plants, *state_->environment, state_->step, state_->what_is_recorded().fields);
    }
    state_->all_do([&] {
        if (state_->spread) state_->memory.check_received(state_->plants, state_->step);
        state_->exchange();
    });
}

void World::State::exchange() {
    if (!exchanges) return;
    std::vector<PlantView> views;
    std::vector<ModuleString*> strings;
    views.reserve(plants.size());
    strings.reserve(plants.size());
    for (GrowingPlant& plant : plants) {
        views.push_back(plant.view());
        strings.push_back(&*plant.string);
    }
    share_out_memory();
    const environment::WaitingQueries waiting = store ? store->queries() : environment::WaitingQueries{};
    environment->exchange({step, time(), scene.dt, views, store ? &waiting : nullptr}, strings);
    share_out_memory();
    store_answers();
}

void World::answer_turtle_queries() {
    for (GrowingPlant& plant : state_->plants) write_turtle_answers(*plant.interpretation, *plant.string);
    state_->store_answers();
}

// Answers are kept as all parameters are.
void World::State::store_answers() {
    for (GrowingPlant& plant : plants) {
        if (plant.asks()) round_as_stored(*plant.string, plant.model().arithmetic);
    }
}

void World::record() {
    if (state_->spread ? state_->what_is_recorded().anything : !state_->recorders.empty()) {
        const Stopwatch stopwatch(state_->times.record);
        const StopRequest::Scope no_request(nullptr);  // a frame is recorded whole
        state_->record();
    }
    state_->end_step();
}

void World::State::record_waiting() {
    const auto& parts = store->parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for_waiting(parts[i], [&](GrowingPlant& plant) { store->show(plant); });
        give(parts[i], i == 0, i + 1 == parts.size());
        for_waiting(parts[i], [&](GrowingPlant& plant) { store->put_back(plant); });
    }
}

void World::attach(Recorder& recorder) {
    state_->recorders.push_back(&recorder);
    state_->memory.count_recorder(recorder);
}

void World::attach_for_pieces(Recorder& recorder) {
    state_->gets_only_pieces = true;
    attach(recorder);
}

void World::skip_geometry() {
    State& state = *state_;
    state.is_seen = state.exchanges;
    for (GrowingPlant& plant : state.plants) plant.derivation.set_lineage(state.is_seen);
}

void World::require_waiting() const {
    const State& state = *state_;
    if (state.spread) throw UserError("--blocks is for one process; ranks divide the plants among themselves");
    for (std::size_t process = 0; process < state.environment->size(); ++process) {
        const Spreading spreading = state.environment->spreading(process);
        if (spreading == Spreading::reach || spreading == Spreading::queries) continue;
        throw UserError(fmt::format("process '{}' reads whole plants, so none can wait on disk; run without --blocks",
                                    state.environment->name(process)));
    }
}

void World::keep_on_disk(const std::filesystem::path& folder, std::size_t in_memory) {
    State& state = *state_;
    state.ends_at_will = std::any_of(state.plants.begin(), state.plants.end(),
                                     [](const GrowingPlant& plant) { return has_order(*plant.description->model); });
    state.store = std::make_unique<PlantStore>(folder, state.plants, in_memory);
}

// With the arrays and files of their models, which a checkpoint holds, too.
std::size_t World::bytes_of_strings() const {
    if (state_->store) return state_->store->bytes();
    const ModuleString none;
    std::size_t bytes = 0;
    for (const GrowingPlant& plant : state_->plants) {
        bytes += plant.string->content() + plant.derivation.working_memory(none);
    }
    return bytes;
}

void World::set_steps(int steps) {
    state_->scene.steps = steps;
    state_->set_lengths();
}

DerivedStep World::derived() const {
    DerivedStep derived{state_->step, {}};
    derived.plants.reserve(size());
    for (const GrowingPlant& plant : state_->plants) {
        std::ostringstream memory;
        plant.derivation.save(memory);
        derived.plants.push_back({plant.string.share(), std::move(memory).str()});
    }
    derived.births = state_->births;
    return derived;
}

void World::take(const DerivedStep& derived) {
    state_->step = derived.step;
    state_->births = derived.births;
    for (GrowingPlant& plant : state_->plants) {
        const DerivedStep::OfPlant& from = derived.plants.at(plant.number);
        std::istringstream memory(from.memory);
        plant.derivation.restore(memory);
        plant.string.hold(from.string);
        plant.is_numbered = true;
        plant.note_derived();
        state_->memory.count_strings(plant);
    }
    state_->memory.check_strings(state_->plants, derived.step);
    state_->note_ends();
}

void World::prepare_save(const std::filesystem::path& folder) {
    if (!state_->spread) return;
    state_->gather_states(folder);
    state_->is_saved = true;
}

void World::State::gather_states(const std::filesystem::path& folder) {
    all_do([&] {
        if (spread->is_first())
            gathered.reset(new Gathered{ScratchFile(folder), std::vector<Gathered::Place>(plants.size())});
    });
    for (std::size_t i = 0; i < parts(); ++i) {
        const std::vector<std::string> states = spread->states(part(i));
        all_do([&] {
            if (!gathered) return;
            for (std::size_t k = 0; k < states.size(); ++k) {
                if (states[k].empty()) continue;
                gathered->of_plants[part(i)[k].number] = {gathered->states.append(states[k]), states[k].size()};
            }
        });
    }
}

void World::save(std::ostream& out) const {
    put(out, checkpoint_signature);
    put(out, static_cast<std::int32_t>(state_->step));
    put(out, state_->births);
    put(out, static_cast<std::uint64_t>(size()));
    for (GrowingPlant& plant : state_->plants) {
        if (state_->store) state_->store->show(plant);
        if (plant.is_here) {
            put_state(out, plant);
        } else {
            const State::Gathered::Place& place = state_->gathered->of_plants[plant.number];
            out << state_->gathered->states.read(place.at, place.size);
        }
        if (state_->store) state_->store->put_back(plant);
    }
    state_->environment->save(out);
    FieldValues fields;
    fields.take(state_->environment->fields(), state_->fields_read);
    fields.save(out);
}

void World::restore(std::istream& in) {
    state_->all_do([&] { state_->restore(in); });
    if (state_->spread) state_->agree_on_ends();
}

void World::State::restore(std::istream& in) {
    if (get<std::uint64_t>(in) != checkpoint_signature) throw RunError("this is not the checkpoint of a world");
    const auto saved = get<std::int32_t>(in);
    births = get<std::uint64_t>(in);
    if (get<std::uint64_t>(in) != plants.size()) throw RunError("the checkpoint is of another scene");
    for (GrowingPlant& plant : plants) {
        get_state(in, plant, memory.bytes());
        if (!plant.is_here) plant.give_away();
        if (store) store->rest(plant, /*drawn=*/false);
    }
    if (store) store->turn();
    environment->restore(in);
    share_out_memory();
    fields.restore(in);
    has_restored_fields = true;
    step = saved;
    is_whole = false;
    note_ends();
    memory.check_drawn(plants, step);
}

int World::steps_done() const {
    return state_->step;
}

int World::last_step() const {
    return state_->last_step();
}

bool World::at_end() const {
    return state_->is_at_end();
}

bool World::stopped() const {
    return state_->stopped;
}

void World::review_run() {
    state_->review_run();
}

std::size_t World::modules() const {
    return state_->spread ? state_->modules_of_all : state_->memory.modules();
}

std::size_t World::modules_of(std::size_t plant) const {
    return state_->plants[plant].modules;
}

const StageTimes& World::times() const {
    return state_->times;
}

const ModuleString& World::string(std::size_t plant) const {
    return *state_->plants[plant].string;
}

const Interpretation& World::interpretation(std::size_t plant) const {
    return *state_->plants[plant].interpretation;
}

const Model& World::model(std::size_t plant) const {
    return state_->plants[plant].model();
}

const Environment& World::environment() const {
    return *state_->environment;
}

const Scene& World::scene() const {
    return state_->scene;
}

const std::vector<Diagnostic>& World::warnings() const {
    return state_->warnings;
}

std::size_t World::size() const {
    return state_->plants.size();
}

}  // namespace espalier::simulation

#include "espalier/simulation/world.h"

#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "simulation/plant/every_plant.h"
#include "simulation/scene/scene_keyframes.h"
#include "simulation/world/world_state.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace espalier::simulation {
namespace {

Ends of_all_ranks(Ranks* ranks, const Ends& own) {
    std::ostringstream out;
    put(out, own);
    Ends all;
    for (const std::string& bytes : from_all(ranks, out.str())) {
        std::istringstream in(bytes);
        const auto one = get<Ends>(in);
        all.longest = std::max(all.longest, one.longest);
        all.stopped = all.stopped || one.stopped;
        all.modules += one.modules;
    }
    return all;
}

}  // namespace

World::World(const Scene& scene, const WorldOptions& options) {
    together(options.ranks, [&] { state_.reset(new State(scene, options)); });
}

void World::DeleteState::operator()(State* state) const {
    delete state;
}

void World::start() {
    state_->begin_step();
    state_->grow(&GrowingPlant::write_axiom);
    state_->exchange();
    state_->record();
    state_->end_step();
}

void World::step() {
    state_->begin_step();
    ++state_->step;
    state_->grow(&GrowingPlant::derive);
    state_->exchange();
    state_->record();
    state_->end_step();
}

void World::State::begin_step() {
    times = {};
    if (!std::exchange(has_begun, true)) {
        is_seen = is_looked_at || exchanges || recording.reads_plants();
        for (GrowingPlant& plant : plants->all()) plant.derivation.set_lineage(is_seen);
    }
    plants->begin_growth(busy, step);
    sent = plants->sent();
}

void World::State::end_step() {
    const PlantSet::Sent now = plants->sent();
    times.messages = now.messages - sent.messages;
    times.bytes = now.bytes - sent.bytes;
}

// Plants that are not in memory come into it part by part.
void World::State::grow(Stage stage) {
    is_drawn = recording.reads_plants_at(step, may_stop || is_at_end());
    fields.take(environment->fields());
    const std::vector<Part> parts = plants->parts();
    for (const Part& part : parts) {
        derive(part, stage);
        if (&part == &parts.back()) place_births();
        interpret(part);
    }
    fields.values.forget();  // so that processes may write the next values over these
    all_do([&] { plants->end_growth(); });
    note_ends();
}

// Step by step, plant by plant: so numbers are the same whoever holds the plants.
void World::State::place_births() {
    if (is_seen) plants->place_births(births, recording.is_there());
}

void World::State::derive(Part part, Stage stage) {
    const Stopwatch stopwatch(times.derive);
    const bool is_plentiful = memory.is_plentiful();
    all_do([&] {
        plants->fetch(part);
        const Stopwatch busy_time(busy);
        for_every_plant(part, size() == 1, reads,
                        {&GrowingPlant::prefetch_string, &GrowingPlant::prefetch_for_derivation},
                        [&](GrowingPlant& plant, ModuleString& spare) {
                            if (!plant.is_local || !memory.has_room()) return;
                            memory.limit_strings(plant);
                            (plant.*stage)(is_plentiful ? &spare : nullptr);
                            if (is_seen) plant.count_births();
                            memory.count_strings(plant);
                        });
        memory.check_strings(plants->all(), step);
    });
}

void World::State::interpret(Part part) {
    const Stopwatch stopwatch(times.interpret);
    all_do([&] {
        if (is_seen) walk(part);
        plants->store(part, step, is_drawn);
    });
}

void World::State::walk(Part part) {
    {
        const Stopwatch busy_time(busy);
        for_every_plant(part, size() == 1, reads,
                        {&GrowingPlant::prefetch_values, &GrowingPlant::prefetch_for_interpretation},
                        [&](GrowingPlant& plant, ModuleString&) {
                            if (!plant.is_local) return;
                            plant.number_births();
                            plant.interpret(fields.values, time());
                            memory.count_drawn(plant, step, size() > 1);
                        });
    }
    memory.check_drawn(plants->all(), step);
    review.warn_of_ignored();
}

void World::State::note_ends() {
    ends = of_all_ranks(ranks, ends_here());
}

Ends World::State::ends_here() const {
    Ends here{0, false, memory.modules()};
    for (const GrowingPlant& plant : plants->all()) {
        if (!plant.is_local) continue;
        here.longest = std::max(here.longest, plant.length);
        here.stopped = here.stopped || plant.stopped;
    }
    return here;
}

void FieldsForTurtles::take(const Fields& fields) {
    if (!std::exchange(has_restored, false)) values.take(fields, names);
}

void World::State::exchange() {
    if (!is_seen) return;
    const Stopwatch stopwatch(times.exchange);
    if (scene.environment.in_time) scene.environment.in_time->set(*environment, time());
    plants->share(*environment, step, recording.reads_fields());
    all_do([&] {
        if (exchanges) answer_queries();
    });
}

void World::State::answer_queries() {
    std::vector<PlantView> views;
    std::vector<ModuleString*> strings;
    views.reserve(size());
    strings.reserve(size());
    for (GrowingPlant& plant : plants->all()) {
        views.push_back(plant.view());
        strings.push_back(&*plant.string);
    }
    share_out_memory();
    environment->exchange({step, time(), scene.dt, views, plants->queries()}, strings);
    share_out_memory();
    store_answers();
}

// Answers are kept as all parameters are.
void World::State::store_answers() {
    for (GrowingPlant& plant : plants->all()) {
        if (plant.asks()) round_as_stored(*plant.string, plant.model().arithmetic);
    }
}

void World::State::record() {
    if (!recording.is_there()) return;
    const Stopwatch stopwatch(times.record);
    const StopRequest::Scope no_request(nullptr);  // a frame is recorded whole
    record_frame();
}

void World::attach(Recorder& recorder) {
    state_->recording.attach(recorder);
    state_->memory.count_recorder(recorder);
}

void World::review_run() {
    const State& state = *state_;
    state_->review.warn_of_ignored_elsewhere(state.ranks);
    if (!state.is_whole) return;
    state_->review.review(
        {state.scene, *state.environment, state.plants->all(), state.ranks, state.step, state.is_seen});
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
    return state_->ends.stopped;
}

std::size_t World::modules(std::optional<std::size_t> plant) const {
    return plant ? state_->plants->all()[*plant].modules : state_->ends.modules;
}

const StageTimes& World::times() const {
    return state_->times;
}

Frame World::frame() const {
    Frame frame = state_->frame_of(state_->plants->all());
    frame.models = state_->models();
    return frame;
}

const ModuleString& World::string(std::size_t plant) const {
    return *state_->plants->all()[plant].string;
}

const Interpretation& World::interpretation(std::size_t plant) const {
    return *state_->plants->all()[plant].interpretation;
}

const Model& World::model(std::size_t plant) const {
    return state_->plants->all()[plant].model();
}

const Environment& World::environment() const {
    return *state_->environment;
}

const Scene& World::scene() const {
    return state_->scene;
}

const std::vector<Diagnostic>& World::warnings() const {
    return state_->review.warnings;
}

std::size_t World::size() const {
    return state_->size();
}

}  // namespace espalier::simulation

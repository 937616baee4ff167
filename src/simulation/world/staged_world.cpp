#include "espalier/simulation/staged_world.h"

#include "simulation/world/world_state.h"
#include "turtle/asking.h"

#include <sstream>
#include <utility>

namespace espalier::simulation {

StagedWorld::StagedWorld(const Scene& scene, std::size_t memory, const std::filesystem::path& files,
                         std::shared_ptr<Printout> printout)
    : World(scene, {.memory = memory, .files = files, .printout = std::move(printout)}) {}

void StagedWorld::set_steps(int steps) {
    state_->scene.steps = steps;
    state_->set_lengths();
}

void StagedWorld::write_axioms() {
    state_->times = {};
    state_->derive_all(&GrowingPlant::write_axiom);
}

void StagedWorld::derive() {
    state_->times = {};
    ++state_->step;
    state_->derive_all(&GrowingPlant::derive);
}

// derived() hands on strings with their numbers.
void World::State::derive_all(Stage stage) {
    derive(plants->all(), stage);
    place_births();
    for (GrowingPlant& plant : plants->all()) {
        plant.number_births();
        plant.is_numbered = true;
    }
    note_ends();
}

void StagedWorld::interpret() {
    state_->fields.take(state_->environment->fields());
    state_->interpret(state_->plants->all());
    state_->fields.values.forget();
}

void StagedWorld::exchange() {
    state_->exchange();
}

void StagedWorld::answer_turtle_queries() {
    for (GrowingPlant& plant : state_->plants->all()) write_turtle_answers(*plant.interpretation, *plant.string);
    state_->store_answers();
}

DerivedStep StagedWorld::derived() const {
    DerivedStep derived{state_->step, {}, state_->births};
    derived.plants.reserve(size());
    for (const GrowingPlant& plant : state_->plants->all()) {
        std::ostringstream memory;
        plant.derivation.save(memory);
        derived.plants.push_back({plant.string.share(), std::move(memory).str()});
    }
    return derived;
}

void StagedWorld::take(const DerivedStep& derived) {
    state_->step = derived.step;
    state_->births = derived.births;
    for (GrowingPlant& plant : state_->plants->all()) {
        const DerivedStep::OfPlant& from = derived.plants.at(plant.number);
        std::istringstream memory(from.memory);
        plant.derivation.restore(memory);
        plant.string.hold(from.string);
        plant.is_numbered = true;
        plant.note_derived();
        state_->memory.count_strings(plant);
    }
    state_->memory.check_strings(state_->plants->all(), derived.step);
    state_->note_ends();
}

Frame StagedWorld::frame_of_plants() const {
    Frame frame{state_->step, state_->time(), {}, nullptr, state_->is_at_end(), nullptr};
    for (const GrowingPlant& plant : state_->plants->all()) frame.plants.push_back(plant.frame({}));
    frame.models = state_->models();
    return frame;
}

}  // namespace espalier::simulation

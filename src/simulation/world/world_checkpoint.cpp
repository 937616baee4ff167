#include "espalier/simulation/world_checkpoint.h"

#include "espalier/base/error.h"

#include "base/bytes.h"
#include "simulation/plant/plant_bytes.h"
#include "simulation/world/world_state.h"

namespace espalier::simulation {
namespace {

constexpr std::uint64_t checkpoint_signature = 0x36'646c'726f'57;  // "World6"

}  // namespace

std::size_t WorldCheckpoint::bytes() const {
    return world_.state_->plants->bytes();
}

void WorldCheckpoint::prepare(const std::filesystem::path& folder) {
    world_.state_->plants->gather_states(folder);
}

void WorldCheckpoint::save(std::ostream& out) const {
    World::State& world = *world_.state_;
    put(out, checkpoint_signature);
    put(out, static_cast<std::int32_t>(world.step));
    put(out, world.births);
    put(out, static_cast<std::uint64_t>(world.size()));
    for (GrowingPlant& plant : world.plants->all()) world.plants->put_state(out, plant);
    world.environment->save(out);
    FieldValues fields;
    fields.take(world.environment->fields(), world.fields.names);
    fields.save(out);
}

void WorldCheckpoint::restore(std::istream& in) {
    World::State& world = *world_.state_;
    world.all_do([&] { world.restore(in); });
    world.note_ends();
}

void World::State::restore(std::istream& in) {
    if (get<std::uint64_t>(in) != checkpoint_signature) throw RunError("this is not the checkpoint of a world");
    const auto saved = get<std::int32_t>(in);
    births = get<std::uint64_t>(in);
    if (get<std::uint64_t>(in) != size()) throw RunError("the checkpoint is of another scene");
    for (GrowingPlant& plant : plants->all()) {
        get_state(in, plant, memory.bytes());
        plants->take_restored(plant);
    }
    environment->restore(in);
    share_out_memory();
    fields.values.restore(in);
    fields.has_restored = true;
    step = saved;
    is_whole = false;
    memory.check_drawn(plants->all(), step);
}

}  // namespace espalier::simulation

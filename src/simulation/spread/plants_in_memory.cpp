#include "simulation/spread/plants_in_memory.h"

#include "geometry/drawn/mesh_size.h"
#include "simulation/plant/plant_bytes.h"

namespace espalier::simulation {

void PlantsInMemory::place_births(std::uint64_t& births, bool) {
    for (GrowingPlant& plant : plants_) {
        plant.births_before = births;
        births += plant.born;
    }
}

std::vector<std::size_t> PlantsInMemory::points() {
    std::vector<std::size_t> points;
    points.reserve(plants_.size());
    for (const GrowingPlant& plant : plants_) points.push_back(points_foreseen(plant.drawn().geometry));
    return points;
}

void PlantsInMemory::put_state(std::ostream& out, GrowingPlant& plant) {
    simulation::put_state(out, plant);
}

// With the arrays and files of their models, which a checkpoint holds, too.
std::size_t PlantsInMemory::bytes() {
    const ModuleString none;
    std::size_t bytes = 0;
    for (const GrowingPlant& plant : plants_) {
        bytes += plant.string->content() + plant.derivation.working_memory(none);
    }
    return bytes;
}

}  // namespace espalier::simulation

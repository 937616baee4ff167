// All plants of a world in the memory of one process.
#pragma once

#include "simulation/spread/plant_set.h"

#include <vector>

namespace espalier::simulation {

/// One part, which is always there.
class PlantsInMemory : public PlantSet {
public:
    explicit PlantsInMemory(std::vector<GrowingPlant> plants) : plants_(std::move(plants)) {}

    std::span<GrowingPlant> all() override { return plants_; }
    void begin_growth(double, int) override {}
    std::vector<Part> parts() override { return {plants_}; }
    void fetch(Part) override {}
    void store(Part, int, bool) override {}
    void place_births(std::uint64_t& births, bool is_recorded) override;
    void end_growth() override {}

    void share(Environment&, int, bool) override {}
    std::span<const Query> queries_of(const GrowingPlant& plant, QueryColumn&) override {
        return plant.interpretation->queries;
    }
    const environment::WaitingQueries* queries() override { return nullptr; }
    std::vector<Quantity> statistics(const Environment& environment, const GrowingPlant& plant) override {
        return environment.statistics(plant.number);
    }

    std::vector<Part> frame_parts() override { return parts(); }
    void show(std::span<const Part>, const Environment&, int) override {}
    void hide() override {}
    std::size_t writers() override { return 1; }
    std::vector<std::size_t> points() override;

    void gather_states(const std::filesystem::path&) override {}
    void put_state(std::ostream& out, GrowingPlant& plant) override;
    void take_restored(GrowingPlant&) override {}
    std::size_t bytes() override;

    Sent sent() override { return {}; }

private:
    std::vector<GrowingPlant> plants_;
};

}  // namespace espalier::simulation

// The plants of a world that several ranks grow together.
#pragma once

#include "base/scratch_file.h"
#include "simulation/plant/memory_budget.h"
#include "simulation/spread/plant_set.h"
#include "simulation/spread/spread.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace espalier::simulation {

/// Each rank holds some of the plants, in memory or on disk, and gets of the others what a stage must see.
class PlantsOnRanks final : public PlantSet {
public:
    /// `plants`: of the scene, in memory or on disk; those that are local to this rank are set here.
    PlantsOnRanks(std::unique_ptr<PlantSet> plants, std::unique_ptr<Spread> spread, MemoryBudget& memory);

    std::span<GrowingPlant> all() override { return plants_->all(); }
    void begin_growth(double busy, int step) override;
    std::vector<Part> parts() override;
    void fetch(Part part) override { plants_->fetch(part); }
    void store(Part part, int step, bool drawn) override { plants_->store(part, step, drawn); }
    void place_births(std::uint64_t& births, bool is_recorded) override;
    void end_growth() override { plants_->end_growth(); }

    void share(Environment& environment, int step, bool first_sees_all) override;
    std::span<const Query> queries_of(const GrowingPlant& plant, QueryColumn& room) override {
        return plants_->queries_of(plant, room);
    }
    const environment::WaitingQueries* queries() override { return plants_->queries(); }
    std::vector<Quantity> statistics(const Environment& environment, const GrowingPlant& plant) override {
        return spread_->statistics(environment, plant);
    }

    std::vector<Part> frame_parts() override;
    void show(std::span<const Part> to_each, const Environment& environment, int step) override;
    void hide() override;
    std::size_t writers() override { return static_cast<std::size_t>(spread_->ranks().count()); }
    std::vector<std::size_t> points() override;

    void gather_states(const std::filesystem::path& folder) override;
    void put_state(std::ostream& out, GrowingPlant& plant) override;
    void take_restored(GrowingPlant& plant) override;
    std::size_t bytes() override { return plants_->bytes(); }

    Sent sent() override { return {spread_->ranks().messages(), spread_->ranks().bytes()}; }

private:
    /// States of plants that other ranks hold.
    struct Gathered {
        struct Place {
            std::uint64_t at = 0;
            std::size_t size = 0;
        };
        ScratchFile states;
        std::vector<Place> of_plants;  ///< by number
    };

    std::unique_ptr<PlantSet> plants_;
    std::unique_ptr<Spread> spread_;
    MemoryBudget& memory_;
    Part shown_;
    std::unique_ptr<Gathered> gathered_;  ///< for a checkpoint of the first rank
    bool is_saved_ = false;               ///< since the last step: plants may move
    double busy_before_ = 0;              ///< when they might have moved
};

}  // namespace espalier::simulation

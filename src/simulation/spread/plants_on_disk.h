// Plants that wait on disk, so that a world may be larger than memory.
#pragma once

#include "base/scratch_file.h"
#include "simulation/plant/memory_budget.h"
#include "simulation/spread/plants_in_memory.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace espalier::simulation {

/// The local plants come into memory part by part. Of those that wait, memory holds the parameters of their queries,
/// where processes answer; the exchange reads the queries, plant by plant. What other ranks send of theirs does not
/// wait.
class PlantsOnDisk final : public PlantsInMemory {
public:
    /// The local plants are divided into `blocks`, of which `resident` are in memory at once. `folder` exists before
    /// the first plants wait, and has room twice for what the plants are. `holds_queries`: an exchange holds those of
    /// all plants in memory.
    PlantsOnDisk(std::vector<GrowingPlant> plants, std::filesystem::path folder, std::size_t blocks,
                 std::size_t resident, MemoryBudget& memory, bool holds_queries);

    std::vector<Part> parts() override;
    void fetch(Part part) override;
    void store(Part part, int step, bool drawn) override;
    void end_growth() override;

    std::span<const Query> queries_of(const GrowingPlant& plant, QueryColumn& room) override;
    const environment::WaitingQueries* queries() override;

    void show(std::span<const Part> to_each, const Environment& environment, int step) override;
    void hide() override;
    std::vector<std::size_t> points() override;

    void put_state(std::ostream& out, GrowingPlant& plant) override;
    void take_restored(GrowingPlant& plant) override;
    std::size_t bytes() override { return files_[now_] ? files_[now_]->size() : 0; }

private:
    struct Place {
        std::uint64_t at = 0;
        std::uint64_t size = 0;    ///< 0: the plant does not wait
        std::uint64_t string = 0;  ///< of them the first, which fetch() reads
        std::uint64_t asked = 0;   ///< where what it asks ends, which begins behind the string
        std::size_t queries = 0;   ///< since it was stored last; 0 after a restart
        std::size_t points = 0;    ///< of what is drawn
        bool is_drawn = false;
    };
    struct Waiting {
        std::shared_ptr<const ModuleString> string;
        std::shared_ptr<const Interpretation> interpretation;
    };

    template <class Action>
    void for_local_plants(Part part, const Action& action);
    void open_files();
    void write(GrowingPlant& plant, std::size_t file, bool drawn);
    void read(GrowingPlant& plant, bool drawn);
    void show(GrowingPlant& plant);
    void hide(GrowingPlant& plant);

    const std::filesystem::path folder_;
    const std::size_t blocks_, resident_;
    MemoryBudget& memory_;
    const bool holds_queries_;
    std::vector<Place> places_;  ///< of each plant
    Part shown_;
    std::vector<Waiting> waiting_;  ///< of plants that are shown
    environment::WaitingQueries of_all_;
    std::array<std::optional<ScratchFile>, 2> files_;
    std::size_t now_ = 0;
};

}  // namespace espalier::simulation

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

/// The local plants come into memory part by part. Of those that wait, memory holds the parameters of their queries
/// and, until the exchange has read them, the queries, which is all that an exchange needs. What other ranks send of
/// theirs does not wait.
class PlantsOnDisk final : public PlantsInMemory {
public:
    /// The local plants are divided into `blocks`, of which `resident` are in memory at once. `folder` exists before
    /// the first plants wait, and has room twice for what the plants are.
    PlantsOnDisk(std::vector<GrowingPlant> plants, std::filesystem::path folder, std::size_t blocks,
                 std::size_t resident, MemoryBudget& memory);

    void begin_growth(double busy, int step) override;
    std::vector<Part> parts() override;
    void fetch(Part part) override;
    void store(Part part, int step, bool drawn) override;
    void end_growth() override;

    std::span<const Query> queries_of(const GrowingPlant& plant) override;
    /// Memory holds them no longer than the exchange needs.
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
        std::size_t points = 0;    ///< of what is drawn
    };
    /// Of a plant, those of its part's.
    struct Asked {
        std::size_t part = 0, begin = 0, count = 0;
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
    void gather_queries(Part part);
    std::span<const Query> queries_in_order(std::uint32_t plant);

    const std::filesystem::path folder_;
    const std::size_t blocks_, resident_;
    MemoryBudget& memory_;
    std::vector<Place> places_;  ///< of each plant
    Part shown_;
    std::vector<Waiting> waiting_;      ///< of plants that are shown
    std::vector<Asked> asked_;          ///< of each plant
    std::vector<QueryColumn> queries_;  ///< of each part that was stored in this step: of its local plants
    environment::WaitingQueries of_all_;
    std::array<std::optional<ScratchFile>, 2> files_;
    std::size_t now_ = 0;
};

}  // namespace espalier::simulation

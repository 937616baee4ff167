// Plants that wait on disk, so that a world may be larger than memory.
#pragma once

#include "base/scratch_file.h"
#include "simulation/plant/growing_plant.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace espalier::simulation {

/// The plants of a world come into memory part by part, in the order of the scene. Of those that wait, memory holds
/// the parameters of their queries and, until the exchange has read them, the queries, which is all that an exchange
/// needs. Each of the functions for one plant may be called for several at once, by several threads; all throw RunError
/// for a disk that is full or fails.
class PlantStore {
public:
    /// `folder`: exists, and has room twice for what the plants are.
    PlantStore(const std::filesystem::path& folder, std::span<GrowingPlant> plants, std::size_t in_memory);

    const std::vector<std::span<GrowingPlant>>& parts() const { return parts_; }

    /// After its interpretation, or after it was restored: its string waits; if it is `drawn`, what is drawn of it,
    /// too.
    void rest(GrowingPlant& plant, bool drawn);
    /// After all plants of a part rest: puts their queries side by side.
    void gather_queries(std::size_t part);
    /// After all plants rest: the room on disk of what they were before is free again.
    void turn();
    /// Those of all plants, once: memory holds them no longer than the exchange needs.
    environment::WaitingQueries queries();
    /// Its string is there again, answered.
    void wake(GrowingPlant& plant);
    /// The same, with what is drawn of it if that waits, until put_back(). The string must not change.
    void show(GrowingPlant& plant);
    void put_back(GrowingPlant& plant);

    std::uint64_t bytes() const { return files_[now_].size(); }

private:
    struct Place {
        std::uint64_t at = 0;
        std::uint64_t size = 0;    ///< 0: the plant does not wait
        std::uint64_t string = 0;  ///< of them the first, which wake() reads
    };
    struct Waiting {
        std::shared_ptr<const ModuleString> string;
        std::shared_ptr<const Interpretation> interpretation;
    };
    /// The queries of a part's plants, one after the other.
    struct Queries {
        QueryColumn all;
        std::vector<std::size_t> begins;  ///< of each plant, and the end of the last
    };

    std::span<const Query> queries_of(std::uint32_t plant);
    void fetch(GrowingPlant& plant, bool drawn);

    std::vector<std::span<GrowingPlant>> parts_;
    std::vector<Place> places_;     ///< of each plant
    std::vector<Waiting> waiting_;  ///< of plants that are shown
    std::vector<Queries> queries_;  ///< of each part
    std::array<ScratchFile, 2> files_;
    std::size_t now_ = 0;
};

}  // namespace espalier::simulation

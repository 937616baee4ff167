// What lasts of a world from step to step, as bytes.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/world.h"

#include <cstddef>
#include <filesystem>
#include <iosfwd>

namespace espalier::simulation {

/// Between two steps of a world. The bytes are for this machine and the same scene, and any number of ranks.
class WorldCheckpoint {
public:
    /// The world outlives it.
    explicit WorldCheckpoint(World& world) : world_(world) {}

    /// About how many bytes save() writes of the plants that this rank holds.
    std::size_t bytes() const;
    /// Before save(), on all ranks: the first one gets what the others hold, part by part, into an unlinked file in
    /// `folder`. Without others, it does nothing. Throws RunError for a disk that is full.
    void prepare(const std::filesystem::path& folder);
    /// Only on the first rank.
    void save(std::ostream& out) const;
    /// Instead of the world's start(), on all ranks: the next step() is the one after the save. The frame of the saved
    /// step is not there again. Throws RunError or UserError for bytes of another scene, or for bytes that are damaged.
    void restore(std::istream& in);

private:
    World& world_;
};

}  // namespace espalier::simulation

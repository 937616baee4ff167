// The recorders of a world, and what all ranks know of them.
#pragma once

#include "espalier/simulation/ranks.h"
#include "espalier/timeline/recorder.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace espalier::simulation {

/// The first rank has the recorders. Another may have one that writes pieces of frames.
class Recording {
public:
    explicit Recording(Ranks* ranks) : ranks_(ranks) {}

    /// Where there are several ranks, before the first step.
    void attach(Recorder& recorder) {
        recorders_.push_back(&recorder);
        if (!ranks_) known_.reset();
    }

    // All ranks ask the same, in the same order, and get the same answers.

    bool is_there() { return known().is_there; }
    bool reads_fields() { return known().reads_fields; }
    bool reads_plants();
    /// `may_end`: the run may end at the step.
    bool reads_plants_at(int step, bool may_end);
    /// How many points a file has that each rank can write alone; 0: one must read all plants. `may_cut`: the plants of
    /// this rank allow it.
    std::size_t points_per_file(bool may_cut);

    /// A recorder of this rank wants frames, or this `piece` of one.
    bool takes(std::optional<int> piece) const;
    void record(const Frame& frame) const;

private:
    struct Known {
        bool is_there = false, reads_fields = false;
    };
    const Known& known();  ///< asked for once
    template <class Is>
    bool is_any(const Is& is) const;

    Ranks* ranks_;
    std::vector<Recorder*> recorders_;
    std::optional<Known> known_;
};

}  // namespace espalier::simulation

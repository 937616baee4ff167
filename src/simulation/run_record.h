// What a run says of itself in run.json and timings.csv: enough to repeat it exactly, and what it cost.
#pragma once

#include "espalier/simulation/simulation.h"
#include "espalier/timeline/timeline.h"

#include <string>

namespace espalier {

class RunRecord {
public:
    RunRecord(const Scene& scene, const RunOptions& options);

    void add_step(const StageTimes& times);
    /// `exit`: "running", "done", "interrupted", "failed: why".
    void write(const Timeline& timeline, const World& world, const std::string& exit, double seconds) const;

private:
    std::string json(const World& world, const std::string& exit, double seconds) const;

    const Scene& scene_;
    std::size_t memory_;
    std::string started_;
    StageTimes total_;
    std::string timings_ = "step,derive,interpret,exchange,record\n";
    int steps_ = 0;  ///< recorded so far
};

}  // namespace espalier

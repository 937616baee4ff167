// What a run says of itself in run.json and timings.csv: enough to repeat it exactly, and what it cost.
#pragma once

#include "espalier/simulation/simulation.h"
#include "espalier/timeline/timeline.h"

#include "base/csv_file.h"

#include <algorithm>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <set>
#include <string>

namespace espalier::simulation {

class RunRecord {
public:
    RunRecord(const World& world, const RunOptions& options);

    /// What lies where the models will write, though none of them wrote it.
    void note_files_before(std::set<std::filesystem::path> files) { files_before_ = std::move(files); }
    /// Makes timings.csv, which then grows by a row a step.
    void begin(const Timeline& timeline);
    /// Goes on with it as save() left it; without a timeline, which another rank has, no timings are written.
    void resume(const Timeline* timeline, std::istream& in);
    void save(std::ostream& out) const;
    /// The last step that save() knew of. Throws RunError.
    static int step_saved_in(std::istream& in);
    void add_step(const StageTimes& times);
    /// Without those that were dropped.
    int steps_done() const { return std::max(steps_ - 1, 0); }
    /// `exit`: "running", "done", "interrupted", "failed: why".
    void write(const Timeline& timeline, const std::string& exit, double seconds) const;
    /// Returns what write() writes.
    std::string json(const std::string& exit, double seconds) const;

private:
    const World& world_;
    int planned_steps_;
    std::size_t memory_;
    int ranks_;
    int checkpoint_every_;
    AskedOptions asked_;
    std::filesystem::path output_;
    const ReadLog* inputs_;
    std::vector<std::string> arguments_;
    std::string folder_;  ///< where the run was started
    std::string started_;
    std::set<std::filesystem::path> files_before_;
    StageTimes total_;
    std::optional<CsvFile> timings_;
    int steps_ = 0;  ///< recorded so far, the axiom among them
};

}  // namespace espalier::simulation

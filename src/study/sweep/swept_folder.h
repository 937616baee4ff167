// The folder of a sweep: one run for every combination of values, each in a folder of its own, and what they ended
// with.
#pragma once

#include "espalier/archive/recorded_run.h"

#include "picture/charts/sweep_charts.h"
#include "simulation/scene/variation.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace espalier::study {

struct SweepRun {
    Variant variant;
    std::filesystem::path folder;
    std::vector<std::string> words;  ///< arguments of `espalier run`, without --output
};

struct SweepResult {
    const SweepRun* run;
    RecordedTable table;
    std::vector<RecordedPlant> plants;
};

class SweptFolder {
public:
    /// `words`: the arguments of the run with these values.
    SweptFolder(std::vector<Variation> variations, std::filesystem::path folder,
                const std::function<std::vector<std::string>(const Variant&)>& words);

    const std::vector<SweepRun>& runs() const { return runs_; }
    /// Those that have not ended yet, or whose inputs or values have changed since.
    std::vector<const SweepRun*> to_do() const;
    /// What became of a run that is not complete: "killed, with a checkpoint of step 12".
    static std::string state(const SweepRun& run);

    /// Where a run writes what it prints.
    static std::filesystem::path log(const SweepRun& run);
    /// What a run that failed said first, warnings and excerpts of files aside; "" if nothing.
    static std::string complaint(const SweepRun& run);
    /// A run that is complete now may have failed before: what it then printed is removed.
    void remove_old_complaints() const;

    /// The runs that are done, with the last step of their statistics.csv.
    std::vector<SweepResult> results() const;
    /// sweep.csv: the rows of every result after its values. Returns its path.
    std::filesystem::path write_table(const std::vector<SweepResult>& results) const;
    /// What sweep_page() draws.
    SweptRuns drawn(const std::vector<SweepResult>& results) const;

private:
    std::vector<Variation> variations_;
    std::filesystem::path folder_;
    std::vector<SweepRun> runs_;
};

}  // namespace espalier::study

// A sweep: one run for every combination of values, each in a folder of its own, several at a time.
#pragma once

#include "app/run_command.h"
#include "picture/charts/sweep_charts.h"
#include "simulation/scene/variation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::app {

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

class Sweep {
public:
    /// Values go to `--set`, but to `--define` where a model alone is grown and the key has no dot.
    Sweep(const RunArguments& base, const std::vector<Variation>& variations, const std::filesystem::path& folder);

    const std::vector<SweepRun>& runs() const { return runs_; }
    /// The runs have no terminal on which to ask whether they may start the programs that their files name: the user is
    /// asked here, for the first of them. Throws UserError if they may not.
    void agree_on_programs();
    /// Returns statistics.csv as the first run has it at step 0; nothing if it cannot be grown.
    RecordedTable first_statistics() const;
    /// Those that have not ended yet, or whose inputs or values have changed since.
    std::vector<const SweepRun*> to_do() const;
    /// What became of a run that is not complete: "killed, with a checkpoint of step 12".
    static std::string state(const SweepRun& run);
    /// The whole command line of one, to be started in the current folder. It does what is then left to do.
    std::vector<std::string> command(const SweepRun& run) const;
    /// Where it writes what it prints.
    std::filesystem::path log(const SweepRun& run) const;

    struct Outcome {
        std::size_t failed = 0;
        bool interrupted = false;
    };
    /// Runs what is to do, so many at a time. What fails does not keep the others.
    Outcome run(int jobs, bool quiet) const;

    /// A run that is complete now may have failed before: what it then printed is removed.
    void remove_old_complaints() const;
    /// The runs that are done, with the last step of their statistics.csv.
    std::vector<SweepResult> results() const;
    /// sweep.csv: the rows of every result behind its values. Returns its path.
    std::filesystem::path write_table(const std::vector<SweepResult>& results) const;
    /// What sweep_page() draws.
    SweptRuns drawn(const std::vector<SweepResult>& results) const;

private:
    RunArguments arguments_of(const Variant& variant) const;
    std::vector<std::string> options_of_children(std::size_t at_once) const;
    void tell_warnings(const SweepRun& run, bool quiet) const;

    RunArguments base_;
    std::vector<Variation> variations_;
    std::filesystem::path folder_;
    std::vector<SweepRun> runs_;
};

}  // namespace espalier::app

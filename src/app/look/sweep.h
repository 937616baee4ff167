// The runs of a sweep as programs that this one starts, several at a time.
#pragma once

#include "app/run_command.h"
#include "study/sweep/swept_folder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::app {

class Sweep {
public:
    /// Values go to `--set`, but to `--define` where a model alone is grown and the key has no dot.
    Sweep(const RunArguments& base, const std::vector<Variation>& variations, const std::filesystem::path& folder);

    const study::SweptFolder& folder() const { return folder_; }
    /// The runs have no terminal on which to ask whether they may start the programs that their files name: the user is
    /// asked here, for the first of them. Throws UserError if they may not.
    void agree_on_programs();
    /// Returns statistics.csv as the first run has it at step 0; nothing if it cannot be grown.
    RecordedTable first_statistics() const;
    /// The whole command line of one, to be started in the current folder. It does what is then left to do.
    std::vector<std::string> command(const study::SweepRun& run) const;

    struct Outcome {
        std::size_t failed = 0;
        bool interrupted = false;
    };
    /// Runs what is to do, so many at a time. What fails does not keep the others.
    Outcome run(int jobs, bool quiet) const;

private:
    RunArguments arguments_of(const Variant& variant) const;
    std::vector<std::string> options_of_children(std::size_t at_once) const;
    void tell_warnings(const study::SweepRun& run, bool quiet) const;

    RunArguments base_;
    study::SweptFolder folder_;
};

}  // namespace espalier::app

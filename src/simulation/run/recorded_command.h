// How a run was started and what it read, from its run.json: enough to repeat it.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/simulation/simulation.h"

#include "simulation/run/named_programs.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace espalier::simulation {

struct RecordedCommand {
    std::string version, exit;
    int checkpoint_every = 0;
    AskedOptions asked;
    int steps = 0, steps_done = 0;       ///< where it was to end, and where it was when run.json was written
    std::filesystem::path folder;        ///< where it was started
    std::vector<std::string> arguments;  ///< for `espalier run`, without --output and what does not change the timeline
    std::map<std::filesystem::path, ReadLog::File> inputs;
    std::vector<NamedProgram> programs;  ///< that it started, as its run.json says
};

/// Throws UserError if the folder holds no run, or one from before runs could be repeated.
RecordedCommand read_command(const std::filesystem::path& run);

/// True if an input is still there with the bytes it had.
bool is_unchanged(const std::filesystem::path& path, const ReadLog::File& file);

/// Writes the inputs below `root`, each at its own absolute path, and returns the folder to start the program in.
/// Inputs that run.json does not hold are copied from where they were. Throws UserError if one of those is gone or
/// changed, or if run.json itself was.
std::filesystem::path lay_out_inputs(const RecordedCommand& command, const std::filesystem::path& root);

/// Paths among the arguments that lie below `root` once laid out there are replaced by those.
std::vector<std::string> arguments_below(const RecordedCommand& command, const std::filesystem::path& root);

/// Files of two timelines that are not the same bytes: "plants/0003.vtp differs from byte 117 on", "... is missing".
/// run.json and timings.csv describe the run, not the growth, and are ignored.
std::vector<std::string> timeline_differences(const std::filesystem::path& before, const std::filesystem::path& after);

/// What lies in the folder of a run and no run wrote: pictures, charts, exports; names of files and folders.
std::vector<std::string> beside_timeline(const std::filesystem::path& run);

}  // namespace espalier::simulation

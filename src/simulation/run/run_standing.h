// How far a run has come in its folder: what decides whether it begins, goes on, or has nothing left to do.
#pragma once

#include "simulation/run/recorded_command.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::simulation {

struct RunStanding {
    enum class Kind : char {
        absent = 'a',     ///< the folder holds no run
        begun = 'b',      ///< this run, with nothing that it could go on from
        resumable = 'r',  ///< this run, with a checkpoint
        complete = 'c',   ///< this run
        other = 'o'       ///< one that was started otherwise, or that read a file which has changed since
    };
    Kind kind = Kind::absent;
    std::string why = {};          ///< of `begun` after it was complete, and of `other`
    RecordedCommand command = {};  ///< unless absent
};

/// Of the run that `espalier run` with these arguments, started in the current folder, has in `folder`. Files are read
/// that it read.
RunStanding standing_of(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Removes the checkpoint in a run's folder, and what is kept for it.
void remove_checkpoint(const std::filesystem::path& folder);
/// The last act of a run that ended by itself; does nothing new in the folder of one that has done so. Throws RunError.
void mark_complete(const std::filesystem::path& folder);

/// The first file that a run read and that has changed since, or is gone; empty if there is none.
std::filesystem::path changed_input(const RecordedCommand& command);

}  // namespace espalier::simulation

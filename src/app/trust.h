// Programs that files of a scene name are started only for a user who agreed to that.
#pragma once

#include "simulation/run/named_programs.h"

#include <filesystem>
#include <vector>

namespace espalier::app {

/// Returns if all of them may be started: `given` by --trust, or by the user's consent to their folders, which is asked
/// for on a terminal and remembered. Throws UserError if not.
void require_trust(const std::vector<NamedProgram>& programs, bool given);

/// A run that has started programs may do so again, as `resume` and `rerun` do.
void trust_record(const std::vector<NamedProgram>& programs, bool given, const std::filesystem::path& output);

/// What --trust says of itself.
inline constexpr const char* trust_help =
    "start the environment programs that the files name; without it, you are asked on a terminal, once for each folder";

}  // namespace espalier::app

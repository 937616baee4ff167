// Which frames of a recorded run a command takes: --step.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <string>
#include <vector>

namespace espalier::archive {

/// "12", "first", "last", "all", "A:B" or "A:B:C" (from A to B, every C-th step; either end may be left out): the
/// frames recorded at those steps, of plants or of fields. Throws UserError for text that is none of these, and if no
/// frame is left.
std::vector<const RecordedFrame*> chosen_frames(const RecordedRun& run, const std::string& text);

/// Throws UserError for text that is none of these, whatever the run.
void require_frame_option(const std::string& text);

/// What --step may be, for the help of commands.
inline constexpr const char* frame_option_help = "which frames: N, first, last, all, or FROM:TO[:EVERY]";

}  // namespace espalier::archive

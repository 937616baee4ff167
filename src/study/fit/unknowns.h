// Parameters that are sought, as words and scenes name them.
#pragma once

#include "study/fit/growth.h"
#include "study/fit/prior.h"

#include <string>
#include <vector>

namespace espalier::study {

/// "ANGLE" (over the range in the comment of its #define), "ANGLE=30" (from there), "ANGLE=10:60", "RATE=log:0.01:1",
/// "ANGLE=normal:40:5"; names as `Growth` has them. Throws UserError.
Unknown unknown_of(const std::string& text, const Subject& subject);

/// Those of a scene's [fit], or all settings of a model that have no whole numbers. Throws UserError if there are none.
std::vector<Unknown> usual_unknowns(const Subject& subject);

/// The files of a scene's [fit].
std::vector<std::filesystem::path> usual_targets(const Subject& subject);

}  // namespace espalier::study

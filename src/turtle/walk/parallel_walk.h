// One string walked by several threads, with the result of a walk in one piece.
#pragma once

#include "turtle/walk/string_walk.h"

namespace espalier::turtle {

/// Walks stretches of at least `chunk` modules side by side into the empty `result`. Returns false, having left
/// anything there, where the string is too short or too little branched, or where its turtle carries more from stretch
/// to stretch than was predicted: then it is to be walked in one piece.
bool walk_in_parallel(const WalkInput& input, std::size_t chunk, Interpretation& result);

}  // namespace espalier::turtle

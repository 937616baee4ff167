// Reads the blocks of a skeleton description. Fibres are read by a class of their own.
#pragma once

#include "language/sdl/skeleton.h"
#include "language/sdl/token_reader.h"

#include <string>
#include <vector>

namespace espalier::language::sdl {

/// The block `fibres { ... }`, behind its first brace. A mistake in a statement does not end the block.
std::vector<Fibre> parse_fibres(TokenReader& in, Mistakes& mistakes);

/// What a fibre may say of itself: "flat", "cut", ...
const std::vector<std::string>& fibre_settings();

/// Reports what is wrong with a skeleton as a whole: names that are unknown or defined twice, places off the master.
void check(const Skeleton& skeleton, Mistakes& mistakes);

}  // namespace espalier::language::sdl

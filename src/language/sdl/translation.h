// The model that a skeleton stands for.
#pragma once

#include "espalier/language/notation.h"

#include "language/sdl/skeleton.h"

#include <string>
#include <vector>

namespace espalier::language::sdl {

/// The fibres that the slaves of a component begin on: its own, or, as it is NULL, those of all its masters.
std::vector<const Fibre*> bearers(const Skeleton& skeleton, const std::string& component);

/// `file` is the name that mistakes are told with; the first comment has it without its folder.
TranslatedText model_of(const Skeleton& skeleton, const std::string& file);

}  // namespace espalier::language::sdl

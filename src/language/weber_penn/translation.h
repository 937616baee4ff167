// Species as L-systems: stems that grow segment by segment, all levels at once.
#pragma once

#include "espalier/language/notation.h"

#include "language/weber_penn/species.h"

#include <string>

namespace espalier::language::weber_penn {

/// The model of a species. `file` is the name that mistakes are told with; the head has it without its folder. What
/// goes wrong in a level is placed where the file sets the first of its parameters.
TranslatedText model_of(const Species& species, const std::string& file);

}  // namespace espalier::language::weber_penn

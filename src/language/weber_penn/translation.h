// Species as L-systems: stems that grow segment by segment, all levels at once.
#pragma once

#include "language/weber_penn/species.h"

#include <string>

namespace espalier::language::weber_penn {

/// The model of a species; `file` stands in its head.
std::string model_of(const Species& species, const std::string& file);

/// A leaf of length `size` as polygons: modules that move the turtle around its outline.
std::string leaf_polygons(const Species& species, const std::string& size);

}  // namespace espalier::language::weber_penn

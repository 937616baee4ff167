// Trees of points with radii, the form of neurons (Cannon et al. 1998), which programs for roots write, too.
#pragma once

#include "espalier/language/measured_plants.h"

#include <string>

namespace espalier::language::swc {

/// Throws UserError with the place of a mistake.
MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options);

}  // namespace espalier::language::swc

// Root systems in Dune's grid format, as DuMux, CPlantBox and CRootBox write them: a row for each segment.
#pragma once

#include "espalier/language/measured_plants.h"

#include <string>

namespace espalier::language::dgf {

/// Throws UserError with the place of a mistake.
MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options);

}  // namespace espalier::language::dgf

// A tree of cylinders that were fitted to scanned points.
#pragma once

#include "espalier/language/measured_plants.h"

#include <string>

namespace espalier::language::cylinders {

/// Throws UserError with the place of a mistake.
MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options);

}  // namespace espalier::language::cylinders

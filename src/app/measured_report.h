// What a file of measured plants holds, for people and as JSON.
#pragma once

#include "espalier/language/measured_plants.h"

namespace espalier::app {

/// Prints warnings to standard error, and lengths, numbers and the extent to standard output.
void report_measured(const MeasuredPlants& plants, bool json);

}  // namespace espalier::app

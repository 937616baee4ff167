// The axes of a multiscale tree graph, as measured lines.
#pragma once

#include "espalier/language/measured_plants.h"

#include <string>

namespace espalier::language::mtg {

/// The entities of the finest scale that has coordinates, by the succession of which axes consist, and coarser ones
/// without parts. Those between two with coordinates lie evenly between them. Throws UserError if none has coordinates.
MeasuredPlants read_axes(std::string text, const std::string& name, const MeasuredOptions& options);

}  // namespace espalier::language::mtg

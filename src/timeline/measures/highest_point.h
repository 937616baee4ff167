// How high a plant reaches.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <optional>

namespace espalier::timeline {

/// The y of the highest point drawn: of internodes the rims of their ends, of patches the control points. Nothing where
/// nothing is drawn.
std::optional<double> highest_point(const PlantGeometry& geometry);

}  // namespace espalier::timeline

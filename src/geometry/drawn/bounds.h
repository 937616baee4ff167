// The box around what is drawn of a plant.
#pragma once

#include "espalier/geometry/plant_geometry.h"

namespace espalier::geometry {

/// Around internodes and round organs with their radii, and the control points of surfaces.
Box drawn_bounds(const PlantGeometry& geometry);

}  // namespace espalier::geometry

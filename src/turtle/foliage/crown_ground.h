// The ground below a crown.
#pragma once

#include "espalier/geometry/plant_geometry.h"

namespace espalier::turtle {

/// Area of the convex hull of all that is drawn flat, seen from straight above, m2 (Andrew 1979's chain).
double ground_below(const PlantGeometry& leaves);

}  // namespace espalier::turtle

// Flat pictures of leaves: one square, or two that cross.
#pragma once

#include "espalier/geometry/surface.h"

namespace espalier::turtle {

/// A square of side 1 that faces up and stands on the middle of its lower edge: 4 vertices, 2 triangles. Its texture is
/// upright along the heading.
Surface card();
/// Two of them, at right angles about the heading: 8 vertices, 4 triangles.
Surface crossed_cards();

}  // namespace espalier::turtle

// The columns of what a plant has drawn, for whoever counts, clears or keeps all of them.
#pragma once

#include "espalier/geometry/plant_geometry.h"

namespace espalier::geometry {

/// Calls visit(column) for each. `geometry` is a PlantGeometry, constant or not.
template <class Geometry, class Visit>
void for_drawn_columns(Geometry& geometry, const Visit& visit) {
    visit(geometry.internodes);
    visit(geometry.polygons);
    visit(geometry.vertices);
    visit(geometry.organs);
    visit(geometry.mesh.vertices);
    visit(geometry.mesh.triangles);
    visit(geometry.mesh.pieces);
    visit(geometry.labels);
    visit(geometry.textures);
}

}  // namespace espalier::geometry

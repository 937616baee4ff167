// Not among the shapes: the program says this without loading OpenVDB.
#include "espalier/environment/shape.h"

namespace espalier::environment {

const char* shape_help() {
    return R"(A solid is a table with the key `shape`. Lengths are in metres, angles in degrees; the distance is negative inside.

box           center and size, or lower and upper; with two numbers each, [x, y], it is unbounded along z
sphere        center, radius
ellipsoid     center, radii = [x, y, z]
cylinder      base, tip: centres of the end faces; radius
cone          base, tip: centres of the end faces; base_radius, tip_radius (0)
tube          points = [[x, y, z], ...], radius: a rounded pipe along a polyline
half-space    point ([0, 0, 0]), normal: solid on the side that the normal points away from
height-field  heights = [...] row after row along z with columns = n; or file = an image with lowest, highest = heights
              of black and white. size = [x, z], corner ([0, 0, 0]), floor (the lowest height minus the shorter side):
              solid from the floor up to the heights
mesh          file (OBJ, STL or PLY; closed), voxel of its level set (longest side / 128)
union         of = [{...}, ...], blend (0): surfaces closer than this merge smoothly
intersection  of = [{...}, ...]: what is in all of them
difference    of = [{...}, ...]: the first without the others

Every solid may have these keys, which are applied in this order:

scale      1, > 0; factor of the size, about the origin
rotate     none; { axis = [x, y, z], angle = degrees }: a turn about an axis through the origin
translate  [0, 0, 0] m; a movement
offset     0 m; by how much the solid is expanded on all sides; less than 0: shrunk
)";
}

}  // namespace espalier::environment

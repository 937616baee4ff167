#include "espalier/environment/shape.h"

namespace espalier::environment {

const char* shape_help() {
    return R"(shape = one of (metres and degrees; distance is negative inside):
  box          center and size, or lower and upper; with two numbers each, [x, y], it is unbounded along z
  sphere       center, radius
  ellipsoid    center, radii = [x, y, z]
  cylinder     base, tip (centres of the end faces), radius
  cone         base, tip, base_radius, tip_radius (0)
  tube         points = [[x, y, z], ...], radius: a rounded pipe along a polyline
  half-space   point ([0, 0, 0]), normal: solid on the side the normal points away from
  height-field heights = [..] row after row along z with columns = n, or file = an image with
               lowest, highest = heights of black and white; size = [x, z], corner ([0, 0, 0]),
               floor (lowest height minus the shorter side): solid from floor up to the heights
  mesh         file (OBJ, STL, PLY; closed), voxel of its level set (longest side / 128)
  union        of = [{...}, ...], blend (0): surfaces closer than this merge smoothly
  intersection of = [{...}, ...]
  difference   of = [{...}, ...]: the first without the others
Every shape may have, applied in this order:
  scale (1), rotate = { axis = [x, y, z], angle = degrees }, translate ([0, 0, 0]),
  offset (0): expands by so many metres, shrinks if negative)";
}

}  // namespace espalier::environment

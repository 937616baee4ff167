// Polygons: { opens one, F, f and . mark its vertices, } fills it. They may stand inside one another, and a polygon
// may reach across branches.
#include "espalier/turtle/symbol.h"

namespace espalier {
namespace {

// With parameters these belong to generalized cylinders, whose points are no polygon's vertices.
const Symbol open{"{", {}, "{: begin a polygon", [](Walk& walk, std::span<const double> parameters) {
                      walk.open_polygon(parameters.empty());
                  }};

const Symbol close{"}",
                   {},
                   "}: end the polygon and fill it; fewer than three vertices draw nothing",
                   [](Walk& walk, std::span<const double>) { walk.close_polygon(); }};

const Symbol vertex{
    ".", {0}, ".: mark a vertex of the open polygon where the turtle is", [](Walk& walk, std::span<const double>) {
        walk.record_vertex();
    }};

}  // namespace
}  // namespace espalier

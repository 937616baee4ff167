// A box of space, in the turtle's frame, that bends and takes along what is drawn until the deformation ends.
#include "espalier/turtle/symbol.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::turtle {
namespace {

constexpr std::size_t before_moves = 10;

std::size_t points_along(Walk& walk, double count) {
    if (!(count >= 2 && count <= 16 && count == std::floor(count))) {
        walk.fail("the lattice of a deformation has 2 to 16 points along x, y and z");
    }
    return std::size_t(count);
}

void begin_deformation(Walk& walk, std::span<const double> values) {
    using enum FreeForm::Leaves;
    if (values.size() < before_moves) walk.fail("a deformation says its leaves, lattice, corners and moves");
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) {
        walk.fail("a number of a deformation is not a number");
    }
    const auto vector = [&](std::size_t at) { return glm::dvec3(values[at], values[at + 1], values[at + 2]); };
    FreeForm form;
    form.leaves = values[0] == 0 ? bent : values[0] == 1 ? carried : left;
    for (std::size_t axis = 0; axis < 3; ++axis) form.counts[axis] = points_along(walk, values[1 + axis]);
    form.lower = vector(4);
    form.upper = vector(7);
    const glm::dvec3 size = form.upper - form.lower;
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
        walk.fail("the upper corner of a deformation lies not above the lower");
    const std::size_t points = form.counts[0] * form.counts[1] * form.counts[2];
    if (values.size() != before_moves + 3 * points) {
        walk.fail("a deformation needs a vector for each point of its lattice");
    }
    for (std::size_t k = 0; k < points; ++k) form.moves.push_back(vector(before_moves + 3 * k));
    walk.begin_deformation(std::move(form));
}

const Registered<Symbol> deformation_start{
    {"@Db",
     {},
     "@Db(leaves,nx,ny,nz,x,y,z,X,Y,Z,moves...): begin a free-form deformation of the box from (x,y,z) to (X,Y,Z) in "
     "the "
     "turtle's frame by the moves of nx by ny by nz points; leaves 0 bend, 1 are carried, 2 stay",
     begin_deformation}};

const Registered<Symbol> deformation_end{{"@De",
                                          {0},
                                          "@De: end the deformation: what was drawn since it began is moved",
                                          [](Walk& walk, std::span<const double>) { walk.end_deformation(); }}};

const Registered<SymbolGroup> deformation_group{
    {"deformation",
     "free-form deformations",
     {"@Db", "@De"},
     "The points of a lattice of nx by ny by nz points in the box move by the vectors (moves), along x "
     "first, then y, then z: x runs against left, y along the heading, z against up. Lengths are in units "
     "of the scale.\n"
     "What is drawn until @De moves with them (Sederberg & Parry 1986). The turtle, queries and radii do "
     "not notice the deformation.",
     "axiom: !(0.2) @Db(0, 2,2,2, -1,0,-1, 1,3,1, 0,0,0, 0,0,0, 1,0,0, 1,0,0, 0,0,0, 0,0,0, 1,0,0, 1,0,0) F(1) F(1) "
     "F(1) @De"}};

}  // namespace
}  // namespace espalier::turtle

#include "turtle/foliage/cards.h"

namespace espalier::turtle {
namespace {

/// Makes a patch of one quadrilateral; s runs along `across`, t along the heading.
BicubicPatch square(const glm::dvec3& across) {
    BicubicPatch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            patch.points[row][column] = (double(row) / 3 - 0.5) * across + glm::dvec3(0, double(column) / 3, 0);
        }
    }
    return patch;
}

}  // namespace

Surface card() {
    Surface surface;
    surface.patches = {square({1, 0, 0})};
    surface.precision_s = surface.precision_t = 1;
    return surface;
}

Surface crossed_cards() {
    Surface surface = card();
    surface.patches.push_back(square({0, 0, 1}));
    return surface;
}

}  // namespace espalier::turtle

// Outlines of leaves, as the turtle walks around them.
#include "espalier/base/math.h"

#include "language/weber_penn/translated_species.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <numbers>

namespace espalier::language::weber_penn {
namespace {

using Outline = std::vector<glm::dvec2>;  // right half from base to tip: (across, along), both by the leaf's length

Outline half_outline(int shape) {
    switch (shape) {
        case 1:
            return {{0, 0}, {0.5, 0.05}, {0, 1}};
        case 2:
            return {{0, 0}, {0.12, 0.12}, {0.42, 0.38}, {0.46, 0.55}, {0.2, 0.52}, {0.26, 0.8}, {0, 1}};
        case 3:
            return {{0, 0}, {0.25, 0.08}, {0.5, 0.62}, {0.18, 0.48}, {0.14, 0.75}, {0, 1}};
        case 4:
            return {{0, 0}, {0.4, -0.05}, {0.3, 0.2}, {0.5, 0.6}, {0.16, 0.45}, {0.14, 0.75}, {0, 1}};
        default:
            return {{0, 0}, {0.3, 0.15}, {0.5, 0.42}, {0.36, 0.75}, {0, 1}};
    }
}

/// Turns and moves from the base around one half and back along the midrib; the turtle looks along the leaf at first.
std::string walk_around(const Outline& half, double side, double width, const std::string& size) {
    std::string modules = "[ { .";
    double heading = 0;
    for (std::size_t k = 1; k < half.size(); ++k) {
        const glm::dvec2 step = (half[k] - half[k - 1]) * glm::dvec2(side * width, 1);
        const double angle = math::atan2(step.x, step.y) * 180 / std::numbers::pi;
        modules += fmt::format(" +({:.4g}) f({:.4g} * {})", angle - heading, glm::length(step), size);
        heading = angle;
    }
    return modules + " } ]";
}

std::string blade(const Outline& half, double width, const std::string& size) {
    return walk_around(half, 1, width, size) + " " + walk_around(half, -1, width, size);
}

}  // namespace

std::string leaf_polygons(const Species& species, const std::string& size) {
    const int shape = static_cast<int>(species.value("LeafShape"));
    const double width = species.value("LeafScaleX");
    const Outline half = half_outline(shape);
    const std::string stalk = species.value("LeafStemLen") > 0 ? fmt::format("f(LeafStemLen * {}) ", size) : "";
    if (shape != 5) return stalk + blade(half, width, size);
    const std::string leaflet = blade(half, width, "0.6 * " + size);
    return stalk + fmt::format("f(0.4 * {}) {} [ +(70) {} ] [ -(70) {} ]", size, leaflet, leaflet, leaflet);
}

// Weber & Penn 1995, section 4.9: the leaf turns about the vertical, so that its upper side looks away from the trunk,
// and about its width, so that it looks up as far as it can. The upper side is where the turtle's up points away from.
std::string leaf_turns() {
    return R"(?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) LeafBud : {
	px = x - foot_x + LeafScale / 2 * hx;
	pz = z - foot_z + LeafScale / 2 * hz;
	around = ux ^ 2 + uz ^ 2 > 1e-12 ? atan2(pz, px) - atan2(-uz, -ux) : 0;
	around = LeafBend * (around - 360 * floor(around / 360 + 0.5));
	qx = hx * cos(around) - hz * sin(around); hz = hx * sin(around) + hz * cos(around); hx = qx;
	rx = ux * cos(around) - uz * sin(around); uz = ux * sin(around) + uz * cos(around); ux = rx;
	} 1 --> @R(hx, hy, hz, ux, uy, uz) &(LeafBend * atan2(hy, -uy)) Leaf
)";
}

}  // namespace espalier::language::weber_penn

// A box of space that bends and takes what is drawn in it along, after Sederberg & Parry 1986: a lattice of points
// spans the box, and Bernstein polynomials carry their displacements inside.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/plant_geometry.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace espalier::geometry {

struct FreeForm {
    /// What becomes of polygons, organs and patches: their points move, or they keep their shape and move with their
    /// first vertex, or they stay.
    enum class Leaves : std::uint8_t { bent, carried, left };

    Pose pose;         ///< pose of the box: x against left, y along the heading, z against up
    double scale = 1;  ///< metres in a unit of the box
    glm::dvec3 lower{0}, upper{1};
    std::array<std::size_t, 3> counts{2, 2, 2};  ///< points of the lattice along x, y, z; at least 2
    std::vector<glm::dvec3> moves;               ///< displacement of each point of the lattice; x first, then y, then z
    Leaves leaves = Leaves::carried;

    /// Returns how a point of the world moves. Points outside the box move as the nearest point of it.
    glm::dvec3 displacement(const glm::dvec3& point) const;
};

/// How much was drawn at some time.
struct DrawnSoFar {
    std::size_t polygons = 0, vertices = 0, organs = 0, mesh_vertices = 0, pieces = 0, labels = 0;

    static DrawnSoFar of(const PlantGeometry& geometry);
};

/// Moves these internodes, and what was drawn of other kinds since then. Radii and bounds do not change.
void deform(const FreeForm& form, std::span<Internode> internodes, PlantGeometry& geometry,
            const DrawnSoFar& since = {});

}  // namespace espalier::geometry

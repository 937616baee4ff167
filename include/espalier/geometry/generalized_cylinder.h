// Generalized cylinders: a contour swept along a curve through, or near, control points.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/plant_geometry.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace espalier::geometry {

/// The slopes of the radius on both sides of a control point, as angle (radians) and length of tangents.
struct RadiusTangents {
    double angle_before = 0, length_before = 0;
    double angle_after = 0, length_after = 0;
    bool scaled = false;  ///< lengths count in distances between the control points
};

struct CylinderPoint {
    std::uint32_t module = 0;
    std::uint16_t order = 0;
    std::uint16_t colour = 0;
    Look look = {};
    Pose pose;  ///< its heading is the curve's direction, unless the curve is a B-spline
    double width = 1;
    const Contour* contour = nullptr;  ///< null: the circle. Outlives the drawing
    int strips = 1;                    ///< between the control point before and this one
    double tangent_before = 1.2, tangent_after = 1.2;
    std::optional<RadiusTangents> radius =
        {};                     ///< none: the radius goes smoothly from point to point without overshooting
    bool follows_roll = false;  ///< `up` is the pose's own here instead of twisting least
};

struct GeneralizedCylinder {
    enum class Curve : std::uint8_t { open_hermite = 1, closed_hermite = 2, open_spline = 3, closed_spline = 4 };
    Curve curve = Curve::open_hermite;
    int sides = 8;             ///< corners of a contour, at least 3
    double texture_ratio = 1;  ///< stretches textures along it
    std::vector<CylinderPoint> points;

    /// Closed curves need three points; with two they are open.
    bool closed() const {
        return points.size() >= 3 && (curve == Curve::closed_hermite || curve == Curve::closed_spline);
    }
};

/// A place of the contour along the curve. Its frame's heading is the curve's direction.
struct CylinderRing {
    Pose frame;
    double width;
    double along;       ///< length of the curve up to here
    std::size_t after;  ///< control point before or at this ring
    double share;       ///< how far on the way to the next control point, 0 to 1
};

/// The rings from the first control point to the last; of a closed cylinder back to the first.
/// Between control points frames twist least (double reflection; Wang, Juettler, Zheng & Liu 2008).
std::vector<CylinderRing> rings_of(const GeneralizedCylinder& cylinder);

/// Adds the cylinder to a plant's mesh and bounds, one piece for each control point but the first; that of a closed
/// cylinder's last stretch belongs to its last point. Tubes with ends are capped, so that they are watertight.
/// Does nothing for fewer than two points.
void draw(const GeneralizedCylinder& cylinder, PlantGeometry& geometry);

}  // namespace espalier::geometry

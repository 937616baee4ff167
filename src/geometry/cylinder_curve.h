// The centre line of a generalized cylinder, stretch by stretch between control points.
#pragma once

#include "espalier/geometry/generalized_cylinder.h"

namespace espalier::geometry {

/// Stretch i leads from control point i to the next.
class CylinderCurve {
public:
    explicit CylinderCurve(const GeneralizedCylinder& cylinder);

    std::size_t stretches() const { return cylinder_.points.size() - (closed_ ? 0 : 1); }
    std::size_t next(std::size_t point) const { return (point + 1) % cylinder_.points.size(); }

    struct Place {
        glm::dvec3 position;
        glm::dvec3 tangent;  ///< unit length
        double width;
    };
    Place at(std::size_t stretch, double u) const;

private:
    struct Stretch {
        glm::dvec3 points[4];  ///< a Hermite curve has position, tangent, position, tangent
        double widths[4];
    };
    void add_hermite(std::size_t i);
    void add_spline(std::size_t i);
    double width_slope(std::size_t point, std::size_t stretch) const;
    double distance(std::size_t stretch) const;

    const GeneralizedCylinder& cylinder_;
    const bool closed_;
    const bool spline_;
    std::vector<Stretch> stretches_;
};

}  // namespace espalier::geometry

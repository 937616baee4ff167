// Cross-sections of generalized cylinders: closed or open uniform cubic B-splines, or what magnets make of an ellipse.
#pragma once

#include "espalier/base/stations.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace espalier::geometry {

struct MagneticCut;

/// Units are half widths of the turtle's line: a circle of radius 1 has the line's width as diameter.
class Contour {
public:
    struct Vertex {
        glm::dvec3 position;
        glm::dvec3 normal;  ///< in the plane of x and y, pointing out
    };

    /// The unit circle, contour 0.
    Contour() = default;
    /// Control points, each as often as its multiplicity says. Throws UserError for fewer than four (closed: three).
    Contour(std::vector<glm::dvec3> points, bool closed);
    explicit Contour(MagneticCut cut);

    /// `sides` + 1 vertices at equal distances along the curve; of a closed contour the last equals the first, and
    /// the first lies on the +x axis. Those of a magnetic cut are at equal angles.
    std::vector<Vertex> sample(int sides) const;
    bool closed() const { return closed_; }
    bool is_circle() const { return points_.empty() && !cut_; }
    /// True if it is drawn counter-clockwise.
    bool counter_clockwise() const;

private:
    std::vector<glm::dvec3> points_;  // none: the circle
    bool closed_ = true;
    std::shared_ptr<const MagneticCut> cut_;
};

}  // namespace espalier::geometry

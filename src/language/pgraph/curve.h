// A smooth curve in space through given points, measured by its length.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace espalier::language::pgraph {

/// Cubic between each two points, with the tangent of the parabola through a point and its neighbours (Catmull & Rom
/// 1974, over the distances of the points), so it is smooth whatever these are.
class CurveThrough {
public:
    /// At least two points, no two successive ones in one place.
    explicit CurveThrough(std::vector<glm::dvec3> points);

    double length() const { return lengths_.back(); }
    /// At a distance from the beginning, along the curve.
    glm::dvec3 at(double distance) const;
    /// Returns how far point k is from the beginning, along the curve.
    double distance_of(std::size_t k) const { return lengths_[k]; }

private:
    glm::dvec3 tangent(std::size_t k) const;
    glm::dvec3 point(std::size_t segment, double t) const;
    double speed(std::size_t segment, double t) const;
    double length_to(std::size_t segment, double t) const;

    std::vector<glm::dvec3> points_;
    std::vector<double> lengths_;  ///< at each point
};

}  // namespace espalier::language::pgraph

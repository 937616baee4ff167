// The control points of curves and patches as their files write them: for readers, and for editors that change them.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::geometry {

/// A control point, and where its numbers stand in the text.
struct ControlPoint {
    glm::dvec3 position{0};  ///< coordinates that the file leaves out are 0
    int times = 1;           ///< how often it counts
    std::size_t from = 0, to = 0;
};

/// How control points make a curve: a cubic B-spline that is open, closed, or reaches its ends; or another one.
enum class Spline { open, closed, clamped, other };

/// The points of one curve, or of one patch of a surface.
struct ControlPoints {
    std::string name;
    Spline spline = Spline::open;
    int coordinates = 2;                       ///< 2 or 3
    bool may_repeat = false;                   ///< a number behind the coordinates says how often a point counts
    bool says_times = false;                   ///< the file does so
    bool says_total = false;                   ///< behind the number of points stands how often all of them count
    std::optional<std::size_t> count_at = {};  ///< where the number of points stands; none: it is fixed
    std::size_t total = 0;                     ///< how often all points count
    std::vector<ControlPoint> points;

    /// Adds the point of a line of numbers, the last of which says how often it counts if there is one more than
    /// coordinates. False if that is less than 1, or if the points become more than a file may have.
    bool add(std::span<const double> numbers, std::size_t from, std::size_t to);
};

/// Each point as often as it counts.
template <class Vector>
std::vector<Vector> expanded(const ControlPoints& curve) {
    std::vector<Vector> all;
    all.reserve(curve.total);
    for (const ControlPoint& point : curve.points) {
        all.insert(all.end(), static_cast<std::size_t>(point.times), Vector(point.position));
    }
    return all;
}

/// The text with other points of a curve that was read from it. Lines of points that stay are kept as they are. Throws
/// UserError for points that the file cannot write.
std::string with_points(const std::string& text, const ControlPoints& curve, const std::vector<ControlPoint>& points);

}  // namespace espalier::geometry

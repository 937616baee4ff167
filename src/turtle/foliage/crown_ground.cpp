#include "turtle/foliage/crown_ground.h"

#include "geometry/drawn/faces.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace espalier::turtle {
namespace {

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// From the first to the last of sorted points, around one side.
template <class Iterator>
std::vector<glm::dvec2> chain(Iterator first, Iterator last) {
    std::vector<glm::dvec2> hull;
    for (; first != last; ++first) {
        while (hull.size() > 1 && turn(hull[hull.size() - 2], hull.back(), *first) <= 0) hull.pop_back();
        hull.push_back(*first);
    }
    return hull;
}

}  // namespace

double ground_below(const PlantGeometry& leaves) {
    DrawnFaces faces;
    faces.add_leaves(0, leaves);
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (const glm::dvec3& corner : faces[i].corners) points.emplace_back(corner.x, corner.z);
    }
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    double twice = 0;
    for (const std::vector<glm::dvec2>& side :
         {chain(points.begin(), points.end()), chain(points.rbegin(), points.rend())}) {
        for (std::size_t i = 1; i < side.size(); ++i) {
            twice += side[i - 1].x * side[i].y - side[i].x * side[i - 1].y;
        }
    }
    return std::abs(twice) / 2;
}

}  // namespace espalier::turtle

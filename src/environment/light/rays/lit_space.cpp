#include "environment/light/rays/lit_space.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::environment {

Box LitSpace::bounds_of(const LitTriangles& triangles, std::span<const LightSensor> sensors) const {
    Box box = triangles.bounds();
    for (const LightSensor& sensor : sensors) {
        for (const double u : {-0.5, 0.5}) {
            for (const double v : {-0.5, 0.5}) {
                box.add(sensor.middle + u * sensor.size[0] * sensor.x + v * sensor.size[1] * sensor.y);
            }
        }
    }
    if (box.empty()) box.add(glm::dvec3(0, ground_, 0));
    if (period_) {
        for (const int axis : {0, 2}) {
            box.lower[axis] = period_->lower[axis];
            box.upper[axis] = period_->upper[axis];
        }
    }
    box.upper.y = std::max(box.upper.y, ground_);
    return box;
}

std::size_t LitSpace::set(const LitTriangles& triangles, std::span<const LightSensor> sensors, double highest) {
    const Box box = bounds_of(triangles, sensors);
    centre_ = (box.lower + box.upper) / 2.0;
    radius_ = glm::length(box.upper - box.lower) / 2 + 1e-3;
    top_ = std::max(centre_.y + radius_, highest);
    const glm::dvec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    near_ = 1e-5 * std::max({farthest.x, farthest.y, farthest.z, 1e-3});
    soil_ = ground_ - 2 * near_;  // light that the soil scatters meets what lies on it
    return scene_.set_parts(triangles.parts(period_));
}

bool LitSpace::is_open(const glm::dvec3& from, const glm::dvec3& direction, double length) const {
    LightPath path{inside(from), direction, near_};
    if (path.origin.y < soil_ || path.origin.y + length * direction.y < soil_) return false;
    for (int periods = 0; periods < most_periods; ++periods) {
        const double limit = std::min(length, to_side(path));
        if (scene_.is_blocked(glm::vec3(path.origin), glm::vec3(direction), static_cast<float>(path.near),
                              static_cast<float>(limit))) {
            return false;
        }
        if (limit == length) return true;
        path.origin += limit * direction;
        length -= limit;
        if (direction.y >= 0 && path.origin.y > top_) return true;
        enter_opposite(path);
    }
    return true;
}

std::optional<RayScene::Hit> LitSpace::met_at(const glm::dvec3& place, const glm::dvec3& towards) const {
    const glm::dvec3 from = inside(place) + near_ * towards;
    return scene_.first_hit(glm::vec3(from), glm::vec3(-towards), 0, static_cast<float>(2 * near_));
}

double LitSpace::to_side(const LightPath& path) const {
    double nearest = far;
    if (!period_) return nearest;
    for (const int axis : {0, 2}) {
        const double along = path.direction[axis];
        if (along == 0) continue;
        const double side = along > 0 ? period_->upper[axis] : period_->lower[axis];
        nearest = std::min(nearest, std::max(0.0, (side - path.origin[axis]) / along));
    }
    return nearest;
}

/// From a side of the period to the other.
void LitSpace::enter_opposite(LightPath& path) const {
    for (const int axis : {0, 2}) {
        const double along = path.direction[axis], low = period_->lower[axis], high = period_->upper[axis];
        const double left = along > 0 ? high - path.origin[axis] : along < 0 ? path.origin[axis] - low : far;
        if (left <= 1e-12 * (high - low)) path.origin[axis] = along > 0 ? low : high;
    }
    path.near = 0;
}

}  // namespace espalier::environment

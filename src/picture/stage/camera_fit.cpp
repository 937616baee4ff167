#include "picture/stage/camera_fit.h"

#include "geometry/sky/radiance.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::picture {
namespace {

constexpr std::size_t direction_count = 96;
constexpr int turns_tried = 24;

const std::vector<glm::dvec3>& directions() {
    static const std::vector<glm::dvec3> all = [] {
        std::vector<glm::dvec3> result;
        for (std::size_t i = 0; i < direction_count; ++i) {
            const double height = 1 - (2 * static_cast<double>(i) + 1) / direction_count;
            result.push_back(sunflower_direction(i, height));
        }
        return result;
    }();
    return all;
}

glm::dvec3 middle_of(std::span<const glm::dvec3> points) {
    glm::dvec3 lower(std::numeric_limits<double>::max()), upper(-std::numeric_limits<double>::max());
    for (const glm::dvec3& point : points) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    return points.empty() ? glm::dvec3(0) : (lower + upper) / 2.0;
}

struct Axes {
    glm::dvec3 right, up, towards;  ///< `towards` the camera
};

Axes axes_of(double azimuth, double elevation, double twist) {
    const double a = glm::radians(azimuth), e = glm::radians(elevation), t = glm::radians(twist);
    const glm::dvec3 right(std::cos(a), 0, -std::sin(a));
    const glm::dvec3 up(-std::sin(e) * std::sin(a), std::cos(e), -std::sin(e) * std::cos(a));
    const glm::dvec3 towards(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
    return {std::cos(t) * right + std::sin(t) * up, std::cos(t) * up - std::sin(t) * right, towards};
}

/// What one picture axis asks for: how far the middle is moved along it, and how far away the camera must be.
struct Reach {
    double most = -std::numeric_limits<double>::max(), least = -std::numeric_limits<double>::max();

    // A point at x and z (towards the camera) is seen if |x - shift| <= slope (distance - z).
    void add(double x, double z, double slope) {
        most = std::max(most, x + slope * z);
        least = std::max(least, -x + slope * z);
    }
    double shift() const { return (most - least) / 2; }
    double half(bool is_shifted) const { return is_shifted ? (most + least) / 2 : std::max(most, least); }
};

}  // namespace

void Outline::add(const glm::dvec3& point, double radius) {
    if (furthest_.empty()) {
        furthest_.assign(direction_count, {-std::numeric_limits<double>::max(), glm::dvec3(0)});
    }
    for (std::size_t i = 0; i < direction_count; ++i) {
        const double distance = glm::dot(point, directions()[i]) + radius;
        if (distance > furthest_[i].distance) furthest_[i] = {distance, point + radius * directions()[i]};
    }
}

void Outline::add(const Outline& other) {
    for (const Furthest& furthest : other.furthest_) add(furthest.point, 0);
}

std::vector<glm::dvec3> Outline::points() const {
    std::vector<glm::dvec3> points;
    for (const Furthest& furthest : furthest_) points.push_back(furthest.point);
    return points;
}

namespace {

/// How points are seen from all azimuths tried, relative to a middle.
struct Seen {
    Reach across, over;
};

Seen seen_around(std::span<const glm::dvec3> points, const glm::dvec3& middle, const CameraPlace& place, int turns,
                 double slope_x, double slope_y) {
    Seen seen;
    for (int turn = 0; turn < turns; ++turn) {
        const Axes axes = axes_of(place.azimuth + 360.0 * turn / turns, place.elevation, place.twist);
        for (const glm::dvec3& point : points) {
            const glm::dvec3 here = point - middle;
            const double z = glm::dot(here, axes.towards);
            seen.across.add(glm::dot(here, axes.right), z, slope_x);
            seen.over.add(glm::dot(here, axes.up), z, slope_y);
        }
    }
    if (points.empty()) seen.across = seen.over = {1, 1};
    return seen;
}

}  // namespace

CameraView fitted(std::span<const glm::dvec3> points, const CameraPlace& place, bool turns, bool is_parallel,
                  double aspect, const Margins& margins) {
    CameraView view;
    view.is_parallel = is_parallel;
    view.view_angle = place.view_angle.value_or(view.view_angle);
    view.focus = middle_of(points);
    const double wide = std::max(0.1, 1 - margins.left - margins.right);
    const double high = std::max(0.1, 1 - margins.bottom - margins.top);
    const double slope = std::tan(glm::radians(view.view_angle / 2));
    const double slope_x = is_parallel ? 0 : slope * aspect * wide, slope_y = is_parallel ? 0 : slope * high;
    const Axes axes = axes_of(place.azimuth, place.elevation, place.twist);
    Seen seen = seen_around(points, view.focus, place, turns ? turns_tried : 1, slope_x, slope_y);
    if (turns) {
        // What turns does so about its own middle, which only moves up and down: that changes distances too.
        constexpr int rounds = 6;
        const double upright = std::max(0.2, axes.up.y);
        for (int round = 0; round < rounds; ++round) {
            view.focus.y += seen.over.shift() / upright;
            seen = seen_around(points, view.focus, place, turns_tried, slope_x, slope_y);
        }
    } else {
        view.focus += seen.across.shift() * axes.right + seen.over.shift() * axes.up;
    }
    const double half_width = seen.across.half(!turns), half_height = seen.over.half(!turns);
    const double least = 1e-9;
    if (is_parallel) {
        view.half_height = std::max({half_height / high, half_width / wide / aspect, least}) / place.zoom;
        view.distance = 10 * std::max(half_width, half_height) + 10;
    } else {
        view.distance = std::max({half_width / slope_x, half_height / slope_y, least});
        view.half_height = view.distance * slope / place.zoom;
        view.view_angle = 2 * glm::degrees(std::atan(slope / place.zoom));
    }
    view.position = view.focus + view.distance * axes.towards;
    view.up = axes.up;
    view.shift = {margins.left - margins.right, margins.bottom - margins.top};
    return view;
}

}  // namespace espalier::picture

// Solids of revolution and the ellipsoid: sphere, cylinder, cone.
#include "environment/space/shapes/kinds.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::environment {
namespace {

class Sphere final : public Shape {
public:
    Sphere(const glm::dvec3& center, double radius) : center_(center), radius_(radius) {}

    double distance(const glm::dvec3& point) const override { return glm::length(point - center_) - radius_; }

    Sample sample(const glm::dvec3& point) const override {
        const double away = glm::length(point - center_);
        const glm::dvec3 normal = away > 0 ? (point - center_) / away : glm::dvec3{0, 1, 0};
        return {away - radius_, normal, center_ + radius_ * normal};
    }

    std::optional<Box> bounds() const override { return Box{center_ - radius_, center_ + radius_}; }

private:
    glm::dvec3 center_;
    double radius_;
};

/// A cone cut off at both ends, of which the cylinder is a special case: the trapezium (0, 0), (base_radius, 0),
/// (tip_radius, length), (0, length) in the half plane of radius and height, turned about its axis.
class Frustum final : public Shape {
public:
    Frustum(const glm::dvec3& base, const glm::dvec3& tip, double base_radius, double tip_radius)
        : base_(base),
          axis_(glm::normalize(tip - base)),
          length_(glm::length(tip - base)),
          base_radius_(base_radius),
          tip_radius_(tip_radius) {}

    double distance(const glm::dvec3& point) const override {
        const glm::dvec2 at = in_half_plane(point).at;
        const double away = glm::length(at - nearest_on_profile(at).foot);
        return within(at) ? -away : away;
    }

    Sample sample(const glm::dvec3& point) const override {
        const auto [at, outward] = in_half_plane(point);
        const auto [foot, normal] = nearest_on_profile(at);
        const auto to_space = [&, outward = outward](const glm::dvec2& v) { return v.x * outward + v.y * axis_; };
        return sample_of(point, base_ + to_space(foot), within(at), to_space(normal));
    }

    std::optional<Box> bounds() const override {
        Box box;
        // A disc at right angles to `axis` reaches r sqrt(1 - axis_i^2) along axis i.
        const glm::dvec3 reach = glm::sqrt(glm::max(1.0 - axis_ * axis_, glm::dvec3(0)));
        for (const auto& [height, radius] : {std::pair{0.0, base_radius_}, std::pair{length_, tip_radius_}}) {
            box.add(base_ + height * axis_ - radius * reach);
            box.add(base_ + height * axis_ + radius * reach);
        }
        return box;
    }

private:
    struct InHalfPlane {
        glm::dvec2 at;  ///< distance from the axis, height along it
        glm::dvec3 outward;
    };
    struct OnProfile {
        glm::dvec2 foot, normal;
    };

    InHalfPlane in_half_plane(const glm::dvec3& point) const {
        const double height = glm::dot(point - base_, axis_);
        const glm::dvec3 across = point - base_ - height * axis_;
        const double radius = glm::length(across);
        return {{radius, height}, radius > 0 ? across / radius : perpendicular(axis_)};
    }

    bool within(const glm::dvec2& at) const {
        const double radius = base_radius_ + (tip_radius_ - base_radius_) * (at.y / length_);
        return at.y >= 0 && at.y <= length_ && at.x <= radius;
    }

    OnProfile nearest_on_profile(const glm::dvec2& at) const {
        const glm::dvec2 side{tip_radius_ - base_radius_, length_};
        const double t = std::clamp(glm::dot(at - glm::dvec2(base_radius_, 0), side) / glm::dot(side, side), 0.0, 1.0);
        const OnProfile candidates[] = {
            {glm::dvec2(base_radius_, 0) + t * side, glm::normalize(glm::dvec2(side.y, -side.x))},
            {{std::min(at.x, base_radius_), 0}, {0, -1}},
            {{std::min(at.x, tip_radius_), length_}, {0, 1}},
        };
        return *std::min_element(std::begin(candidates), std::end(candidates),
                                 [&](const OnProfile& a, const OnProfile& b) {
                                     return glm::dot(at - a.foot, at - a.foot) < glm::dot(at - b.foot, at - b.foot);
                                 });
    }

    glm::dvec3 base_, axis_;
    double length_, base_radius_, tip_radius_;
};

/// The root u of sum over i of (c_i z_i / (u + c_i - 1))^2 = 1, where c >= 1 and the last c is 1: the Lagrange
/// multiplier of the nearest point on an ellipse or ellipsoid (Eberly 2013), with u = s + 1 to keep all digits of
/// points near the longest axes. The sum is convex and falling, so Newton steps from the left never pass the root.
template <std::size_t N>
double nearest_point_multiplier(const std::array<double, N>& c, const std::array<double, N>& z) {
    double u = z[N - 1];
    for (int i = 0; i < 2000; ++i) {  // far points on near-flat ellipsoids: each step at least doubles u
        double sum = -1, slope = 0;
        for (std::size_t k = 0; k < N; ++k) {
            const double denominator = u + (c[k] - 1);
            const double term = c[k] * z[k] / denominator;
            sum += term * term;
            slope -= 2 * term * term / denominator;
        }
        const double next = u - sum / slope;
        if (!(next > u)) break;
        u = next;
    }
    return u;
}

/// The nearest point of an ellipse with half axes a[0] >= a[1], y >= 0 (Eberly 2013).
glm::dvec2 nearest_on_ellipse(const glm::dvec2& a, const glm::dvec2& y) {
    if (y[1] > 0) {
        const double c = (a[0] / a[1]) * (a[0] / a[1]);
        const double u = nearest_point_multiplier<2>({c, 1}, {y[0] / a[0], y[1] / a[1]});
        return {c * y[0] / (u + (c - 1)), y[1] / u};
    }
    const double numerator = a[0] * y[0], denominator = a[0] * a[0] - a[1] * a[1];
    if (numerator < denominator) {
        const double x = numerator / denominator;
        return {a[0] * x, a[1] * std::sqrt(1 - x * x)};
    }
    return {a[0], 0};
}

/// The nearest point of an ellipsoid with half axes a[0] >= a[1] >= a[2], y >= 0 (Eberly 2013).
glm::dvec3 nearest_on_ellipsoid(const glm::dvec3& a, const glm::dvec3& y) {
    if (y[2] > 0) {
        const glm::dvec3 c = (a / a[2]) * (a / a[2]), z = y / a;
        const double u = nearest_point_multiplier<3>({c[0], c[1], 1}, {z[0], z[1], z[2]});
        return {c[0] * y[0] / (u + (c[0] - 1)), c[1] * y[1] / (u + (c[1] - 1)), y[2] / u};
    }
    // In the plane of the two longer axes, near the middle, the nearest point lies above the plane.
    const glm::dvec2 numerator{a[0] * y[0], a[1] * y[1]};
    const glm::dvec2 denominator{a[0] * a[0] - a[2] * a[2], a[1] * a[1] - a[2] * a[2]};
    if (numerator[0] < denominator[0] && numerator[1] < denominator[1]) {
        const glm::dvec2 x = numerator / denominator;
        const double height = 1 - glm::dot(x, x);
        if (height > 0) return {a[0] * x[0], a[1] * x[1], a[2] * std::sqrt(height)};
    }
    const glm::dvec2 flat = nearest_on_ellipse({a[0], a[1]}, {y[0], y[1]});
    return {flat[0], flat[1], 0};
}

class Ellipsoid final : public Shape {
public:
    Ellipsoid(const glm::dvec3& center, const glm::dvec3& radii) : center_(center), radii_(radii) {
        std::sort(order_.begin(), order_.end(), [&](int a, int b) { return radii_[a] > radii_[b]; });
    }

    double distance(const glm::dvec3& point) const override { return sample(point).distance; }

    bool inside(const glm::dvec3& point) const override {
        const glm::dvec3 scaled = (point - center_) / radii_;
        return glm::dot(scaled, scaled) <= 1;
    }

    Sample sample(const glm::dvec3& point) const override {
        const glm::dvec3 relative = point - center_;
        glm::dvec3 axes, first_octant, nearest;
        for (int i = 0; i < 3; ++i) {
            axes[i] = radii_[order_[i]];
            first_octant[i] = std::abs(relative[order_[i]]);
        }
        const glm::dvec3 found = nearest_on_ellipsoid(axes, first_octant);
        for (int i = 0; i < 3; ++i) nearest[order_[i]] = std::copysign(found[i], relative[order_[i]]);
        const glm::dvec3 normal = glm::normalize(nearest / (radii_ * radii_));
        return sample_of(point, center_ + nearest, inside(point), normal);
    }

    std::optional<Box> bounds() const override { return Box{center_ - radii_, center_ + radii_}; }

private:
    glm::dvec3 center_, radii_;
    std::array<int, 3> order_{0, 1, 2};  ///< axes from the longest to the shortest
};

}  // namespace

ShapePointer read_sphere(Settings& table) {
    const glm::dvec3 center = table.vector("center");
    return std::make_shared<Sphere>(center, table.number("radius", Range::positive()));
}

ShapePointer read_ellipsoid(Settings& table) {
    const glm::dvec3 center = table.vector("center");
    const glm::dvec3 radii = table.vector("radii");
    for (int i = 0; i < 3; ++i) {
        if (!(radii[i] > 0)) throw UserError(table.place("radii"), "'radii' must all be greater than 0");
    }
    return std::make_shared<Ellipsoid>(center, radii);
}

ShapePointer read_cylinder(Settings& table) {
    const glm::dvec3 base = table.vector("base"), tip = table.vector("tip");
    require_apart(table, "tip", base, tip);
    const double radius = table.number("radius", Range::positive());
    return std::make_shared<Frustum>(base, tip, radius, radius);
}

ShapePointer read_cone(Settings& table) {
    const glm::dvec3 base = table.vector("base"), tip = table.vector("tip");
    require_apart(table, "tip", base, tip);
    const double base_radius = table.number("base_radius", Range::positive());
    return std::make_shared<Frustum>(base, tip, base_radius, table.number_or("tip_radius", 0, Range::not_negative()));
}

}  // namespace espalier::environment

#include "geometry/cylinder_curve.h"

#include "espalier/base/math.h"

#include "base/cubic_basis.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::geometry {
namespace {

using Weights = std::array<double, 4>;

template <class T>
T combined(const T (&values)[4], const Weights& weights) {
    return values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2] + values[3] * weights[3];
}

}  // namespace

CylinderCurve::CylinderCurve(const GeneralizedCylinder& cylinder)
    : cylinder_(cylinder),
      closed_(cylinder.closed()),
      spline_(cylinder.curve == GeneralizedCylinder::Curve::open_spline ||
              cylinder.curve == GeneralizedCylinder::Curve::closed_spline) {
    for (std::size_t i = 0; i < stretches(); ++i) spline_ ? add_spline(i) : add_hermite(i);
}

double CylinderCurve::distance(std::size_t stretch) const {
    return glm::distance(cylinder_.points[stretch].pose.position, cylinder_.points[next(stretch)].pose.position);
}

void CylinderCurve::add_hermite(std::size_t i) {
    const CylinderPoint &a = cylinder_.points[i], &b = cylinder_.points[next(i)];
    const double length = distance(i);
    stretches_.push_back({{a.pose.position, a.pose.heading * (a.tangent_after * length), b.pose.position,
                           b.pose.heading * (b.tangent_before * length)},
                          {a.width, width_slope(i, i), b.width, width_slope(next(i), i)}});
}

/// In an open spline, points beyond the ends are the inner ones mirrored: it begins and ends at its end points.
void CylinderCurve::add_spline(std::size_t i) {
    const std::size_t size = cylinder_.points.size();
    Stretch stretch{};
    for (std::size_t k = 0; k < 4; ++k) {
        if (closed_) {
            const CylinderPoint& point = cylinder_.points[(i + k + size - 1) % size];
            stretch.points[k] = point.pose.position;
            stretch.widths[k] = point.width;
        } else if (i + k >= 1 && i + k <= size) {
            stretch.points[k] = cylinder_.points[i + k - 1].pose.position;
            stretch.widths[k] = cylinder_.points[i + k - 1].width;
        } else {
            const CylinderPoint& end = cylinder_.points[i + k == 0 ? 0 : size - 1];
            const CylinderPoint& inner = cylinder_.points[i + k == 0 ? 1 : size - 2];
            stretch.points[k] = 2.0 * end.pose.position - inner.pose.position;
            stretch.widths[k] = std::max(2 * end.width - inner.width, 0.0);
        }
    }
    stretches_.push_back(stretch);
}

/// dw/du of a stretch at one of its ends. Without tangents of its own a point has the slope that keeps the width
/// between its neighbours' (Fritsch & Carlson 1980), 0 at an extremum.
double CylinderCurve::width_slope(std::size_t point, std::size_t stretch) const {
    const bool at_start = point == stretch;
    const CylinderPoint& here = cylinder_.points[point];
    if (here.radius) {
        const RadiusTangents& radius = *here.radius;
        const double angle = at_start ? radius.angle_after : radius.angle_before;
        const double length = at_start ? radius.length_after : radius.length_before;
        return 2 * math::sin(angle) * length * (radius.scaled ? distance(stretch) : 1);
    }
    const std::size_t size = cylinder_.points.size();
    const auto secant = [&](std::size_t i) {
        const double length = distance(i);
        return length > 0 ? (cylinder_.points[next(i)].width - cylinder_.points[i].width) / length : 0;
    };
    const bool first = !closed_ && point == 0, last = !closed_ && point + 1 == size;
    const double before = first ? secant(0) : secant((point + size - 1) % size);
    const double after = last ? before : secant(point);
    if (before * after <= 0) return 0;
    return 2 * before * after / (before + after) * distance(stretch);
}

CylinderCurve::Place CylinderCurve::at(std::size_t i, double u) const {
    const Stretch& stretch = stretches_[i];
    const double v = 1 - u;
    const Weights hermite{v * v * (1 + 2 * u), u * v * v, u * u * (3 - 2 * u), -u * u * v};
    const Weights hermite_slopes{-6 * u * v, v * (1 - 3 * u), 6 * u * v, u * (3 * u - 2)};
    const Weights spline = b_spline_weights(u), spline_slopes = b_spline_slopes(u);

    Place place;
    place.position = combined(stretch.points, spline_ ? spline : hermite);
    place.width = std::max(combined(stretch.widths, spline_ ? spline : hermite), 0.0);
    const glm::dvec3 slope = combined(stretch.points, spline_ ? spline_slopes : hermite_slopes);
    const double length = glm::length(slope);
    const CylinderPoint &a = cylinder_.points[i], &b = cylinder_.points[next(i)];
    if (length > 1e-9 * (distance(i) + 1e-300)) {
        place.tangent = slope / length;
    } else {
        // The points coincide, or the tangents cancel: go by the turtle's headings.
        const glm::dvec3 mean = v * a.pose.heading + u * b.pose.heading;
        place.tangent = glm::length(mean) > 1e-9 ? glm::normalize(mean) : b.pose.heading;
    }
    return place;
}

}  // namespace espalier::geometry

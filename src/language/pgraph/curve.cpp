#include "language/pgraph/curve.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace espalier::language::pgraph {

CurveThrough::CurveThrough(std::vector<glm::dvec3> points) : points_(std::move(points)), lengths_{0} {
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) lengths_.push_back(lengths_.back() + length_to(k, 1));
}

// Per unit of distance between the points.
glm::dvec3 CurveThrough::tangent(std::size_t k) const {
    const auto slope = [&](std::size_t i) {
        return (points_[i + 1] - points_[i]) / glm::distance(points_[i], points_[i + 1]);
    };
    const std::size_t last = points_.size() - 1;
    if (last == 1) return slope(0);
    if (k == 0) return 1.5 * slope(0) - 0.5 * tangent(1);
    if (k == last) return 1.5 * slope(last - 1) - 0.5 * tangent(last - 1);
    const double before = glm::distance(points_[k - 1], points_[k]), after = glm::distance(points_[k], points_[k + 1]);
    return (slope(k - 1) * after + slope(k) * before) / (before + after);
}

glm::dvec3 CurveThrough::point(std::size_t segment, double t) const {
    const double span = glm::distance(points_[segment], points_[segment + 1]);
    const glm::dvec3 a = tangent(segment) * span, b = tangent(segment + 1) * span;
    const glm::dvec3 rise = points_[segment + 1] - points_[segment];
    return points_[segment] + t * (a + t * (3.0 * rise - 2.0 * a - b + t * (a + b - 2.0 * rise)));
}

double CurveThrough::speed(std::size_t segment, double t) const {
    const double span = glm::distance(points_[segment], points_[segment + 1]);
    const glm::dvec3 a = tangent(segment) * span, b = tangent(segment + 1) * span;
    const glm::dvec3 rise = points_[segment + 1] - points_[segment];
    return glm::length(a + t * (2.0 * (3.0 * rise - 2.0 * a - b) + 3.0 * t * (a + b - 2.0 * rise)));
}

// By Gauss's rule with five points on each of some parts.
double CurveThrough::length_to(std::size_t segment, double t) const {
    constexpr int parts = 32;
    constexpr std::array<std::pair<double, double>, 5> rule{{{0, 128. / 225},
                                                             {-0.538469310105683, 0.478628670499366},
                                                             {0.538469310105683, 0.478628670499366},
                                                             {-0.906179845938664, 0.236926885056189},
                                                             {0.906179845938664, 0.236926885056189}}};
    double sum = 0;
    for (int part = 0; part < parts; ++part) {
        for (const auto& [place, weight] : rule) sum += weight * speed(segment, t * (part + 0.5 + place / 2) / parts);
    }
    return sum * t / (2 * parts);
}

glm::dvec3 CurveThrough::at(double distance) const {
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, distance);
    const auto segment = static_cast<std::size_t>(next - lengths_.begin() - 1);
    const double wanted = distance - lengths_[segment];
    double low = 0, high = 1;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = (low + high) / 2;
        (length_to(segment, middle) < wanted ? low : high) = middle;
    }
    return point(segment, (low + high) / 2);
}

}  // namespace espalier::language::pgraph

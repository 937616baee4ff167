#include "espalier/base/error.h"
#include "espalier/lsystem/resources.h"

#include "base/cubic_basis.h"
#include "lsystem/model/clamped_spline.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::lsystem {
namespace {

constexpr double epsilon = 0.000001;  // keeps the last parameter within the last segment, as cpfg does

using Four = std::array<glm::dvec3, 4>;

Four four(const std::vector<glm::dvec3>& points, std::size_t first) {
    Four q;
    std::copy_n(points.begin() + std::ptrdiff_t(first), 4, q.begin());
    return q;
}

glm::dvec3 uniform(const Four& q, double u) {
    const auto [a, b, c, d] = b_spline_sixths(u);
    return (a * q[0] + b * q[1] + c * q[2] + d * q[3]) / 6.0;
}

glm::dvec3 bezier(const Four& q, double u) {
    const double v = 1 - u;
    return v * v * v * q[0] + 3 * u * v * v * q[1] + 3 * u * u * v * q[2] + u * u * u * q[3];
}

void extend(std::vector<glm::dvec3>& points, SpaceCurve::Type type) {
    if (type == SpaceCurve::Type::closed) {
        for (std::size_t k = 0; k < 3; ++k) points.push_back(glm::dvec3(points[k]));
    } else if (type == SpaceCurve::Type::phantom) {
        const std::size_t last = points.size() - 1;
        const glm::dvec3 before = 2.0 * points[0] - points[1], behind = 2.0 * points[last] - points[last - 1];
        points.insert(points.begin(), before);
        points.push_back(behind);
    }
}

}  // namespace

SpaceCurve::SpaceCurve(std::vector<glm::dvec3> points, Type type, int samples)
    : points_(std::move(points)), type_(type) {
    if (points_.size() < least_control_points) {
        throw UserError(fmt::format("a curve needs at least {} points, not {}", least_control_points, points_.size()));
    }
    extend(points_, type_);
    samples = std::max(samples, 2);
    lengths_.push_back(0);
    glm::dvec3 previous = at_parameter(0);
    for (int j = 1; j < samples; ++j) {
        const glm::dvec3 point = at_parameter(double(j) / (samples - 1));
        length_ += glm::distance(previous, point);
        lengths_.push_back(length_);
        previous = point;
    }
    for (double& length : lengths_) length = length_ > 0 ? length / length_ : 0;
}

glm::dvec3 SpaceCurve::operator()(double t) const {
    t = t > 0 ? std::min(t, 1.0) : 0;  // no number counts as 0
    const auto after = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, t);
    const auto j = std::size_t(after - lengths_.begin()) - 1;
    const double chord = lengths_[j + 1] - lengths_[j];
    const double share = chord > 0 ? (t - lengths_[j]) / chord : 0;
    return at_parameter((double(j) + share) / double(lengths_.size() - 1));
}

glm::dvec3 SpaceCurve::at_parameter(double t) const {
    const int count = int(points_.size());
    if (type_ == Type::bezier) {
        const int pieces = 1 + (count - 4) / 3;
        const int piece = std::min(int(t * pieces / (1 + epsilon)), pieces - 1);
        const double local = (t - double(piece) / pieces) * pieces / (1 + epsilon);
        return bezier(four(points_, std::size_t(3 * piece)), local);
    }
    const int segments = count - 3;
    const double u = t * (segments - epsilon);
    const int segment = std::clamp(int(u), 0, segments - 1);
    const Four q = four(points_, std::size_t(segment));
    return type_ == Type::end_point ? clamped_spline(q, segment, segments, u) : uniform(q, u - segment);
}

}  // namespace espalier::lsystem

#include "espalier/base/error.h"
#include "espalier/lsystem/resources.h"

#include "lsystem/model/clamped_spline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::lsystem {
namespace {

constexpr double near_enough = 0.001;  // as cpfg stops; further halving would give other values than its
constexpr int most_halvings = 60;

}  // namespace

FunctionCurve::FunctionCurve(std::vector<glm::dvec2> points, int samples) : points_(std::move(points)) {
    if (points_.size() < least_control_points) {
        throw UserError(
            fmt::format("a function needs at least {} points, not {}", least_control_points, points_.size()));
    }
    if (samples <= 2) return;
    samples_.reserve(std::size_t(samples));
    for (int j = 0; j < samples; ++j) samples_.push_back(exact(double(j) / (samples - 1)));
}

double FunctionCurve::operator()(double x) const {
    if (points_.empty()) return 0;
    x = x > 0 ? std::min(x, 1.0) : 0;  // no number counts as 0
    if (samples_.empty()) return exact(x);
    const double place = x * double(samples_.size() - 1);
    const std::size_t j = std::min(std::size_t(place), samples_.size() - 2);
    return samples_[j] + (place - double(j)) * (samples_[j + 1] - samples_[j]);
}

glm::dvec2 FunctionCurve::at_parameter(double d) const {
    const int segments = int(points_.size()) - 3;
    const double u = d * segments;
    const int segment = std::min(int(u), segments - 1);
    std::array<glm::dvec2, 4> points;
    std::copy_n(points_.begin() + segment, 4, points.begin());
    return clamped_spline(points, segment, segments, u);
}

double FunctionCurve::exact(double x) const {
    double left = 0, right = 1;
    glm::dvec2 point;
    for (int halving = 0; halving < most_halvings; ++halving) {
        const double middle = (left + right) / 2;
        point = at_parameter(middle);
        if (std::abs(point.x - x) <= near_enough) break;
        (point.x > x ? right : left) = middle;
    }
    return point.y;
}

}  // namespace espalier::lsystem

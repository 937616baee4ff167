#include "environment/light/canopy/leaf_angles.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

using std::numbers::pi;

/// Share of leaf area per inclination, from 0 to pi / 2.
double density(const std::string& name, double inclination) {
    if (name == "spherical") return math::sin(inclination);
    if (name == "planophile") return 2 / pi * (1 + math::cos(2 * inclination));
    if (name == "erectophile") return 2 / pi * (1 - math::cos(2 * inclination));
    if (name == "plagiophile") return 2 / pi * (1 - math::cos(4 * inclination));
    if (name == "extremophile") return 2 / pi * (1 + math::cos(4 * inclination));
    return 2 / pi;
}

/// How much of unit area of that inclination, evenly turned about the vertical, a direction sees from above: the mean
/// of the positive cosines between it and the upper normals (Warren Wilson 1960). The cosine is negative from below.
double seen_from_above(double cosine_of_inclination, double cosine) {
    const double sines = std::sqrt((1 - cosine_of_inclination * cosine_of_inclination) * (1 - cosine * cosine));
    const double cosines = cosine_of_inclination * cosine;
    if (std::abs(cosines) >= sines) return std::max(cosines, 0.0);
    const double turn = math::acos(-cosines / sines);
    return (cosines * turn + std::sqrt(sines * sines - cosines * cosines)) / pi;
}

/// Half of a spheroid's surface over its shadow from above (Campbell 1986).
double surface_of_spheroid(double ratio) {
    if (ratio == 1) return 2;
    if (ratio < 1) {
        const double e = std::sqrt(1 - ratio * ratio);
        return ratio + math::asin(e) / e;
    }
    const double e = std::sqrt(1 - 1 / (ratio * ratio));
    return ratio + math::log((1 + e) / (1 - e)) / (2 * e * ratio);
}

}  // namespace

LeafAngles::LeafAngles(const std::string& name) : name_(name) {}

LeafAngles::LeafAngles(double ratio) : ratio_(ratio) {}

const std::vector<std::string>& LeafAngles::names() {
    static const std::vector<std::string> names{"spherical",    "planophile", "erectophile", "plagiophile",
                                                "extremophile", "uniform",    "horizontal",  "vertical"};
    return names;
}

double LeafAngles::density(double inclination) const {
    if (!name_.empty()) return environment::density(name_, inclination);
    const double sine = math::sin(inclination), cosine = math::cos(inclination);
    const double square = cosine * cosine + ratio_ * ratio_ * sine * sine;
    return 2 * ratio_ * ratio_ * ratio_ * sine / (surface_of_spheroid(ratio_) * square * square);
}

double LeafAngles::seen_from_above(double cosine) const {
    cosine = std::clamp(cosine, -1.0, 1.0);
    if (name_ == "horizontal") return std::max(cosine, 0.0);
    if (name_ == "vertical") return environment::seen_from_above(0, cosine);
    constexpr int parts = 1000;
    double sum = 0, all = 0;
    for (int i = 0; i < parts; ++i) {
        const double inclination = pi / 2 * (i + 0.5) / parts, share = density(inclination);
        sum += share * environment::seen_from_above(math::cos(inclination), cosine);
        all += share;
    }
    return sum / all;
}

double LeafAngles::projection(double cosine) const {
    cosine = std::clamp(cosine, 0.0, 1.0);
    if (name_ == "spherical") return 0.5;
    if (!name_.empty()) return seen_from_above(cosine) + seen_from_above(-cosine);
    return std::sqrt(ratio_ * ratio_ * cosine * cosine + 1 - cosine * cosine) / surface_of_spheroid(ratio_);
}

}  // namespace espalier::environment

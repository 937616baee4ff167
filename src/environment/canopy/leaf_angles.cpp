#include "environment/canopy/leaf_angles.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

constexpr double pi = std::numbers::pi;

/// Share of leaf area per inclination, from 0 to pi / 2.
double density(const std::string& name, double inclination) {
    if (name == "spherical") return math::sin(inclination);
    if (name == "planophile") return 2 / pi * (1 + math::cos(2 * inclination));
    if (name == "erectophile") return 2 / pi * (1 - math::cos(2 * inclination));
    if (name == "plagiophile") return 2 / pi * (1 - math::cos(4 * inclination));
    if (name == "extremophile") return 2 / pi * (1 + math::cos(4 * inclination));
    return 2 / pi;
}

/// Area that unit area of that inclination, evenly turned, hides from a direction (Warren Wilson 1960).
double hidden(double cosine_of_inclination, double cosine) {
    const double sines = std::sqrt((1 - cosine_of_inclination * cosine_of_inclination) * (1 - cosine * cosine));
    const double cosines = cosine_of_inclination * cosine;
    if (cosines >= sines) return cosines;
    const double turn = math::acos(cosines / sines);
    return cosines * (1 - 2 * turn / pi) + 2 / pi * std::sqrt(sines * sines - cosines * cosines);
}

/// Campbell's: the shadow of a spheroid over half its surface.
double of_spheroid(double ratio, double cosine) {
    double surface = 2;
    if (ratio < 1) {
        const double e = std::sqrt(1 - ratio * ratio);
        surface = ratio + math::asin(e) / e;
    } else if (ratio > 1) {
        const double e = std::sqrt(1 - 1 / (ratio * ratio));
        surface = ratio + math::log((1 + e) / (1 - e)) / (2 * e * ratio);
    }
    return std::sqrt(ratio * ratio * cosine * cosine + 1 - cosine * cosine) / surface;
}

}  // namespace

LeafAngles::LeafAngles(const std::string& name) : name_(name) {}

LeafAngles::LeafAngles(double ratio) : ratio_(ratio) {}

const std::vector<std::string>& LeafAngles::names() {
    static const std::vector<std::string> names{"spherical",    "planophile", "erectophile", "plagiophile",
                                                "extremophile", "uniform",    "horizontal",  "vertical"};
    return names;
}

double LeafAngles::projection(double cosine) const {
    cosine = std::clamp(cosine, 0.0, 1.0);
    if (name_.empty()) return of_spheroid(ratio_, cosine);
    if (name_ == "spherical") return 0.5;
    if (name_ == "horizontal") return cosine;
    if (name_ == "vertical") return hidden(0, cosine);
    constexpr int parts = 1000;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
        const double inclination = pi / 2 * (i + 0.5) / parts;
        sum += density(name_, inclination) * hidden(math::cos(inclination), cosine);
    }
    return sum * pi / 2 / parts;
}

}  // namespace espalier::environment

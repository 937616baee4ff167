#include "geometry/sky/radiance.h"

#include "espalier/base/math.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace espalier::geometry {
namespace {

using std::numbers::pi;

/// ISO 15469:2004, table 1: a, b of the gradation and c, d, e of the indicatrix.
constexpr std::array<std::array<double, 5>, 15> cie_skies{{{4.0, -0.70, 0, -1.0, 0},
                                                           {4.0, -0.70, 2, -1.5, 0.15},
                                                           {1.1, -0.80, 0, -1.0, 0},
                                                           {1.1, -0.80, 2, -1.5, 0.15},
                                                           {0.0, -1.00, 0, -1.0, 0},
                                                           {0.0, -1.00, 2, -1.5, 0.15},
                                                           {0.0, -1.00, 5, -2.5, 0.30},
                                                           {0.0, -1.00, 10, -3.0, 0.45},
                                                           {-1.0, -0.55, 2, -1.5, 0.15},
                                                           {-1.0, -0.55, 5, -2.5, 0.30},
                                                           {-1.0, -0.55, 10, -3.0, 0.45},
                                                           {-1.0, -0.32, 10, -3.0, 0.45},
                                                           {-1.0, -0.32, 16, -3.0, 0.30},
                                                           {-1.0, -0.15, 16, -3.0, 0.30},
                                                           {-1.0, -0.15, 24, -2.8, 0.15}}};

/// Of a radiance 1 + g y from below the height y: its light on level ground, and across its directions.
double light_on_ground(double y, double g) {
    return y * y * (0.5 + g * y / 3);
}
double light_across(double y, double g) {
    return y * (1 + 0.5 * g * y);
}

/// The height from below which so much light falls on level ground; by Newton's method.
double height_on_ground(double light, double g) {
    double y = std::sqrt(std::max(0.0, 2 * light / (1 + g * 2 / 3)));
    for (int turn = 0; turn < 6 && g != 0 && y > 0; ++turn) y -= (light_on_ground(y, g) - light) / (y * (1 + g * y));
    return y;
}

/// Legendre's polynomial of that degree and its derivative.
std::pair<double, double> legendre(std::int64_t degree, double x) {
    double before = 1, value = x;
    for (std::int64_t k = 2; k <= degree; ++k) {
        const double next =
            (static_cast<double>(2 * k - 1) * x * value - static_cast<double>(k - 1) * before) / static_cast<double>(k);
        before = value;
        value = next;
    }
    return {value, static_cast<double>(degree) * (x * value - before) / (x * x - 1)};
}

}  // namespace

// By Newton's method.
std::vector<GaussPoint> gauss_points(std::int64_t count) {
    std::vector<GaussPoint> points;
    for (std::int64_t i = 0; i < count; ++i) {
        double x = math::cos(pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(count) + 0.5));
        for (int turn = 0; turn < 20; ++turn) {
            const auto [value, slope] = legendre(count, x);
            x -= value / slope;
        }
        const double slope = legendre(count, x).second;
        points.push_back({(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)});
    }
    return points;
}

SkyRadiance SkyRadiance::uniform() {
    return {};
}

SkyRadiance SkyRadiance::overcast() {
    SkyRadiance sky;
    sky.kind_ = Kind::overcast;
    return sky;
}

SkyRadiance SkyRadiance::cie(int type, const glm::dvec3& sun) {
    SkyRadiance sky = perez(cie_skies.at(static_cast<std::size_t>(type - 1)), sun);
    sky.indicatrix_.across = math::exp(sky.indicatrix_.d * pi / 2);
    return sky;
}

SkyRadiance SkyRadiance::perez(const std::array<double, 5>& a_to_e, const glm::dvec3& sun) {
    const auto& [a, b, c, d, e] = a_to_e;
    SkyRadiance sky;
    sky.kind_ = Kind::by_sun;
    sky.gradation_ = {a, b};
    sky.indicatrix_ = {c, d, e, 0};
    sky.sun_ = sun;
    return sky;
}

double SkyRadiance::operator()(const glm::dvec3& towards) const {
    if (kind_ == Kind::uniform) return 1;
    if (kind_ == Kind::overcast) return 1 + 2 * towards.y;
    return at(towards.y, math::acos(std::clamp(glm::dot(towards, sun_), -1.0, 1.0)));
}

double SkyRadiance::at(double rise, double from_sun) const {
    const double cosine = math::cos(from_sun);
    const auto& [c, d, e, across] = indicatrix_;
    const double scattered = 1 + c * (math::exp(d * from_sun) - across) + e * cosine * cosine;
    return scattered * (1 + gradation_.a * math::exp(gradation_.b / std::max(rise, 1e-9)));
}

glm::dvec3 sunflower_direction(std::size_t i, double height) {
    const double across = std::sqrt(1 - height * height);
    const auto [sine, cosine] = math::sine_and_cosine(pi * (3 - std::sqrt(5.0)) * static_cast<double>(i));
    return {across * cosine, height, across * sine};
}

double SkyWindow::rise_on_ground(double share) const {
    const double low = light_on_ground(lowest, gradient), high = light_on_ground(highest, gradient);
    return std::clamp(height_on_ground(low + share * (high - low), gradient), lowest, highest);
}

double SkyWindow::rise_across(double share) const {
    const double low = light_across(lowest, gradient), high = light_across(highest, gradient);
    const double light = low + share * (high - low);
    return gradient == 0 ? light : (std::sqrt(1 + 2 * gradient * light) - 1) / gradient;
}

double SkyWindow::mean_rise() const {
    return (light_on_ground(highest, gradient) - light_on_ground(lowest, gradient)) /
           (light_across(highest, gradient) - light_across(lowest, gradient));
}

glm::dvec3 SkyWindow::direction(const glm::dvec3& middle, double rise, double turn) const {
    if (is_point()) return middle;
    const double across =
        std::sqrt(std::max(0.0, 1 - rise * rise)) / std::sqrt(middle.x * middle.x + middle.z * middle.z);
    const auto [sine, cosine] = math::sine_and_cosine((2 * turn - 1) * half_turn);
    return {across * (cosine * middle.x - sine * middle.z), rise, across * (sine * middle.x + cosine * middle.z)};
}

std::vector<SkyPart> sky_parts(std::int64_t rings, std::int64_t around, double gradient) {
    std::vector<SkyPart> parts;
    const std::vector<GaussPoint> points = gauss_points(rings);
    const double step = 2 * pi / static_cast<double>(around);
    const double all = light_on_ground(1, gradient);
    double above = 1, below = 1;  // Gauss's points run downwards; the share of all light that comes from below
    for (std::size_t ring = 0; ring < points.size(); ++ring) {
        const double y = points[ring].at, across = std::sqrt(1 - y * y);
        below -= (1 + gradient * y) * y * points[ring].weight / all;
        const double lowest = ring + 1 < points.size() ? height_on_ground(below * all, gradient) : 0;
        const SkyWindow window{lowest, above, step / 2, gradient};
        above = lowest;
        const double turned = ring % 2 == 0 ? 0.25 : 0.75;  // neighbouring rings do not stand above each other
        for (std::int64_t i = 0; i < around; ++i) {
            const auto [sine, cosine] = math::sine_and_cosine(step * (static_cast<double>(i) + turned));
            parts.push_back({{across * cosine, y, across * sine}, step * points[ring].weight, window});
        }
    }
    return parts;
}

std::vector<double> shares_on_ground(const SkyRadiance& radiance, const std::vector<SkyPart>& parts) {
    std::vector<double> shares;
    double sum = 0;
    for (const SkyPart& part : parts) {
        shares.push_back(radiance(part.towards) * part.towards.y * part.solid_angle);
        sum += shares.back();
    }
    for (double& share : shares) share /= sum;
    return shares;
}

}  // namespace espalier::geometry

#include "picture/light/sky_light.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace espalier::picture {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double disc_radius = 0.2666 * pi / 180;  // of the sun
constexpr double least_elevation = 3 * pi / 180;

// Preetham, Shirley & Smits 1999, A practical analytic model for daylight, appendix A.2: coefficients of Perez'
// function for x, y and Y, each `per_turbidity` times the turbidity and `fixed`.
struct Perez {
    double per_turbidity, fixed;
};
constexpr Perez perez[3][5] = {
    {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}},
    {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}},
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}}};

std::array<SkyRadiance, 3> clear_sky(double turbidity, const glm::vec3& towards_sun) {
    std::array<SkyRadiance, 3> sky;
    for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 5> a_to_e;
        for (std::size_t i = 0; i < 5; ++i) a_to_e[i] = perez[k][i].per_turbidity * turbidity + perez[k][i].fixed;
        sky[k] = SkyRadiance::perez(a_to_e, glm::dvec3(towards_sun));
    }
    return sky;
}

glm::dvec3 values_at(const std::array<SkyRadiance, 3>& sky, double rise, double from_sun) {
    return {sky[0].at(rise, from_sun), sky[1].at(rise, from_sun), sky[2].at(rise, from_sun)};
}

/// x, y and Y (kcd/m2) at the zenith: appendix A.2 again.
glm::dvec3 zenith_at(double turbidity, double sun_angle) {
    constexpr double x[3][4] = {
        {0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}};
    constexpr double y[3][4] = {
        {0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}};
    const double t[] = {turbidity * turbidity, turbidity, 1};
    const double s[] = {std::pow(sun_angle, 3), sun_angle * sun_angle, sun_angle, 1};
    glm::dvec3 zenith(0);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) zenith += t[i] * s[k] * glm::dvec3(x[i][k], y[i][k], 0);
    }
    const double chi = (4.0 / 9 - turbidity / 120) * (pi - 2 * sun_angle);
    zenith.z = (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
    return zenith;
}

/// From CIE x, y and luminance.
glm::vec3 linear_of_xyy(const glm::dvec3& xyy) {
    const double scale = xyy.z / xyy.y;
    const glm::dvec3 xyz(scale * xyy.x, xyy.z, scale * (1 - xyy.x - xyy.y));
    const glm::dmat3 rows(3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434, -0.2040259,
                          1.0572252);
    return glm::max(glm::vec3(xyz * rows), glm::vec3(0));
}

glm::vec3 across(const glm::vec3& direction) {
    const glm::vec3 other = std::abs(direction.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(direction, other));
}

glm::vec3 lifted(const glm::vec3& towards) {
    const double elevation = std::asin(std::clamp(static_cast<double>(towards.y), -1.0, 1.0));
    if (elevation >= least_elevation) return towards;
    glm::dvec3 level(towards.x, 0, towards.z);
    level = glm::length(level) > 0 ? glm::normalize(level) : glm::dvec3(0, 0, 1);
    return glm::vec3(std::cos(least_elevation) * level + glm::dvec3(0, std::sin(least_elevation), 0));
}

}  // namespace

glm::vec3 sun_through_air(double turbidity, double sun_angle) {
    constexpr std::array micrometres{0.61, 0.55, 0.465};
    constexpr double above_air = 128;                       // klx
    const glm::vec3 colour_above_air(1.04F, 0.99F, 0.96F);  // of 5900 K, seen as sRGB's white sees it
    const double degrees = sun_angle * 180 / pi;
    const double mass = 1 / (std::cos(sun_angle) + 0.15 * std::pow(93.885 - degrees, -1.253));
    glm::vec3 left;
    for (std::size_t k = 0; k < 3; ++k) {
        const double rayleigh = 0.008735 * std::pow(micrometres[k], -4.08);
        const double beta = 0.04608365822050 * turbidity - 0.04586025928522;
        const double aerosol = beta * std::pow(micrometres[k], -1.3);
        left[static_cast<int>(k)] = static_cast<float>(std::exp(-(rayleigh + aerosol) * mass));
    }
    return static_cast<float>(above_air) * colour_above_air * left;
}

SkyLight::SkyLight(const PictureSky& sky, const glm::vec3& towards_sun)
    : kind_(sky.kind),
      towards_sun_(lifted(towards_sun)),
      turbidity_(sky.turbidity),
      sun_angle_(std::acos(std::min(1.0, static_cast<double>(towards_sun_.y)))) {
    if (kind_ == PictureSky::Kind::clear) {
        clear_ = clear_sky(turbidity_, towards_sun_);
        scale_ = zenith_at(turbidity_, sun_angle_) / values_at(clear_, 1, sun_angle_);
        sun_ = sun_through_air(turbidity_, sun_angle_);
    }
    measure_sky();
    if (!sky.diffuse) return;
    const auto diffuse = static_cast<float>(std::clamp(*sky.diffuse, 0.01, 1.0));
    const glm::vec3 colour = sun_through_air(turbidity_, sun_angle_);
    const float wanted = (1 - diffuse) / diffuse * sky_on_ground_.y / towards_sun_.y;
    sun_ = colour * (wanted / colour.y);
}

glm::vec3 SkyLight::clear(const glm::vec3& towards) const {
    constexpr double least_rise = 0.1;  // nearer to the horizon the model is purple
    const double from_sun = std::acos(std::clamp(static_cast<double>(glm::dot(towards, towards_sun_)), -1.0, 1.0));
    return linear_of_xyy(scale_ * values_at(clear_, std::max<double>(towards.y, least_rise), from_sun));
}

// The colours of clouds are nearly white.
glm::vec3 SkyLight::sky(const glm::vec3& towards) const {
    if (kind_ == PictureSky::Kind::uniform) return glm::vec3(1);
    if (kind_ == PictureSky::Kind::overcast) {
        const double radiance = SkyRadiance::overcast()(glm::dvec3(0, std::max(towards.y, 0.0F), 0));
        return glm::vec3(0.97F, 1, 1.04F) * static_cast<float>(radiance);
    }
    return clear(towards);
}

glm::vec3 SkyLight::horizon(const glm::vec3& towards) const {
    const glm::vec3 level(towards.x, 0, towards.z);
    return sky(glm::length(level) > 0 ? glm::normalize(level) : glm::vec3(0, 0, 1));
}

glm::vec3 SkyLight::towards_disc(float u, float v) const {
    const auto radius = static_cast<float>(disc_radius) * std::sqrt(u), turn = 2 * static_cast<float>(pi) * v;
    const glm::vec3 right = across(towards_sun_), up = glm::cross(right, towards_sun_);
    return glm::normalize(towards_sun_ + radius * (std::cos(turn) * right + std::sin(turn) * up));
}

bool SkyLight::is_on_disc(const glm::vec3& towards) const {
    return has_sun() && glm::length(glm::cross(towards, towards_sun_)) < disc_radius &&
           glm::dot(towards, towards_sun_) > 0;
}

glm::vec3 SkyLight::disc() const {
    return sun_ / static_cast<float>(pi * disc_radius * disc_radius);
}

// The middles of cells that have equal shares in the light of a uniform sky on level ground.
void SkyLight::measure_sky() {
    constexpr int rings = 64, around = 128;
    glm::dvec3 sum(0);
    for (int ring = 0; ring < rings; ++ring) {
        const double sine = std::sqrt((ring + 0.5) / rings), rise = std::sqrt(1 - sine * sine);
        for (int k = 0; k < around; ++k) {
            const double turn = 2 * pi * (k + 0.5) / around;
            sum += glm::dvec3(sky(glm::vec3(sine * std::cos(turn), rise, sine * std::sin(turn))));
        }
    }
    sky_on_ground_ = glm::vec3(sum * (pi / (rings * around)));
}

}  // namespace espalier::picture

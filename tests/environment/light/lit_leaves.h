// Leaves made by hand for processes of light, and what these say of them.
#pragma once

#include "espalier/base/random.h"

#include "environment/exchange/exchange_plants.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

namespace espalier {

/// Leaves, stems and soil that absorb all that they get.
inline const std::string black = "bands.par = { leaf = [0, 0], stem = 0, soil = 0 }\n";

/// A process of light in a domain of 2 x 3 x 2 m, for two plants.
inline Environment light_process(const std::string& process, const std::string& lines) {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 2;
    return environment_of("[light]\nprocess = \"" + process + "\"\n" + lines, context);
}

inline double statistic(const Environment& environment, const std::string& name, std::uint32_t plant = 0) {
    for (const Quantity& quantity : environment.statistics(plant)) {
        if (quantity.name == "light." + name) return quantity.value;
    }
    throw std::runtime_error("no statistic " + name);
}

/// Parallel light from a zenith angle, over the x axis.
inline std::string sun_at(double zenith) {
    return "sky = { par = 1000, diffuse = 0, sun = [" + std::to_string(std::sin(zenith)) + ", " +
           std::to_string(std::cos(zenith)) + ", 0] }\n";
}

/// A leaf: a square in the plane of two unit vectors, drawn by module `module`; its front faces along x across.
inline void draw_square(PlantGeometry& geometry, std::uint32_t module, const glm::dvec3& middle,
                        const glm::dvec3& along, const glm::dvec3& across, double side, std::uint16_t colour = 0) {
    Polygon polygon{};
    polygon.module = module;
    polygon.colour = colour;
    polygon.first = static_cast<std::uint32_t>(geometry.vertices.size());
    polygon.count = 4;
    for (const auto& [a, b] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        geometry.vertices.push_back(middle + side / 2 * (a * along + b * across));
    }
    geometry.polygons.push_back(polygon);
}

/// Density of the inclination of leaves, from 0 to pi / 2.
using InclinationDensity = std::function<double(double)>;

inline InclinationDensity inclination_density(const std::string& name) {
    const double share = 2 / std::numbers::pi;
    if (name == "spherical") return [](double a) { return std::sin(a); };
    if (name == "planophile") return [=](double a) { return share * (1 + std::cos(2 * a)); };
    if (name == "erectophile") return [=](double a) { return share * (1 - std::cos(2 * a)); };
    if (name == "plagiophile") return [=](double a) { return share * (1 - std::cos(4 * a)); };
    return [=](double) { return share; };
}

/// Squares evenly anywhere in the domain, inclined as a density (at most 2) says, upwards.
inline void draw_at_random(PlantGeometry& geometry, std::uint32_t module, int count, double side, std::uint64_t seed,
                           const std::string& inclination = "spherical", const glm::dvec3& domain = {2, 3, 2}) {
    RandomSamples samples(RandomKey(seed, 0, Stream::process, 1), 5, 0);
    const InclinationDensity density = inclination_density(inclination);
    for (int i = 0; i < count; ++i) {
        double a = 0;
        do {
            a = std::numbers::pi / 2 * samples.uniform();
        } while (2 * samples.uniform() > density(a));
        const double turn = 2 * std::numbers::pi * samples.uniform();
        const glm::dvec3 normal(std::sin(a) * std::cos(turn), std::cos(a), std::sin(a) * std::sin(turn));
        const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.4, 0.86)));
        const glm::dvec3 middle =
            domain * glm::dvec3(samples.uniform(), 0.02 + 0.96 * samples.uniform(), samples.uniform());
        draw_square(geometry, module, middle, along, glm::cross(normal, along), side);
    }
}

/// Mean projection of unit leaf area by plain numbers: inclinations and turns one by one.
inline double plain_projection(const std::string& inclination, double zenith) {
    const InclinationDensity density = inclination_density(inclination);
    double sum = 0, all = 0;
    for (int i = 0; i < 400; ++i) {
        const double a = std::numbers::pi / 2 * (i + 0.5) / 400;
        for (int k = 0; k < 400; ++k) {
            const double turn = 2 * std::numbers::pi * (k + 0.5) / 400;
            sum +=
                density(a) * std::abs(std::cos(a) * std::cos(zenith) + std::sin(a) * std::sin(zenith) * std::cos(turn));
            all += density(a);
        }
    }
    return sum / all;
}

/// What horizontal leaves of the area index L let through and send back in light from above: the two-stream equations
/// dI-/dL = -(1 - t) I- + r I+ and their mirror, over a soil that reflects s, in closed form.
struct TwoStreams {
    double down, up;  ///< of light 1: on the ground, and out at the top

    TwoStreams(double area_index, double r, double t, double s) {
        const double a = 1 - t, k = std::sqrt(a * a - r * r);
        const double fade = std::exp(-k * area_index), grow = std::exp(k * area_index);
        const double to_soil_a = fade * ((a - k) / r - s), to_soil_b = grow * ((a + k) / r - s);
        const double b = to_soil_a / (to_soil_a - to_soil_b);
        down = (1 - b) * fade + b * grow;
        up = ((a - k) * (1 - b) + (a + k) * b) / r;
    }
};

}  // namespace espalier

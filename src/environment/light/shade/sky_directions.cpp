#include "environment/light/shade/sky_directions.h"

#include "espalier/base/math.h"

#include "geometry/sky/radiance.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace espalier::environment {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

std::vector<Triangle> octahedron() {
    std::vector<Triangle> faces;
    for (const double y : {1.0, -1.0}) {
        for (const double x : {1.0, -1.0}) {
            for (const double z : {1.0, -1.0}) {
                faces.push_back({glm::dvec3(x, 0, 0), glm::dvec3(0, y, 0), glm::dvec3(0, 0, z)});
            }
        }
    }
    return faces;
}

std::vector<Triangle> divided(const std::vector<Triangle>& faces) {
    std::vector<Triangle> parts;
    for (const auto& [a, b, c] : faces) {
        const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
        for (const Triangle& part : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
            parts.push_back(part);
        }
    }
    return parts;
}

// Shares 1 / (1 + ratio) among those above the horizon as `weight` says, and the rest evenly among those below.
template <class Weight>
std::vector<SkyDirection> sky(std::int64_t samples, double ratio, const Weight& weight) {
    std::vector<Triangle> faces = octahedron();
    while (static_cast<std::int64_t>(faces.size()) < samples) faces = divided(faces);
    std::vector<SkyDirection> directions;
    double upper = 0;
    for (const auto& [a, b, c] : faces) {
        const glm::dvec3 middle = glm::normalize(a + b + c);
        directions.push_back({middle, middle.y > 0 ? weight(middle) : 0});
        upper += directions.back().weight;
    }
    const double lower = static_cast<double>(faces.size()) / 2;
    for (SkyDirection& direction : directions) {
        const bool above = direction.towards.y > 0;
        direction.weight = (above ? direction.weight / upper : ratio / lower) / (1 + ratio);
    }
    return directions;
}

}  // namespace

std::vector<SkyDirection> uniform_sky(std::int64_t samples, double lower_to_upper) {
    return sky(samples, lower_to_upper, [](const glm::dvec3&) { return 1.0; });
}

std::vector<glm::dvec3> sky_hemisphere(std::int64_t samples) {
    std::vector<glm::dvec3> directions;
    for (std::int64_t i = 0; i < samples; ++i) {
        const double height = (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
        directions.push_back(sunflower_direction(static_cast<std::size_t>(i), height));
    }
    return directions;
}

std::vector<SkyDirection> chiba_overcast_sky(std::int64_t samples, double lower_to_upper) {
    return sky(samples, lower_to_upper, [](const glm::dvec3& towards) {
        const double c = towards.y / math::hypot(towards.x, towards.y);
        return (1 + c) / 3 * (8.6 * c + 0.123) / 0.203;
    });
}

std::vector<SkyDirection> normalised_sky(std::vector<SkyDirection> directions) {
    double sum = 0;
    for (const SkyDirection& direction : directions) sum += direction.weight;
    for (SkyDirection& direction : directions) {
        direction.towards = glm::normalize(direction.towards);
        direction.weight = sum > 0 ? direction.weight / sum : 0;
    }
    return directions;
}

}  // namespace espalier::environment

#include "picture/light/path_tracer.h"

#include "espalier/base/random.h"

#include "base/sobol.h"
#include "picture/light/colour_space.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::picture {
namespace {

constexpr float one_by_pi = std::numbers::inv_pi_v<float>;
constexpr int most_bounces = 16, sure_bounces = 2;
constexpr float haze_radii = 60;  ///< radii of the scene after which haze hides most of the ground

/// A direction about `normal` with a probability in proportion to the cosine. Duff et al. 2017 for the frame.
glm::vec3 cosine_direction(const glm::vec3& normal, float u, float v) {
    const float sign = std::copysign(1.0F, normal.z), a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
    const glm::vec3 right(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 up(b, sign + normal.y * normal.y * a, -normal.y);
    const float radius = std::sqrt(u), turn = 2 * std::numbers::pi_v<float> * v;
    return glm::normalize(radius * std::cos(turn) * right + radius * std::sin(turn) * up +
                          std::sqrt(std::max(0.0F, 1 - u)) * normal);
}

/// Where a path goes on from a surface, and how much of its light is left.
struct Bounce {
    glm::vec3 direction, share;
};

Bounce bounce_of(const LitSurface& surface, float choice, float u, float v) {
    const float back = luminance_of(surface.reflectance), through = luminance_of(surface.transmittance);
    if (!(back + through > 0)) return {surface.normal, glm::vec3(0)};
    const float of_back = back / (back + through);
    const bool turns_back = choice < of_back;
    const float side = turns_back ? 1.0F : -1.0F;
    glm::vec3 direction = cosine_direction(side * surface.normal, u, v);
    // A bent normal may send it to the other side: it is mirrored, so that no light is lost.
    const float height = side * glm::dot(direction, surface.flat);
    if (height < 0) direction -= 2 * height * side * surface.flat;
    return {direction, turns_back ? surface.reflectance / of_back : surface.transmittance / (1 - of_back)};
}

}  // namespace

std::array<float, 4> PathNumbers::next() {
    constexpr float below_one = 0x1.fffffep-1F;
    const auto seed = static_cast<std::uint32_t>(mix(pixel_, set_++));
    std::array<float, 4> numbers;
    const std::array<double, 4> sample = scrambled_sobol(sample_, seed);
    for (std::size_t k = 0; k < 4; ++k) numbers[k] = std::min(static_cast<float>(sample[k]), below_one);
    return numbers;
}

glm::vec3 PathTracer::far_away(const glm::vec3& towards) const {
    if (towards.y >= 0) return light_.sky(towards);
    constexpr float haze = 0.1F;  // sine of the angle below the horizon at which it is gone
    const float clear = glm::smoothstep(0.0F, haze, -towards.y);
    const glm::vec3 ground = light_.on_ground() * far_ground_ * one_by_pi;
    return glm::mix(light_.horizon(towards), ground, clear);
}

std::optional<LitSurface> PathTracer::next_surface(const glm::vec3& origin, const glm::vec3& direction, float from,
                                                   float chance) const {
    constexpr int most_layers = 64;
    for (int layer = 0; layer < most_layers; ++layer) {
        const auto surface = scene_.seen(origin, direction, from);
        if (!surface || chance < surface->opacity) return surface;
        chance = (chance - surface->opacity) / (1 - surface->opacity);
        from = surface->distance + scene_.gap(surface->point);
    }
    return std::nullopt;
}

glm::vec3 PathTracer::sunlight(const LitSurface& surface, float u, float v) const {
    if (!light_.has_sun()) return glm::vec3(0);
    const glm::vec3 towards = light_.towards_disc(u, v);
    const float cosine = glm::dot(surface.normal, towards);
    const glm::vec3& share = cosine > 0 ? surface.reflectance : surface.transmittance;
    const glm::vec3 light = light_.sun() * share * (std::abs(cosine) * one_by_pi);
    if (luminance_of(light) <= 0) return glm::vec3(0);
    return light * scene_.clearness(surface.point, towards);
}

glm::vec3 PathTracer::scattered(const LitSurface& first, PathNumbers& numbers) const {
    glm::vec3 light(0), left(1);
    LitSurface surface = first;
    for (int bounce = 0; bounce < most_bounces; ++bounce) {
        const auto [sun_u, sun_v, choice, survival] = numbers.next();
        const auto [u, v, chance, spare] = numbers.next();
        light += left * (surface.emission * light_.on_ground().y * one_by_pi + sunlight(surface, sun_u, sun_v));
        const Bounce next = bounce_of(surface, choice, u, v);
        left *= next.share;
        const float weight = std::max({left.x, left.y, left.z});
        if (!(weight > 0)) break;
        if (bounce >= sure_bounces) {
            const float kept = std::min(1.0F, weight);
            if (survival >= kept) break;
            left /= kept;
        }
        const auto met = next_surface(surface.point, next.direction, scene_.gap(surface.point), chance);
        if (!met) {
            light += left * far_away(next.direction);
            break;
        }
        surface = *met;
    }
    return light;
}

float PathTracer::presence(const LitSurface& ground) const {
    const LitGround& disc = *scene_.ground();
    const glm::vec2 off((ground.point.x - disc.middle.x) / disc.radius, (ground.point.z - disc.middle.z) / disc.radius);
    const float inside = std::clamp(1 - glm::length(off), 0.0F, 1.0F);
    return inside * inside * (3 - 2 * inside);
}

glm::vec3 PathTracer::through_haze(const LitSurface& ground, const glm::vec3& radiance,
                                   const glm::vec3& direction) const {
    const float depth = ground.distance / (haze_radii * static_cast<float>(scene_.ground()->radius));
    return glm::mix(light_.horizon(direction), radiance, std::exp(-depth * depth));
}

PathTracer::Seen PathTracer::seen(const glm::vec3& origin, const glm::vec3& direction, bool shows_sky,
                                  PathNumbers& numbers) const {
    const float chance = numbers.next()[0];
    const auto surface = next_surface(origin, direction, 0, chance);
    if (!surface && !shows_sky) return {glm::vec3(0), 0};
    if (!surface) return {light_.is_on_disc(direction) ? light_.disc() : far_away(direction), 1};
    if (!surface->is_ground) return {scattered(*surface, numbers), 1};
    if (shows_sky) return {through_haze(*surface, scattered(*surface, numbers), direction), 1};
    const float opacity = presence(*surface);
    return opacity > 0 ? Seen{scattered(*surface, numbers), opacity} : Seen{glm::vec3(0), 0};
}

}  // namespace espalier::picture

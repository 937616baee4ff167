#include "picture/stage/sky_visibility.h"

#include "geometry/sky/radiance.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::picture {
namespace {

constexpr int sky_texels = 384, sun_texels = 1536;
/// Triangles times directions: more triangles are seen from fewer directions.
constexpr std::size_t budget = 30'000'000;
constexpr std::size_t fewest_directions = 12, most_directions = 32;

/// Spread evenly over the upper half of the sphere, from the zenith down.
glm::vec3 sky_direction(std::size_t i, std::size_t count) {
    return glm::vec3(sunflower_direction(i, 1 - (static_cast<double>(i) + 0.5) / static_cast<double>(count)));
}

void fill(DepthMap& map, std::span<const Occluder> occluders) {
    for (const Occluder& occluder : occluders) {
        const auto corner = [&](std::size_t i) {
            return occluder.points[static_cast<std::size_t>(occluder.corners[i])];
        };
        for (std::size_t i = 0; i + 2 < occluder.corners.size(); i += 3)
            map.add(corner(i), corner(i + 1), corner(i + 2));
    }
}

/// The lower and the upper corner of all.
std::array<glm::vec3, 2> corners_of(std::span<const Occluder> occluders) {
    glm::vec3 lower(std::numeric_limits<float>::max()), upper(-std::numeric_limits<float>::max());
    for (const Occluder& occluder : occluders) {
        for (const glm::vec3& point : occluder.points) {
            lower = glm::min(lower, point);
            upper = glm::max(upper, point);
        }
    }
    if (!(lower.x <= upper.x)) lower = upper = glm::vec3(0);
    return {lower, upper};
}

std::size_t directions_for(std::span<const Occluder> occluders) {
    std::size_t triangles = 1;
    for (const Occluder& occluder : occluders) triangles += occluder.corners.size() / 3;
    return std::clamp(budget / triangles, fewest_directions, most_directions);
}

}  // namespace

DepthMap::DepthMap(const glm::vec3& towards, int texels, const glm::vec3& lower, const glm::vec3& upper)
    : towards_(towards), texels_(texels) {
    const glm::vec3 other = std::abs(towards.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    right_ = glm::normalize(glm::cross(other, towards));
    up_ = glm::cross(towards, right_);
    glm::vec2 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                           corner & 4 ? upper.z : lower.z);
        const glm::vec2 seen(glm::dot(at, right_), glm::dot(at, up_));
        low = glm::min(low, seen);
        high = glm::max(high, seen);
    }
    origin_ = low;
    texel_ = std::max({high.x - low.x, high.y - low.y, 1e-12f}) / static_cast<float>(texels);
    depths_.assign(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels),
                   -std::numeric_limits<float>::max());
}

glm::vec3 DepthMap::place(const glm::vec3& point) const {
    return {(glm::dot(point, right_) - origin_.x) / texel_, (glm::dot(point, up_) - origin_.y) / texel_,
            glm::dot(point, towards_)};
}

// Texels whose middle lies inside take part, so that what is thinner than a texel covers its share of them.
void DepthMap::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 p = place(a), q = place(b), r = place(c);
    const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (!(std::abs(area) > 0) || !std::isfinite(area)) return;
    const auto first = [&](float low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5f))); };
    const auto last = [&](float high) { return std::min(texels_ - 1, static_cast<int>(std::floor(high - 0.5f))); };
    const int x0 = first(std::min({p.x, q.x, r.x})), x1 = last(std::max({p.x, q.x, r.x}));
    const int y0 = first(std::min({p.y, q.y, r.y})), y1 = last(std::max({p.y, q.y, r.y}));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const float mx = static_cast<float>(x) + 0.5f, my = static_cast<float>(y) + 0.5f;
            const float of_q = ((mx - p.x) * (r.y - p.y) - (my - p.y) * (r.x - p.x)) / area;
            const float of_r = ((q.x - p.x) * (my - p.y) - (q.y - p.y) * (mx - p.x)) / area;
            if (of_q < 0 || of_r < 0 || of_q + of_r > 1) continue;
            float& depth =
                depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(texels_) + static_cast<std::size_t>(x)];
            depth = std::max(depth, p.z + of_q * (q.z - p.z) + of_r * (r.z - p.z));
        }
    }
}

float DepthMap::open(const glm::vec3& point, int reach) const {
    const glm::vec3 at = place(point);
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    int open = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            const int tx = x + dx, ty = y + dy;
            const bool outside = tx < 0 || ty < 0 || tx >= texels_ || ty >= texels_;
            open += outside || depths_[static_cast<std::size_t>(ty) * static_cast<std::size_t>(texels_) +
                                       static_cast<std::size_t>(tx)] <= at.z;
        }
    }
    return static_cast<float>(open) / static_cast<float>((2 * reach + 1) * (2 * reach + 1));
}

glm::vec3 direction_at(double azimuth, double elevation) {
    const double round = glm::radians(azimuth), above = glm::radians(elevation);
    return glm::vec3(std::cos(above) * std::sin(round), std::sin(above), std::cos(above) * std::cos(round));
}

SkyVisibility::SkyVisibility(const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& sun,
                             std::size_t directions) {
    for (std::size_t i = 0; i < directions; ++i) {
        sky_.emplace_back(sky_direction(i, directions), sky_texels, lower, upper);
    }
    sun_.emplace_back(sun, sun_texels, lower, upper);
}

SkyVisibility::SkyVisibility(const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& sun)
    : SkyVisibility(lower, upper, sun, fewest_directions) {}

SkyVisibility::SkyVisibility(std::span<const Occluder> occluders, const glm::vec3& sun)
    : SkyVisibility(corners_of(occluders)[0], corners_of(occluders)[1], sun, directions_for(occluders)) {
    add(occluders);
}

void SkyVisibility::add(std::span<const Occluder> occluders) {
    tbb::parallel_for(std::size_t{0}, sky_.size() + 1,
                      [&](std::size_t i) { fill(i < sky_.size() ? sky_[i] : sun_[0], occluders); });
}

float SkyVisibility::sky(const glm::vec3& point, const glm::vec3& normal, bool both_sides) const {
    float reached = 0, all = 0;
    for (const DepthMap& map : sky_) {
        const float across = glm::dot(normal, map.towards());
        const float weight = std::max(0.1f, both_sides ? std::abs(across) : across);
        // Away from the surface itself: by what a texel's slope on it may hide.
        const float away = 1.5f * map.texel();
        const glm::vec3 side = both_sides && across < 0 ? -normal : normal;
        all += weight;
        reached += weight * map.open(point + away * (side + map.towards()), 0);
    }
    return reached / all;
}

float SkyVisibility::sun(const glm::vec3& point, int softness) const {
    const DepthMap& map = sun_.front();
    return map.open(point + 3 * map.texel() * map.towards(), softness);
}

}  // namespace espalier::picture

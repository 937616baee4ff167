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

constexpr int sky_texels = 384, sun_texels = 1024;
/// More triangles are seen from fewer directions. Few numbers of them, so that shadows do not flicker in a film.
constexpr std::size_t few_triangles = 20'000, fewest_directions = 12, most_directions = 32;

/// Spread evenly over the upper half of the sphere, from the zenith down.
glm::vec3 sky_direction(std::size_t i, std::size_t count) {
    return glm::vec3(sunflower_direction(i, 1 - (static_cast<double>(i) + 0.5) / static_cast<double>(count)));
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
    return triangles <= few_triangles ? most_directions : fewest_directions;
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
    texels_per_metre_ = 1 / texel_;
    depths_.assign(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels),
                   -std::numeric_limits<float>::max());
}

glm::vec3 DepthMap::place(const glm::vec3& point) const {
    const glm::vec2 across(glm::dot(point, right_), glm::dot(point, up_));
    return {(across - origin_) * texels_per_metre_, glm::dot(point, towards_)};
}

// Triangles share corners: each is placed once.
void DepthMap::add(const Occluder& occluder) {
    std::vector<glm::vec3> placed;
    placed.reserve(occluder.points.size());
    for (const glm::vec3& point : occluder.points) placed.push_back(place(point));
    const auto corner = [&](std::size_t i) { return placed[static_cast<std::size_t>(occluder.corners[i])]; };
    for (std::size_t i = 0; i + 2 < occluder.corners.size(); i += 3) cover(corner(i), corner(i + 1), corner(i + 2));
}

// Texels whose middle lies inside take part, so that what is thinner than a texel covers its share of them.
void DepthMap::cover(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
    const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (!(std::abs(area) > 0) || !std::isfinite(area)) return;
    const auto first = [&](float low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5f))); };
    const auto last = [&](float high) { return std::min(texels_ - 1, static_cast<int>(std::floor(high - 0.5f))); };
    const int x0 = first(std::min({p.x, q.x, r.x})), x1 = last(std::max({p.x, q.x, r.x}));
    const int y0 = first(std::min({p.y, q.y, r.y})), y1 = last(std::max({p.y, q.y, r.y}));
    // Shares of the corners at so many texels across and up from p. Rows are cut to where all are positive: the box of
    // what is long, thin and aslant is mostly empty.
    const glm::vec2 of_q = glm::vec2(r.y - p.y, p.x - r.x) / area, of_r = glm::vec2(p.y - q.y, q.x - p.x) / area;
    const float deeper = of_q.x * (q.z - p.z) + of_r.x * (r.z - p.z);
    for (int y = y0; y <= y1; ++y) {
        const float up = static_cast<float>(y) + 0.5f - p.y;
        float low = static_cast<float>(x0), high = static_cast<float>(x1);
        const auto cut = [&](float slope, float at_p) {
            const float zero = p.x - 0.5f - at_p / slope;
            if (slope > 0) low = std::max(low, zero - 1);  // a texel more, for rounding
            if (slope < 0) high = std::min(high, zero + 1);
        };
        cut(of_q.x, up * of_q.y);
        cut(of_r.x, up * of_r.y);
        cut(-of_q.x - of_r.x, 1 - up * (of_q.y + of_r.y));
        if (!(low <= high)) continue;
        float* const row = depths_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(texels_);
        const auto shares = [&](int x) {
            const float across = static_cast<float>(x) + 0.5f - p.x;
            return glm::vec2(across * of_q.x + up * of_q.y, across * of_r.x + up * of_r.y);
        };
        const auto is_inside = [&](int x) {
            const glm::vec2 share = shares(x);
            return share.x >= 0 && share.y >= 0 && share.x + share.y <= 1;
        };
        int from = static_cast<int>(low), to = static_cast<int>(high);
        while (from <= to && !is_inside(from)) ++from;
        while (from <= to && !is_inside(to)) --to;
        const glm::vec2 share = shares(from);
        const float depth = p.z + share.x * (q.z - p.z) + share.y * (r.z - p.z);
        for (int x = from; x <= to; ++x) row[x] = std::max(row[x], depth + static_cast<float>(x - from) * deeper);
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
    tbb::parallel_for(std::size_t{0}, sky_.size() + 1, [&](std::size_t i) {
        DepthMap& map = i < sky_.size() ? sky_[i] : sun_[0];
        for (const Occluder& occluder : occluders) map.add(occluder);
    });
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

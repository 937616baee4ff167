#include "environment/light/rays/organ_rays.h"

#include "espalier/base/random.h"

#include "base/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double most_rays = 1 << 24;

/// Its lowest ten bits, two zeros before each.
std::uint32_t spread(std::uint32_t x) {
    x &= 0x3FF;
    x = (x | x << 16) & 0x030000FF;
    x = (x | x << 8) & 0x0300F00F;
    x = (x | x << 4) & 0x030C30C3;
    return (x | x << 2) & 0x09249249;
}

}  // namespace

void OrganRays::set(const LitTriangles& triangles, std::size_t slots, const LightSources& sources) {
    triangles_ = &triangles;
    projected_.assign(slots + 1, 0);
    small_.assign(slots + 1, 0);
    has_projected_ = false;
    sort_by_organ();
    sums_.assign(order_.size(), {});
    for_in_parallel(std::size_t{0}, organs_.size(), [&](std::size_t i) { look_at(organs_[i], sources); });
    std::sort(organs_.begin(), organs_.end(),
              [](const Organ& a, const Organ& b) { return std::pair(a.place, a.key) < std::pair(b.place, b.key); });
}

void OrganRays::sort_by_organ() {
    const std::size_t numbers = projected_.size();
    std::vector<std::size_t> starts(numbers + 1, 0);
    const auto number = [&](std::size_t triangle) { return organ_number(triangles_->owner(triangle)); };
    for (std::size_t i = 0; i < triangles_->size(); ++i) ++starts[number(i) + 1];
    for (std::size_t k = 0; k < numbers; ++k) starts[k + 1] += starts[k];
    organs_.clear();
    for (std::size_t k = 0; k < numbers; ++k) {
        if (starts[k + 1] > starts[k]) organs_.push_back({starts[k], starts[k + 1], 0, 0, {}, {}});
    }
    order_.resize(triangles_->size());
    for (std::size_t i = 0; i < triangles_->size(); ++i) order_[starts[number(i)]++] = i;
}

void OrganRays::look_at(Organ& organ, const LightSources& sources) {
    organ.key = key_of(order_[organ.first]);
    organ.place = place_of(order_[organ.first]);
    for (std::size_t k = 0; k < source_kinds; ++k) {
        const auto kind = static_cast<SourceKind>(k);
        if (!sources.can_be_sought(kind)) continue;
        for (std::size_t at = organ.first; at < organ.end; ++at) {
            const LitPatch surface = patch(order_[at]);
            if (surface.area > 0) organ.open[k] += sources.open_light(kind, surface);
            sums_[at].open[k] = organ.open[k];
        }
    }
}

void OrganRays::share_out(double rays, double point) {
    constexpr double enough = 8;  // for each organ, in a trial
    std::vector<SourceKind> kinds;
    for (const SourceKind kind : {SourceKind::sun, SourceKind::sky, SourceKind::lamp}) {
        const auto k = static_cast<std::size_t>(kind);
        if (std::any_of(organs_.begin(), organs_.end(), [k](const Organ& organ) { return organ.open[k] > 0; })) {
            kinds.push_back(kind);
        }
    }
    const double of_kind = rays / static_cast<double>(std::max<std::size_t>(1, kinds.size()));
    has_projected_ = of_kind < enough * static_cast<double>(organs_.size());
    std::fill(projected_.begin(), projected_.end(), has_projected_);
    for (Organ& organ : organs_) organ.rays = {};
    for (const SourceKind kind : kinds) {
        if (kind == SourceKind::lamp || !has_projected_) share_out_to_all(kind, of_kind);
    }
    if (has_projected_) share_out_to_small(of_kind, point);
}

void OrganRays::share_out_to_all(SourceKind kind, double rays) {
    const auto k = static_cast<std::size_t>(kind);
    double open = 0;
    for (const Organ& organ : organs_) open += organ.open[k];
    for (Organ& organ : organs_) {
        if (!(organ.open[k] > 0)) continue;
        const double own = rays * (0.5 / static_cast<double>(organs_.size()) + 0.5 * organ.open[k] / open);
        organ.rays[k] = std::bit_floor(static_cast<std::uint32_t>(std::clamp(own, 1.0, most_rays)));
    }
}

void OrganRays::share_out_to_small(double rays, double point) {
    constexpr double few = 2;
    const auto open = [](const Organ& organ) { return organ.open[0] + organ.open[1]; };
    const auto is_small = [&](const Organ& organ) { return open(organ) < few * point; };
    const double own = rays / static_cast<double>(std::count_if(organs_.begin(), organs_.end(), is_small));
    if (!(own >= 1)) return;
    for (Organ& organ : organs_) {
        if (!is_small(organ)) continue;
        projected_[organ_number(owner(organ))] = 0;
        for (const std::size_t k : {0, 1}) {
            if (organ.open[k] > 0) organ.rays[k] = std::bit_floor(static_cast<std::uint32_t>(std::min(own, 1024.0)));
        }
    }
}

void OrganRays::find_small(double light) {
    for (const Organ& organ : organs_) {
        const LitTriangles::Owner& own = owner(organ);
        const bool has_rays = std::any_of(organ.rays.begin(), organ.rays.end(), [](auto count) { return count > 0; });
        const double open = organ.open[0] + organ.open[1] + organ.open[2];
        small_[organ_number(own)] = own.kind != LitKind::solid && has_rays && !is_projected(own) && open < light;
    }
}

OrganRays::Begin OrganRays::begin(const Organ& organ, SourceKind kind, double u, double v) const {
    const auto k = static_cast<std::size_t>(kind);
    const auto first = sums_.begin() + static_cast<std::ptrdiff_t>(organ.first),
               end = sums_.begin() + static_cast<std::ptrdiff_t>(organ.end);
    const double at = u * organ.open[k];
    const auto chosen = std::upper_bound(first, end - 1, at,
                                         [k](double sum, const Triangle& triangle) { return sum < triangle.open[k]; });
    const double before = chosen == first ? 0 : (chosen - 1)->open[k], open = chosen->open[k] - before;
    const std::size_t triangle = order_[static_cast<std::size_t>(chosen - sums_.begin())];
    const double along = std::sqrt(std::clamp((at - before) / open, 0.0, 1.0));
    const auto corners = triangles_->corners(triangle);
    const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
    return {triangle, patch(triangle), open, a + along * (b - a + v * (c - b))};
}

LitPatch OrganRays::patch(std::size_t triangle) const {
    const glm::dvec3 vector = triangles_->area_vector(triangle);
    const double area = glm::length(vector);
    const auto corners = triangles_->corners(triangle);
    const glm::dvec3 middle = (glm::dvec3(corners[0]) + glm::dvec3(corners[1]) + glm::dvec3(corners[2])) / 3.0;
    return {middle, area > 0 ? vector / area : glm::dvec3(0), area};
}

std::uint64_t OrganRays::key_of(std::size_t triangle) const {
    std::uint64_t key = 0;
    for (const glm::vec3& corner : triangles_->corners(triangle)) {
        for (int axis = 0; axis < 3; ++axis) key = mix(key, std::bit_cast<std::uint32_t>(corner[axis]));
    }
    return key;
}

std::uint32_t OrganRays::place_of(std::size_t triangle) const {
    const Box& bounds = triangles_->bounds();
    std::uint32_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.upper[axis] - bounds.lower[axis];
        const double along = size > 0 ? (patch(triangle).middle[axis] - bounds.lower[axis]) / size : 0;
        place |= spread(static_cast<std::uint32_t>(1023 * along)) << axis;
    }
    return place;
}

}  // namespace espalier::environment

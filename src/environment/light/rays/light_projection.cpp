#include "environment/light/rays/light_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace espalier::environment {
namespace {

constexpr double most_points = 1 << 24;

/// The least whole number from `at` on.
std::int64_t whole(double at) {
    const auto cut = static_cast<std::int64_t>(at);
    return cut + (static_cast<double>(cut) < at);
}

/// From 0 to before `count`.
std::int64_t repeated(std::int64_t i, std::int64_t count) {
    const std::int64_t rest = i % count;
    return rest < 0 ? rest + count : rest;
}

}  // namespace

void LightProjection::look(const LitTriangles& triangles, const View& view, double points) {
    counts_.assign(triangles.size(), 0);
    if (triangles.size() == 0) return;
    lay_grid(triangles, view, points);
    pixels_.assign(static_cast<std::size_t>(columns_ * rows_), {static_cast<float>(view.ground), nothing});
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto corners = triangles.corners(i);
        draw(i, {seen(corners[0]), seen(corners[1]), seen(corners[2])}, view.period.has_value());
    }
    for (const Pixel& pixel : pixels_) {
        if (pixel.triangle != nothing) ++counts_[pixel.triangle];
    }
}

void LightProjection::lay_grid(const LitTriangles& triangles, const View& view, double points) {
    lean_ = glm::dvec2(view.towards.x, view.towards.z) / view.towards.y;
    glm::dvec2 size;
    if (view.period) {
        lower_ = {view.period->lower.x, view.period->lower.z};
        size = glm::dvec2(view.period->upper.x, view.period->upper.z) - lower_;
    } else {
        const Box& box = triangles.bounds();
        const glm::dvec2 low = box.lower.y * lean_, high = box.upper.y * lean_;
        lower_ = glm::dvec2(box.lower.x, box.lower.z) - glm::max(low, high);
        size = glm::dvec2(box.upper.x, box.upper.z) - glm::min(low, high) - lower_;
        size = glm::max(size, glm::dvec2(1e-9));
    }
    const double count = std::clamp(points, 1.0, most_points);
    columns_ = std::llround(std::clamp(std::sqrt(count * size.x / size.y), 1.0, count));
    rows_ = std::max<std::int64_t>(1, std::llround(count / static_cast<double>(columns_)));
    cell_ = size / glm::dvec2(static_cast<double>(columns_), static_cast<double>(rows_));
    lower_ += view.shift * cell_;
    if (view.period) return;
    lower_ -= cell_;  // the shift moves some points out on one side: one more on the other
    columns_ += 2;
    rows_ += 2;
}

LightProjection::Corner LightProjection::seen(const glm::vec3& corner) const {
    return {(corner.x - corner.y * lean_.x - lower_.x) / cell_.x, (corner.z - corner.y * lean_.y - lower_.y) / cell_.y,
            corner.y};
}

/// Points of the grid are whole numbers. Each edge is taken from its lower end, so that it cuts rows of points at the
/// same places in both triangles that share it.
void LightProjection::draw(std::uint32_t triangle, const std::array<Corner, 3>& corners, bool repeats) {
    const auto& [a, b, c] = corners;
    const double twice = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
    if (twice == 0) return;
    const auto [near, far] = std::minmax({a.z, b.z, c.z});
    const std::int64_t first_row = repeats ? whole(near) : std::max<std::int64_t>(0, whole(near)),
                       end_row = repeats ? whole(far) : std::min(rows_, whole(far));
    if (first_row >= end_row) return;
    const double along_x = ((b.height - a.height) * (c.z - a.z) - (c.height - a.height) * (b.z - a.z)) / twice,
                 along_z = ((c.height - a.height) * (b.x - a.x) - (b.height - a.height) * (c.x - a.x)) / twice;
    const auto [lowest, highest] = std::minmax({a.height, b.height, c.height});
    for (std::int64_t row = first_row; row < end_row; ++row) {
        const auto z = static_cast<double>(row);
        double left = std::numeric_limits<double>::infinity(), right = -left;
        for (int k = 0; k < 3; ++k) {
            const Corner *low = &corners[k], *high = &corners[(k + 1) % 3];
            if (low->z > high->z) std::swap(low, high);
            if (!(low->z <= z && z < high->z)) continue;
            const double x = low->x + (z - low->z) / (high->z - low->z) * (high->x - low->x);
            left = std::min(left, x);
            right = std::max(right, x);
        }
        if (!(left <= right)) continue;
        const std::int64_t first = repeats ? whole(left) : std::max<std::int64_t>(0, whole(left)),
                           end = repeats ? whole(right) : std::min(columns_, whole(right));
        Pixel* const pixels = &pixels_[static_cast<std::size_t>(repeated(row, rows_) * columns_)];
        std::int64_t at = repeated(first, columns_);
        for (std::int64_t column = first; column < end; ++column) {
            const double exact = a.height + along_x * (static_cast<double>(column) - a.x) + along_z * (z - a.z);
            const auto height = static_cast<float>(std::clamp(exact, lowest, highest));
            if (height > pixels[at].height) pixels[at] = {height, triangle};
            if (++at == columns_) at = 0;
        }
    }
}

}  // namespace espalier::environment

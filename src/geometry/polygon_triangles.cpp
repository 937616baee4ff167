#include "geometry/polygon_triangles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace espalier::geometry {
namespace {

/// Cutting takes the square of the corners.
constexpr std::size_t most_corners = 4096;

/// True if every corner turns the same way about the normal.
bool convex(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 in = corners[(i + 1) % n] - corners[i], out = corners[(i + 2) % n] - corners[(i + 1) % n];
        const double turn = glm::dot(glm::cross(in, out), normal);
        if (turn < -1e-12 * (glm::dot(in, in) + glm::dot(out, out))) return false;
    }
    return true;
}

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

double extent_of(std::span<const glm::dvec3> corners) {
    glm::dvec3 lower = corners[0], upper = corners[0];
    for (const glm::dvec3& corner : corners) {
        lower = glm::min(lower, corner);
        upper = glm::max(upper, corner);
    }
    return glm::length(upper - lower);
}

/// Where two lines are closest, in lengths of `a` and `b` from their starts; none if they are nearly parallel.
std::optional<glm::dvec2> closest_points(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& between) {
    constexpr double least_pivot = 256 * std::numeric_limits<double>::epsilon();
    const double ab = -glm::dot(a, b);
    glm::dvec3 pivot(squared(a), ab, glm::dot(a, between)), other(ab, squared(b), -glm::dot(b, between));
    if (ab == 0) {
        if (pivot.x < least_pivot || other.y == 0) return std::nullopt;
        return glm::dvec2(pivot.z / pivot.x, other.z / other.y);
    }
    if (std::abs(other.x) > pivot.x) std::swap(pivot, other);
    const double factor = -other.x / pivot.x, reduced = factor * pivot.y + other.y;
    if (std::abs(reduced) < least_pivot) return std::nullopt;
    const double v = (factor * pivot.z + other.z) / reduced;
    return glm::dvec2((pivot.z - pivot.y * v) / pivot.x, v);
}

/// True if the closest points of two lines are in both segments and in one place, up to a tolerance of length. Parallel
/// lines count as meeting.
bool segments_meet(const glm::dvec3& a, const glm::dvec3& a_end, const glm::dvec3& b, const glm::dvec3& b_end,
                   double tolerance) {
    const glm::dvec3 along_a = a_end - a, along_b = b_end - b;
    const std::optional<glm::dvec2> at = closest_points(along_a, along_b, b - a);
    if (!at) return true;
    const double least = tolerance * tolerance;
    if (squared(at->x * along_a + a - (at->y * along_b + b)) > least) return false;
    const double beyond_a = std::sqrt(least / squared(along_a)), beyond_b = std::sqrt(least / squared(along_b));
    return -beyond_a <= at->x && at->x <= 1 + beyond_a && -beyond_b <= at->y && at->y <= 1 + beyond_b;
}

/// A binary heap of corners, the smallest measure first. Its order among equal measures decides which triangles come
/// out, so it is written out here.
class EarQueue {
public:
    explicit EarQueue(std::size_t corners) : place_(corners, none) {}

    std::size_t size() const { return heap_.size(); }

    void insert(double measure, std::size_t corner) {
        heap_.push_back({measure, corner});
        place_[corner] = heap_.size() - 1;
        sift_up(heap_.size() - 1);
    }

    std::size_t pop() { return remove_at(0); }

    void remove(std::size_t corner) {
        if (place_[corner] != none) remove_at(place_[corner]);
    }

private:
    struct Entry {
        double measure;
        std::size_t corner;
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t remove_at(std::size_t at) {
        const std::size_t corner = heap_[at].corner;
        heap_[at] = heap_.back();
        place_[heap_[at].corner] = at;
        place_[corner] = none;
        heap_.pop_back();
        if (at < heap_.size()) {
            sift_down(at);
            sift_up(at);
        }
        return corner;
    }

    void sift_up(std::size_t at) {
        for (std::size_t parent; at > 0 && heap_[at].measure < heap_[parent = (at - 1) / 2].measure; at = parent) {
            exchange(at, parent);
        }
    }

    void sift_down(std::size_t at) {
        while (2 * at + 1 < heap_.size()) {
            std::size_t child = 2 * at + 1;
            if (child + 1 < heap_.size() && !(heap_[child].measure < heap_[child + 1].measure)) ++child;
            if (!(heap_[at].measure > heap_[child].measure)) return;
            exchange(at, child);
            at = child;
        }
    }

    void exchange(std::size_t a, std::size_t b) {
        std::swap(heap_[a], heap_[b]);
        std::swap(place_[heap_[a].corner], place_[heap_[b].corner]);
    }

    std::vector<Entry> heap_;
    std::vector<std::size_t> place_;  ///< place of each corner in the heap
};

/// A ring of corners that loses one ear after another.
class EarCutter {
public:
    explicit EarCutter(std::span<const glm::dvec3> corners)
        : corners_(corners),
          next_(corners.size()),
          previous_(corners.size()),
          left_(corners.size()),
          tolerance_(1e-6 * extent_of(corners)),
          queue_(corners.size()) {
        for (std::size_t i = 0; i < left_; ++i) {
            next_[i] = (i + 1) % left_;
            previous_[next_[i]] = i;
        }
        drop_repeated_corners();
    }

    /// What was cut off until no ear was left.
    EarCut cut() {
        EarCut result;
        if (left_ == 3) return whole_triangle();
        if (!find_normal()) return result;
        std::size_t corner = head_;
        for (std::size_t i = 0; i < left_; ++i, corner = next_[corner]) enqueue(corner);
        while (left_ > 2 && queue_.size() > 0) {
            const std::size_t ear = queue_.pop();
            if (can_cut(ear)) cut_off(ear, result.triangles);
        }
        result.complete = left_ <= 2;
        return result;
    }

private:
    EarCut whole_triangle() const {
        const std::size_t second = next_[head_];
        EarCut result{{}, true};
        for (const std::size_t i : {head_, second, next_[second]}) {
            result.triangles.push_back(static_cast<std::uint32_t>(i));
        }
        return result;
    }

    void drop_repeated_corners() {
        const std::size_t count = left_;
        std::size_t corner = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t next = next_[corner];
            if (squared(corners_[corner] - corners_[next]) < tolerance_ * tolerance_) {
                unlink(next);
                if (next == head_) head_ = corner;
                --left_;
            } else {
                corner = next;
            }
        }
    }

    bool find_normal() {
        const glm::dvec3& anchor = corners_[head_];
        for (std::size_t i = next_[head_]; next_[i] != head_; i = next_[i]) {
            normal_ += glm::cross(corners_[i] - anchor, corners_[next_[i]] - anchor);
        }
        const double length = glm::length(normal_);
        if (length == 0) return false;
        normal_ /= length;
        return true;
    }

    /// Corners that bend inward are no ears.
    void enqueue(std::size_t corner) {
        const glm::dvec3 in = corners_[corner] - corners_[previous_[corner]];
        const glm::dvec3 out = corners_[next_[corner]] - corners_[corner];
        const glm::dvec3 across = corners_[previous_[corner]] - corners_[next_[corner]];
        const double area = glm::dot(glm::cross(in, out), normal_);
        if (!(area > 0)) return;
        const double perimeter = glm::length(in) + glm::length(out) + glm::length(across);
        queue_.insert(perimeter * perimeter / area, corner);
    }

    /// Whether the line that cuts off a corner stays inside: no edge crosses it, and the rest is on its other side.
    bool can_cut(std::size_t corner) const {
        if (left_ <= 3) return true;
        const glm::dvec3 &from = corners_[previous_[corner]], &to = corners_[next_[corner]];
        glm::dvec3 sideways = glm::cross(to - from, normal_);
        const double length = glm::length(sideways);
        if (length == 0) return false;
        sideways /= length;
        const auto side = [&](std::size_t i) {
            const double distance = glm::dot(sideways, corners_[i] - from);
            return distance > tolerance_ ? 1 : distance < -tolerance_ ? -1 : 0;
        };
        int before = side(next_[next_[corner]]);
        bool rest_is_beyond = before < 0;
        for (std::size_t i = next_[next_[next_[corner]]]; i != previous_[corner]; i = next_[i]) {
            const int here = side(i);
            if (here == before) continue;
            rest_is_beyond |= here < 0;
            if (segments_meet(from, to, corners_[i], corners_[previous_[i]], tolerance_)) return false;
            before = here;
        }
        return rest_is_beyond;
    }

    void cut_off(std::size_t corner, std::vector<std::uint32_t>& triangles) {
        const std::size_t before = previous_[corner], after = next_[corner];
        for (const std::size_t i : {corner, after, before}) triangles.push_back(static_cast<std::uint32_t>(i));
        if (--left_ < 3) return;
        unlink(corner);
        queue_.remove(before);
        queue_.remove(after);
        enqueue(before);
        enqueue(after);
    }

    void unlink(std::size_t corner) {
        next_[previous_[corner]] = next_[corner];
        previous_[next_[corner]] = previous_[corner];
    }

    std::span<const glm::dvec3> corners_;
    std::vector<std::size_t> next_, previous_;
    std::size_t left_, head_ = 0;
    double tolerance_;
    glm::dvec3 normal_{0};
    EarQueue queue_;
};

}  // namespace

EarCut cut_ears(std::span<const glm::dvec3> corners) {
    if (corners.size() < 3) return {};
    if (corners.size() == 3) return {{0, 1, 2}, true};
    return EarCutter(corners).cut();
}

std::vector<std::uint32_t> triangles_of(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    if (corners.size() <= 3 || corners.size() > most_corners || convex(corners, normal)) return {};
    EarCut ears = cut_ears(corners);
    return ears.complete ? std::move(ears.triangles) : std::vector<std::uint32_t>{};
}

}  // namespace espalier::geometry

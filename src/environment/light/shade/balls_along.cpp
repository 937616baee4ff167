#include "environment/light/shade/balls_along.h"

#include "base/vector_clones.h"
#include "environment/light/shade/eight_reals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::environment {
namespace {

/// In u, v and depth.
struct Ray {
    glm::dvec3 origin;
    double margin;
};

/// Appends those of the slots from `first` to `end` whose balls the ray meets. Every slot is written, and kept if its
/// ball is met: no branch depends on the balls.
ESPALIER_VECTOR_CLONES
std::uint32_t* append_met(const Ray& ray, const BallColumns& balls, std::uint32_t first, std::uint32_t end,
                          std::uint32_t* slots) {
    for (; first < end; first += lanes) {
        EightReals u, v, along, radii;  // the columns are padded
        load(u, balls.u.data() + first);
        load(v, balls.v.data() + first);
        load(along, balls.depth.data() + first);
        load(radii, balls.radius.data() + first);
        u -= ray.origin.x;
        v -= ray.origin.y;
        along -= ray.origin.z;
        const EightReals reach = radii + ray.margin;
        const EightReals behind2 = along > 0.0 ? EightReals{} : along * along;  // it may contain the origin
        const EightTruths met = u * u + v * v + behind2 < reach * reach;
        const std::uint32_t some = std::min<std::uint32_t>(lanes, end - first);
        for (std::uint32_t k = 0; k < some; ++k) {
            *slots = first + k;
            slots -= met[k];
        }
    }
    return slots;
}

/// The whole part of a place among bins, at most `last`.
std::size_t index(double place, std::size_t last) {
    return place > 0 ? static_cast<std::size_t>(std::min(place, static_cast<double>(last))) : 0;
}

/// Two directions across one, the same for the same direction.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
    const glm::dvec3 u = glm::normalize(glm::cross(direction, axis));
    return {u, glm::cross(direction, u)};
}

/// Balls of one class have radii within a factor of four. Below 2^-40 of the largest all are small alike.
std::map<int, std::vector<std::uint32_t>> size_classes(std::span<const Ball> balls) {
    double largest = 0;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    const int lowest = largest > 0 ? std::ilogb(largest) - 40 : 0;
    std::map<int, std::vector<std::uint32_t>> classes;
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        const int size = balls[i].radius > 0 ? std::max(std::ilogb(balls[i].radius), lowest) : lowest;
        classes[size >> 1].push_back(i);
    }
    return classes;
}

}  // namespace

void BallsMet::reserve(std::size_t balls) {
    if (ahead.size() >= balls + lanes) return;
    for (std::vector<double>* column : {&ahead, &aside2, &radius}) column->resize(balls + lanes);
    slots.resize(balls + lanes);
}

BallsAlong::BallsAlong(std::span<const Ball> balls)
    : balls_(balls), places_(balls.size()), slots_(balls.size()), level_of_(balls.size()) {
    for (auto& [size, members] : size_classes(balls)) {
        Level level;
        level.largest = 0;
        for (const std::uint32_t i : members) {
            level.largest = std::max(level.largest, balls[i].radius);
            level_of_[i] = static_cast<std::uint32_t>(levels_.size());
        }
        for (auto* column : {&level.balls.u, &level.balls.v, &level.balls.depth, &level.balls.radius}) {
            column->assign(members.size() + lanes, 0);
        }
        level.bins.resize(members.size());
        level.members = std::move(members);
        levels_.push_back(std::move(level));
    }
}

void BallsAlong::turn_to(const glm::dvec3& direction) {
    const auto [u, v] = across(direction);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const glm::dvec3& centre = balls_[i].centre;
        places_[i] = {glm::dot(centre, u), glm::dot(centre, v), glm::dot(centre, direction)};
    }
    for (Level& level : levels_) bin(level);
}

// About as wide as a ball, and no more of them than balls.
void BallsAlong::choose_bins(Level& level) const {
    glm::dvec2 most(places_[level.members[0]]);
    level.least = most;
    for (const std::uint32_t i : level.members) {
        level.least = glm::min(level.least, glm::dvec2(places_[i]));
        most = glm::max(most, glm::dvec2(places_[i]));
    }
    const glm::dvec2 side = most - level.least;
    const auto count = static_cast<double>(level.members.size());
    level.edge =
        std::max({level.largest, std::sqrt(side.x / count) * std::sqrt(side.y), side.x / count, side.y / count});
    if (!(level.edge > 0)) level.edge = 1;
    level.columns = index(side.x / level.edge, level.members.size()) + 1;
    level.rows = index(side.y / level.edge, level.members.size()) + 1;
}

// Sorted by counting, which keeps the order of the balls within a bin.
void BallsAlong::bin(Level& level) {
    choose_bins(level);
    level.ends.assign(level.columns * level.rows + 1, 0);
    for (std::size_t k = 0; k < level.members.size(); ++k) {
        const glm::dvec2 place = (glm::dvec2(places_[level.members[k]]) - level.least) / level.edge;
        level.bins[k] = static_cast<std::uint32_t>(index(place.y, level.rows - 1) * level.columns +
                                                   index(place.x, level.columns - 1));
        ++level.ends[level.bins[k] + 1];
    }
    for (std::size_t k = 1; k < level.ends.size(); ++k) level.ends[k] += level.ends[k - 1];
    std::vector<std::uint32_t> next(level.ends.begin(), level.ends.end() - 1);
    for (std::size_t k = 0; k < level.members.size(); ++k) {
        const std::uint32_t ball = level.members[k], slot = next[level.bins[k]]++;
        slots_[ball] = slot;
        level.balls.u[slot] = places_[ball].x;
        level.balls.v[slot] = places_[ball].y;
        level.balls.depth[slot] = places_[ball].z;
        level.balls.radius[slot] = balls_[ball].radius;
    }
}

void BallsAlong::meet(std::size_t own, double margin, BallsMet& met) const {
    met.reserve(balls_.size());
    met.count = 0;
    for (std::size_t number = 0; number < levels_.size(); ++number) {
        const std::uint32_t itself = level_of_[own] == number ? slots_[own] : std::uint32_t(-1);
        meet(levels_[number], places_[own], margin, itself, met);
    }
}

void BallsAlong::meet(const Level& level, const glm::dvec3& origin, double margin, std::uint32_t itself,
                      BallsMet& met) const {
    const double reach = (level.largest + margin) * (1 + 1e-9);
    const glm::dvec2 place = glm::dvec2(origin) - level.least;
    const glm::dvec2 lower = (place - reach) / level.edge, upper = (place + reach) / level.edge;
    const std::size_t left = index(lower.x, level.columns - 1), right = index(upper.x, level.columns - 1);
    const std::size_t last = index(upper.y, level.rows - 1);
    std::uint32_t* end = met.slots.data();
    for (std::size_t row = index(lower.y, level.rows - 1); row <= last; ++row) {
        const std::uint32_t first = level.ends[row * level.columns + left];
        const std::uint32_t behind = level.ends[row * level.columns + right + 1];
        end = append_met({origin, margin}, level.balls, first, behind, end);
    }
    for (const std::uint32_t* slot = met.slots.data(); slot != end; ++slot) {
        if (*slot == itself) continue;
        const double u = level.balls.u[*slot] - origin.x, v = level.balls.v[*slot] - origin.y;
        met.ahead[met.count] = level.balls.depth[*slot] - origin.z;
        met.aside2[met.count] = u * u + v * v;
        met.radius[met.count++] = level.balls.radius[*slot];
    }
}

}  // namespace espalier::environment

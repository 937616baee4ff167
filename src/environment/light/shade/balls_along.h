// Balls seen along one direction after the other: which of them parallel rays meet.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

struct Ball {
    glm::dvec3 centre;
    double radius;

    bool operator==(const Ball&) const = default;
};

/// The balls that a ray meets, as columns. `ahead` is how far along the ray the centre lies, `aside2` the square of its
/// distance from the ray.
struct BallsMet {
    std::vector<double> ahead, aside2, radius;
    std::size_t count = 0;
    std::vector<std::uint32_t> slots;  ///< scratch memory

    /// Room for so many, and for the lanes of a last vector. Columns only grow.
    void reserve(std::size_t balls);
};

/// Places in the plane across a direction, and along it.
struct BallColumns {
    std::vector<double> u, v, depth, radius;
};

/// Balls binned in the plane across a direction, one grid for each class of sizes. The bins of a row lie one behind
/// the other, so that a ray tests eight balls at a time.
class BallsAlong {
public:
    /// The order of the balls decides the order in which rays meet them.
    explicit BallsAlong(std::span<const Ball> balls);

    void turn_to(const glm::dvec3& direction);

    /// Balls whose surface a ray from the centre of ball `own` comes nearer to than `margin`, without itself: those
    /// with their centre in front, and those that contain the origin. Replaces what `met` holds. Thread safe.
    void meet(std::size_t own, double margin, BallsMet& met) const;

private:
    /// Balls of about one size, in the order of their bins, row by row.
    struct Level {
        double largest;                      ///< radius
        std::vector<std::uint32_t> members;  ///< numbers of the balls
        std::vector<std::uint32_t> bins;     ///< bin of each member
        std::vector<std::uint32_t> ends;     ///< where each bin ends, behind a zero
        BallColumns balls;
        glm::dvec2 least{0};
        double edge = 1;
        std::size_t columns = 1, rows = 1;
    };

    void bin(Level& level);
    void choose_bins(Level& level) const;
    void meet(const Level& level, const glm::dvec3& origin, double margin, std::uint32_t itself, BallsMet& met) const;

    std::span<const Ball> balls_;
    std::vector<Level> levels_;
    std::vector<glm::dvec3> places_;    ///< u, v and depth of the balls
    std::vector<std::uint32_t> slots_;  ///< where a ball is in its level
    std::vector<std::uint32_t> level_of_;
};

}  // namespace espalier::environment

// Limbs as solids: tapering capsules along axes, and their union with smooth joints.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::archive {

/// Two balls and all between them: what a ball sweeps whose radius changes evenly from `base` to `tip`.
struct LimbPiece {
    glm::dvec3 base, tip;
    double base_radius, tip_radius;
    std::uint32_t limb;
    std::uint32_t node;      ///< of the limb's curve, where it ends
    bool flat_base = false;  ///< cut off at `base`, so that it stands on a plane
};

/// A point and the ball of a piece whose surface is nearest, on the outside or the inside.
struct LimbDistance {
    double distance;      ///< negative inside
    glm::dvec3 gradient;  ///< the unit vector from the ball's centre
    double radius;        ///< of the ball
    double share;         ///< where its centre lies between base (0) and tip (1)
};

LimbDistance distance_to(const LimbPiece& piece, const glm::dvec3& point);

/// The union of limbs. Pieces of one limb meet as they are. Two limbs are joined by a quadratic smooth minimum (Quilez
/// 2013) whose width is `blend` times the smaller radius where their surfaces meet at a right angle or an opening of
/// less, and falls to 0 where they are parallel, so that nothing bulges on the far side of a fork (after Gourmel et al.
/// 2013). The order of limbs does not matter.
class LimbUnion {
public:
    LimbUnion(std::vector<LimbPiece> pieces, double blend) : pieces_(std::move(pieces)), blend_(blend) {}

    const std::vector<LimbPiece>& pieces() const { return pieces_; }
    /// How far beyond its surface a piece may change the union.
    double reach(const LimbPiece& piece) const;

    /// The nearest piece of one limb.
    struct Nearest {
        std::uint32_t piece;
        LimbDistance at;
    };
    /// Of each limb that has pieces among `near`, in the order of limbs, into `found`. `near` is sorted.
    void nearest(const glm::dvec3& point, std::span<const std::uint32_t> near, std::vector<Nearest>& found) const;
    /// The distance from the union's surface, roughly: exact where one limb is alone.
    double distance(std::span<const Nearest> limbs) const;

private:
    std::vector<LimbPiece> pieces_;
    double blend_;
};

}  // namespace espalier::archive

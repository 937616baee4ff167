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
    std::uint32_t limb, node;              ///< its limb, and the node of the limb's curve where it ends
    glm::dvec3 base_tangent, tip_tangent;  ///< tangents of the curve, unit vectors
    bool is_first = true, is_last = true;  ///< first and last piece of its limb
    bool is_flat = false;                  ///< cut off at `base`, to stand on a plane
};

/// From the piece's surface, negative inside.
double distance_to(const LimbPiece& piece, const glm::dvec3& point);

/// The union of limbs. Pieces of one limb meet as they are. Two limbs are joined by a cubic smooth minimum (Quilez
/// 2013), which fills a right angle about as a fillet of `blend` times the radius of the thinner limb does. Where
/// surfaces are parallel nothing is filled, so that nothing bulges on the far side of a fork (after Gourmel et al.
/// 2013). The order of limbs does not matter.
class LimbUnion {
public:
    /// The pieces of a limb follow each other, from its first to its last.
    LimbUnion(std::vector<LimbPiece> pieces, double blend) : pieces_(std::move(pieces)), blend_(blend) {}

    const std::vector<LimbPiece>& pieces() const { return pieces_; }
    /// How far beyond its surface a piece may change the union.
    double reach(const LimbPiece& piece) const;
    /// How far beyond its surface that of the union may lie.
    double deepest_fill(const LimbPiece& piece) const { return reach(piece) / 6; }

    /// The nearest piece of one limb.
    struct Nearest {
        std::uint32_t piece;
        double distance;
    };
    /// Finds the nearest piece of each limb that has pieces among `near`, in the order of limbs. `near` is sorted.
    void nearest(const glm::dvec3& point, std::span<const std::uint32_t> near, std::vector<Nearest>& found) const;
    /// The distance from the union's surface, roughly: exact where one limb is alone. `limbs` are those `nearest`
    /// finds.
    double distance(const glm::dvec3& point, std::span<const Nearest> limbs) const;

private:
    /// Where the direction away from a limb starts, and how thick the limb is there.
    struct Outward {
        glm::dvec3 direction;
        double radius;
    };
    Outward outward_at(std::uint32_t piece, const glm::dvec3& point) const;
    double fill(const glm::dvec3& point, const Nearest& a, const Nearest& b) const;

    std::vector<LimbPiece> pieces_;
    double blend_;
};

}  // namespace espalier::archive

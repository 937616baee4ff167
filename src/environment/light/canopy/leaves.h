// Leaf area in voxels, piece by piece.
#pragma once

#include "espalier/base/stop.h"
#include "espalier/geometry/plant_geometry.h"

#include "base/parallel.h"
#include "environment/light/canopy/leaf_angles.h"
#include "environment/light/canopy/medium.h"
#include "environment/light/optics/optics.h"
#include "geometry/drawn/faces.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace espalier::environment {

struct OrientedArea {
    glm::vec3 area;   ///< m2, along the normal of the front; (area, 0, 0) if it is undirected
    bool undirected;  ///< inclined as a distribution says, its front upwards
};

/// A part of a leaf, stem or body that lies in one voxel. Light also meets the backs of closed things, so these are
/// there for the half of the surface that is turned to it, and pieces have half of their area.
struct LeafPiece {
    std::uint32_t plant, module;
    glm::dvec3 middle;
    OrientedArea leaf;
    std::uint16_t material;
    LitKind kind;
    std::size_t voxel = 0;  ///< once sorted
};

/// Pieces of which those of one voxel stand together.
struct SortedPieces {
    std::span<const LeafPiece> pieces;
    std::span<const std::size_t> starts;  ///< the first piece of each voxel that has some, and behind the last

    std::size_t size() const { return pieces.size(); }
};

/// The sum of amount_of(number of piece) in each voxel, per volume.
template <class Number = float, class AmountOf>
std::vector<Number> per_volume(const CanopyVoxels& voxels, const SortedPieces& sorted, const AmountOf& amount_of) {
    std::vector<Number> values(voxels.count(), Number(0));
    const double volume = voxels.edge * voxels.edge * voxels.edge;
    const std::size_t occupied = sorted.starts.empty() ? 0 : sorted.starts.size() - 1;
    for_each_if_worth(occupied, sorted.size(), [&](std::size_t k) {
        double sum = 0;
        for (std::size_t i = sorted.starts[k]; i < sorted.starts[k + 1]; ++i) sum += amount_of(i);
        values[sorted.pieces[sorted.starts[k]].voxel] = static_cast<Number>(sum / volume);
    });
    return values;
}

/// What cutting would make at least, known before it begins.
struct ForeseenPieces {
    double count = 0;
    Box box;  ///< pieces lie beyond each of its sides, or on it
};

class CanopyLeaves {
public:
    void clear();
    /// Everything flat that the plant has drawn, its spheres, and its stems if asked for, cut into pieces no longer
    /// than `longest`, metres. `require` hears before of all pieces, with those of earlier plants, and may throw.
    /// Throws RunError for leaves whose colour no material names.
    void add(std::uint32_t plant, const PlantGeometry& geometry, double longest, const Optics& optics, bool with_stems,
             const std::function<void(const ForeseenPieces&)>& require = nullptr);
    /// Area (m2) at a place, without a direction of its own.
    void add(std::uint32_t plant, std::uint32_t module, const glm::dvec3& place, double area);

    const Box& bounds() const { return bounds_; }
    /// Once they are sorted.
    SortedPieces pieces() const { return {pieces_, starts_}; }

    /// Gives each piece its voxel, and brings pieces of a voxel together.
    void sort_into(const CanopyVoxels& voxels);
    /// Leaf area per volume of each voxel, 1/m.
    std::vector<float> densities(const CanopyVoxels& voxels) const;

private:
    struct Owner {
        std::uint32_t plant, module;
        std::uint16_t material;
        LitKind kind;
    };

    ForeseenPieces foresee(const PlantGeometry& geometry, double longest, bool with_stems) const;
    void add(const DrawnFace& face, const Owner& owner, double longest);
    void cut(const Owner& owner, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double longest);
    void add_stem(const Owner& owner, const Internode& internode, double longest);
    void add(const Owner& owner, const glm::dvec3& middle, const glm::dvec3& area);
    void add(const LeafPiece& piece);

    std::vector<LeafPiece> pieces_;
    std::vector<std::size_t> starts_;
    DrawnFaces drawn_;
    Box bounds_;
    StopCheck<4096> check_stop_;
};

double area_of(const LeafPiece& piece);

/// How leaves look from one direction.
class LeavesSeen {
public:
    /// `towards` is a unit vector from the leaves on; clumped leaves hide each other, and a share `clumping` is seen.
    LeavesSeen(const glm::dvec3& towards, const LeafAngles& angles, double clumping);

    struct Sides {
        double front, back;  ///< m2 across the direction; of a directed piece one of them is 0
        double both() const { return front + back; }
    };
    Sides operator()(const OrientedArea& leaf) const {
        if (leaf.undirected) return {leaf.area.x * above_, leaf.area.x * below_};
        const double seen = clumping_ * glm::dot(glm::dvec3(leaf.area), towards_);
        return {std::max(seen, 0.0), std::max(-seen, 0.0)};
    }
    /// Of unit area of the distribution.
    double projection() const { return above_ + below_; }

private:
    glm::dvec3 towards_;
    double above_, below_, clumping_;
};

}  // namespace espalier::environment

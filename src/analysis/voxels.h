// The boxes of a grid that segments and points touch.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace espalier::analysis {

/// A cubic grid of at most 2^21 boxes along each side. What lies outside counts as in the outermost boxes.
class VoxelSet {
public:
    VoxelSet(const glm::dvec3& origin, double edge) : origin_(origin), edge_(edge) {}

    void add_point(const glm::dvec3& point);
    /// Every box the segment passes through (Amanatides & Woo 1987).
    void add_segment(const glm::dvec3& from, const glm::dvec3& to);

    /// How many boxes are touched.
    std::size_t count();
    /// Doubles the boxes' edges.
    void coarsen();
    double edge() const { return edge_; }

private:
    void add(const glm::i64vec3& box);
    glm::i64vec3 box_of(const glm::dvec3& point) const;
    void remove_repeated();

    glm::dvec3 origin_;
    double edge_;
    std::vector<std::uint64_t> codes_;  ///< Morton codes, so that a coarser grid's are theirs shifted
    std::size_t unique_ = 0;            ///< the first so many are sorted and without repetition
};

}  // namespace espalier::analysis

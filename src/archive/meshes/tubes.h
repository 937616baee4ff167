// Axes swept into tubes: rings carried along without twist, closed by flat caps.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace espalier::archive {

struct TubeNode {
    glm::vec3 position;
    float radius;
    PointIndex point;        ///< of the frame, whose attributes hold from the node before on
    glm::vec3 across_of{0};  ///< the ring stands across this direction; 0: halfway between the pieces it joins
};

/// The frame of a ring, carried along without twist.
struct TubeFrame {
    glm::dvec3 tangent, across;  ///< unit vectors; the texture begins at `across`
    double along;                ///< v of the texture
};

struct TubeLine {
    std::vector<TubeNode> nodes;
    int pictures_around =
        0;  ///< pictures of a texture, which keeps its proportions round and along it; 0: it wears none
    bool stands_free = true;                        ///< on no other axis
    std::optional<TubeFrame> first = std::nullopt;  ///< frame of a ring that belongs to another tube, too
};

/// The nodes of an axis: no two neighbours in one place; nodes left out where middle line and radius stray no more than
/// `tolerance` from them and no colour changes (Douglas and Peucker 1973). Radii of 0 become `thinnest`, tips that
/// taper to nothing a thousandth of the axis's thickest; widths in pixels count in widths of the thinnest.
TubeLine tube_line(const FrameGeometry& geometry, std::span<const PointIndex> points, double tolerance, float thinnest);

/// Whether two points have one colour.
bool same_look(const FrameAttributes& of_points, PointIndex a, PointIndex b);

/// How far middle line and radius stray once a node and all that stray less have left; infinite at both ends. Where the
/// colour changes it is the radius at least.
std::vector<double> node_errors(const TubeLine& line, const FrameAttributes& of_points);

/// Returns the frame of each node; two nodes at least.
std::vector<TubeFrame> frames_along(const TubeLine& line);

struct TubeVertex {
    glm::vec3 position, normal;
    glm::vec2 uv;        ///< once round, and metres along the axis; in pictures if it wears a texture
    std::uint32_t node;  ///< node of the line
};

struct TubeTriangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t node;  ///< whose attributes it has
};

struct Tube {
    std::vector<TubeVertex> vertices;
    std::vector<TubeTriangle> triangles;
};

/// Caps are fans around their middle, or from their first corner, which takes two triangles less.
enum class Caps { round, lean };

/// How many `sweep` makes of so many nodes: pieces and two caps.
constexpr std::size_t swept_triangles(std::size_t nodes, int sides, Caps caps) {
    return 2 * nodes * static_cast<std::size_t>(sides) - (caps == Caps::lean ? 4 : 0);
}

/// Two nodes at least; a tube of two sides is flat and lean. Every edge belongs to two triangles once vertices in one
/// place are taken for one.
Tube sweep(const TubeLine& line, int sides, Caps caps = Caps::round);

}  // namespace espalier::archive

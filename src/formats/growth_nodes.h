// The growth of a run as things that last: each internode and organ once, with where it stood at each frame.
#pragma once

#include "archive/meshes/surface_mesh.h"

#include <glm/gtc/quaternion.hpp>

#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace espalier::formats {

struct NodePose {
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
};

/// Triangles in a thing's own coordinates, shared by all that look alike.
struct NodeShape {
    std::vector<glm::vec3> points, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Rgb> rgb;  ///< colours of triangles
    std::string texture;   ///< texture of all of it

    auto key() const { return std::tie(points_key_, triangles, rgb, texture, textured_uvs_); }
    /// Shapes that differ by less than a ten-thousandth are taken for one.
    void round();

private:
    std::vector<std::array<int, 3>> points_key_;
    std::vector<std::array<float, 2>> textured_uvs_;
};

/// An internode or an organ: shown from its first to its last pose.
struct GrowthNode {
    MeshPart part;
    NodeShape organ;                                      ///< as last seen; an internode's is made by shape_of
    float taper = 1;                                      ///< tip radius of an internode by its base radius
    Rgb rgb{};                                            ///< colour of an internode
    std::vector<std::pair<std::size_t, NodePose>> poses;  ///< by number of the frame
    std::vector<std::uint32_t> anchors;                   ///< the three vertices that say how an organ is turned
};

/// `sides` are those of internodes.
NodeShape shape_of(const GrowthNode& node, int sides);

/// Frames come in their order.
class GrowthNodes {
public:
    explicit GrowthNodes(const MeshOptions& options) : options_(options) {}

    void add(const FrameGeometry& geometry);
    /// A frame's organs alone.
    void add_organs(const FrameGeometry& geometry);
    /// In the order in which they appeared.
    const std::vector<GrowthNode>& all() const { return nodes_; }

private:
    /// What stays the same through the frames: plant, kind, identity, and which of a module's.
    using Key = std::tuple<std::uint32_t, Kind, std::uint64_t, std::uint32_t>;

    GrowthNode& node(std::uint32_t plant, Kind kind, std::uint64_t identity);
    void add_internode(const FrameGeometry& geometry, const FrameInternode& internode, float thinnest);
    void add_surfaces(const FrameGeometry& geometry);
    void add_organ(const FrameMesh& mesh, const MeshPart& part);

    MeshOptions options_;
    std::vector<GrowthNode> nodes_;
    std::map<Key, std::size_t> number_;
    std::map<Key, std::uint32_t> seen_;  ///< how many of a module's in this frame; the last of the key is 0
    std::size_t frame_ = 0;
};

}  // namespace espalier::formats

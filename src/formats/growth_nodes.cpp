#include "formats/growth_nodes.h"

#include "espalier/base/error.h"

#include "archive/meshes/tubes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::formats {
namespace {

constexpr std::size_t most_nodes = 500000;
constexpr float taper_steps = 16;  // internodes whose taper differs by less share a shape

/// The shortest turn from +y to a direction.
glm::quat turn_from_y(const glm::vec3& direction) {
    const float w = 1 + direction.y;
    if (w < 1e-6f) return {0, 1, 0, 0};  // half a turn about x
    return glm::normalize(glm::quat(w, direction.z, 0, -direction.x));
}

NodeShape frustum(float taper, int sides, const Rgb& rgb) {
    const TubeLine line{{{{0, 0, 0}, 1, PointIndex(0)}, {{0, 1, 0}, taper, PointIndex(0)}}};
    NodeShape shape;
    const Tube tube = sweep(line, sides);
    for (const TubeVertex& vertex : tube.vertices) {
        shape.points.push_back(vertex.position);
        shape.normals.push_back(vertex.normal);
        shape.uvs.push_back(vertex.uv);
    }
    for (const TubeTriangle& triangle : tube.triangles) shape.triangles.push_back(triangle.corners);
    shape.rgb.assign(shape.triangles.size(), rgb);
    return shape;
}

/// The vertex farthest from the first, and the one farthest from the line through both.
std::vector<std::uint32_t> anchors_of(std::span<const glm::vec3> points) {
    std::uint32_t far = 0, wide = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (glm::distance(points[i], points[0]) > 1.001f * glm::distance(points[far], points[0])) far = i;
    }
    const glm::vec3 along = points[far] - points[0];
    const auto off = [&](std::uint32_t i) { return glm::length(glm::cross(points[i] - points[0], along)); };
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (off(i) > 1.001f * off(wide)) wide = i;
    }
    return {far, wide};
}

/// Where an organ stands: its first vertex, turned as its anchors are, as large as they are apart.
std::optional<NodePose> pose_of(std::span<const glm::vec3> points, const std::vector<std::uint32_t>& anchors) {
    const glm::dvec3 base(points[0]), along = glm::dvec3(points[anchors[0]]) - base;
    const double size = glm::length(along);
    const glm::dvec3 aside = glm::dvec3(points[anchors[1]]) - base;
    const glm::dvec3 across = glm::cross(along, aside);
    if (size == 0 || glm::length(across) < 1e-9 * size * size) return std::nullopt;
    const glm::dvec3 y = along / size, z = glm::normalize(across), x = glm::cross(y, z);
    return NodePose{glm::vec3(base), glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(x, y, z)))),
                    glm::vec3(static_cast<float>(size))};
}

/// The turns of neighbouring frames on the same side, so that what is between them is the short way.
void append(GrowthNode& node, std::size_t frame, NodePose pose) {
    if (!node.poses.empty() && glm::dot(node.poses.back().second.rotation, pose.rotation) < 0) {
        pose.rotation = -pose.rotation;
    }
    node.poses.emplace_back(frame, pose);
}

}  // namespace

void NodeShape::round() {
    points_key_.clear();
    textured_uvs_.clear();
    for (const glm::vec2& uv : uvs) {
        if (!texture.empty()) textured_uvs_.push_back({uv.x, uv.y});
    }
    for (const glm::vec3& point : points) {
        points_key_.push_back({static_cast<int>(std::lround(point.x * 1e4f)),
                               static_cast<int>(std::lround(point.y * 1e4f)),
                               static_cast<int>(std::lround(point.z * 1e4f))});
    }
}

NodeShape shape_of(const GrowthNode& node, int sides) {
    return node.part.kind == Kind::axis ? frustum(node.taper, sides, node.rgb) : node.organ;
}

GrowthNode& GrowthNodes::node(std::uint32_t plant, Kind kind, std::uint64_t identity) {
    const std::uint32_t ordinal = seen_[{plant, kind, identity, 0}]++;
    const auto [at, is_new] = number_.emplace(Key{plant, kind, identity, ordinal}, nodes_.size());
    if (is_new) {
        if (nodes_.size() == most_nodes) {
            throw RunError(
                fmt::format("the growth has more than {} internodes and organs, too many to move one by one; "
                            "fewer frames or one --plant make them fewer",
                            most_nodes));
        }
        nodes_.emplace_back();
    }
    return nodes_[at->second];
}

void GrowthNodes::add_internode(const FrameGeometry& geometry, const FrameInternode& internode, float thinnest) {
    if (!geometry.pixels.empty()) thinnest *= std::max(1.0f, geometry.pixels[internode.tip_point.row()]);
    const float length = glm::distance(internode.base, internode.tip);
    if (length == 0) return;
    GrowthNode& here = node(internode.plant, Kind::axis, internode.identity);
    const bool drawn = internode.base_radius > 0 || internode.tip_radius > 0;
    const float thickest = drawn ? std::max(internode.base_radius, internode.tip_radius) : thinnest;
    const float base = drawn ? std::max(internode.base_radius, thickest / 64) : thinnest;
    const float tip = drawn ? internode.tip_radius : thinnest;
    const float taper = std::max(std::round(tip / base * taper_steps) / taper_steps, 1e-3f);
    here.part = {Kind::axis, internode.plant, internode.identity, geometry.symbol_names[internode.symbol]};
    here.taper = taper;
    here.rgb = colour_of(geometry.of_points, internode.tip_point.row());
    append(here, frame_,
           {internode.base, turn_from_y((internode.tip - internode.base) / length), {base, length, base}});
}

void GrowthNodes::add_organ(const FrameMesh& mesh, const MeshPart& part) {
    const std::span points(mesh.points.data() + part.first_vertex, part.vertices);
    if (points.empty()) return;
    GrowthNode& here = node(part.plant, part.kind, part.identity);
    if (here.anchors.empty() || here.organ.points.size() != points.size()) here.anchors = anchors_of(points);
    const std::optional<NodePose> pose = pose_of(points, here.anchors);
    if (!pose) return;
    here.part = part;
    here.organ = {};
    const glm::quat back = glm::inverse(pose->rotation);
    for (std::size_t i = 0; i < points.size(); ++i) {
        here.organ.points.push_back(back * (points[i] - pose->translation) / pose->scale.x);
        here.organ.normals.push_back(back * mesh.normals[part.first_vertex + i]);
        here.organ.uvs.push_back(mesh.uvs[part.first_vertex + i]);
    }
    const auto first = static_cast<std::uint32_t>(part.first_vertex);
    for (std::size_t i = part.first_triangle; i < part.first_triangle + part.triangles; ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        here.organ.triangles.push_back({a - first, b - first, c - first});
        const MeshMaterial& look = mesh.materials[mesh.material_of[i]];
        here.organ.rgb.push_back(look.rgb);
        here.organ.texture = look.texture;
    }
    append(here, frame_, *pose);
}

void GrowthNodes::add(const FrameGeometry& geometry) {
    seen_.clear();
    const float thinnest = thinnest_radius(geometry);
    for (const FrameInternode& internode : internodes_of(geometry)) {
        if (!options_.plant || internode.plant == *options_.plant) add_internode(geometry, internode, thinnest);
    }
    add_surfaces(geometry);
    ++frame_;
}

void GrowthNodes::add_organs(const FrameGeometry& geometry) {
    seen_.clear();
    add_surfaces(geometry);
    ++frame_;
}

void GrowthNodes::add_surfaces(const FrameGeometry& geometry) {
    const FrameMesh surfaces = surfaces_of(geometry, options_);
    for (const MeshPart& part : surfaces.parts) add_organ(surfaces, part);
}

}  // namespace espalier::formats

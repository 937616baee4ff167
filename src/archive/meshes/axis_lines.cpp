#include "archive/meshes/axis_lines.h"

#include "archive/meshes/bark.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <unordered_map>

namespace espalier::archive {
namespace {

float thickest_radius(const TubeLine& line) {
    float radius = 0;
    for (const TubeNode& node : line.nodes) radius = std::max(radius, node.radius);
    return radius;
}

/// Turns the rings at forks, and begins branches with them. The lines stand in the order of the paths.
void share_rings(std::span<const AxisPath> paths, std::vector<AxisLine>& lines) {
    struct Ring {
        std::size_t line, node;
    };
    std::unordered_map<PointIndex, glm::vec3> direction_at;
    for (const AxisPath& path : paths) {
        for (const Fork& fork : path.forks) direction_at.emplace(fork.point, fork.across_of);
    }
    std::unordered_map<PointIndex, Ring> ring_at;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::vector<TubeNode>& nodes = lines[i].line.nodes;
        for (std::size_t k = 1; k < nodes.size(); ++k) {
            const auto fork = direction_at.find(nodes[k].point);
            if (fork == direction_at.end()) continue;
            nodes[k].across_of = fork->second;
            ring_at[nodes[k].point] = {i, k};
        }
    }
    std::unordered_map<std::size_t, std::vector<TubeFrame>> frames_of;  // a path comes after what bears it
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto ring = ring_at.find(paths[i].first_ring);
        if (ring == ring_at.end() || lines[i].line.nodes.size() < 2) continue;
        const TubeLine& bearer = lines[ring->second.line].line;
        std::vector<TubeFrame>& frames = frames_of[ring->second.line];
        if (frames.empty()) frames = frames_along(bearer);
        lines[i].line.first = frames[ring->second.node];
        lines[i].line.nodes.front().radius = bearer.nodes[ring->second.node].radius;
    }
}

}  // namespace

std::vector<AxisLine> axis_lines(const FrameGeometry& geometry, std::span<const AxisPath> paths, double tolerance,
                                 float thinnest, Forks forks) {
    std::vector<AxisLine> lines(paths.size());
    tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
        lines[i] = {tube_line(geometry, paths[i].points, tolerance, thinnest), paths[i].plant, paths[i].row};
        lines[i].line.stands_free = paths[i].stands_free;
    });
    std::map<std::uint32_t, float> thickest;
    for (const AxisLine& axis : lines) {
        float& radius = thickest[axis.plant];
        radius = std::max(radius, thickest_radius(axis.line));
    }
    for (AxisLine& axis : lines) {
        const std::uint16_t texture = geometry.textures[axis.row];
        if (texture == 0) continue;
        axis.texture = geometry.texture_files[texture];
        axis.line.pictures_around = pictures_around(axis.texture, thickest_radius(axis.line), thickest[axis.plant]);
    }
    if (forks == Forks::rings) share_rings(paths, lines);
    std::erase_if(lines, [](const AxisLine& axis) { return axis.line.nodes.size() < 2; });
    return lines;
}

void apply_bark(FrameGeometry& geometry, const std::string& texture) {
    if (geometry.texture_files.empty()) geometry.texture_files.emplace_back();
    const auto number = static_cast<std::uint16_t>(geometry.texture_files.size());
    geometry.texture_files.push_back(texture);
    for (std::size_t line = 0; line < geometry.lines.size(); ++line) {
        const std::size_t row = geometry.lines.first + line;
        if (geometry.of_cells.kinds[row] == Kind::axis && geometry.textures[row] == 0) geometry.textures[row] = number;
    }
}

}  // namespace espalier::archive

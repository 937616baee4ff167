#include "archive/meshes/axis_lines.h"

#include "archive/meshes/bark.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

namespace espalier::archive {
namespace {

float thickest_radius(const TubeLine& line) {
    float radius = 0;
    for (const TubeNode& node : line.nodes) radius = std::max(radius, node.radius);
    return radius;
}

}  // namespace

std::vector<AxisLine> axis_lines(const RecordedGeometry& geometry, std::span<const AxisPath> paths, double tolerance,
                                 float thinnest) {
    std::vector<AxisLine> lines(paths.size());
    tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
        lines[i] = {tube_line(geometry, paths[i].points, tolerance, thinnest), paths[i].plant, paths[i].row};
        lines[i].line.stands_free = paths[i].stands_free;
    });
    std::erase_if(lines, [](const AxisLine& axis) { return axis.line.nodes.size() < 2; });
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
    return lines;
}

void dress_axes(RecordedGeometry& geometry, const std::string& texture) {
    if (geometry.texture_files.empty()) geometry.texture_files.emplace_back();
    const auto number = static_cast<std::uint16_t>(geometry.texture_files.size());
    geometry.texture_files.push_back(texture);
    for (std::size_t line = 0; line < geometry.lines.size(); ++line) {
        const std::size_t row = geometry.lines.first + line;
        if (geometry.of_cells.kinds[row] == Kind::axis && geometry.textures[row] == 0) geometry.textures[row] = number;
    }
}

}  // namespace espalier::archive

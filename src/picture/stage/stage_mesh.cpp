#include "picture/stage/stage_mesh.h"

#include "archive/meshes/axis_lines.h"
#include "archive/meshes/skin.h"
#include "archive/meshes/surface_mesh.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace espalier::picture {
namespace {

/// A mesh of known size that is filled place by place.
class MeshFiller {
public:
    MeshFiller(std::size_t points, std::size_t triangles) {
        const auto count = static_cast<vtkIdType>(points), cells = static_cast<vtkIdType>(triangles);
        points_ = floats(3, count);
        normals_ = floats(3, count);
        uvs_ = floats(2, count);
        offsets_->SetNumberOfValues(cells + 1);
        for (vtkIdType i = 0; i <= cells; ++i) offsets_->SetValue(i, static_cast<vtkTypeInt32>(3 * i));
        corners_->SetNumberOfValues(3 * cells);
        mesh_.row_of_point.resize(points);
        mesh_.row_of_triangle.resize(triangles);
    }

    void set_point(std::size_t at, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv,
                   std::uint32_t row) {
        std::copy_n(&position.x, 3, points_->GetPointer(static_cast<vtkIdType>(3 * at)));
        std::copy_n(&normal.x, 3, normals_->GetPointer(static_cast<vtkIdType>(3 * at)));
        std::copy_n(&uv.x, 2, uvs_->GetPointer(static_cast<vtkIdType>(2 * at)));
        mesh_.row_of_point[at] = row;
    }

    void set_triangle(std::size_t at, const std::array<std::size_t, 3>& corners, std::uint32_t row) {
        for (std::size_t k = 0; k < 3; ++k) {
            corners_->SetValue(static_cast<vtkIdType>(3 * at + k), static_cast<vtkTypeInt32>(corners[k]));
        }
        mesh_.row_of_triangle[at] = row;
    }

    StageMesh take() {
        vtkNew<vtkPoints> points;
        points->SetData(points_);
        vtkNew<vtkCellArray> cells;
        cells->SetData(offsets_, corners_);
        normals_->SetName("Normals");
        mesh_.data = vtkSmartPointer<vtkPolyData>::New();
        mesh_.data->SetPoints(points);
        mesh_.data->SetPolys(cells);
        mesh_.data->GetPointData()->SetNormals(normals_);
        mesh_.data->GetPointData()->SetTCoords(uvs_);
        return std::move(mesh_);
    }

private:
    static vtkSmartPointer<vtkFloatArray> floats(int components, vtkIdType count) {
        auto array = vtkSmartPointer<vtkFloatArray>::New();
        array->SetNumberOfComponents(components);
        array->SetNumberOfTuples(count);
        return array;
    }

    StageMesh mesh_;
    vtkSmartPointer<vtkFloatArray> points_, normals_, uvs_;
    vtkNew<vtkTypeInt32Array> offsets_, corners_;
};

struct PlacedTube {
    AxisLine axis;
    std::uint16_t texture = 0;
    int sides = 3;
    std::optional<Tube> patch = std::nullopt;  ///< the tube's part of a skin; none: it is still to be swept
    std::size_t first_point = 0, first_triangle = 0;

    // What `sweep` makes: a ring per node, and two caps with a centre each.
    std::size_t points() const {
        return patch ? patch->vertices.size() : (axis.line.nodes.size() + 2) * static_cast<std::size_t>(sides + 1);
    }
    std::size_t triangles() const {
        return patch ? patch->triangles.size() : 2 * axis.line.nodes.size() * static_cast<std::size_t>(sides);
    }
};

/// Outlines and other lines that are no axes.
std::vector<AxisPath> outlines(const FrameGeometry& geometry, const std::optional<std::uint32_t>& plant) {
    std::vector<AxisPath> paths;
    for (std::size_t line = 0; line < geometry.lines.size(); ++line) {
        const std::size_t row = geometry.lines.first + line;
        if (geometry.of_cells.kinds[row] == Kind::axis) continue;
        if (plant && geometry.of_cells.plants[row] != *plant) continue;
        AxisPath& path = paths.emplace_back(AxisPath{geometry.of_cells.plants[row], row, {}});
        for (const std::int32_t point : geometry.lines[line]) path.points.emplace_back(point);
    }
    return paths;
}

/// Enough for an outline that lies within 0.3 pixels of a round one, at a thousand pixels.
double wanted_sides(const TubeLine& line, double size) {
    float radius = 0;
    for (const TubeNode& node : line.nodes) radius = std::max(radius, node.radius);
    return std::clamp(4 * std::sqrt(1000 * radius / size), 4.0, 24.0);
}

/// The parts of a skin that belong to each axis.
void cover(std::span<PlacedTube> tubes, const archive::AxisSkin& skin) {
    std::vector<AxisLine> lines;
    std::vector<int> sides;
    for (const PlacedTube& tube : tubes) {
        lines.push_back(tube.axis);
        sides.push_back(tube.sides);
    }
    std::vector<Tube> patches = skin_of(lines, sides, skin);
    for (std::size_t i = 0; i < tubes.size(); ++i) tubes[i].patch = std::move(patches[i]);
}

std::vector<PlacedTube> placed_tubes(const FrameGeometry& geometry, const StageMeshOptions& options) {
    MeshOptions wanted;
    wanted.plant = options.plant;
    std::vector<PlacedTube> tubes;
    const auto add = [&](const std::vector<AxisPath>& paths) {
        const auto forks = options.skin.smooth ? archive::Forks::none : archive::Forks::rings;
        for (AxisLine& axis : axis_lines(geometry, paths, 0, options.thinnest, forks)) {
            const std::uint16_t texture = geometry.textures[axis.row];
            tubes.push_back({std::move(axis), texture});
        }
    };
    add(axis_paths(geometry, wanted));
    const std::size_t axes = tubes.size();
    add(outlines(geometry, options.plant));
    double triangles = 1;
    for (const PlacedTube& tube : tubes) {
        triangles += 2 * static_cast<double>(tube.axis.line.nodes.size()) * wanted_sides(tube.axis.line, options.size);
    }
    const double share = std::min(1.0, static_cast<double>(options.triangles) / triangles);
    for (PlacedTube& tube : tubes) {
        tube.sides = std::max(3, static_cast<int>(share * wanted_sides(tube.axis.line, options.size)));
    }
    if (options.skin.smooth) cover(std::span(tubes).first(axes), options.skin);
    const auto by_texture = [](const PlacedTube& a, const PlacedTube& b) { return a.texture < b.texture; };
    std::stable_sort(tubes.begin(), tubes.end(), by_texture);
    return tubes;
}

void fill_tube(const PlacedTube& placed, MeshFiller& filler) {
    const Tube tube = placed.patch ? *placed.patch : sweep(placed.axis.line, placed.sides);
    const auto row = [&](std::uint32_t node) { return placed.axis.line.nodes[node].point.row(); };
    std::size_t at = placed.first_point;
    for (const TubeVertex& vertex : tube.vertices) {
        filler.set_point(at++, vertex.position, vertex.normal, vertex.uv, row(vertex.node));
    }
    at = placed.first_triangle;
    for (const TubeTriangle& triangle : tube.triangles) {
        const std::size_t origin = placed.first_point;
        filler.set_triangle(at++,
                            {origin + triangle.corners[0], origin + triangle.corners[1], origin + triangle.corners[2]},
                            row(triangle.node));
    }
}

/// Makes a mesh of tubes that wear one texture.
StageMesh mesh_of(std::span<PlacedTube> tubes) {
    std::size_t points = 0, triangles = 0;
    for (PlacedTube& tube : tubes) {
        tube.first_point = points;
        tube.first_triangle = triangles;
        points += tube.points();
        triangles += tube.triangles();
    }
    MeshFiller filler(points, triangles);
    tbb::parallel_for(std::size_t{0}, tubes.size(), [&](std::size_t i) { fill_tube(tubes[i], filler); });
    StageMesh mesh = filler.take();
    mesh.is_of_axes = true;
    mesh.texture = tubes.front().texture;
    return mesh;
}

/// A triangle fan's area, along its normal.
glm::dvec3 area_of(const FrameGeometry& geometry, std::size_t cell) {
    const auto corners = geometry.polygons[cell];
    const auto corner = [&](std::size_t k) {
        return glm::dvec3(geometry.points[static_cast<std::size_t>(corners[k])]);
    };
    return area_vector(corners.size(), corner);
}

/// How many cells from `cell` on belong to its module.
std::size_t cells_of_module(const FrameGeometry& geometry, std::size_t cell) {
    const FrameAttributes& of = geometry.of_cells;
    const std::size_t row = geometry.polygons.first + cell;
    std::size_t count = 1;
    while (cell + count < geometry.polygons.size() && of.identities[row + count] == of.identities[row] &&
           of.plants[row + count] == of.plants[row]) {
        ++count;
    }
    return count;
}

/// The areas of a closed surface cancel out; of anything that can be seen from behind they hardly do.
bool is_closed(const FrameGeometry& geometry, std::size_t cell, std::size_t count) {
    constexpr double rounding = 1e-4;
    glm::dvec3 sum(0);
    double all = 0;
    for (std::size_t i = cell; i < cell + count; ++i) {
        const glm::dvec3 area = area_of(geometry, i);
        sum += area;
        all += glm::length(area);
    }
    return glm::length(sum) < rounding * all;
}

/// The cells that wear one texture.
StageMesh surface_of(const FrameGeometry& geometry, const std::vector<std::size_t>& cells) {
    std::size_t points = 0, triangles = 0;
    for (const std::size_t cell : cells) {
        points += geometry.polygons[cell].size();
        triangles += geometry.polygons[cell].size() - 2;
    }
    MeshFiller filler(points, triangles);
    std::size_t point = 0, triangle = 0;
    for (const std::size_t cell : cells) {
        const auto row = static_cast<std::uint32_t>(geometry.polygons.first + cell);
        const std::size_t first = point;
        for (const std::int32_t corner : geometry.polygons[cell]) {
            const auto i = static_cast<std::size_t>(corner);
            filler.set_point(point++, geometry.points[i], geometry.normals[i], geometry.uvs[i],
                             static_cast<std::uint32_t>(i));
        }
        for (std::size_t k = first + 2; k < point; ++k) filler.set_triangle(triangle++, {first, k - 1, k}, row);
    }
    return filler.take();
}

}  // namespace

std::vector<StageMesh> tubes_of(const FrameGeometry& geometry, const StageMeshOptions& options) {
    std::vector<PlacedTube> tubes = placed_tubes(geometry, options);
    std::vector<StageMesh> meshes;
    for (std::size_t first = 0, last = 0; first < tubes.size(); first = last) {
        while (last < tubes.size() && tubes[last].texture == tubes[first].texture) ++last;
        meshes.push_back(mesh_of(std::span(tubes).subspan(first, last - first)));
    }
    return meshes;
}

std::vector<StageMesh> surfaces_of(const FrameGeometry& geometry, const StageMeshOptions& options) {
    std::map<std::pair<std::uint16_t, bool>, std::vector<std::size_t>> cells_with;
    for (std::size_t cell = 0, count = 0; cell < geometry.polygons.size(); cell += count) {
        count = cells_of_module(geometry, cell);
        if (options.plant && geometry.of_cells.plants[geometry.polygons.first + cell] != *options.plant) continue;
        const bool is_thin = !is_closed(geometry, cell, count);
        for (std::size_t i = cell; i < cell + count; ++i) {
            if (geometry.polygons[i].size() < 3) continue;
            cells_with[{geometry.textures[geometry.polygons.first + i], is_thin}].push_back(i);
        }
    }
    std::vector<StageMesh> meshes;
    for (const auto& [kind, cells] : cells_with) {
        meshes.push_back(surface_of(geometry, cells));
        std::tie(meshes.back().texture, meshes.back().is_thin) = kind;
    }
    return meshes;
}

std::span<const glm::vec3> points_of(const StageMesh& mesh) {
    auto* array = vtkFloatArray::SafeDownCast(mesh.data->GetPoints()->GetData());
    return {reinterpret_cast<const glm::vec3*>(array->GetPointer(0)), mesh.row_of_point.size()};
}

std::span<const glm::vec3> normals_of(const StageMesh& mesh) {
    auto* array = vtkFloatArray::SafeDownCast(mesh.data->GetPointData()->GetNormals());
    return {reinterpret_cast<const glm::vec3*>(array->GetPointer(0)), mesh.row_of_point.size()};
}

std::span<const glm::vec2> uvs_of(const StageMesh& mesh) {
    auto* array = vtkFloatArray::SafeDownCast(mesh.data->GetPointData()->GetTCoords());
    return {reinterpret_cast<const glm::vec2*>(array->GetPointer(0)), mesh.row_of_point.size()};
}

std::span<const std::int32_t> corners_of(const StageMesh& mesh) {
    auto* array = vtkTypeInt32Array::SafeDownCast(mesh.data->GetPolys()->GetConnectivityArray());
    return {array->GetPointer(0), 3 * mesh.row_of_triangle.size()};
}

}  // namespace espalier::picture

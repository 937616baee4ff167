#include "archive/meshes/surface_mesh.h"

#include "espalier/base/error.h"

#include "archive/meshes/axis_lines.h"
#include "archive/meshes/bark.h"
#include "archive/meshes/reduction.h"
#include "archive/meshes/skin.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace espalier::archive {
namespace {

constexpr Rgb wood{122, 92, 62}, leaf{70, 130, 50};
constexpr std::size_t most_vertices = std::size_t{1} << 31;

class MeshBuilder {
public:
    MeshBuilder(const FrameGeometry& geometry, const MeshOptions& options)
        : geometry_(geometry),
          options_(options),
          thinnest_(thinnest_radius(geometry)),
          vertex_of_(geometry.points.size()),
          part_of_(geometry.points.size(), 0) {}

    std::vector<PlannedTube> planned_tubes() const {
        std::vector<PlannedTube> tubes;
        for (AxisLine& axis : lines()) {
            tubes.push_back({std::move(axis.line), options_.sides, Caps::round, axis.row});
        }
        return tubes;
    }

    void add(const std::vector<PlannedTube>& tubes) {
        for (const PlannedTube& tube : tubes) {
            if (tube.sides == 0) continue;
            require_room(tube.line.nodes.size() * static_cast<std::size_t>(tube.sides + 1));
            add_tube(tube.line, tube.row, sweep(tube.line, tube.sides, tube.caps));
        }
    }

    void add_skin() {
        const std::vector<AxisLine> axes = lines();
        const std::vector<int> sides(axes.size(), options_.sides);
        const std::vector<Tube> patches = skin_of(axes, sides, options_.skin);
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if (patches[i].triangles.empty()) continue;  // inside others
            require_room(patches[i].vertices.size());
            add_tube(axes[i].line, axes[i].row, patches[i]);
        }
    }

    // Neighbouring cells of one module and kind are one organ.
    void add_surfaces() {
        for (std::size_t cell = 0; cell < geometry_.polygons.size(); ++cell) {
            const std::size_t row = geometry_.polygons.first + cell;
            if (!wanted(row)) continue;
            if (cell == 0 || !open_ || !same_organ(row - 1, row)) {
                end_part();
                begin_part(row);
            }
            add_polygon(cell, row);
        }
        end_part();
    }

    // Before the tubes are swept.
    void reduce(std::vector<PlannedTube>& tubes) {
        const FrameAttributes& of = geometry_.of_points;
        if (options_.distance > 0) degrade(tubes, mesh_, of, smallest_angle * options_.distance);
        if (options_.triangles) archive::reduce(tubes, mesh_, of, *options_.triangles, options_.up);
    }

    FrameMesh take() {
        const auto by_plant = [](const MeshPart& a, const MeshPart& b) { return a.plant < b.plant; };
        std::stable_sort(mesh_.parts.begin(), mesh_.parts.end(), by_plant);
        return std::move(mesh_);
    }

private:
    std::vector<AxisLine> lines() const {
        return axis_lines(geometry_, axis_paths(geometry_, options_), options_.simplify, thinnest_,
                          options_.skin.smooth ? Forks::none : Forks::rings);
    }

    bool wanted(std::size_t row) const { return !options_.plant || geometry_.of_cells.plants[row] == *options_.plant; }

    bool same_organ(std::size_t a, std::size_t b) const {
        const FrameAttributes& of = geometry_.of_cells;
        return of.identities[a] == of.identities[b] && of.kinds[a] == of.kinds[b] && of.plants[a] == of.plants[b] &&
               wanted(a);
    }

    void require_room(std::size_t more) const {
        if (mesh_.points.size() + more < most_vertices) return;
        throw RunError(
            "a mesh would have more than 2^31 vertices; fewer --sides or a larger --simplify make it smaller");
    }

    void begin_part(std::size_t row) {
        const FrameAttributes& of = geometry_.of_cells;
        MeshPart& part = mesh_.parts.emplace_back();
        part.kind = of.kinds[row];
        part.plant = of.plants[row];
        part.identity = of.identities[row];
        part.symbol = geometry_.symbol_names[of.symbols[row]];
        part.first_vertex = mesh_.points.size();
        part.first_triangle = mesh_.triangles.size();
        open_ = true;
    }

    void end_part() {
        if (!std::exchange(open_, false)) return;
        MeshPart& part = mesh_.parts.back();
        part.vertices = mesh_.points.size() - part.first_vertex;
        part.triangles = mesh_.triangles.size() - part.first_triangle;
    }

    std::uint32_t material(const MeshMaterial& wanted_material) {
        const auto [at, is_new] =
            material_number_.emplace(wanted_material, static_cast<std::uint32_t>(mesh_.materials.size()));
        if (is_new) mesh_.materials.push_back(wanted_material);
        return at->second;
    }

    MeshMaterial worn(const Rgb& rgb, std::uint16_t texture) const {
        if (texture == 0) return {rgb, ""};
        // Where no colour is given the picture has it; bark is only brighter and darker.
        const std::string& file = geometry_.texture_files[texture];
        const bool has_own = geometry_.of_cells.rgb.empty() && !is_bark(file);
        return {has_own ? Rgb{255, 255, 255} : rgb, file};
    }

    void add_tube(const TubeLine& line, std::size_t row, const Tube& tube) {
        begin_part(row);
        const std::uint16_t texture = geometry_.textures[row];
        std::vector<std::uint32_t> materials;
        std::vector<Rgb> colours;
        for (const TubeNode& node : line.nodes) {
            colours.push_back(colour_of(geometry_.of_points, node.point.row()));
            materials.push_back(material(worn(colours.back(), texture)));
        }
        const auto origin = static_cast<std::uint32_t>(mesh_.points.size());
        for (const TubeVertex& vertex : tube.vertices) {
            mesh_.points.push_back(upright(vertex.position, options_.up));
            mesh_.normals.push_back(upright(vertex.normal, options_.up));
            mesh_.uvs.push_back(vertex.uv);
            mesh_.rgb.push_back(colours[vertex.node]);
        }
        for (const TubeTriangle& triangle : tube.triangles) {
            mesh_.triangles.push_back(
                {origin + triangle.corners[0], origin + triangle.corners[1], origin + triangle.corners[2]});
            mesh_.material_of.push_back(materials[triangle.node]);
        }
        end_part();
    }

    void add_polygon(std::size_t cell, std::size_t row) {
        const auto corners = geometry_.polygons[cell];
        if (corners.size() < 3) return;
        require_room(corners.size());
        const std::uint16_t texture = geometry_.textures[row];
        const std::uint32_t look = material(worn(colour_of(geometry_.of_cells, row), texture));
        const std::uint32_t first = vertex(corners[0]);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const std::array<std::uint32_t, 3> triangle{first, vertex(corners[i - 1]), vertex(corners[i])};
            mesh_.triangles.push_back(triangle);
            mesh_.material_of.push_back(look);
        }
    }

    // Each part has vertices of its own, also where two share a ring.
    std::uint32_t vertex(std::int32_t point) {
        const auto row = static_cast<std::size_t>(point);
        const auto part = static_cast<std::uint32_t>(mesh_.parts.size());
        if (part_of_[row] == part) return vertex_of_[row];
        part_of_[row] = part;
        mesh_.points.push_back(upright(geometry_.points[row], options_.up));
        const glm::vec3 normal = geometry_.normals[row];
        mesh_.normals.push_back(upright(glm::dot(normal, normal) > 0 ? normal : glm::vec3(0, 1, 0), options_.up));
        mesh_.uvs.push_back(geometry_.uvs[row]);
        mesh_.rgb.push_back(colour_of(geometry_.of_points, row));
        return vertex_of_[row] = static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }

    const FrameGeometry& geometry_;
    const MeshOptions& options_;
    float thinnest_;
    FrameMesh mesh_;
    std::map<MeshMaterial, std::uint32_t> material_number_;
    std::vector<std::uint32_t> vertex_of_;  ///< vertex of a point, within the part that `part_of_` counts (from 1)
    std::vector<std::uint32_t> part_of_;
    bool open_ = false;
};

std::string_view name_of(Kind kind) {
    switch (kind) {
        case Kind::axis:
            return "axis";
        case Kind::polygon:
            return "polygon";
        case Kind::cylinder:
            return "cylinder";
        case Kind::patch:
            return "patch";
        default:
            return "organ";
    }
}

}  // namespace

Rgb colour_of(const FrameAttributes& attributes, std::size_t row) {
    if (!attributes.rgb.empty()) return attributes.rgb[row];
    const Kind kind = attributes.kinds[row];
    return kind == Kind::axis || kind == Kind::cylinder ? wood : leaf;
}

float thinnest_radius(const FrameGeometry& geometry) {
    if (geometry.points.empty()) return 0.001f;
    glm::vec3 lower = geometry.points.front(), upper = lower;
    for (const glm::vec3& point : geometry.points) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    const float diagonal = glm::distance(lower, upper);
    return diagonal > 0 ? diagonal / 1000 : 0.001f;
}

FrameMesh mesh_of(const FrameGeometry& geometry, const MeshOptions& options) {
    MeshBuilder builder(geometry, options);
    if (options.skin.smooth) {
        builder.add_skin();
        builder.add_surfaces();
        return builder.take();
    }
    std::vector<PlannedTube> tubes = builder.planned_tubes();
    if (options.triangles || options.distance > 0) {
        builder.add_surfaces();
        builder.reduce(tubes);
        builder.add(tubes);
    } else {
        builder.add(tubes);
        builder.add_surfaces();
    }
    return builder.take();
}

FrameMesh tubes_of(const FrameGeometry& geometry, const MeshOptions& options) {
    MeshBuilder builder(geometry, options);
    if (options.skin.smooth) {
        builder.add_skin();
    } else {
        builder.add(builder.planned_tubes());
    }
    return builder.take();
}

FrameMesh surfaces_of(const FrameGeometry& geometry, const MeshOptions& options) {
    MeshBuilder builder(geometry, options);
    builder.add_surfaces();
    return builder.take();
}

std::map<std::uint32_t, FrameMesh> by_plant(const FrameMesh& mesh) {
    std::map<std::uint32_t, FrameMesh> plants;
    const auto append = [](auto& to, const auto& from, std::size_t first, std::size_t count) {
        const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
        to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    };
    for (const MeshPart& part : mesh.parts) {
        FrameMesh& own = plants[part.plant];
        if (own.parts.empty()) own.materials = mesh.materials;
        MeshPart& moved = own.parts.emplace_back(part);
        moved.first_vertex = own.points.size();
        moved.first_triangle = own.triangles.size();
        append(own.points, mesh.points, part.first_vertex, part.vertices);
        append(own.normals, mesh.normals, part.first_vertex, part.vertices);
        append(own.uvs, mesh.uvs, part.first_vertex, part.vertices);
        append(own.rgb, mesh.rgb, part.first_vertex, part.vertices);
        append(own.material_of, mesh.material_of, part.first_triangle, part.triangles);
        const auto shift = static_cast<std::uint32_t>(moved.first_vertex - part.first_vertex);  // modulo 2^32
        for (std::size_t i = 0; i < part.triangles; ++i) {
            const auto [a, b, c] = mesh.triangles[part.first_triangle + i];
            own.triangles.push_back({a + shift, b + shift, c + shift});
        }
    }
    return plants;
}

std::string part_name(const RecordedRun& run, const MeshPart& part, std::size_t number) {
    std::string name =
        fmt::format("{}_{}_{}_{}", run.plants()[part.plant].name, name_of(part.kind), part.symbol, number);
    for (char& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!plain) c = '_';
    }
    return name;
}

}  // namespace espalier::archive

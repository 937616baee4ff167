// Surfaces as a walk meets them: those of the view file, and those whose control points the turtle walks to.
#include "espalier/turtle/walk.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::turtle {
namespace {

constexpr double finest = 64;  // quadrilaterals along a side of a patch

int precision(double wanted) {
    return std::isnan(wanted) ? 1 : int(std::clamp(wanted, 1.0, finest));
}

/// Returns the index of a row or column: 0 to 4, whichever way the model counts; -1 if it is neither.
int index_of(double number) {
    return number >= 0 && number < 5 ? int(number) : -1;
}

}  // namespace

void Walk::place_surface(std::uint32_t id, const glm::dvec3& factors) {
    const glm::dvec3 size = factors * turtle().scale;
    if (!std::isfinite(size.x + size.y + size.z)) fail("the size of a surface is not a number");
    Organ organ{
        acting_.module, Organ::Shape::surface, turtle().order, std::uint16_t(turtle().colour), id, turtle().pose, size,
        look()};
    if (!settings_->shapes) {  // without the shapes of surfaces the organ marks where they would be
        add_organ(organ);
        geometry_->bounds.add(turtle().pose.position);
        return;
    }
    const auto found = settings_->shapes->surfaces.find(id);
    if (found == settings_->shapes->surfaces.end()) return;
    const Surface& surface = found->second;
    const Pose pose = turtle().pose;
    const auto in_world = [&](const glm::dvec3& point, const glm::dvec3& scale) {
        return pose.position + scale.x * point.x * pose.left + scale.y * point.y * pose.heading +
               scale.z * point.z * pose.up;
    };
    if (size.x * size.y * size.z != 0) {
        if (surface.texture) organ.look.texture = std::uint16_t(std::max(*surface.texture, 0));
        add_organ(organ);
        for (const BicubicPatch& patch : surface.patches) {
            for (const auto& row : patch.points) {
                for (const glm::dvec3& point : row) geometry_->bounds.add(in_world(point, size));
            }
        }
        for (const auto& triangle : surface.triangles) {
            for (const SurfaceVertex& vertex : triangle) geometry_->bounds.add(in_world(vertex.position, size));
        }
    }
    // All three coordinates go with the first factor.
    const glm::dvec3 end = in_world(surface.end, glm::dvec3(size.x));
    if (end != pose.position) jump(end);
}

void OpenPatches::begin(const Walk& walk, double id, BicubicPatch::Basis basis) {
    if (std::isnan(id)) return;
    Open& patch = open_[std::trunc(id)];
    patch = {basis, walk.turtle().pose.position, {}};
}

void OpenPatches::mark(const Walk& walk, double id, double row, double column) {
    const auto patch = open_.find(std::trunc(id));
    const int i = index_of(row), j = index_of(column);
    if (patch == open_.end() || i < 0 || j < 0) return;
    patch->second.points[std::size_t(i)][std::size_t(j)] = walk.turtle().pose.position;
}

void OpenPatches::draw(const Walk& walk, double id, double rows, double columns) const {
    const auto found = open_.find(std::trunc(id));
    if (found == open_.end()) return;
    const auto& points = found->second.points;
    // A model that counts from 1 fills row 4 or column 4, and neither row 0 nor column 0.
    bool has_first = false, has_last = false;
    for (std::size_t k = 0; k < 5; ++k) {
        has_first = has_first || points[0][k] || points[k][0];
        has_last = has_last || points[4][k] || points[k][4];
    }
    const std::size_t first = has_last && !has_first ? 1 : 0;
    Surface surface;
    BicubicPatch& patch = surface.patches.emplace_back();
    patch.basis = found->second.basis;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            patch.points[i][j] = points[i + first][j + first].value_or(found->second.origin);
        }
    }
    surface.precision_s = precision(rows);
    surface.precision_t = precision(columns);

    const SurfaceMesh mesh = mesh_of(surface);
    DrawnMesh& drawn = walk.geometry().mesh;
    const auto origin = std::uint32_t(drawn.vertices.size());
    const auto first_index = std::uint32_t(drawn.triangles.size());
    for (const SurfaceVertex& vertex : mesh.vertices) {
        drawn.vertices.push_back(vertex);
        walk.geometry().bounds.add(vertex.position);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 4) {
        const auto corner = [&](std::size_t k) { return origin + mesh.indices[i + k]; };
        drawn.triangles.insert(drawn.triangles.end(),
                               {corner(0), corner(1), corner(2), corner(0), corner(2), corner(3)});
    }
    drawn.pieces.push_back({walk.module(), first_index, std::uint32_t(drawn.triangles.size()) - first_index,
                            walk.turtle().order, std::uint16_t(walk.turtle().colour), walk.look(),
                            MeshPiece::Kind::patch});
    walk.require_room();
}

void OpenNets::begin(const Walk& walk, double columns) {
    constexpr double most = 1e6;
    if (!(columns >= 2 && columns <= most)) walk.fail("a net has two to a million columns");
    open_.push_back({std::size_t(columns), walk.module(), std::uint16_t(walk.turtle().colour), walk.look(), {}});
}

void OpenNets::mark(const Walk& walk) {
    if (!open_.empty()) open_.back().points.push_back(walk.turtle().pose.position);
}

void OpenNets::draw(const Walk& walk) {
    if (open_.empty()) return;
    const Open net = std::move(open_.back());
    open_.pop_back();
    const std::size_t columns = net.columns, rows = net.points.size() / columns;
    if (rows < 2) return;
    DrawnMesh& drawn = walk.geometry().mesh;
    const std::size_t origin = drawn.vertices.size(), first = drawn.triangles.size();
    for (std::size_t k = 0; k < rows * columns; ++k) {
        const glm::dvec2 uv(double(k % columns) / double(columns - 1), double(k / columns) / double(rows - 1));
        drawn.vertices.push_back({net.points[k], glm::dvec3(0), uv});
        walk.geometry().bounds.add(net.points[k]);
    }
    const auto add_triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        const auto place = [&](std::size_t k) { return drawn.vertices[origin + k].position; };
        const glm::dvec3 normal = glm::cross(place(b) - place(a), place(c) - place(a));
        for (const std::size_t k : {a, b, c}) {
            drawn.triangles.push_back(std::uint32_t(origin + k));
            drawn.vertices[origin + k].normal += normal;
        }
    };
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t k = row * columns; k + 1 < (row + 1) * columns; ++k) {
            add_triangle(k, k + 1, k + columns + 1);
            add_triangle(k, k + columns + 1, k + columns);
        }
    }
    for (std::size_t k = origin; k < drawn.vertices.size(); ++k) {
        glm::dvec3& normal = drawn.vertices[k].normal;
        const double length = glm::length(normal);
        normal = length > 0 ? normal / length : glm::dvec3(0, 0, 1);
    }
    drawn.pieces.push_back({net.module, std::uint32_t(first), std::uint32_t(drawn.triangles.size() - first),
                            walk.turtle().order, net.colour, net.look, MeshPiece::Kind::patch});
    walk.require_room();
}

}  // namespace espalier::turtle

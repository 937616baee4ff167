#include "geometry/drawn/faces.h"

#include "espalier/base/math.h"

#include "geometry/drawn/organ_mesh.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace espalier::geometry {
namespace {

FaceOwner owner_of(std::uint32_t plant, const Organ& organ, FaceOf of = FaceOf::leaf) {
    return {plant, organ.module, Kind::organ, organ.colour, organ.look.back_colour, organ.look.texture, of};
}

bool is_closed(const MeshPiece& piece) {
    return piece.kind == MeshPiece::Kind::cylinder && !piece.is_open;
}

FaceOwner owner_of(std::uint32_t plant, const MeshPiece& piece) {
    const Kind kind = piece.kind == MeshPiece::Kind::cylinder ? Kind::cylinder : Kind::patch;
    const FaceOf of = is_closed(piece) ? FaceOf::stem : FaceOf::leaf;
    return {plant, piece.module, kind, piece.colour, piece.look.back_colour, piece.look.texture, of};
}

// A square of its area.
std::array<glm::dvec3, 4> square_of(const Organ& disc) {
    const double half = disc.size.x / 4 * std::sqrt(std::numbers::pi);
    const glm::dvec3 along = half * disc.pose.heading, across = half * disc.pose.left, at = disc.pose.position;
    return {at - along - across, at + along - across, at + along + across, at - along + across};
}

glm::dvec3 placed_point(const Organ& organ, const glm::dvec3& point) {
    const glm::dvec3 scaled = organ.size * point;
    return organ.pose.position + scaled.x * organ.pose.left + scaled.y * organ.pose.heading + scaled.z * organ.pose.up;
}

}  // namespace

glm::dvec3 DrawnFace::area() const {
    return area_vector(corners.size(), [this](std::size_t i) { return corners[i]; });
}

glm::dvec3 DrawnFace::middle() const {
    glm::dvec3 sum(0);
    for (const glm::dvec3& corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
}

void DrawnFaces::clear() {
    owners_.clear();
    corners_.clear();
    ends_.assign(1, 0);
}

void DrawnFaces::add(const FaceOwner& owner, std::span<const glm::dvec3> corners) {
    if (corners.empty()) return;
    owners_.push_back(owner);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    ends_.push_back(corners_.size());
}

void DrawnFaces::add_leaves(std::uint32_t plant, const PlantGeometry& geometry, const Palette* palette) {
    for (const Polygon& polygon : geometry.polygons) {
        const Look& look = polygon.look;
        add({plant, polygon.module, Kind::polygon, polygon.colour, look.back_colour, look.texture},
            {&geometry.vertices[polygon.first], polygon.count});
    }
    for (const MeshPiece& piece : geometry.mesh.pieces) {
        if (!is_closed(piece)) add_piece(owner_of(plant, piece), geometry.mesh, piece);
    }
    add_organs(plant, geometry, palette);
}

void DrawnFaces::add_piece(const FaceOwner& owner, const DrawnMesh& mesh, const MeshPiece& piece) {
    const auto corner = [&](std::uint32_t i) { return mesh.vertices[mesh.triangles[i]].position; };
    for (std::uint32_t i = piece.first; i + 2 < piece.first + piece.count; i += 3) {
        add(owner, std::array{corner(i), corner(i + 1), corner(i + 2)});
    }
}

void DrawnFaces::add_organs(std::uint32_t plant, const PlantGeometry& geometry, const Palette* palette) {
    SurfaceMeshes surfaces(geometry.shapes);
    std::vector<glm::dvec3> corners;
    for (const Organ& organ : geometry.organs) {
        if (organ.shape == Organ::Shape::disc) add(owner_of(plant, organ), square_of(organ));
        if (organ.shape != Organ::Shape::surface) continue;
        const SurfaceMeshes::Entry* const surface = surfaces.find(organ.surface);
        if (!surface) {
            add(owner_of(plant, organ), rhombus_of(organ));
            continue;
        }
        for (std::size_t face = 0, next = 0; face < surface->mesh.faces.size(); ++face) {
            FaceOwner owner = owner_of(plant, organ);
            if (palette) {
                const SideColours colours =
                    colours_of_patch({owner.colour, owner.back_colour}, surface->patch(face), palette);
                owner.colour = colours.front;
                owner.back_colour = colours.back;
            }
            corners.clear();
            for (std::uint32_t i = 0; i < surface->mesh.faces[face]; ++i) {
                corners.push_back(placed_point(organ, surface->mesh.vertices[surface->mesh.indices[next++]].position));
            }
            add(owner, corners);
        }
    }
}

void DrawnFaces::add_stems(std::uint32_t plant, const PlantGeometry& geometry) {
    for (std::size_t i = 0; i < geometry.internodes.size(); ++i) {
        const Internode& internode = geometry.internodes[i];
        const std::uint16_t texture = i < geometry.textures.size() ? geometry.textures[i] : std::uint16_t{0};
        add_stem({plant, internode.module, Kind::axis, internode.colour, internode.colour, texture, FaceOf::stem},
                 internode);
    }
}

void DrawnFaces::add_stem(const FaceOwner& owner, const Internode& internode) {
    const glm::dvec3 along = internode.tip - internode.base;
    const double length = glm::length(along);
    if (!(length > 0) || !(internode.base_radius + internode.tip_radius > 0)) return;
    constexpr int sides = 6;
    constexpr double same_perimeter = std::numbers::pi / 3;  // six chords of a circle of this radius are 2 pi long
    const glm::dvec3 x = any_across(along / length), y = glm::cross(along / length, x);
    std::array<glm::dvec3, sides + 1> low, high;
    for (std::size_t i = 0; i <= sides; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i % sides) / sides;
        const glm::dvec3 out = same_perimeter * (math::cos(angle) * x + math::sin(angle) * y);
        low[i] = internode.base + internode.base_radius * out;
        high[i] = internode.tip + internode.tip_radius * out;
    }
    for (std::size_t i = 0; i < sides; ++i) {
        add(owner, std::array{low[i], low[i + 1], high[i + 1]});
        add(owner, std::array{low[i], high[i + 1], high[i]});
    }
}

void DrawnFaces::add_bodies(std::uint32_t plant, const PlantGeometry& geometry) {
    for (const MeshPiece& piece : geometry.mesh.pieces) {
        if (is_closed(piece)) add_piece(owner_of(plant, piece), geometry.mesh, piece);
    }
    OrganMeshes meshes;
    for (const Organ& organ : geometry.organs) {
        if (organ.shape == Organ::Shape::sphere && organ.size.x > 0) add_sphere(plant, organ, meshes);
    }
}

void DrawnFaces::add_sphere(std::uint32_t plant, const Organ& organ, OrganMeshes& meshes) {
    const OrganMesh& mesh = meshes.of(organ);
    const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.faces.indices[i]].position; };
    double surface = 0;
    std::size_t next = 0;
    for (const std::uint32_t count : mesh.faces.counts) {
        surface += glm::length(area_vector(count, [&](std::size_t i) { return corner(next + i); }));
        next += count;
    }
    const double widening = organ.size.x * std::sqrt(std::numbers::pi / surface);
    std::vector<glm::dvec3> corners;
    next = 0;
    for (const std::uint32_t count : mesh.faces.counts) {
        corners.clear();
        for (const std::size_t end = next + count; next < end; ++next) {
            corners.push_back(organ.pose.position + widening * (corner(next) - organ.pose.position));
        }
        add(owner_of(plant, organ, FaceOf::body), corners);
    }
}

}  // namespace espalier::geometry

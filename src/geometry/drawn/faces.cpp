#include "geometry/drawn/faces.h"

#include "espalier/base/math.h"

#include "geometry/drawn/organ_mesh.h"
#include "geometry/opacity.h"
#include "geometry/polygon_texture.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

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

glm::dvec3 unit_normal(std::span<const glm::dvec3> corners) {
    return unit_or(area_vector(corners.size(), [&](std::size_t i) { return corners[i]; }), {0, 0, 1});
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

/// The opacities of a plant's textures, each asked for once.
class WornPictures {
public:
    explicit WornPictures(const Shapes* shapes) : known_(shapes ? shapes->textures.size() : 0), shapes_(shapes) {}

    /// Null if there is no such texture, or no hole in it.
    const Opacity* of(std::uint16_t texture) {
        if (texture == 0 || texture > known_.size()) return nullptr;
        std::optional<std::shared_ptr<const Opacity>>& known = known_[texture - 1u];
        if (!known) known = Opacity::of(shapes_->textures[texture - 1u].file);
        return known->get();
    }

    /// The opaque share of each face of a surface; empty if all are opaque.
    const std::vector<double>& of(const Organ& organ, const SurfaceMeshes::Entry& surface, bool as_whole) {
        const auto [found, is_new] = shares_.try_emplace({organ.surface, organ.look.texture});
        const Opacity* const opacity = is_new ? of(organ.look.texture) : nullptr;
        if (!opacity) return found->second;
        std::vector<glm::dvec2> corners;
        std::size_t next = 0;
        for (const std::uint32_t count : surface.mesh.faces) {
            corners.clear();
            for (const std::size_t end = next + count; next < end; ++next) {
                const std::uint32_t vertex = surface.mesh.indices[next];
                corners.push_back(as_whole ? surface.whole[vertex] : surface.mesh.vertices[vertex].uv);
            }
            found->second.push_back(opacity->over(corners));
        }
        return found->second;
    }

private:
    std::vector<std::optional<std::shared_ptr<const Opacity>>> known_;
    std::map<std::pair<std::uint32_t, std::uint16_t>, std::vector<double>> shares_;
    const Shapes* shapes_;
};

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

void DrawnFaces::add(const FaceOwner& owner, std::span<const glm::dvec3> corners, double opaque) {
    if (corners.empty() || !(opaque > 0)) return;
    owners_.push_back(owner);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    ends_.push_back(corners_.size());
    if (opaque == 1) return;
    const glm::dvec3 middle = (*this)[size() - 1].middle();
    for (std::size_t i = corners_.size() - corners.size(); i < corners_.size(); ++i) {
        corners_[i] = middle + std::sqrt(opaque) * (corners_[i] - middle);
    }
}

void DrawnFaces::add_leaves(std::uint32_t plant, const PlantGeometry& geometry, const Palette* palette) {
    WornPictures pictures(geometry.shapes.get());
    for (const Polygon& polygon : geometry.polygons) {
        const Look& look = polygon.look;
        const std::span corners(&geometry.vertices[polygon.first], polygon.count);
        const Opacity* const opacity = pictures.of(look.texture);
        add({plant, polygon.module, Kind::polygon, polygon.colour, look.back_colour, look.texture}, corners,
            opacity ? opacity->over(texture_coordinates(corners, unit_normal(corners))) : 1);
    }
    for (const MeshPiece& piece : geometry.mesh.pieces) {
        if (!is_closed(piece)) add_piece(owner_of(plant, piece), geometry.mesh, piece, pictures);
    }
    add_organs(plant, geometry, palette, pictures);
}

void DrawnFaces::add_piece(const FaceOwner& owner, const DrawnMesh& mesh, const MeshPiece& piece,
                           WornPictures& pictures) {
    const Opacity* const opacity = owner.of == FaceOf::leaf ? pictures.of(owner.texture) : nullptr;
    const auto corner = [&](std::uint32_t i) -> const SurfaceVertex& { return mesh.vertices[mesh.triangles[i]]; };
    for (std::uint32_t i = piece.first; i + 2 < piece.first + piece.count; i += 3) {
        const SurfaceVertex &a = corner(i), &b = corner(i + 1), &c = corner(i + 2);
        add(owner, std::array{a.position, b.position, c.position},
            opacity ? opacity->over(std::array{a.uv, b.uv, c.uv}) : 1);
    }
}

void DrawnFaces::add_organs(std::uint32_t plant, const PlantGeometry& geometry, const Palette* palette,
                            WornPictures& pictures) {
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
        const std::vector<double>& opaque = pictures.of(organ, *surface, surfaces.textured_as_whole(organ));
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
            add(owner, corners, opaque.empty() ? 1 : opaque[face]);
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
    WornPictures pictures(nullptr);
    for (const MeshPiece& piece : geometry.mesh.pieces) {
        if (is_closed(piece)) add_piece(owner_of(plant, piece), geometry.mesh, piece, pictures);
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

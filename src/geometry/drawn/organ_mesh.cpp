#include "geometry/drawn/organ_mesh.h"

#include "espalier/base/math.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace espalier::geometry {
namespace {

constexpr std::uint32_t sides_of_discs = 16;

std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

std::vector<glm::dvec4> angles_of_ring(std::uint32_t sides) {
    std::vector<glm::dvec4> angles;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        angles.emplace_back(math::cos(angle), math::sin(angle), 0, 0);
    }
    return angles;
}

void place_ring(const Organ& organ, const std::vector<glm::dvec4>& angles, std::vector<SurfaceVertex>& vertices) {
    const Pose& pose = organ.pose;
    const glm::dvec3 normal = glm::cross(pose.heading, pose.left);
    vertices.clear();
    for (const glm::dvec4& angle : angles) {
        const double x = angle.x, y = angle.y;
        vertices.push_back({pose.position + organ.size.x / 2 * (x * pose.heading + y * pose.left),
                            normal,
                            {(1 + x) / 2, (1 + y) / 2}});
    }
}

/// Meridians and bands of a sphere; its vertices are the first pole, ring after ring, and the other pole.
class SphereGrid {
public:
    explicit SphereGrid(std::uint32_t sides)
        : meridians_(std::max<std::uint32_t>(sides, 3)), bands_(std::max<std::uint32_t>(meridians_ * 3 / 4, 2)) {}

    template <class Visit>
    void for_vertices(const Visit& visit) const {
        visit(0.0, 0.0);
        for (std::uint32_t band = 1; band < bands_; ++band) {
            for (std::uint32_t i = 0; i < meridians_; ++i) visit(double(band) / bands_, double(i) / meridians_);
        }
        visit(1.0, 0.0);
    }

    // Quadrilaterals that face outward (left, up and heading are a left-handed frame); triangles at the poles.
    IndexRuns faces() const {
        IndexRuns faces;
        for (std::uint32_t band = 0; band < bands_; ++band) {
            for (std::uint32_t i = 0; i < meridians_; ++i) {
                // Counter-clockwise seen from outside: up = left x heading runs clockwise about the heading.
                std::vector<std::uint32_t> face{index(band + 1, i), index(band, i)};
                if (band > 0) face.push_back(index(band, i + 1));
                if (band + 1 < bands_) face.push_back(index(band + 1, i + 1));
                faces.add(face);
            }
        }
        return faces;
    }

private:
    std::uint32_t index(std::uint32_t ring, std::uint32_t meridian) const {
        if (ring == 0) return 0;
        if (ring == bands_) return (bands_ - 1) * meridians_ + 1;
        return 1 + (ring - 1) * meridians_ + meridian % meridians_;
    }

    const std::uint32_t meridians_, bands_;
};

void place_sphere(const Organ& organ, const std::vector<glm::dvec4>& angles, std::vector<SurfaceVertex>& vertices) {
    const Pose& pose = organ.pose;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec4& a = angles[i];
        vertices[i].normal = a.x * pose.heading + a.y * (a.z * pose.left + a.w * pose.up);
        vertices[i].position = pose.position + organ.size.x / 2 * vertices[i].normal;
    }
}

void place_rhombus(const Organ& organ, std::vector<SurfaceVertex>& vertices) {
    const std::array<glm::dvec3, 4> corners = rhombus_of(organ);
    constexpr glm::dvec2 uvs[] = {{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}};
    vertices.resize(4);
    for (std::size_t i = 0; i < 4; ++i) vertices[i] = {corners[i], organ.pose.up, uvs[i]};
}

/// x and y of the vertices as shares of the box they fill.
std::vector<glm::dvec2> shares_of_box(const SurfaceMesh& mesh) {
    Box box;
    for (const SurfaceVertex& vertex : mesh.vertices) box.add(vertex.position);
    const glm::dvec2 extent(glm::max(box.upper - box.lower, glm::dvec3(1e-300)));
    std::vector<glm::dvec2> shares;
    for (const SurfaceVertex& vertex : mesh.vertices) {
        shares.push_back(glm::dvec2(vertex.position - box.lower) / extent);
    }
    return shares;
}

std::vector<const BicubicPatch*> patches_of_vertices(const Surface& surface, const SurfaceMesh& mesh) {
    std::vector<const BicubicPatch*> patches(mesh.vertices.size(), nullptr);
    std::size_t at = 0;
    for (std::size_t face = 0; face < mesh.patches.size(); ++face) {
        for (std::size_t k = 0; k < mesh.faces[face]; ++k) {
            patches[mesh.indices[at++]] = &surface.patches[mesh.patches[face]];
        }
    }
    return patches;
}

std::uint32_t sides_of_ring(const Organ& organ) {
    return std::max<std::uint32_t>(sides_of_discs, organ.sides);
}

}  // namespace

void IndexRuns::add(const std::vector<std::uint32_t>& run) {
    counts.push_back(static_cast<std::uint32_t>(run.size()));
    indices.insert(indices.end(), run.begin(), run.end());
}

const OrganMesh& OrganMeshes::disc(const Organ& organ) {
    Round& disc = discs_[sides_of_ring(organ)];
    if (disc.angles.empty()) {
        disc.angles = angles_of_ring(sides_of_ring(organ));
        disc.mesh.faces.add(counted(disc.angles.size()));
    }
    place_ring(organ, disc.angles, disc.mesh.vertices);
    return disc.mesh;
}

const OrganMesh& OrganMeshes::circle(const Organ& organ) {
    Round& circle = circles_[sides_of_ring(organ)];
    if (circle.angles.empty()) {
        circle.angles = angles_of_ring(sides_of_ring(organ));
        std::vector<std::uint32_t> closed = counted(circle.angles.size());
        closed.push_back(0);
        circle.mesh.outlines.add(closed);
    }
    place_ring(organ, circle.angles, circle.mesh.vertices);
    return circle.mesh;
}

const OrganMesh& OrganMeshes::sphere(const Organ& organ) {
    Round& sphere = spheres_[organ.sides];
    if (sphere.angles.empty()) {
        const SphereGrid grid(organ.sides);
        grid.for_vertices([&](double down, double round) {
            const double polar = std::numbers::pi * down, around = 2 * std::numbers::pi * round;
            sphere.angles.emplace_back(math::cos(polar), math::sin(polar), math::cos(around), math::sin(around));
            sphere.mesh.vertices.push_back({{}, {}, {round, 1 - down}});
        });
        sphere.mesh.faces = grid.faces();
    }
    place_sphere(organ, sphere.angles, sphere.mesh.vertices);
    return sphere.mesh;
}

const OrganMesh& OrganMeshes::rhombus(const Organ& organ) {
    if (rhombus_.faces.counts.empty()) rhombus_.faces.add(counted(4));
    place_rhombus(organ, rhombus_.vertices);
    return rhombus_;
}

const OrganMesh& OrganMeshes::of(const Organ& organ) {
    switch (organ.shape) {
        case Organ::Shape::disc:
            return disc(organ);
        case Organ::Shape::circle:
            return circle(organ);
        case Organ::Shape::sphere:
            return sphere(organ);
        case Organ::Shape::surface:
            break;
    }
    return rhombus(organ);
}

const SurfaceMeshes::Entry* SurfaceMeshes::find(std::uint32_t id) {
    const auto known = entries_.find(id);
    if (known != entries_.end()) return &known->second;
    if (!shapes_) return nullptr;
    const auto surface = shapes_->surfaces.find(id);
    if (surface == shapes_->surfaces.end()) return nullptr;
    Entry entry{&surface->second, mesh_of(surface->second), {}, {}};
    entry.whole = shares_of_box(entry.mesh);
    entry.patches = patches_of_vertices(surface->second, entry.mesh);
    return &entries_.emplace(id, std::move(entry)).first->second;
}

bool SurfaceMeshes::textured_as_whole(const Organ& organ) const {
    const std::size_t texture = organ.look.texture;
    return texture >= 1 && texture <= shapes_->textures.size() && shapes_->textures[texture - 1].per_surface;
}

SideColours colours_of_patch(SideColours organ, const BicubicPatch* patch, const Palette* palette) {
    if (!patch || (palette && palette->of_materials)) return organ;
    if (patch->top_colour > 0) organ.front = static_cast<std::uint16_t>(patch->top_colour);
    if (patch->bottom_colour > 0) organ.back = static_cast<std::uint16_t>(patch->bottom_colour);
    return organ;
}

std::array<glm::dvec3, 4> rhombus_of(const Organ& organ) {
    const Pose& pose = organ.pose;
    const glm::dvec3 middle = pose.position + 0.5 * organ.size.y * pose.heading;
    const glm::dvec3 half_width = 0.25 * organ.size.x * pose.left;
    return {pose.position, middle + half_width, pose.position + organ.size.y * pose.heading, middle - half_width};
}

SurfaceVertex placed(const SurfaceVertex& vertex, const Organ& organ) {
    const Pose& pose = organ.pose;
    const auto in_world = [&](const glm::dvec3& v) { return v.x * pose.left + v.y * pose.heading + v.z * pose.up; };
    // Normals are stretched by the cofactors, so that they stay normals and go with the faces, mirrored or not.
    const glm::dvec3 &s = organ.size, cofactors(s.y * s.z, s.z * s.x, s.x * s.y);
    const glm::dvec3 normal = in_world(vertex.normal * cofactors);
    const double length = glm::length(normal);
    return {pose.position + in_world(vertex.position * s), length > 0 ? normal / length : pose.up, vertex.uv};
}

}  // namespace espalier::geometry

#include "timeline/organ_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace espalier {
namespace {

constexpr std::uint32_t sides_of_discs = 16;

std::vector<SurfaceVertex> ring(const Organ& organ) {
    const Pose& pose = organ.pose;
    const std::uint32_t sides = std::max<std::uint32_t>(sides_of_discs, organ.sides);
    std::vector<SurfaceVertex> vertices;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        const double x = std::cos(angle), y = std::sin(angle);
        vertices.push_back({pose.position + organ.size.x / 2 * (x * pose.heading + y * pose.left),
                            glm::cross(pose.heading, pose.left),
                            {(1 + x) / 2, (1 + y) / 2}});
    }
    return vertices;
}

std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

OrganMesh disc(const Organ& organ) {
    const auto vertices = ring(organ);
    return {vertices, {counted(vertices.size())}, {}};
}

OrganMesh circle(const Organ& organ) {
    const auto vertices = ring(organ);
    std::vector<std::uint32_t> closed = counted(vertices.size());
    closed.push_back(0);
    return {vertices, {}, {closed}};
}

class Sphere {
public:
    explicit Sphere(const Organ& organ)
        : organ_(organ),
          meridians_(std::max<std::uint32_t>(organ.sides, 3)),
          bands_(std::max<std::uint32_t>(meridians_ * 3 / 4, 2)) {}

    OrganMesh mesh() {
        add_vertex(0, 0);
        for (std::uint32_t band = 1; band < bands_; ++band) {
            for (std::uint32_t i = 0; i < meridians_; ++i) add_vertex(double(band) / bands_, double(i) / meridians_);
        }
        add_vertex(1, 0);
        for (std::uint32_t band = 0; band < bands_; ++band) add_band(band);
        return std::move(mesh_);
    }

private:
    void add_vertex(double down, double round) {
        const double polar = std::numbers::pi * down, around = 2 * std::numbers::pi * round;
        const Pose& pose = organ_.pose;
        const glm::dvec3 outward = std::cos(polar) * pose.heading +
                                   std::sin(polar) * (std::cos(around) * pose.left + std::sin(around) * pose.up);
        mesh_.vertices.push_back({pose.position + organ_.size.x / 2 * outward, outward, {round, 1 - down}});
    }

    // Quadrilaterals that face outward (left, up and heading are a left-handed frame); triangles at the poles.
    void add_band(std::uint32_t band) {
        const auto index = [&](std::uint32_t ring_number, std::uint32_t meridian) {
            if (ring_number == 0) return 0u;
            if (ring_number == bands_) return (bands_ - 1) * meridians_ + 1;
            return 1 + (ring_number - 1) * meridians_ + meridian % meridians_;
        };
        for (std::uint32_t i = 0; i < meridians_; ++i) {
            // Counter-clockwise seen from outside: up = left x heading runs clockwise about the heading.
            std::vector<std::uint32_t> face{index(band + 1, i), index(band, i)};
            if (band > 0) face.push_back(index(band, i + 1));
            if (band + 1 < bands_) face.push_back(index(band + 1, i + 1));
            mesh_.faces.push_back(std::move(face));
        }
    }

    const Organ& organ_;
    const std::uint32_t meridians_, bands_;
    OrganMesh mesh_;
};

OrganMesh rhombus(const Organ& organ) {
    const Pose& pose = organ.pose;
    const glm::dvec3 middle = pose.position + 0.5 * organ.size.y * pose.heading;
    const glm::dvec3 half_width = 0.25 * organ.size.x * pose.left;
    return {{{pose.position, pose.up, {0.5, 0}},
             {middle + half_width, pose.up, {1, 0.5}},
             {pose.position + organ.size.y * pose.heading, pose.up, {0.5, 1}},
             {middle - half_width, pose.up, {0, 0.5}}},
            {counted(4)},
            {}};
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

}  // namespace

OrganMesh mesh_of(const Organ& organ) {
    switch (organ.shape) {
        case Organ::Shape::disc:
            return disc(organ);
        case Organ::Shape::circle:
            return circle(organ);
        case Organ::Shape::sphere:
            return Sphere(organ).mesh();
        case Organ::Shape::surface:
            return rhombus(organ);
    }
    return {};
}

const SurfaceMeshes::Entry* SurfaceMeshes::find(std::uint32_t id) {
    const auto known = entries_.find(id);
    if (known != entries_.end()) return &known->second;
    const auto surface = shapes_.surfaces.find(id);
    if (surface == shapes_.surfaces.end()) return nullptr;
    Entry entry{&surface->second, mesh_of(surface->second), {}};
    entry.whole = shares_of_box(entry.mesh);
    return &entries_.emplace(id, std::move(entry)).first->second;
}

bool SurfaceMeshes::textured_as_whole(const Organ& organ) const {
    const std::size_t texture = organ.look.texture;
    return texture >= 1 && texture <= shapes_.textures.size() && shapes_.textures[texture - 1].per_surface;
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

}  // namespace espalier

#include "picture/landscape/ray_mesh.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace espalier::picture {
namespace {

glm::vec3 bright(const Rgb& rgb) {
    return glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0F;
}

/// Returns the place of a texel of a picture that repeats.
std::size_t texel_at(float share, std::size_t count) {
    const float inside = share - std::floor(share);
    return std::min(count - 1, static_cast<std::size_t>(inside * static_cast<float>(count)));
}

}  // namespace

RayMesh::RayMesh(const FrameMesh& mesh, const TextureOf& texture_of) : points_(mesh.points), normals_(mesh.normals) {
    for (const MeshMaterial& material : mesh.materials) {
        looks_.push_back({bright(material.rgb), material.texture.empty() ? nullptr : texture_of(material.texture)});
    }
    if (looks_.size() > 0xffff) throw RunError("a plant of a landscape has more than 65535 materials");
    const auto wears = [](const Look& look) { return look.texture != nullptr; };
    if (std::any_of(looks_.begin(), looks_.end(), wears)) uvs_ = mesh.uvs;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        triangles_.push_back({mesh.triangles[i], static_cast<std::uint16_t>(mesh.material_of[i]), false});
    }
    for (const MeshPart& part : mesh.parts) {
        if (part.kind == Kind::axis) continue;
        for (std::size_t i = 0; i < part.triangles; ++i) triangles_[part.first_triangle + i].is_thin = true;
    }
}

std::vector<glm::vec3> RayMesh::corners() const {
    std::vector<glm::vec3> corners;
    corners.reserve(3 * triangles_.size());
    for (const Triangle& triangle : triangles_) {
        for (const std::uint32_t corner : triangle.corners) corners.push_back(points_[corner]);
    }
    return corners;
}

bool RayMesh::is_opaque(const Hit& hit) const {
    const Triangle& triangle = triangles_[hit.triangle];
    if (!looks_[triangle.material].texture) return true;
    const int opacity = texel(triangle, hit.u, hit.v)[3];
    const std::uint64_t place =
        std::uint64_t{std::bit_cast<std::uint32_t>(hit.u)} << 32 | std::bit_cast<std::uint32_t>(hit.v);
    return static_cast<int>(mix(place) % 255) < opacity;
}

const OpacityPicture::Pixel& RayMesh::texel(const Triangle& triangle, float u, float v) const {
    const OpacityPicture& picture = *looks_[triangle.material].texture;
    const auto [a, b, c] = triangle.corners;
    const glm::vec2 place = (1 - u - v) * uvs_[a] + u * uvs_[b] + v * uvs_[c];
    return picture.at(texel_at(place.x, picture.width), texel_at(1 - place.y, picture.height));
}

RaySurface RayMesh::surface(const Hit& hit) const {
    const Triangle& triangle = triangles_[hit.triangle];
    const auto [a, b, c] = triangle.corners;
    const Look& look = looks_[triangle.material];
    glm::vec3 normal = (1 - hit.u - hit.v) * normals_[a] + hit.u * normals_[b] + hit.v * normals_[c];
    if (glm::length(normal) < 0.1F) normal = glm::cross(points_[b] - points_[a], points_[c] - points_[a]);
    RaySurface surface{glm::normalize(normal), look.colour, triangle.is_thin};
    if (look.texture) {
        const OpacityPicture::Pixel& pixel = texel(triangle, hit.u, hit.v);
        surface.colour *= bright({pixel[0], pixel[1], pixel[2]});
    }
    return surface;
}

std::size_t RayMesh::bytes() const {
    return points_.size() * 2 * sizeof(glm::vec3) + uvs_.size() * sizeof(glm::vec2) +
           triangles_.size() * (sizeof(Triangle) + geometry::RayScene::bytes_per_triangle);
}

}  // namespace espalier::picture

// Triangles that rays meet, with their colours and textures.
#pragma once

#include "archive/meshes/surface_mesh.h"
#include "base/png_file.h"
#include "picture/landscape/box_tree.h"

#include <functional>
#include <memory>
#include <optional>

namespace espalier::picture {

/// The picture of a texture file; null if there is none.
using TextureOf = std::function<std::shared_ptr<const OpacityPicture>(const std::string& file)>;

struct RaySurface {
    glm::vec3 normal;  ///< a vector of length 1
    glm::vec3 colour;  ///< 0 to 1
    bool is_thin;      ///< light goes through
};

class RayMesh {
public:
    RayMesh(const FrameMesh& mesh, const TextureOf& texture_of);

    struct Hit {
        std::uint32_t triangle;
        float u, v;  ///< weights of the second and third corner
    };
    /// The nearest opaque place, to which the ray is shortened.
    std::optional<Hit> hit(Ray& ray) const;
    /// Whether anything opaque lies on the ray.
    bool blocks(Ray ray) const;
    RaySurface surface(const Hit& hit) const;

    const RayBox& bounds() const { return bounds_; }
    std::size_t bytes() const;

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;
        std::uint16_t material;
        bool is_thin;
    };
    struct Look {
        glm::vec3 colour;
        std::shared_ptr<const OpacityPicture> texture;
    };

    bool meets(const Ray& ray, const Triangle& triangle, float& distance, float& u, float& v) const;
    bool is_opaque(const Triangle& triangle, float u, float v) const;
    const OpacityPicture::Pixel& texel(const Triangle& triangle, float u, float v) const;

    std::vector<glm::vec3> points_, normals_;
    std::vector<glm::vec2> uvs_;  ///< empty where nothing wears a texture
    std::vector<Triangle> triangles_;
    std::vector<Look> looks_;
    std::optional<BoxTree> tree_;
    RayBox bounds_;
};

}  // namespace espalier::picture

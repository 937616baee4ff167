// What stands in the light of a traced picture: triangles with their colours, and the ground.
#pragma once

#include "espalier/archive/mesh_options.h"

#include "geometry/rays/ray_scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace espalier::picture {

/// A picture on surfaces; it repeats.
struct LitTexture {
    int width = 0, height = 0;
    std::vector<std::array<std::uint8_t, 4>> pixels;  ///< row by row, the lowest first; the fourth part is opacity

    /// Between the middles of pixels. `uv` (0, 0) is the lower left corner of the picture.
    glm::vec4 at(const glm::vec2& uv, bool is_colour) const;
};

/// A mesh. The spans belong to `owner`, or to something else that lives as long.
struct LitPart {
    std::span<const glm::vec3> points, normals;
    std::span<const glm::vec2> uvs;
    std::span<const std::int32_t> corners;                  ///< three a triangle
    std::vector<std::array<std::uint8_t, 3>> colours;       ///< of points, as on a screen
    std::vector<std::array<std::uint8_t, 3>> emissions{};   ///< of points; empty where nothing glows
    std::vector<float> opacities{};                         ///< of points; empty where nothing is seen through
    std::shared_ptr<const LitTexture> texture{}, relief{};  ///< relief: normals in the tangent space
    bool is_thin = false;                                   ///< light that falls on one side leaves by the other, too
    std::shared_ptr<const void> owner{};
};

/// Level ground at height 0.
struct LitGround {
    glm::dvec3 middle{0};
    double radius = 1;  ///< of what stands on it
    glm::vec3 reflectance{0.2F};
    bool is_disc = false;  ///< it fades away towards the radius; else it goes on to the horizon
};

/// Short grass, dry here and there.
inline constexpr glm::vec3 open_ground{0.21F, 0.22F, 0.10F};

/// Light that a surface sends back and lets through, as shares of what falls on it.
struct LitSurface {
    glm::vec3 point;
    glm::vec3 flat;    ///< normal of the triangle, on the side of the ray
    glm::vec3 normal;  ///< normal of the smooth surface, on that side
    glm::vec3 reflectance, transmittance{0}, emission{0};
    float side = 1;  ///< -1: the normals of the mesh point to the other side
    float opacity = 1;
    float distance = 0;
    bool is_ground = false;
    std::uint32_t part = 0, triangle = 0;  ///< where it is no ground
};

class LitScene {
public:
    /// Throws RunError if there is no memory for it.
    LitScene(std::vector<LitPart> parts, const std::optional<LitGround>& ground);

    /// The nearest surface, opaque or not, further away than `from`.
    std::optional<LitSurface> seen(const glm::vec3& origin, const glm::vec3& direction, float from) const;
    /// The same without colours and relief.
    std::optional<LitSurface> met(const glm::vec3& origin, const glm::vec3& direction, float from) const;
    /// met() of four rays beside each other, quicker; from their origins on.
    using FourSurfaces = std::array<std::optional<LitSurface>, 4>;
    FourSurfaces met(std::span<const glm::vec3, 4> origins, std::span<const glm::vec3, 4> directions) const;
    /// The share of light that comes straight through.
    float clearness(const glm::vec3& origin, const glm::vec3& direction) const;
    /// How far rays leave a point before they may meet something: surfaces do not meet themselves.
    float gap(const glm::vec3& point) const;

    const std::optional<LitGround>& ground() const { return ground_; }

private:
    /// The triangle counts from the first of its part.
    void tell_part(geometry::RayScene::Hit& hit) const;
    std::optional<geometry::RayScene::Hit> first_hit(const glm::vec3& origin, const glm::vec3& direction, float from,
                                                     float to) const;
    LitSurface surface(const geometry::RayScene::Hit& hit, const glm::vec3& direction) const;
    LitSurface uncoloured(const geometry::RayScene::Hit& hit, const glm::vec3& direction) const;
    /// Without colours, texture and relief.
    LitSurface bare_surface(const geometry::RayScene::Hit& hit, const glm::vec3& direction) const;
    std::optional<LitSurface> on_ground(const glm::vec3& origin, const glm::vec3& direction, float from) const;

    std::vector<LitPart> parts_;
    std::vector<std::uint32_t> first_triangles_;  ///< of each part
    std::optional<LitGround> ground_;
    geometry::RayScene rays_;
    bool is_opaque_ = true;
    float size_ = 1;
};

/// Reflectance and transmittance of a leaf or petal that is seen in this colour; together they are at most 0.95.
struct ThinOptics {
    glm::vec3 reflectance, transmittance;
};
ThinOptics thin_optics(const glm::vec3& colour);

}  // namespace espalier::picture

// How much of the sky and of the sun reaches points among triangles. It does not depend on where one looks from.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::picture {

/// Triangles whose corners index points.
struct Occluder {
    std::span<const glm::vec3> points;
    std::span<const std::int32_t> corners;  ///< three a triangle
};

/// Depths of what a direction sees first, in parallel projection.
class DepthMap {
public:
    /// `towards`: the unit vector to the light. `texels` along a side.
    DepthMap(const glm::vec3& towards, int texels, const glm::vec3& lower, const glm::vec3& upper);

    void add(const Occluder& occluder);
    /// The share of `reach` texels to each side, and the one in the middle, that see past the point's own surroundings.
    float open(const glm::vec3& point, int reach) const;

    const glm::vec3& towards() const { return towards_; }
    float texel() const { return texel_; }  ///< its side

private:
    glm::vec3 place(const glm::vec3& point) const;
    /// A triangle whose corners are placed.
    void cover(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r);

    glm::vec3 towards_, right_, up_;
    glm::vec2 origin_{0};
    float texel_, texels_per_metre_;
    int texels_;
    std::vector<float> depths_;
};

/// The unit vector to a light at so many degrees round the vertical (0: from +z) and above the horizon.
glm::vec3 direction_at(double azimuth, double elevation);

class SkyVisibility {
public:
    /// `sun`: the unit vector to it. Equal triangles give equal light, with any number of threads.
    SkyVisibility(std::span<const Occluder> occluders, const glm::vec3& sun);
    /// Nothing is there yet of some millions of triangles between these corners.
    SkyVisibility(const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& sun);
    void add(std::span<const Occluder> occluders);

    /// Returns the free part of the sky above a surface, 0 to 1. What is lit from both sides takes the light of both.
    float sky(const glm::vec3& point, const glm::vec3& normal, bool both_sides) const;
    /// Returns the part of the sun that is free, whatever the angle at which it shines. Shadows fade over `softness`
    /// texels of the sun's map to either side.
    float sun(const glm::vec3& point, int softness) const;

private:
    SkyVisibility(const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& sun, std::size_t directions);

    std::vector<DepthMap> sky_;
    std::vector<DepthMap> sun_;  ///< one
};

}  // namespace espalier::picture

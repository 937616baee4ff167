// Light that comes to an eye along rays, by paths that go back from it to sun and sky.
#pragma once

#include "picture/light/lit_scene.h"
#include "picture/light/sky_light.h"

#include <array>
#include <cstdint>

namespace espalier::picture {

/// Four numbers after the other for one path, the same for the same sample of the same pixel.
class PathNumbers {
public:
    PathNumbers(std::uint64_t pixel, std::uint32_t sample) : pixel_(pixel), sample_(sample) {}
    std::array<float, 4> next();

private:
    std::uint64_t pixel_;
    std::uint32_t sample_, set_ = 0;
};

/// Lambert's law on both sides: surfaces send back and let through what falls on them in all directions alike (Kajiya
/// 1986). The sun is looked for at every surface, the sky where paths leave the scene. Both must outlive it.
class PathTracer {
public:
    /// `far_ground`: reflectance of what lies below the horizon where the scene has no ground.
    PathTracer(const LitScene& scene, const SkyLight& light, const glm::vec3& far_ground)
        : scene_(scene), light_(light), far_ground_(far_ground) {}

    /// What a ray sees, and how opaque it is: 1 wherever the sky is part of the picture.
    struct Seen {
        glm::vec3 radiance{0};
        float opacity = 1;
    };
    /// `shows_sky`: else a ray that meets nothing sees nothing, and the ground fades.
    Seen seen(const glm::vec3& origin, const glm::vec3& direction, bool shows_sky, PathNumbers& numbers) const;

    /// The radiance far away: of the sky, and of open ground below the horizon.
    glm::vec3 far_away(const glm::vec3& towards) const;

private:
    /// The surface that a path meets next; what is seen through lets some paths go on.
    std::optional<LitSurface> next_surface(const glm::vec3& origin, const glm::vec3& direction, float from,
                                           float chance) const;
    glm::vec3 sunlight(const LitSurface& surface, float u, float v) const;
    /// What a surface sends to the eye, and in `emission` what it gives by itself.
    glm::vec3 scattered(const LitSurface& first, PathNumbers& numbers) const;
    float presence(const LitSurface& ground) const;
    glm::vec3 through_haze(const LitSurface& ground, const glm::vec3& radiance, const glm::vec3& direction) const;

    const LitScene& scene_;
    const SkyLight& light_;
    glm::vec3 far_ground_;
};

}  // namespace espalier::picture

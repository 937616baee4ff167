// Sun and sky of traced pictures: how bright each direction is, and in which colour.
#pragma once

#include "espalier/picture/picture_style.h"

#include "geometry/sky/radiance.h"

#include <glm/vec3.hpp>

#include <array>

namespace espalier::picture {

/// What a clear air leaves of the light of a sun that stands `sun_angle` radians from the zenith, klx on a plane across
/// it: Preetham, Shirley & Smits 1999, appendix A.1, at a wavelength for each primary of the screen, without ozone,
/// water vapour and mixed gases.
glm::vec3 sun_through_air(double turbidity, double sun_angle);

/// Radiances are kcd/m2 and irradiances klx, each as a linear colour of the screen's primaries.
class SkyLight {
public:
    /// `towards_sun`: a unit vector. A sun that stands lower than 3 degrees is taken to stand there.
    SkyLight(const PictureSky& sky, const glm::vec3& towards_sun);

    /// Of a unit vector above the horizon, the sun's disc left out.
    glm::vec3 sky(const glm::vec3& towards) const;
    /// Of the horizon above or below a direction.
    glm::vec3 horizon(const glm::vec3& towards) const;

    bool has_sun() const { return sun_ != glm::vec3(0); }
    const glm::vec3& towards_sun() const { return towards_sun_; }
    /// On a plane across its direction.
    const glm::vec3& sun() const { return sun_; }
    /// A direction to the sun's disc, evenly distributed over it for two even numbers in [0, 1).
    glm::vec3 towards_disc(float u, float v) const;
    bool is_on_disc(const glm::vec3& towards) const;
    /// Of the disc.
    glm::vec3 disc() const;

    /// On open level ground, by sun and sky.
    glm::vec3 on_ground() const { return sky_on_ground_ + sun_ * towards_sun_.y; }
    const glm::vec3& sky_on_ground() const { return sky_on_ground_; }

private:
    glm::vec3 clear(const glm::vec3& towards) const;
    void measure_sky();

    PictureSky::Kind kind_;
    glm::vec3 towards_sun_;
    double turbidity_, sun_angle_;
    std::array<SkyRadiance, 3> clear_;  ///< x, y and Y of a clear sky, up to `scale_`
    glm::dvec3 scale_{0};
    glm::vec3 sun_{0}, sky_on_ground_{0};
};

}  // namespace espalier::picture

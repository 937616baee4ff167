#include "studio/session/sky_message.h"

#include "picture/light/sky_light.h"

#include <algorithm>
#include <cmath>

namespace espalier::studio {
namespace {

struct SkyOfStep {
    static constexpr TypeName type{"SkyOfStep", "the light of a step"};
    std::uint32_t growth = 0;
    int step = 0;
    ShownSky sky;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("step", self.step, "that it falls on", at_least(0));
        field("sky", self.sky, "of the first process of the scene that has a sky");
    }
};

const Message<SkyOfStep> sky_message_type{"sky", "before the packet of a step, if a process of the scene has a sky"};

/// As in the pictures of `render --light`.
std::array<double, 3> colour_of_sun(const glm::dvec3& towards) {
    const glm::vec3 light =
        picture::sun_through_air(PictureSky().turbidity, std::acos(std::clamp(towards.y, 0.0, 1.0)));
    const float most = std::max({light.r, light.g, light.b});
    return {light.r / most, light.g / most, light.b / most};
}

}  // namespace

ShownSky shown_sky(const environment::StepSky& sky) {
    ShownSky shown{{}, {1, 1, 1}, sky.diffuse, sky.par};
    if (!sky.sun) return shown;
    shown.sun = std::array{sky.sun->x, sky.sun->y, sky.sun->z};
    shown.colour = colour_of_sun(*sky.sun);
    return shown;
}

Json sky_message(std::uint32_t growth, int step, const environment::StepSky& sky) {
    return sky_message_type({growth, step, shown_sky(sky)});
}

}  // namespace espalier::studio

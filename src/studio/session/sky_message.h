// What pages are told of the sun and the sky of a step.
#pragma once

#include "environment/light/sky/scene_sky.h"
#include "studio/session/message.h"

#include <array>
#include <cstdint>

namespace espalier::studio {

struct ShownSky {
    static constexpr TypeName type{"Sky", "the light of a step, with one sun for all that shine during the step"};
    Nullable<std::array<double, 3>> sun;
    std::array<double, 3> colour{1, 1, 1};
    double diffuse = 1, par = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("sun", self.sun,
              "unit vector to the sun that brings most light to level ground; null if all light comes from the sky");
        field("colour", self.colour, "of the sun behind the air: red, green and blue, linear, the largest 1");
        field("diffuse", self.diffuse, "share of the sky in the light on open level ground", between(0, 1));
        field("par", self.par, "PAR there while there is light, umol m-2 s-1; 0: it is dark", at_least(0));
    }
};

ShownSky shown_sky(const environment::StepSky& sky);

/// Told before the packet of the step.
Json sky_message(std::uint32_t growth, int step, const environment::StepSky& sky);

}  // namespace espalier::studio

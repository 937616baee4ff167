// Colours as light: linear in energy, with the primaries of the screen (IEC 61966-2-1, sRGB).
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace espalier::picture {

/// Of a channel of the screen from 0 to 1.
inline float linear_of_screen(float share) {
    return share <= 0.04045F ? share / 12.92F : std::pow((share + 0.055F) / 1.055F, 2.4F);
}
inline float screen_of_linear(float share) {
    return share <= 0.0031308F ? share * 12.92F : 1.055F * std::pow(share, 1 / 2.4F) - 0.055F;
}

/// A colour of a model as the share of each primary that a surface sends back.
inline glm::vec3 linear_of(const std::array<std::uint8_t, 3>& rgb) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> all{};
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = linear_of_screen(static_cast<float>(i) / 255);
        return all;
    }();
    return {table[rgb[0]], table[rgb[1]], table[rgb[2]]};
}

/// How bright a linear colour is (ITU-R BT.709).
inline float luminance_of(const glm::vec3& colour) {
    return 0.2126F * colour.x + 0.7152F * colour.y + 0.0722F * colour.z;
}

}  // namespace espalier::picture

// Colours as other programs count them.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace espalier::formats {

/// Linear light from a colour as screens show it (IEC 61966-2-1).
inline glm::vec3 linear_light(const std::array<std::uint8_t, 3>& rgb) {
    glm::vec3 result;
    for (int k = 0; k < 3; ++k) {
        const double c = rgb[static_cast<std::size_t>(k)] / 255.0;
        result[k] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return result;
}

}  // namespace espalier::formats

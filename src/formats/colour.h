// Colours as other programs count them.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <glm/vec3.hpp>

#include <algorithm>
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

/// The parts of a recorded colour that its material reflects and emits.
struct ColourParts {
    std::array<std::uint8_t, 3> reflected{}, emitted{};
};

inline ColourParts parts_of(const std::array<std::uint8_t, 3>& rgb, const RecordedMaterial& material) {
    ColourParts parts;
    for (std::size_t k = 0; k < 3; ++k) {
        const long emitted = std::lround(255 * material.emission[static_cast<int>(k)]);
        parts.emitted[k] = static_cast<std::uint8_t>(std::min<long>(emitted, rgb[k]));
        parts.reflected[k] = static_cast<std::uint8_t>(rgb[k] - parts.emitted[k]);
    }
    return parts;
}

}  // namespace espalier::formats

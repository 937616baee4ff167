#include "picture/light/tone.h"

#include "picture/light/colour_space.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::picture {

glm::vec3 toned(const glm::vec3& colour) {
    constexpr float knee = 0.8F, room = 1 - knee, desaturation = 0.15F;
    const float peak = std::max({colour.x, colour.y, colour.z});
    if (peak <= knee) return colour;
    const float compressed = 1 - room * room / (peak + room - knee);
    const float white = 1 - 1 / (desaturation * (peak - compressed) + 1);
    return glm::mix(colour * (compressed / peak), glm::vec3(compressed), white);
}

std::array<std::uint8_t, 3> screen_bytes(const glm::vec3& colour) {
    std::array<std::uint8_t, 3> bytes{};
    for (std::size_t k = 0; k < 3; ++k) {
        const float share = screen_of_linear(std::clamp(colour[static_cast<int>(k)], 0.0F, 1.0F));
        bytes[k] = static_cast<std::uint8_t>(std::lround(255 * share));
    }
    return bytes;
}

}  // namespace espalier::picture

// From the light of a picture to the bytes of a screen.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace espalier::picture {

/// Colours up to 0.8 stay what they are; what is brighter comes nearer and nearer to white. From linear to linear
/// colours, the latter from 0 to 1. Khronos Group 2024, PBR Neutral tone mapper, without its correction for gloss.
glm::vec3 toned(const glm::vec3& colour);

/// Of a linear colour from 0 to 1.
std::array<std::uint8_t, 3> screen_bytes(const glm::vec3& colour);

}  // namespace espalier::picture

// How surfaces are numbered: by the code point of the character behind ~.
#pragma once

#include <cstdint>
#include <string_view>

namespace espalier::geometry {

/// The first code point of UTF-8 text; a byte that begins none stands for itself.
inline std::uint32_t surface_id(std::string_view text) {
    const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
    const std::uint32_t lead = byte(0);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if (length == 1 || text.size() < length) return lead;
    std::uint32_t result = lead & (0xFFu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) result = result << 6 | (byte(i) & 0x3F);
    return result;
}

}  // namespace espalier::geometry

// Bytes that a page has in letters, read by a reader of the tests' own.
#pragma once

#include "studio/server/frame_texts.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace espalier::studio {

inline std::string from_letters(const std::string& text) {
    std::string bytes;
    for (std::size_t from = 0; from < text.size(); from += 5) {
        const std::size_t count = std::min<std::size_t>(5, text.size() - from);
        std::uint64_t number = 0;
        for (std::size_t i = 0; i < 5; ++i) number = number * 85 + (i < count ? page_letters.find(text[from + i]) : 84);
        for (std::size_t i = 0; i + 1 < count; ++i) bytes += static_cast<char>(number >> (8 * (3 - i)) & 0xFF);
    }
    return bytes;
}

}  // namespace espalier::studio

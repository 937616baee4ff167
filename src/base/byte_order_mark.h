// The three bytes by which some programs say that a text is UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace espalier {

/// How many bytes of the text are its mark.
constexpr std::size_t byte_order_mark(std::string_view text) {
    return text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

}  // namespace espalier

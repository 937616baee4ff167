#include "language/text/plain_text.h"

#include "espalier/base/error.h"

#include "base/byte_order_mark.h"
#include "base/characters.h"

#include <fmt/format.h>

namespace espalier::language {

void require_text(const std::string& text, const std::string& name) {
    constexpr int most_control_characters = 8;
    int found = 0;
    for (const char c : text) {
        const bool control = static_cast<unsigned char>(c) < 0x20 && !is_blank(c) && c != '\n';
        if (c != '\0' && (!control || ++found <= most_control_characters)) continue;
        throw UserError(fmt::format("{} is a binary file, not the text of a model", name));
    }
}

std::string with_plain_lines(std::string text) {
    std::size_t end = 0;
    for (std::size_t k = byte_order_mark(text); k < text.size(); ++k) {
        const bool ends_line = text[k] == '\r';
        if (ends_line && k + 1 < text.size() && text[k + 1] == '\n') ++k;
        text[end++] = ends_line ? '\n' : text[k];
    }
    text.resize(end);
    return text;
}

}  // namespace espalier::language

#include "base/json_text.h"

#include <charconv>
#include <cstddef>
#include <optional>

namespace espalier {
namespace {

/// The code that a backslash, u and four digits at a place mean.
std::optional<unsigned> escaped_at(std::string_view text, std::size_t at) {
    if (!text.substr(at).starts_with("\\u") || at + 6 > text.size()) return std::nullopt;
    unsigned code = 0;
    const char* const end = text.data() + at + 6;
    return std::from_chars(text.data() + at + 2, end, code, 16).ptr == end ? std::optional(code) : std::nullopt;
}

bool is_high(unsigned code) {
    return code >= 0xD800 && code < 0xDC00;
}

bool is_low(unsigned code) {
    return code >= 0xDC00 && code < 0xE000;
}

}  // namespace

bool is_deeper_than_json_may_be(std::string_view text) {
    int depth = 0;
    bool is_in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\\' && is_in_text) {
            ++i;
        } else if (c == '"') {
            is_in_text = !is_in_text;
        } else if (!is_in_text && (c == '[' || c == '{')) {
            if (++depth > deepest_json) return true;
        } else if (!is_in_text && (c == ']' || c == '}')) {
            --depth;
        }
    }
    return false;
}

std::string with_whole_surrogates(std::string_view json) {
    std::string whole;
    whole.reserve(json.size());
    for (std::size_t at = 0; at < json.size();) {
        const std::optional<unsigned> code = escaped_at(json, at);
        const bool is_pair = code && is_high(*code) && is_low(escaped_at(json, at + 6).value_or(0));
        const bool is_half = code && !is_pair && (is_high(*code) || is_low(*code));
        const std::size_t size = is_pair ? 12 : code ? 6 : json[at] == '\\' ? 2 : 1;
        whole += is_half ? "\\ufffd" : json.substr(at, size);
        at += size;
    }
    return whole;
}

}  // namespace espalier

#include "base/excerpt.h"

#include "espalier/base/file.h"

#include <algorithm>
#include <fstream>

namespace espalier {
namespace {

bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Bytes of the character that begins at `i`, or 0 if it cannot be shown: a control character, or no UTF-8.
std::size_t shown_length(const std::string& text, std::size_t i) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    const unsigned first = byte(i);
    if (first < 0x80) return first == '\t' || first == '\n' || (first >= 0x20 && first != 0x7F) ? 1 : 0;
    if (first < 0xC2 || first > 0xF4 || (first == 0xC2 && byte(i + 1) < 0xA0)) return 0;
    const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    for (std::size_t k = i + 1; k < i + length; ++k) {
        if ((byte(k) & 0xC0) != 0x80) return 0;
    }
    return length;
}

}  // namespace

std::string printable(std::string text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = shown_length(text, i);
        if (length == 0) text[i] = '?';
        i += std::max<std::size_t>(length, 1);
    }
    return text;
}

// Tabs before the caret are kept so that it lines up however wide they are shown.
std::string excerpt(const std::string& line, int column) {
    const std::string source = printable(line);
    constexpr std::size_t before = 80, longest = 160;
    const std::size_t at = std::min(static_cast<std::size_t>(std::max(column, 1)) - 1, source.size());
    std::size_t begin = source.size() > longest && at > before ? at - before : 0;
    std::size_t end = std::min(source.size(), begin + longest);
    while (begin > 0 && is_continuation(source[begin])) --begin;
    while (end < source.size() && is_continuation(source[end])) ++end;
    const std::string left = begin > 0 ? "... " : "", right = end < source.size() ? " ..." : "";
    const std::string text = "\n    " + left + source.substr(begin, end - begin) + right;
    if (column <= 0) return text;
    std::string caret(left.size(), ' ');
    for (std::size_t i = begin; i < at; ++i) {
        if (!is_continuation(source[i])) caret += source[i] == '\t' ? '\t' : ' ';
    }
    return text + "\n    " + caret + '^';
}

std::string source_line(const Place& place) {
    if (!is_readable(place.file)) return "";
    std::string line;
    std::ifstream file(place.file);
    for (int number = 0; number < place.line; ++number) {
        if (!std::getline(file, line)) return "";
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

std::string excerpt(const Place& place) {
    const std::string line = source_line(place);
    return line.empty() ? "" : excerpt(line, place.column);
}

}  // namespace espalier

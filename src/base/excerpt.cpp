#include "base/excerpt.h"

#include "espalier/base/file.h"

#include "base/text.h"

#include <algorithm>
#include <fstream>

namespace espalier {
namespace {

bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
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

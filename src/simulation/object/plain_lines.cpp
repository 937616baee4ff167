#include "simulation/object/plain_lines.h"

#include "base/byte_order_mark.h"

namespace espalier::simulation {

std::vector<PlainLine> plain_lines(std::string_view text, const std::string& name) {
    std::vector<PlainLine> lines;
    for (std::size_t begin = byte_order_mark(text); begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = text.substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back({std::string(line), {name, static_cast<int>(lines.size()) + 1, 1}});
        begin = end + 1;
    }
    return lines;
}

std::optional<int> leading_integer(std::string_view word) {
    constexpr int most = 1000000000;
    const bool negative = word.starts_with('-');
    if (negative || word.starts_with('+')) word.remove_prefix(1);
    if (word.empty() || word[0] < '0' || word[0] > '9') return std::nullopt;
    int number = 0;
    for (const char digit : word) {
        if (digit < '0' || digit > '9') break;
        number = number > most / 10 ? most : number * 10 + (digit - '0');
        if (number > most) number = most;
    }
    return negative ? -number : number;
}

}  // namespace espalier::simulation

#include "language/mtg/entity_code.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language::mtg {
namespace {

constexpr std::size_t longest_shown = 60;

std::string shown(std::string_view code) {
    return escaped(code.substr(0, longest_shown)) + (code.size() > longest_shown ? "..." : "");
}

}  // namespace

std::size_t first_digit(std::string_view label) {
    return std::min(label.find_first_of("0123456789"), label.size());
}

std::vector<EntityCode> items_of(std::string_view code, const Place& place) {
    std::vector<EntityCode> items;
    for (std::size_t i = code.front() == '^' ? 1 : 0; i < code.size();) {
        EntityCode item{code[i++], {}};
        if (item.relation != '/' && item.relation != '<' && item.relation != '+') {
            throw UserError(
                place, fmt::format("'{}' begins no entity: write /, < or + and then its class and index", shown(code)));
        }
        // <<, <. and <.< are the same row; a dot gives the features to its last entity alone.
        while (item.relation != '/' && i < code.size() && (code[i] == item.relation || code[i] == '.')) {
            item.is_row = true;
            item.last_alone = item.last_alone || code[i] == '.';
            ++i;
        }
        const std::size_t end = std::min(code.find_first_of("/<+", i), code.size());
        item.label = code.substr(i, end - i);
        if (end == i) throw UserError(place, fmt::format("an entity of '{}' has no class", shown(code)));
        items.push_back(item);
        i = end;
    }
    if (items.empty()) throw UserError(place, fmt::format("'{}' names no entity", shown(code)));
    return items;
}

}  // namespace espalier::language::mtg

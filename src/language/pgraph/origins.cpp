#include "language/pgraph/origins.h"

#include "base/characters.h"
#include "language/text/marks.h"

#include <algorithm>

namespace espalier::language::pgraph {
namespace {

/// The end of the name, number or other character at `k`. A digit takes its exponent along: the e of 1e3 is no name.
std::size_t end_of_word(const std::string& text, std::size_t k) {
    const bool is_number = is_digit(text[k]), is_name = is_name_start(text[k]);
    ++k;
    while ((is_name || is_number) && k < text.size() && (is_name_part(text[k]) || (is_number && text[k] == '.'))) ++k;
    return k;
}

}  // namespace

std::string substituted(const std::string& text, const Names& names) {
    std::string result;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
        end = end_of_word(text, begin);
        const std::string word = text.substr(begin, end - begin);
        const auto found = names.find(word);
        result += found == names.end() ? word : found->second;
    }
    return result;
}

Origins::Origins(const Graph& graph) {
    for (const Define& define : graph.defines) add(define.place);
    for (const Component& component : graph.components) {
        add(component.place);
        for (const KeyValue& key : component.keys) add(key.value.place);
    }
}

void Origins::add(const Place& place) {
    if (std::find(files_.begin(), files_.end(), place.file) == files_.end()) files_.push_back(place.file);
}

std::string Origins::marked(const std::string& text, const Place& place) const {
    const auto file = std::find(files_.begin(), files_.end(), place.file);
    if (!place.known() || file == files_.end()) return text;
    return language::marked(text, {static_cast<std::uint32_t>(file - files_.begin()), place.line, place.column});
}

std::string Origins::written(const std::string& expression, const Place& place, const Names& names) const {
    if (!place.known()) return substituted(expression, names);
    std::string result;
    for (std::size_t begin = 0, end = 0; begin < expression.size(); begin = end) {
        end = end_of_word(expression, begin);
        const std::string word = expression.substr(begin, end - begin);
        const auto found = names.find(word);
        const Place here{place.file, place.line, place.column + static_cast<int>(begin)};
        result += word == " " ? word : marked(found == names.end() ? word : found->second, here);
    }
    return result;
}

}  // namespace espalier::language::pgraph

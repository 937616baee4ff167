#include "language/parser/symbols.h"

#include "base/characters.h"

namespace espalier::language {

void Symbols::declare(const std::string& name) {
    declared_.insert(name);
    lengths_[name.front()].insert(name.size());
}

std::string_view Symbols::at(std::string_view text) const {
    const char first = text.empty() ? '\0' : text.front();
    if (!lengths_.empty()) {
        if (const auto lengths = lengths_.find(first); lengths != lengths_.end()) {
            for (const std::size_t length : lengths->second) {
                if (length <= text.size() && declared_.contains(text.substr(0, length))) return text.substr(0, length);
            }
        }
    }
    constexpr std::string_view reserved = "<>:*()\n";
    if (first == '\0' || is_blank(first) || reserved.find(first) != std::string_view::npos) return {};
    std::size_t length = 1;
    while (length < text.size() && length < 4 && static_cast<unsigned char>(first) >= 0xC0 &&
           is_continuation_byte(text[length])) {
        ++length;
    }
    return text.substr(0, length);
}

const std::vector<std::size_t>* Symbols::declared_arities(std::string_view name) const {
    const auto found = arities_.find(name);
    return found == arities_.end() ? nullptr : &found->second;
}

}  // namespace espalier::language

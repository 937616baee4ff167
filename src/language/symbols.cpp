#include "language/symbols.h"

#include "language/characters.h"

#include <algorithm>

namespace espalier::language {

void Symbols::declare(const std::string& name) {
    std::vector<std::string>& names = declared_[name.front()];
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    names.push_back(name);
    std::stable_sort(names.begin(), names.end(),
                     [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
}

std::string_view Symbols::at(std::string_view text) const {
    const char first = text.empty() ? '\0' : text.front();
    if (!declared_.empty()) {
        if (const auto names = declared_.find(first); names != declared_.end()) {
            for (const std::string& name : names->second) {
                if (text.starts_with(name)) return text.substr(0, name.size());
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

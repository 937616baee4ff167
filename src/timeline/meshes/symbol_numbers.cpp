#include "timeline/meshes/symbol_numbers.h"

namespace espalier::timeline {

const std::vector<std::uint16_t>& SymbolNumbers::of(const Model& model) {
    const auto known = numbers_.find(&model);
    if (known != numbers_.end()) return known->second;
    std::vector<std::uint16_t>& numbers = numbers_[&model];
    for (std::size_t letter = 0; letter < model.alphabet.size(); ++letter) {
        const std::string& name = model.alphabet.name(static_cast<LetterId>(letter));
        const auto [entry, is_new] = number_of_.emplace(name, static_cast<std::uint16_t>(names_.size()));
        if (is_new) names_.push_back(name);
        numbers.push_back(entry->second);
    }
    return numbers;
}

}  // namespace espalier::timeline

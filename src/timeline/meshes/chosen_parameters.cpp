#include "timeline/meshes/chosen_parameters.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>

namespace espalier::timeline {
namespace {

constexpr std::array own_names{"identity", "organ",  "parent", "plant",  "symbol", "birth",
                               "order",    "colour", "kind",   "radius", "pixels", "symbol_names"};

// Only symbols with parameters: the names a user may have meant.
std::vector<std::string> symbols_of(std::span<const Model* const> models) {
    std::set<std::string> names;
    for (const Model* model : models) {
        const Alphabet& alphabet = model->alphabet;
        for (std::size_t i = 0; i < alphabet.size(); ++i) {
            if (alphabet.arity(static_cast<LetterId>(i)) > 0) names.insert(alphabet.name(static_cast<LetterId>(i)));
        }
    }
    return {names.begin(), names.end()};
}

// The modules that make up a symbol: a declared name is one, other symbols are a module per character.
struct SymbolLetters {
    std::vector<LetterId> preceding;
    std::vector<LetterId> last;  ///< one per arity; empty if the model does not know the symbol
};

SymbolLetters letters_of(const std::string& symbol, const Alphabet& alphabet) {
    SymbolLetters letters;
    std::string last = symbol;
    if (!alphabet.find_symbol(symbol)) {
        std::vector<std::string> characters = code_points(symbol);
        last = characters.back();
        characters.pop_back();
        for (const std::string& character : characters) {
            const std::optional<LetterId> letter = alphabet.find(character, 0);
            if (!letter) return {};
            letters.preceding.push_back(*letter);
        }
    }
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        if (alphabet.name(static_cast<LetterId>(i)) == last) letters.last.push_back(static_cast<LetterId>(i));
    }
    return letters;
}

// The most parameters a symbol has in any model; nothing if no model has it.
std::optional<int> most_parameters(const std::string& symbol, std::span<const Model* const> models) {
    std::optional<int> most;
    for (const Model* model : models) {
        const Alphabet& alphabet = model->alphabet;
        const SymbolLetters letters = letters_of(symbol, alphabet);
        for (const LetterId letter : letters.last) most = std::max(most.value_or(0), alphabet.arity(letter));
    }
    return most;
}

}  // namespace

ChosenParameter chosen_parameter(const std::string& text, const std::string& name, const Place& place) {
    ChosenParameter chosen;
    chosen.name = name;
    chosen.place = place;
    // The last dot separates: `.` may itself be a symbol.
    const std::size_t dot = text.rfind('.');
    const std::string_view digits = dot == std::string::npos ? "" : std::string_view(text).substr(dot + 1);
    chosen.number = whole_text_as<decltype(chosen.number)>(digits).value_or(0);
    if (chosen.number < 1 || dot == 0) {
        throw UserError(place, fmt::format("'{}' must be a symbol, a dot and the number of a parameter counted "
                                           "from 1, as in \"F.2\" or \"?E.1\", not \"{}\"",
                                           name, text));
    }
    chosen.symbol = text.substr(0, dot);
    return chosen;
}

std::vector<ChosenParameter> read_chosen_parameters(const Settings& table) {
    std::vector<ChosenParameter> chosen;
    for (const std::string& name : table.keys()) {
        if (std::find(own_names.begin(), own_names.end(), name) != own_names.end()) {
            throw UserError(table.place(name),
                            fmt::format("'{}' is an array of every timeline; choose another name", name));
        }
        chosen.push_back(chosen_parameter(table.text(name), name, table.place(name)));
    }
    return chosen;
}

void require_known(std::span<const ChosenParameter> chosen, std::span<const Model* const> models) {
    if (models.empty()) return;
    for (const ChosenParameter& parameter : chosen) {
        const std::optional<int> most = most_parameters(parameter.symbol, models);
        if (!most) {
            const std::vector<std::string> symbols = symbols_of(models);
            throw UserError(
                parameter.place,
                fmt::format("no model of this scene has a module '{}'{}; those with parameters are {}",
                            parameter.symbol, did_you_mean(parameter.symbol, symbols), fmt::join(symbols, " ")));
        }
        if (*most < parameter.number) {
            throw UserError(parameter.place, fmt::format("module '{}' has no parameter number {}; it has {} at most",
                                                         parameter.symbol, parameter.number, *most));
        }
    }
}

ParameterSlots::ParameterSlots(const ChosenParameter& chosen, const Alphabet& alphabet)
    : slot_(chosen.number - 1), carries_(alphabet.size(), 0) {
    SymbolLetters letters = letters_of(chosen.symbol, alphabet);
    preceding_ = std::move(letters.preceding);
    for (const LetterId letter : letters.last) {
        if (alphabet.arity(letter) < chosen.number) continue;
        carries_[letter] = 1;
    }
}

int ParameterSlots::find(const ModuleString& string, std::size_t module) const {
    if (!carries_[string.letters[module]] || module < preceding_.size()) return -1;
    const auto before = string.letters.begin() + static_cast<std::ptrdiff_t>(module - preceding_.size());
    return std::equal(preceding_.begin(), preceding_.end(), before) ? slot_ : -1;
}

}  // namespace espalier::timeline

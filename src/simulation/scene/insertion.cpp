#include "simulation/scene/insertion.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::simulation {
namespace {

/// Reads modules in the letters of an alphabet, as strings are printed: symbols side by side, parameters as numbers.
class ModuleReader {
public:
    ModuleReader(const Insertion& insertion, const Alphabet& alphabet)
        : insertion_(insertion), rest_(insertion.modules), alphabet_(alphabet) {}

    void read(std::vector<LetterId>& letters, std::vector<double>& parameters) {
        int open = 0;
        for (skip_blanks(); !rest_.empty(); skip_blanks()) {
            const std::string symbol = read_symbol();
            const std::vector<double> values = read_parameters();
            letters.push_back(letter_of(symbol, static_cast<int>(values.size())));
            parameters.insert(parameters.end(), values.begin(), values.end());
            open += letters.back() == Alphabet::open_bracket;
            open -= letters.back() == Alphabet::close_bracket;
            if (open < 0) break;
        }
        if (letters.empty()) fail("there is nothing to insert");
        if (open != 0) fail("its brackets do not match");
    }

private:
    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }

    // A declared name if one stands here, the longest of them; else one character.
    std::string read_symbol() {
        std::string symbol;
        for (std::size_t i = 0; i < alphabet_.symbol_count(); ++i) {
            const std::string& known = alphabet_.symbol_name(static_cast<SymbolId>(i));
            if (known.size() > symbol.size() && rest_.starts_with(known)) symbol = known;
        }
        if (symbol.empty()) symbol = code_points(rest_).front();
        rest_.remove_prefix(symbol.size());
        return symbol;
    }

    std::vector<double> read_parameters() {
        std::vector<double> values;
        if (!rest_.starts_with('(')) return values;
        const std::size_t end = rest_.find(')');
        if (end == std::string_view::npos) fail("')' is missing");
        for (const std::string& word : words_of(rest_.substr(1, end - 1), ", \t")) {
            const std::optional<double> value = whole_text_as<double>(word);
            if (!value || !std::isfinite(*value)) fail(fmt::format("'{}' is no number", word));
            values.push_back(*value);
        }
        rest_.remove_prefix(end + 1);
        return values;
    }

    LetterId letter_of(const std::string& symbol, int arity) const {
        if (const auto letter = alphabet_.find(symbol, arity)) return *letter;
        std::vector<std::string> names;
        for (std::size_t i = 0; i < alphabet_.symbol_count(); ++i) {
            names.push_back(alphabet_.symbol_name(static_cast<SymbolId>(i)));
        }
        fail(fmt::format("the model has no module '{}' with {} parameter{}{}", symbol, arity, arity == 1 ? "" : "s",
                         alphabet_.find_symbol(symbol) ? "" : did_you_mean(symbol, names)));
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw UserError(insertion_.place, fmt::format("cannot insert '{}': {}", insertion_.modules, why));
    }

    const Insertion& insertion_;
    std::string_view rest_;
    const Alphabet& alphabet_;
};

template <class T>
void insert_at(Column<T>& column, std::size_t at, std::span<const T> values) {
    column.insert(column.begin() + static_cast<std::ptrdiff_t>(at), values.begin(), values.end());
}

}  // namespace

Insertion read_insertion(const std::string& text, const Place& place) {
    Insertion insertion;
    insertion.place = place;
    // Symbols may contain `@` and `:`; the step is a number after the last `@` that has one.
    for (std::size_t at = text.rfind('@'); at != std::string::npos && at > 0; at = text.rfind('@', at - 1)) {
        const std::size_t end = std::min(text.find(':', at), text.size());
        const auto step = whole_text_as<int>(std::string_view(text).substr(at + 1, end - at - 1));
        if (!step || *step < 0) continue;
        insertion.modules = text.substr(0, at);
        insertion.step = *step;
        insertion.before = end < text.size() ? text.substr(end + 1) : "";
        const std::size_t dot = insertion.before.rfind('.');
        if (dot == std::string::npos || dot == 0) return insertion;
        const auto number = whole_text_as<int>(std::string_view(insertion.before).substr(dot + 1));
        if (!number || *number < 1) break;
        insertion.number = *number;
        insertion.before.erase(dot);
        return insertion;
    }
    throw UserError(place, fmt::format("'{}' is no insertion: expected MODULES@STEP, MODULES@STEP:SYMBOL or "
                                       "MODULES@STEP:SYMBOL.NUMBER, as in \"X(1)@5:F.3\"",
                                       text));
}

Insertions::Insertions(const Plant& plant)
    : alphabet_(source_of(*plant.model).alphabet), stream_(plant.stream.value_or(0)) {
    for (const Insertion& insertion : plant.insertions) {
        Modules& modules = all_.emplace_back(Modules{&insertion, {}, {}});
        ModuleReader(insertion, alphabet_).read(modules.letters, modules.parameters);
        const Arithmetic arithmetic = source_of(*plant.model).arithmetic;
        for (double& value : modules.parameters) value = stored(value, arithmetic);
    }
}

std::set<LetterId> Insertions::letters() const {
    std::set<LetterId> letters;
    for (const Modules& modules : all_) letters.insert(modules.letters.begin(), modules.letters.end());
    return letters;
}

void Insertions::apply(int step, ModuleString& string) const {
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (all_[i].insertion->step == step) put(all_[i], i, place_of(*all_[i].insertion, string), string);
    }
}

std::size_t Insertions::place_of(const Insertion& insertion, const ModuleString& string) const {
    if (insertion.before.empty()) return 0;
    int left = insertion.number;
    for (std::size_t module = 0; module < string.size(); ++module) {
        if (alphabet_.name(string.letters[module]) == insertion.before && --left == 0) return module;
    }
    const int found = insertion.number - left;
    throw UserError(insertion.place,
                    fmt::format("cannot insert '{}' at step {}: the string has {} modules '{}', not {}",
                                insertion.modules, insertion.step, found, insertion.before, insertion.number));
}

void Insertions::put(const Modules& modules, std::uint64_t number, std::size_t at, ModuleString& string) const {
    std::size_t parameters = 0;
    for (std::size_t module = 0; module < at; ++module) {
        parameters += static_cast<std::size_t>(alphabet_.arity(string.letters[module]));
    }
    const bool has_lineage = string.births.size() == string.size();
    insert_at<LetterId>(string.letters, at, modules.letters);
    insert_at<double>(string.parameters, parameters, modules.parameters);
    if (!has_lineage) return;
    const auto row = static_cast<std::uint32_t>(string.siblings.size());
    string.siblings = string.siblings.grown(1);
    const Identity origin = mix(mix(0x696e'7365'7274, stream_), number);
    string.siblings.added(row) = {origin, static_cast<std::uint32_t>(modules.insertion->step), Siblings::axiom, 0};
    std::vector<Birth> births;
    for (std::uint32_t place = 0; place < modules.letters.size(); ++place) births.push_back({row, place});
    insert_at<Birth>(string.births, at, births);
}

}  // namespace espalier::simulation

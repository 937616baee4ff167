// Strings of modules: brackets, polygons, and modules that nothing knows.
#include "base/text.h"
#include "language/parser/lookalikes.h"
#include "language/review/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace espalier::language {

void ModuleReview::review_axiom(const std::vector<ModuleTemplate>& axiom) {
    review_brackets(axiom, "axiom");
    review_polygons(axiom, "axiom", {});
    review_symbols(axiom);
}

void ModuleReview::review_successor(const Production& production) {
    review_brackets(production.successor, "successor");
    review_polygons(production.successor, "successor", production.strict);
    review_symbols(production.successor);
}

void ModuleReview::review_brackets(const std::vector<ModuleTemplate>& modules, const char* where) {
    std::vector<const ModuleTemplate*> open;
    for (const ModuleTemplate& module : modules) {
        if (module.letter == Alphabet::open_bracket) open.push_back(&module);
        if (module.letter != Alphabet::close_bracket) continue;
        if (open.empty()) {
            branches_.unopened.emplace_back(module.place, where);
            return;
        }
        open.pop_back();
    }
    if (!open.empty()) branches_.unclosed.emplace_back(open.back()->place, where);
}

// A production that replaces a '{' or '}' may leave one without its counterpart.
void ModuleReview::review_polygons(const std::vector<ModuleTemplate>& modules, const char* where,
                                   const std::vector<ModulePattern>& replaced) {
    const auto replaces = [&](const std::string& symbol) {
        return std::any_of(replaced.begin(), replaced.end(), [&](const ModulePattern& pattern) {
            return uses_.alphabet().name(pattern.letter) == symbol;
        });
    };
    const bool may_stay_open = replaces("{"), may_close = replaces("}");
    std::vector<const ModuleTemplate*> open;
    bool is_nested = false;
    for (const ModuleTemplate& module : modules) {
        const std::string& symbol = uses_.alphabet().name(module.letter);
        if (symbol == "{") {
            if (open.size() == 1) {
                is_nested = true;
                findings_.warn(module.place,
                               "this polygon begins within another one, whose vertices it does not share: is a "
                               "'}' missing?");
            }
            open.push_back(&module);
        }
        if (symbol == "}" && open.empty() && !may_close) polygons_.unopened.emplace_back(module.place, where);
        if (symbol == "}" && !open.empty()) open.pop_back();
    }
    if (!open.empty() && !is_nested && !may_stay_open) polygons_.unclosed.emplace_back(open.back()->place, where);
}

// What one production opens, another may close: that is seldom meant of branches, and yet may be.
void ModuleReview::review_ends() {
    const bool may_match = !branches_.unclosed.empty() && !branches_.unopened.empty();
    const auto tell = [&](const Place& place, std::string message) {
        may_match ? findings_.warn(place, std::move(message)) : findings_.insist(place, std::move(message));
    };
    for (const auto& [place, where] : branches_.unclosed) {
        tell(place, fmt::format("this branch is not closed in this {}: ']' is missing", where));
    }
    for (const auto& [place, where] : branches_.unopened) {
        tell(place, fmt::format("this ']' closes no branch of this {}", where));
    }
    if (!polygons_.unclosed.empty() && !polygons_.unopened.empty()) return;
    for (const auto& [place, where] : polygons_.unclosed) {
        findings_.insist(place,
                         fmt::format("this polygon is not closed in this {}, nor elsewhere: '}}' is missing", where));
    }
    for (const auto& [place, where] : polygons_.unopened) {
        findings_.insist(place, fmt::format("this '}}' closes no polygon of this {}, nor of others", where));
    }
}

void ModuleReview::review_symbols(const std::vector<ModuleTemplate>& modules) {
    for (std::size_t i = 0; i < modules.size(); ++i) {
        const LetterId letter = modules[i].letter;
        const std::string& symbol = uses_.alphabet().name(letter);
        if (const std::size_t length = uses_.has_words() ? uses_.word_length(modules, i) : 0; length > 0) {
            i += length - 1;
        } else if (symbol == "'" || !lookalike(symbol).empty()) {
            // The reader has said so.
        } else if (symbol == "?" && uses_.alphabet().arity(letter) == 0) {
            i += review_question(modules, i);
        } else if (symbol == "~") {
            ++i;  // the name of a surface
        } else if (const std::size_t drawn = turtle_symbol_length(modules, i); drawn > 0) {
            note_use(modules, i + drawn - 1, word(modules, i, drawn));
            i += drawn - 1;
        } else if (!turtle_.empty() && !is_known(symbol)) {
            if (!reported_.insert(letter).second) continue;
            std::string message = fmt::format(
                "{} has no effect: no production names it and the turtle does not know it", uses_.described(letter));
            const bool is_typed = static_cast<unsigned char>(symbol.front()) < 0x80;
            is_typed ? findings_.warn(modules[i].place, std::move(message))
                     : findings_.insist(modules[i].place, std::move(message));
        } else {
            note_use(modules, i, symbol);
        }
    }
}

void ModuleReview::note_use(const std::vector<ModuleTemplate>& modules, std::size_t last, const std::string& symbol) {
    const ModuleTemplate& module = modules[last];
    if (module.arguments.empty() || symbol.front() == '?') return;
    uses_of_parameters_.try_emplace(module.letter, module.place, symbol);
}

// F(1, 5) is another module than F(1), and A(1, 5) than A(1). A module without parameters is often meant to be one.
void ModuleReview::review_numbers_of_parameters() {
    for (const auto& [letter, use] : uses_of_parameters_) {
        if (uses_.is_matched(letter)) continue;
        const std::string reason = why_untaken(letter, use.second);
        if (reason.empty()) continue;
        findings_.insist(
            use.first, fmt::format("'{}' {} {}", use.second, with_parameters(uses_.alphabet().arity(letter)), reason));
    }
}

/// What is odd about a letter that no predecessor or context names; empty: nothing is.
std::string ModuleReview::why_untaken(LetterId letter, const std::string& symbol) const {
    const int arity = uses_.alphabet().arity(letter);
    std::set<int> others = uses_.rewritten_arities(uses_.alphabet().symbol_of(letter));
    others.erase(0);
    const auto drawn = turtle_.find(symbol);
    if (drawn == turtle_.end()) {
        if (others.empty()) return "";
        return fmt::format("is taken by no production; those for '{}' take {}", symbol, fmt::join(others, " or "));
    }
    const std::vector<int>& taken = drawn->second;
    if (!taken.empty() && std::find(taken.begin(), taken.end(), arity) == taken.end()) {
        return fmt::format("means nothing to the turtle, which takes {}", fmt::join(taken, " or "));
    }
    // What acts on any number of parameters reads the first, but for cross-sections, deformations, labels and polygons.
    const bool reads_one = taken.empty() && symbol.size() == 1 && symbol != "{" && symbol != "}" && symbol != ".";
    if (!reads_one || arity == 1) return "";
    for (const auto& [other, use] : uses_of_parameters_) {
        const bool is_same = use.second == symbol && other != letter;
        if (is_same) others.insert(uses_.alphabet().arity(other));
    }
    others.erase(arity);
    if (others.empty()) return "";
    return fmt::format(
        "is another module than {}, and of its parameters only the first means something: is a ',' a '.'?",
        fmt::format("'{}' {}", symbol, with_parameters(*others.begin())));
}

// `?` asks the environment (?E), the turtle (?P ?H ?L ?U ?Q), or a process the model declares. Returns how many modules
// behind it belong to it.
std::size_t ModuleReview::review_question(const std::vector<ModuleTemplate>& modules, std::size_t i) {
    std::string asked;
    for (std::size_t k = i + 1; k < modules.size(); ++k) {
        const std::string& symbol = uses_.alphabet().name(modules[k].letter);
        const bool letter = symbol.size() == 1 && ((symbol[0] >= 'a' && symbol[0] <= 'z') ||
                                                   (symbol[0] >= 'A' && symbol[0] <= 'Z') || symbol[0] == '_');
        if (!letter) break;
        asked += symbol;
        if (uses_.alphabet().arity(modules[k].letter) > 0) break;
    }
    if (!asked.empty() && std::string_view("EPHLUQ").find(asked.front()) != std::string_view::npos) return 1;
    if (asked.empty()) {
        findings_.warn(modules[i].place, "this query names no process");
    } else {
        findings_.insist(modules[i].place, fmt::format("no process answers '?{0}': declare 'environment {0};'{1}",
                                                       asked, meant_process(asked)));
    }
    return std::max<std::size_t>(1, asked.size());
}

// The declared process of a like name, or the only one that nothing asks.
std::string ModuleReview::meant_process(const std::string& asked) const {
    const std::vector<std::string>& declared = uses_.model().processes;
    std::string hint = did_you_mean(asked, declared);
    if (!hint.empty()) return hint;
    std::vector<std::string> unasked;
    for (const std::string& name : declared) {
        const std::optional<SymbolId> symbol = uses_.alphabet().find_symbol("?" + name);
        if (!symbol || !uses_.is_produced(*symbol)) unasked.push_back(name);
    }
    return unasked.size() == 1 ? fmt::format(" (did you mean '{}'?)", unasked.front()) : "";
}

bool ModuleReview::is_known(const std::string& symbol) const {
    if (uses_.is_mentioned(*uses_.alphabet().find_symbol(symbol)) || symbol.front() == '?') return true;
    if (symbol == "[" || symbol == "]" || symbol == "%") return true;
    if (symbol == "$" && (uses_.calls_any() || !uses_.called().empty())) return true;
    return turtle_.contains(symbol);
}

std::string ModuleReview::word(const std::vector<ModuleTemplate>& modules, std::size_t begin,
                               std::size_t length) const {
    std::string result;
    for (std::size_t i = begin; i < begin + length; ++i) result += uses_.alphabet().name(modules[i].letter);
    return result;
}

// How many modules from `i` on spell a symbol of the turtle, such as @o or @Gs; the longest counts.
std::size_t ModuleReview::turtle_symbol_length(const std::vector<ModuleTemplate>& modules, std::size_t i) const {
    std::size_t longest = 0;
    std::string spelt;
    for (std::size_t length = 1; length <= std::min<std::size_t>(4, modules.size() - i); ++length) {
        spelt += uses_.alphabet().name(modules[i + length - 1].letter);
        const auto next = turtle_.lower_bound(spelt);
        if (next == turtle_.end() || !next->first.starts_with(spelt)) break;
        if (next->first == spelt) longest = length;
    }
    return longest;
}

// A production of T finds the T of @Ts as well. That is meant where T stands in @Ts only, say for O(d) --> O(2 * d)
// and @O(1), and hardly where it stands alone too.
void ModuleReview::review_symbol_parts(const LSystem& system) {
    SymbolParts found;
    collect_parts(system.axiom, {}, found);
    for (const auto* productions : {&system.productions, &system.decomposition.productions}) {
        for (const Production& production : *productions) collect_parts(production, found);
    }
    review_symbol_parts(system.productions, found);
    review_symbol_parts(system.decomposition.productions, found);
    if (system.homomorphism.maximum_depth) {
        for (const Production& production : system.homomorphism.productions) collect_parts(production, found);
    }
    review_symbol_parts(system.homomorphism.productions, found);
}

void ModuleReview::collect_parts(const Production& production, SymbolParts& parts) const {
    collect_parts(production.successor, production.strict.front().letter, parts);
}

// A letter that replaces itself stands alone there only because its symbol's beginning stays where it is.
void ModuleReview::collect_parts(const std::vector<ModuleTemplate>& modules, std::optional<LetterId> replaced,
                                 SymbolParts& parts) const {
    for (std::size_t i = 0; i < modules.size();) {
        const LetterId letter = modules[i].letter;
        const std::string& symbol = uses_.alphabet().name(letter);
        const bool pair = symbol == "~" || (symbol == "?" && uses_.alphabet().arity(letter) == 0);
        const std::size_t length = pair ? 2 : std::max<std::size_t>(1, turtle_symbol_length(modules, i));
        if (length == 1 && letter != replaced) parts.alone.insert(letter);
        for (std::size_t k = i + 1; k < i + length && !pair; ++k) {
            parts.parts.emplace(modules[k].letter, word(modules, i, length));
        }
        i += length;
    }
}

void ModuleReview::review_symbol_parts(const std::vector<Production>& productions, const SymbolParts& parts) {
    for (const Production& production : productions) {
        const LetterId letter = production.strict.front().letter;
        const bool plain = production.strict.size() == 1 && production.left.empty();
        if (!plain || !parts.alone.contains(letter) || !parts.parts.contains(letter)) continue;
        findings_.warn(production.place,
                       fmt::format("this production replaces the {} in {} too: call the module otherwise",
                                   uses_.described(letter), parts.parts.at(letter)));
    }
}

}  // namespace espalier::language

// Productions: those that can never apply, words that are not declared, and weights.
#include "language/parser/constant.h"
#include "language/parser/label.h"
#include "language/review/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::language {
namespace {

constexpr double computed = std::numeric_limits<double>::quiet_NaN();  // a weight that is no number yet
constexpr double rounded_weights = 0.02;                               // 0.33, 0.33 and 0.33 sum to one

/// The productions of one strict predecessor in a stochastic L-system.
struct Pool {
    const Production* first = nullptr;
    const Production* fallback = nullptr;  ///< without context and condition
    std::size_t size = 0;
    bool any_chance = false;
    bool any_weight = false;
    bool all_fractions = true;  ///< every weight is a number below 1, and nothing but chance decides
    double weights = 0;         ///< their sum
};

class RuleReview {
public:
    RuleReview(const ModelUses& uses, Findings& findings) : uses_(uses), findings_(findings) {}

    void run(const std::vector<Production>& productions, bool stochastic) {
        for (const Production& production : productions) {
            review_applicability(production);
            if (!stochastic) review_shadow(production);
        }
        if (stochastic) review_weights(productions);
    }

private:
    void review_applicability(const Production& production) {
        if (uses_.is_word(production)) return;
        for (const auto* part : {&production.strict, &production.left, &production.right}) {
            for (const ModulePattern& pattern : *part) {
                if (pattern.skip_branch || uses_.reached().contains(pattern.letter)) continue;
                return tell_unreached(production, pattern);
            }
        }
        if (uses_.model().arithmetic == Arithmetic::cpfg) review_left_brackets(production);
        if (!production.condition) return;
        const Place& place = production.condition->place;
        const std::optional<double> value = constant_value(*production.condition);
        if (value == 0) findings_.warn(place, "this production can never apply: its condition is always 0");
        // A switch, as of a #define, is 0 or 1 or compares something.
        const bool is_number = production.condition->kind == Expression::Kind::number;
        if (is_number && value != 0 && value != 1) {
            findings_.insist(place,
                             fmt::format("this condition is the number {0:g}, so it always holds: is it a probability? "
                                         "A weight stands behind the successor, '--> ... : {0:g}', and needs a line "
                                         "'seed: 1' in the header",
                                         *value));
        }
    }

    void tell_unreached(const Production& production, const ModulePattern& pattern) {
        const std::string letter = uses_.described(pattern.letter);
        const std::string label = label_of(production);
        const std::optional<int> other = other_arity(pattern.letter);
        if (uses_.produced().contains(pattern.letter)) {
            findings_.warn(pattern.place,
                           fmt::format("this production can never apply: {} is produced, but only by productions that "
                                       "no axiom leads to",
                                       letter));
        } else if (!label.empty()) {
            findings_.insist(production.place,
                             fmt::format("'{0}' is read as the modules that this production replaces, and nothing "
                                         "produces them. If it is a label: productions have none, so leave '{0}:' away",
                                         label));
        } else if (other) {
            findings_.insist(pattern.place,
                             fmt::format("this production can never apply: nothing produces {} (only {})", letter,
                                         with_parameters(*other)));
        } else {
            findings_.warn(pattern.place,
                           fmt::format("this production can never apply: nothing produces {}; if it waits for a mouse, "
                                       "--insert puts modules into a string",
                                       letter));
        }
    }

    /// "p1" of 'p1: A --> B', as productions are numbered in books; empty: there is no such thing.
    std::string label_of(const Production& production) const {
        if (!production.condition || !production.left.empty() || !production.right.empty()) return "";
        std::string label;
        for (const ModulePattern& pattern : production.strict) {
            if (uses_.alphabet().arity(pattern.letter) > 0) return "";
            label += uses_.alphabet().name(pattern.letter);
        }
        return is_label(label) ? label : "";
    }

    void review_left_brackets(const Production& production) {
        const auto is_bracket = [](const ModulePattern& pattern) { return pattern.letter <= Alphabet::close_bracket; };
        const auto bracket = std::find_if(production.left.begin(), production.left.end(), is_bracket);
        if (bracket == production.left.end()) return;
        findings_.warn(
            bracket->place,
            "this production can never apply: with the arithmetic of cpfg, brackets in a left context do not match");
    }

    void review_shadow(const Production& late) {
        const auto takes_all = [&](const Production* early) {
            return early->strict.size() <= late.strict.size() &&
                   std::equal(early->strict.begin(), early->strict.end(), late.strict.begin(),
                              [](const auto& a, const auto& b) { return a.letter == b.letter; });
        };
        std::vector<const Production*>& unconditional = unconditional_by_letter_[late.strict.front().letter];
        const auto early = std::find_if(unconditional.begin(), unconditional.end(), takes_all);
        if (early != unconditional.end()) {
            findings_.warn(late.place,
                           fmt::format("this production can never apply: the one in {} takes all its modules",
                                       to_string((*early)->place)));
        } else if (late.left.empty() && late.right.empty() && !late.condition) {
            unconditional.push_back(&late);
        }
    }

    void review_weights(const std::vector<Production>& productions) {
        std::map<std::vector<LetterId>, Pool> pools;
        for (const Production& production : productions) {
            std::vector<LetterId> letters;
            for (const ModulePattern& pattern : production.strict) letters.push_back(pattern.letter);
            Pool& pool = pools[letters];
            if (!pool.first) pool.first = &production;
            const bool always = production.left.empty() && production.right.empty() && !production.condition;
            if (always) pool.fallback = &production;
            const double weight = production.weight ? constant_value(*production.weight).value_or(computed) : computed;
            pool.all_fractions = pool.all_fractions && always && weight < 1;
            pool.weights += weight;
            ++pool.size;
            pool.any_weight = pool.any_weight || production.weight;
            pool.any_chance = pool.any_chance || weight != 0;
        }
        for (const auto& [letters, pool] : pools) review_pool(pool, uses_.described(letters.front()));
    }

    void review_pool(const Pool& pool, const std::string& predecessor) {
        if (!pool.any_chance) {
            findings_.warn(pool.first->place, fmt::format("all productions of {} have weight 0", predecessor));
        }
        if (pool.size > 1 && pool.fallback && !pool.any_weight) {
            findings_.warn(
                pool.fallback->place,
                fmt::format("with 'seed:' this production is drawn as often as each of the others of {} that match, "
                            "whatever their order: give it a condition, or all of them weights",
                            predecessor));
        }
        // Older notations write probabilities here.
        if (pool.size > 1 && pool.all_fractions && pool.any_chance && std::abs(pool.weights - 1) > rounded_weights) {
            findings_.warn(
                pool.first->place,
                fmt::format("the weights of {} sum to {:.3g}: they are not probabilities, each is divided by this sum",
                            predecessor, pool.weights));
        }
    }

    /// Another number of parameters with which the symbol is produced.
    std::optional<int> other_arity(LetterId letter) const {
        for (const LetterId other : uses_.produced()) {
            if (uses_.alphabet().symbol_of(other) != uses_.alphabet().symbol_of(letter)) continue;
            return uses_.alphabet().arity(other);
        }
        return std::nullopt;
    }

    const ModelUses& uses_;
    Findings& findings_;
    std::map<LetterId, std::vector<const Production*>> unconditional_by_letter_;  ///< in this set
};

/// Modules are single letters: a word needs a declaration.
void review_word(const Production& production, const ModelUses& uses, std::set<std::string>& known,
                 Findings& findings) {
    if (!uses.is_word(production)) return;
    std::string name;
    for (const ModulePattern& pattern : production.strict) name += uses.alphabet().name(pattern.letter);
    const ModulePattern& last = production.strict.back();
    const auto first = production.formals.begin() + last.first_formal;
    const std::vector<std::string> parameters(first, first + uses.alphabet().arity(last.letter));
    const std::string declared = parameters.empty() ? name : fmt::format("{}({})", name, fmt::join(parameters, ", "));
    if (!known.insert(name).second) return;
    findings.insist(production.place, fmt::format("'{}' is read as {} modules of one letter each: 'module {};' before "
                                                  "'lsystem:' makes it one module",
                                                  name, production.strict.size(), declared));
}

}  // namespace

void review_words(const ModelUses& uses, Findings& findings) {
    std::set<std::string> known;
    for (const LSystem& system : uses.model().systems) {
        for_each_production(system,
                            [&](const Production& production) { review_word(production, uses, known, findings); });
    }
}

void review_rules(const std::vector<Production>& productions, bool stochastic, const ModelUses& uses,
                  Findings& findings) {
    RuleReview(uses, findings).run(productions, stochastic);
}

}  // namespace espalier::language

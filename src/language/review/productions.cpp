// Productions: those that can never apply, words that are not declared, and weights.
#include "language/parser/constant.h"
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
                const std::string letter = uses_.described(pattern.letter);
                findings_.warn(
                    pattern.place,
                    uses_.produced().contains(pattern.letter)
                        ? fmt::format(
                              "this production can never apply: {} is produced, but only by productions that no "
                              "axiom leads to",
                              letter)
                        : fmt::format("this production can never apply: nothing produces {}{}", letter,
                                      why_not(pattern.letter)));
                return;
            }
        }
        if (uses_.model().arithmetic == Arithmetic::cpfg) review_left_brackets(production);
        if (!production.condition) return;
        const std::optional<double> value = constant_value(*production.condition);
        if (value == 0)
            findings_.warn(production.condition->place, "this production can never apply: its condition is always 0");
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

    std::string why_not(LetterId letter) const {
        for (const LetterId other : uses_.produced()) {
            if (uses_.alphabet().symbol_of(other) == uses_.alphabet().symbol_of(letter)) {
                return fmt::format(" (only {})", with_parameters(uses_.alphabet().arity(other)));
            }
        }
        return "; if it waits for a mouse, --insert puts modules into a string";
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
    findings.warn(production.place, fmt::format("'{}' is read as {} modules of one letter each: 'module {};' before "
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

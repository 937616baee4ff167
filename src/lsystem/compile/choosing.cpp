#include "lsystem/compile/choosing.h"

#include "lsystem/compile/compiled_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace espalier {
namespace {

constexpr std::size_t most_classes = 254;
constexpr std::size_t most_outcomes = std::size_t{1} << 16;  // numbered by LetterId
constexpr std::uint32_t most_told = std::uint32_t{1} << 24;  // so that the measures of 256 modules fit into one number
constexpr std::uint64_t most_draws = std::uint64_t{1} << 53;

/// The value of a program that is a constant.
std::optional<double> constant(const CompiledSystem& system, const Program& program) {
    if (program.code.size() != 1 || program.results.size() != 1) return std::nullopt;
    const std::uint32_t result = program.results[0];
    return result < system.constants.size() ? std::optional(system.constants[result]) : std::nullopt;
}

struct Weighted {
    LetterId choice;
    double weight;
};

/// What the draw, a number of 2^53ths, falls on: the same sums and differences as Matcher::choose_by_weight.
std::size_t fall(const std::vector<Weighted>& pool, double sum, std::uint64_t draw) {
    double left = static_cast<double>(draw) * 0x1p-53 * sum;
    for (std::size_t k = 0; k + 1 < pool.size(); ++k) {
        left -= pool[k].weight;
        if (left < 0) return k;
    }
    return pool.size() - 1;
}

class ChoosingCompiler {
public:
    explicit ChoosingCompiler(const CompiledSystem& system) : system_(system), rules_(system.rules) {}

    Choosing compile();

private:
    using Candidates = std::vector<std::uint32_t>;

    void find_gazes();
    void look_for(const CompiledProduction& production);
    void classify();
    void fill_table();
    Outcome outcome(LetterId letter, std::uint32_t left, std::uint32_t right);
    void tell(LetterId letter, const Outcome& outcome);
    Outcome tried(const Candidates& candidates, Outcome::Way way);
    std::optional<Outcome> drawn(const Candidates& candidates);
    bool possible(const CompiledProduction& production, std::uint32_t left, std::uint32_t right) const;
    bool in_place(const CompiledProduction& production) const;
    bool certain(const CompiledProduction& production) const;
    bool wants_positions() const;
    bool sees_both_at_once() const;

    std::uint32_t left_class(LetterId letter) const { return choosing_.gazes.left.codes[letter] & 0xFF; }
    std::uint32_t right_class(LetterId letter) const { return choosing_.gazes.right.codes[letter] & 0xFF; }

    const CompiledSystem& system_;
    const CompiledRules& rules_;
    Choosing choosing_;
    std::map<Candidates, std::uint32_t> trials_, lotteries_;
};

Choosing ChoosingCompiler::compile() {
    find_gazes();
    classify();
    fill_table();
    choosing_.gazes.positions = wants_positions();
    choosing_.gazes.at_once = sees_both_at_once();
    return std::move(choosing_);
}

void ChoosingCompiler::find_gazes() {
    Gazes& gazes = choosing_.gazes;
    for (const CompiledRules* rules : {&system_.rules, &system_.decomposition}) {
        for (const CompiledProduction& production : rules->productions) look_for(production);
    }
    gazes.ring = system_.ring;
    std::vector<std::uint16_t> codes(system_.ignored.size());
    for (std::size_t l = 0; l < codes.size(); ++l) codes[l] = system_.ignored[l] ? Gaze::keeps : 0;
    // The filter is looked at before the brackets to the right, but not to the left.
    gazes.next.branches = false;
    gazes.right.branches = !system_.ignored[Alphabet::open_bracket];
    gazes.left.codes = gazes.right.codes = gazes.next.codes = std::move(codes);
    gazes.left.codes[Alphabet::open_bracket] = Gaze::keeps;
}

void ChoosingCompiler::look_for(const CompiledProduction& production) {
    Gazes& gazes = choosing_.gazes;
    for (const CompiledPattern& pattern : production.left) {
        gazes.left.wanted |= pattern.is_ordinary_left();
        choosing_.needs_partners |= !pattern.is_ordinary_left();
    }
    for (const CompiledPattern& pattern : production.right) {
        gazes.right.wanted |= pattern.is_ordinary_right();
        gazes.next.wanted |= !pattern.skip_branch && !pattern.is_ordinary_right();
        choosing_.needs_partners |= pattern.skip_branch;
    }
}

/// Numbers the letters that productions name as nearest neighbours, unless they are too many for a table.
void ChoosingCompiler::classify() {
    std::vector<std::uint32_t> left(system_.ignored.size()), right(left);
    std::uint32_t lefts = 1, rights = 1;
    const auto name = [&](std::vector<std::uint32_t>& classes, std::uint32_t& count, LetterId letter) {
        if (!system_.ignored[letter] && classes[letter] == 0) classes[letter] = count++;
    };
    for (const CompiledProduction& production : rules_.productions) {
        if (!production.left.empty() && production.left[0].is_ordinary_left())
            name(left, lefts, production.left[0].letter);
        if (!production.right.empty() && production.right[0].is_ordinary_right())
            name(right, rights, production.right[0].letter);
    }
    if (lefts > most_classes || rights > most_classes || left.size() * lefts * rights > most_outcomes) return;
    choosing_.left_classes = lefts;
    choosing_.right_classes = rights;
    for (std::size_t l = 0; l < left.size(); ++l) {
        choosing_.gazes.left.codes[l] |= left[l];
        choosing_.gazes.right.codes[l] |= right[l];
    }
}

void ChoosingCompiler::fill_table() {
    choosing_.ranks.resize(rules_.productions.size());
    for (std::size_t l = 0; l < system_.ignored.size(); ++l) {
        const auto letter = static_cast<LetterId>(l);
        for (std::uint32_t k = rules_.first[l]; k < rules_.first[l + 1]; ++k) {
            choosing_.ranks[rules_.candidates[k]] = static_cast<LetterId>(k - rules_.first[l] + 1);
        }
        const bool depends = system_.plans.of_letter[l].depends();
        for (std::uint32_t place = 0; place < choosing_.places(); ++place) {
            const std::uint32_t left = place / choosing_.right_classes, right = place % choosing_.right_classes;
            tell(letter, depends ? outcome(letter, left, right) : Outcome{});
        }
    }
}

void ChoosingCompiler::tell(LetterId letter, const Outcome& outcome) {
    const Plan& plan = system_.plans.of_letter[letter].choices[outcome.way == Outcome::Way::known ? outcome.index : 0];
    const bool told = outcome.way == Outcome::Way::known && plan.length < most_told;
    // Who comes to draw is a change wherever these may be foreseen: so drawers are counted with them.
    const bool draws = choosing_.places() == 1 && system_.drawers[letter];
    choosing_.outcomes.push_back(outcome);
    choosing_.told.push_back({system_.plans.holdings[letter], !told || plan.production || draws});
    choosing_.plans.push_back(&plan);
    choosing_.lengths.push_back(told ? plan.length : 0);
    choosing_.tells_all &= told;
}

/// False if the production cannot apply between neighbours of these classes.
bool ChoosingCompiler::possible(const CompiledProduction& production, std::uint32_t left, std::uint32_t right) const {
    const bool never = production.before.empty() && production.has_condition &&
                       constant(system_, production.condition) == std::optional(0.0);
    if (never) return false;
    const bool told = choosing_.places() > 1;
    if (told && !production.left.empty() && production.left[0].is_ordinary_left()) {
        const std::uint32_t named = left_class(production.left[0].letter);
        if (named == 0 || named != left) return false;
    }
    const bool next_to_it = production.strict.size() == 1;
    if (told && next_to_it && !production.right.empty() && production.right[0].is_ordinary_right()) {
        const std::uint32_t named = right_class(production.right[0].letter);
        if (named == 0 || named != right) return false;
    }
    return true;
}

/// True if a production's strict predecessor and contexts stand wherever it is possible.
bool ChoosingCompiler::in_place(const CompiledProduction& production) const {
    return production.is_of_neighbours() && (production.context_free() || choosing_.places() > 1);
}

/// True if a production applies wherever it is possible.
bool ChoosingCompiler::certain(const CompiledProduction& production) const {
    return in_place(production) && production.before.empty() && !production.has_condition;
}

Outcome ChoosingCompiler::outcome(LetterId letter, std::uint32_t left, std::uint32_t right) {
    Candidates candidates;
    bool all_certain = true, all_spelled = true, all_tested = true;
    for (std::uint32_t k = rules_.first[letter]; k < rules_.first[letter + 1]; ++k) {
        const CompiledProduction& production = rules_.productions[rules_.candidates[k]];
        if (!possible(production, left, right)) continue;
        candidates.push_back(rules_.candidates[k]);
        all_certain &= certain(production);
        all_spelled &= production.spelled();
        all_tested &= certain(production) || (in_place(production) && production.before.empty() && production.tests);
        if (!rules_.stochastic && certain(production)) break;
    }
    if (candidates.empty()) return {};
    if (rules_.stochastic) {
        const std::optional<Outcome> lottery = all_certain ? drawn(candidates) : std::nullopt;
        return lottery ? *lottery : tried(candidates, Outcome::Way::matched);
    }
    if (!certain(rules_.productions[candidates[0]])) {
        return tried(candidates, all_spelled                            ? Outcome::Way::spelled
                                 : all_tested && !rules_.several_strict ? Outcome::Way::tested
                                                                        : Outcome::Way::matched);
    }
    return {Outcome::Way::known, choosing_.ranks[candidates[0]]};
}

Outcome ChoosingCompiler::tried(const Candidates& candidates, Outcome::Way way) {
    const auto [at, made] = trials_.try_emplace(candidates, static_cast<std::uint32_t>(choosing_.trials.size()));
    if (made) {
        const auto begin = static_cast<std::uint32_t>(choosing_.tried.size());
        choosing_.tried.insert(choosing_.tried.end(), candidates.begin(), candidates.end());
        choosing_.trials.push_back({begin, static_cast<std::uint32_t>(choosing_.tried.size())});
    }
    return {way, at->second};
}

/// Nothing if a weight is not a constant, or not one that can be drawn with.
std::optional<Outcome> ChoosingCompiler::drawn(const Candidates& candidates) {
    std::vector<Weighted> pool;
    double sum = 0;
    for (const std::uint32_t candidate : candidates) {
        const CompiledProduction& production = rules_.productions[candidate];
        const std::optional<double> weight =
            production.has_weight ? constant(system_, production.weight) : std::optional(1.0);
        if (!weight || !(*weight >= 0 && std::isfinite(*weight))) return std::nullopt;
        sum += *weight;
        if (*weight > 0) pool.push_back({choosing_.ranks[candidate], *weight});
    }
    if (pool.size() < 2) return Outcome{Outcome::Way::known, pool.empty() ? 0u : pool[0].choice};
    const auto [at, made] = lotteries_.try_emplace(candidates, static_cast<std::uint32_t>(choosing_.lotteries.size()));
    if (made) {
        Lottery lottery;
        const LetterId letter = rules_.productions[candidates[0]].strict[0].letter;
        const Plan* const choices = system_.plans.of_letter[letter].choices;
        const auto prize = [&](LetterId choice) {
            return static_cast<std::uint32_t>(choices + choice - system_.plans.choices.data());
        };
        lottery.prizes.push_back(prize(pool[0].choice));
        for (std::size_t k = 1; k < pool.size(); ++k) {
            // The smallest draw that falls on this production or one behind it.
            std::uint64_t low = 0, high = most_draws;
            while (low < high) {
                const std::uint64_t middle = low + (high - low) / 2;
                if (fall(pool, sum, middle) >= k)
                    high = middle;
                else
                    low = middle + 1;
            }
            lottery.limits.push_back(low);
            lottery.prizes.push_back(prize(pool[k].choice));
        }
        choosing_.lotteries.push_back(std::move(lottery));
    }
    return Outcome{Outcome::Way::drawn, at->second};
}

/// Where classes do not say all: contexts are matched, or their parameters read.
bool ChoosingCompiler::wants_positions() const {
    if (system_.decomposition.uses_context || system_.serial() ||
        (rules_.uses_context && !system_.decomposition.empty())) {
        return true;
    }
    const auto in_context = [&](std::uint32_t p) { return !rules_.productions[p].context_free(); };
    return std::any_of(choosing_.tried.begin(), choosing_.tried.end(), in_context) ||
           std::any_of(rules_.productions.begin(), rules_.productions.end(),
                       [](const CompiledProduction& production) { return production.reads_context; });
}

bool ChoosingCompiler::sees_both_at_once() const {
    const Gazes& gazes = choosing_.gazes;
    if (gazes.positions || gazes.ring || gazes.next.wanted || !gazes.left.wanted || !gazes.right.wanted) return false;
    for (std::size_t l = 0; l < system_.ignored.size(); ++l) {
        const bool bracket = l <= Alphabet::close_bracket;
        if (bracket && system_.ignored[l]) return false;
        const bool asks = system_.plans.of_letter[l].depends();
        if ((bracket || system_.ignored[l]) && asks) return false;
    }
    return true;
}

}  // namespace

Choosing make_choosing(const CompiledSystem& system) {
    return ChoosingCompiler(system).compile();
}

}  // namespace espalier

#include "lsystem/compile/choosing.h"

#include "lsystem/compile/compiled_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace espalier::lsystem {
namespace {

constexpr std::size_t most_classes = 254;
constexpr std::size_t most_outcomes = std::size_t{1} << 16;  // numbered by LetterId
constexpr std::uint64_t most_samples = std::uint64_t{1} << 53;

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

/// What a random number, in 2^53ths, selects: the same sums and differences as Matcher::choose_by_weight.
std::size_t selected(const std::vector<Weighted>& pool, double sum, std::uint64_t sample) {
    double left = static_cast<double>(sample) * 0x1p-53 * sum;
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
    using Productions = std::vector<std::uint32_t>;

    void find_sides();
    void look_for(const CompiledProduction& production);
    void classify();
    void fill_table();
    Outcome outcome(LetterId letter, std::uint32_t left, std::uint32_t right);
    void enter(LetterId letter, const Outcome& outcome);
    Outcome tried(const Productions& candidates, Outcome::Way way);
    std::optional<Outcome> sampled(const Productions& candidates);
    bool possible(const CompiledProduction& production, std::uint32_t left, std::uint32_t right) const;
    bool in_place(const CompiledProduction& production) const;
    bool certain(const CompiledProduction& production) const;
    bool keeps(const CompiledProduction& production) const;
    bool is_tested(const CompiledProduction& production) const;
    bool wants_positions() const;
    bool sees_both_at_once() const;

    std::uint32_t left_class(LetterId letter) const { return choosing_.sides.left.codes[letter] & 0xFF; }
    std::uint32_t right_class(LetterId letter) const { return choosing_.sides.right.codes[letter] & 0xFF; }

    const CompiledSystem& system_;
    const CompiledRules& rules_;
    Choosing choosing_;
    std::map<Productions, std::uint32_t> trials_, pools_;
};

Choosing ChoosingCompiler::compile() {
    find_sides();
    classify();
    fill_table();
    choosing_.sides.positions = wants_positions();
    choosing_.sides.at_once = sees_both_at_once();
    return std::move(choosing_);
}

void ChoosingCompiler::find_sides() {
    ContextSides& sides = choosing_.sides;
    for (const CompiledRules* rules : {&system_.rules, &system_.decomposition}) {
        for (const CompiledProduction& production : rules->productions) look_for(production);
    }
    sides.ring = system_.ring;
    std::vector<std::uint16_t> codes(system_.ignored.size());
    for (std::size_t l = 0; l < codes.size(); ++l) codes[l] = system_.ignored[l] ? ContextSide::ignored : 0;
    // The filter is looked at before the brackets to the right, but not to the left.
    sides.next.branches = false;
    sides.right.branches = !system_.ignored[Alphabet::open_bracket];
    sides.left.codes = sides.right.codes = sides.next.codes = std::move(codes);
    sides.left.codes[Alphabet::open_bracket] = ContextSide::ignored;
}

void ChoosingCompiler::look_for(const CompiledProduction& production) {
    ContextSides& sides = choosing_.sides;
    for (const CompiledPattern& pattern : production.left) {
        sides.left.wanted |= pattern.is_ordinary_left();
        choosing_.needs_partners |= !pattern.is_ordinary_left();
    }
    for (const CompiledPattern& pattern : production.right) {
        sides.right.wanted |= pattern.is_ordinary_right();
        sides.next.wanted |= !pattern.skip_branch && !pattern.is_ordinary_right();
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
        choosing_.sides.left.codes[l] |= left[l];
        choosing_.sides.right.codes[l] |= right[l];
    }
}

void ChoosingCompiler::fill_table() {
    choosing_.ranks.resize(rules_.productions.size());
    for (std::size_t l = 0; l < system_.ignored.size(); ++l) {
        const auto letter = static_cast<LetterId>(l);
        for (std::uint32_t k = rules_.first[l]; k < rules_.first[l + 1]; ++k) {
            choosing_.ranks[rules_.candidates[k]] = static_cast<LetterId>(k - rules_.first[l] + 1);
        }
        for (std::uint32_t place = 0; place < choosing_.places(); ++place) {
            const std::uint32_t left = place / choosing_.right_classes, right = place % choosing_.right_classes;
            enter(letter, outcome(letter, left, right));
        }
    }
}

void ChoosingCompiler::enter(LetterId letter, const Outcome& outcome) {
    const bool replaced = outcome.way != Outcome::Way::known || outcome.index > system_.plans.first[letter];
    const auto arity = static_cast<std::uint32_t>(system_.source->alphabet.arity(letter));
    choosing_.outcomes.push_back(outcome);
    choosing_.lookups.push_back({arity, replaced});
}

/// False if the production cannot apply between neighbours of these classes.
bool ChoosingCompiler::possible(const CompiledProduction& production, std::uint32_t left, std::uint32_t right) const {
    const bool never = production.before.empty() && production.has_condition &&
                       constant(system_, production.condition) == std::optional(0.0);
    if (never) return false;
    const bool has_classes = choosing_.places() > 1;
    if (has_classes && !production.left.empty() && production.left[0].is_ordinary_left()) {
        const std::uint32_t named = left_class(production.left[0].letter);
        if (named == 0 || named != left) return false;
    }
    const bool next_to_it = production.strict.size() == 1;
    if (has_classes && next_to_it && !production.right.empty() && production.right[0].is_ordinary_right()) {
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

/// True if a production of one module puts the same in its place.
bool ChoosingCompiler::keeps(const CompiledProduction& production) const {
    return production.length == 1 && production.letters[0] == production.strict[0].letter &&
           production.parameters == 0 && production.after.empty() && !production.decomposes;
}

/// True if what decides can be evaluated for many modules at once.
bool ChoosingCompiler::is_tested(const CompiledProduction& production) const {
    if (!in_place(production) || !production.before.empty()) return false;
    const bool weighed = !rules_.stochastic || !production.has_weight || production.weighs;
    return weighed && (!production.has_condition || production.tests);
}

Outcome ChoosingCompiler::outcome(LetterId letter, std::uint32_t left, std::uint32_t right) {
    Productions candidates;
    bool all_certain = true, all_tested = true, all_spelled = !rules_.stochastic;
    for (std::uint32_t k = rules_.first[letter]; k < rules_.first[letter + 1]; ++k) {
        const CompiledProduction& production = rules_.productions[rules_.candidates[k]];
        if (!possible(production, left, right)) continue;
        candidates.push_back(rules_.candidates[k]);
        all_certain &= certain(production);
        all_tested &= is_tested(production);
        all_spelled &= production.context_free() && production.before.empty() && !production.has_condition;
        if (!rules_.stochastic && certain(production)) break;
    }
    const std::uint32_t copied = system_.plans.first[letter];
    if (candidates.empty()) return {Outcome::Way::known, copied};
    const Outcome::Way way = all_tested && !rules_.several_strict ? Outcome::Way::tested : Outcome::Way::matched;
    if (rules_.stochastic) {
        const std::optional<Outcome> pool = all_certain ? sampled(candidates) : std::nullopt;
        return pool ? *pool : tried(candidates, way);
    }
    const CompiledProduction& first = rules_.productions[candidates[0]];
    if (certain(first)) return {Outcome::Way::known, keeps(first) ? copied : copied + choosing_.ranks[candidates[0]]};
    if (all_spelled) return tried(candidates, Outcome::Way::spelled);
    return tried(candidates, way);
}

Outcome ChoosingCompiler::tried(const Productions& candidates, Outcome::Way way) {
    const auto [at, made] = trials_.try_emplace(candidates, static_cast<std::uint32_t>(choosing_.trials.size()));
    if (made) {
        const auto begin = static_cast<std::uint32_t>(choosing_.candidates.size());
        choosing_.candidates.insert(choosing_.candidates.end(), candidates.begin(), candidates.end());
        choosing_.trials.push_back({begin, static_cast<std::uint32_t>(choosing_.candidates.size())});
    }
    return {way, at->second};
}

/// Nothing if a weight is not a constant, or not one to sample with.
std::optional<Outcome> ChoosingCompiler::sampled(const Productions& candidates) {
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
    const std::uint32_t copied = system_.plans.first[rules_.productions[candidates[0]].strict[0].letter];
    if (pool.size() < 2) return Outcome{Outcome::Way::known, copied + (pool.empty() ? 0u : pool[0].choice)};
    const auto [at, made] = pools_.try_emplace(candidates, static_cast<std::uint32_t>(choosing_.pools.size()));
    if (made) {
        Pool made_pool;
        made_pool.plans.push_back(copied + pool[0].choice);
        for (std::size_t k = 1; k < pool.size(); ++k) {
            // The smallest random number that selects this production or one behind it.
            std::uint64_t low = 0, high = most_samples;
            while (low < high) {
                const std::uint64_t middle = low + (high - low) / 2;
                if (selected(pool, sum, middle) >= k)
                    high = middle;
                else
                    low = middle + 1;
            }
            made_pool.limits.push_back(low);
            made_pool.plans.push_back(copied + pool[k].choice);
        }
        choosing_.pools.push_back(std::move(made_pool));
    }
    return Outcome{Outcome::Way::sampled, at->second};
}

/// Where classes do not say all: contexts are matched, or their parameters read.
bool ChoosingCompiler::wants_positions() const {
    if (system_.decomposition.uses_context || system_.serial() ||
        (rules_.uses_context && !system_.decomposition.empty())) {
        return true;
    }
    const auto in_context = [&](std::uint32_t p) { return !rules_.productions[p].context_free(); };
    return std::any_of(choosing_.candidates.begin(), choosing_.candidates.end(), in_context) ||
           std::any_of(rules_.productions.begin(), rules_.productions.end(),
                       [](const CompiledProduction& production) { return production.reads_context; });
}

bool ChoosingCompiler::sees_both_at_once() const {
    const ContextSides& sides = choosing_.sides;
    if (sides.positions || sides.ring || sides.next.wanted || !sides.left.wanted || !sides.right.wanted) return false;
    for (std::size_t l = 0; l < system_.ignored.size(); ++l) {
        const bool bracket = l <= Alphabet::close_bracket;
        if (bracket && system_.ignored[l]) return false;
        const bool asks = rules_.has(static_cast<LetterId>(l)) && rules_.always[l] < 0;
        if ((bracket || system_.ignored[l]) && asks) return false;
    }
    return true;
}

}  // namespace

Choosing make_choosing(const CompiledSystem& system) {
    return ChoosingCompiler(system).compile();
}

}  // namespace espalier::lsystem

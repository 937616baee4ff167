#include "lsystem/derive/matching.h"

#include "base/excerpt.h"
#include "base/text.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::lsystem {

const CompiledProduction* Matcher::choose(const CompiledRules& rules, const Site& site) {
    const std::uint32_t first = rules.first[site.letter];
    return choose(rules, {rules.candidates.data() + first, rules.first[site.letter + 1] - first}, site);
}

const CompiledProduction* Matcher::choose(const CompiledRules& rules, std::span<const std::uint32_t> candidates,
                                          const Site& site) {
    if (candidates.empty()) return nullptr;
    machine_.forget_reseeding();
    if (rules.effects.samples || rules.stochastic) machine_.sample_with(RandomSamples(key_, site.identity, step_));
    if (watch_) watch_->begins(rules, site);
    const CompiledProduction* const chosen =
        rules.stochastic ? choose_by_weight(rules, candidates, site) : choose_first(rules, candidates, site);
    if (watch_) watch_->chose(chosen);
    return chosen;
}

const CompiledProduction* Matcher::choose_first(const CompiledRules& rules, std::span<const std::uint32_t> candidates,
                                                const Site& site) {
    for (const std::uint32_t candidate : candidates) {
        const CompiledProduction& production = rules.productions[candidate];
        if (applies(production, site)) return &production;
    }
    return nullptr;
}

bool Matcher::applies(const CompiledProduction& production, const Site& site) {
    const Trial trial = try_out(production, site);
    if (watch_) watch_->tried(production, trial);
    return trial.verdict == Trial::Verdict::applies;
}

// The order of tests is the language's: strict predecessor, right context, left context, formals, block, condition.
inline Trial Matcher::try_out(const CompiledProduction& production, const Site& site) {
    if (production.strict.size() > 1 && !match_strict(production, site)) return {Trial::Verdict::strict};
    if (!production.right.empty() && !match_right(production, site)) return {Trial::Verdict::right_context};
    if (!production.left.empty() && !match_left(production, site)) return {Trial::Verdict::left_context};
    bind_strict(production, site.values);
    if (!production.before.empty()) machine_.run(production.before);
    if (!production.has_condition) return {};
    const double condition = machine_.evaluate(production.condition);
    return {condition != 0 ? Trial::Verdict::applies : Trial::Verdict::condition, condition};
}

double Matcher::weight(const CompiledProduction& production) {
    if (!production.has_weight) return 1;
    const double weight = machine_.evaluate(production.weight);
    if (weight >= 0 && std::isfinite(weight)) return weight;
    throw EvaluationError(production.source->weight->place,
                          fmt::format("a weight must be a number of at least 0, but is {:g}", weight));
}

const CompiledProduction* Matcher::choose_by_weight(const CompiledRules& rules,
                                                    std::span<const std::uint32_t> candidates, const Site& site) {
    pool_.clear();
    double sum = 0;
    for (const std::uint32_t index : candidates) {
        const CompiledProduction& production = rules.productions[index];
        bound_ = &production;
        if (!applies(production, site)) continue;
        pool_.push_back({&production, weight(production)});
        sum += pool_.back().weight;
    }
    for (const Weighted& candidate : pool_) {
        if (watch_) watch_->weighed(*candidate.production, sum > 0 ? candidate.weight / sum : 0);
    }
    if (!(sum > 0)) return nullptr;
    const CompiledProduction* chosen = nullptr;
    RandomSamples random = machine_.random_numbers();
    double left = random.uniform() * sum;
    machine_.sample_with(random);
    for (const Weighted& candidate : pool_) {
        if (candidate.weight == 0) continue;
        chosen = candidate.production;
        left -= candidate.weight;
        if (left < 0) break;
    }
    // What its block did to its parameters holds, unless another production was tried after it.
    if (bound_ != chosen) bind(*chosen, site);
    return chosen;
}

void Matcher::bind(const CompiledProduction& production, const Site& site) {
    if (production.reads_context) {
        match_right(production, site);
        match_left(production, site);
    }
    bind_strict(production, site.values);
}

void Matcher::begin_successor(const CompiledProduction& production, const Site& site) {
    const bool samples = production.successor.effects.samples || production.after.effects.samples;
    if (samples && !machine_.reseeded())
        machine_.sample_with(RandomSamples(key_, site.identity, step_, first_of_successor));
}

bool Matcher::match_strict(const CompiledProduction& production, const Site& site) const {
    const LetterId* const next = site.following ? site.following : letters_ + site.first + 1;
    if (production.strict.size() - 1 > (site.following ? site.followers : limit_ - site.first - 1)) return false;
    for (std::size_t k = 1; k < production.strict.size(); ++k) {
        if (next[k - 1] != production.strict[k].letter) return false;
    }
    return true;
}

void Matcher::bind_context(const CompiledPattern& pattern, std::size_t module, const Site& site) {
    if (pattern.arity == 0) return;
    const double* value = view_.string->parameters.data() + parameters_at(module, site);
    double* formals = machine_.formals() + pattern.first_formal;
    for (std::uint32_t k = 0; k < pattern.arity; ++k) formals[k] = value[k];
}

std::size_t Matcher::parameters_at(std::size_t module, const Site& site) const {
    if (view_.places) return (*view_.places)[module];
    if (view_.offsets) return view_.offsets[module];
    const auto arities = model_.source->alphabet.arities();
    std::size_t offset = site.parameters_at;
    for (std::size_t i = site.first; i < module; ++i) offset += arities[letters_[i]];
    for (std::size_t i = module; i < site.first; ++i) offset -= arities[letters_[i]];
    return offset;
}

bool Matcher::match_left(const CompiledProduction& production, const Site& site) {
    std::size_t at = site.first;
    bool wrapped = !model_.ring;
    for (const CompiledPattern& pattern : production.left) {
        const std::size_t found = left_of(at, pattern.letter);
        if (found == Neighbours::none || letters_[found] != pattern.letter || (found >= at && wrapped)) return false;
        wrapped |= found >= at;
        bind_context(pattern, found, site);
        at = found;
    }
    return true;
}

bool Matcher::match_right(const CompiledProduction& production, const Site& site) {
    std::size_t at = site.first + (site.width > 0 ? site.width : production.strict.size());
    bool wrapped = !model_.ring;
    for (const CompiledPattern& pattern : production.right) {
        if (pattern.skip_branch) {
            at = end_of_branch(at);
            continue;
        }
        const std::size_t found = right_from(at, pattern.letter);
        if (found == Neighbours::none || letters_[found] != pattern.letter || (found < at && wrapped)) return false;
        wrapped |= found < at;
        bind_context(pattern, found, site);
        at = found + 1;
    }
    return true;
}

/// The module that a pattern is compared with, to the left of a module.
std::size_t Matcher::left_of(std::size_t module, LetterId sought) const {
    if (!view_.neighbours || sought <= Alphabet::close_bracket) return find_left(module, sought);
    return view_.neighbours->left[module];
}

/// The module that a pattern is compared with, from a module on, which is not the first.
std::size_t Matcher::right_from(std::size_t module, LetterId sought) const {
    if (!view_.neighbours) return find_right(module, sought);
    return sought == Alphabet::open_bracket ? view_.neighbours->next[module - 1] : view_.neighbours->right[module - 1];
}

// Leftwards: finished branches are skipped, an opening bracket is stepped over to the parent axis (ABOP 1.8).
std::size_t Matcher::find_left(std::size_t module, LetterId sought) const {
    bool wrapped = !model_.ring;
    while (true) {
        if (module == 0) {
            if (wrapped) return Neighbours::none;
            wrapped = true;
            module = size_;
        }
        const LetterId letter = letters_[module - 1];
        if (letter == sought && letter <= Alphabet::close_bracket) return module - 1;
        if (letter == Alphabet::close_bracket) {
            module = view_.partner[module - 1];
            if (module == BranchLinks::none) return Neighbours::none;
        } else if (letter == Alphabet::open_bracket || model_.ignored[letter]) {
            --module;
        } else {
            return module - 1;
        }
    }
}

// Rightwards: the filter is looked at before the brackets, so a `consider` list without them flattens branches.
std::size_t Matcher::find_right(std::size_t module, LetterId sought) const {
    bool wrapped = !model_.ring;
    while (true) {
        if (module == size_) {
            if (wrapped) return Neighbours::none;
            wrapped = true;
            module = 0;
        }
        const LetterId letter = letters_[module];
        if (model_.ignored[letter]) {
            ++module;
        } else if (letter == sought || letter != Alphabet::open_bracket) {
            return module;
        } else if (view_.partner[module] == BranchLinks::none) {
            return Neighbours::none;
        } else {
            module = std::size_t{view_.partner[module]} + 1;
        }
    }
}

/// The closing bracket of the branch that position `at` stands in, or the end of the string.
std::size_t Matcher::end_of_branch(std::size_t at) const {
    while (at < size_ && letters_[at] == Alphabet::open_bracket) {
        if (view_.partner[at] == BranchLinks::none) return size_;
        at = std::size_t{view_.partner[at]} + 1;
    }
    if (at >= size_ || letters_[at] == Alphabet::close_bracket) return at;
    const std::uint32_t open = view_.partner[at];
    if (open == BranchLinks::none || view_.partner[open] == BranchLinks::none) return size_;
    return view_.partner[open];
}

void require_finite(const CompiledProduction& production, const double* values) {
    const double* value = values;
    for (const ModuleTemplate& module : production.source->successor) {
        for (std::size_t k = 0; k < module.arguments.size(); ++k, ++value) {
            if (std::isfinite(*value)) continue;
            throw EvaluationError(module.arguments[k].place,
                                  fmt::format("parameter {} of the new module is {:g}", k + 1, *value));
        }
    }
}

std::string describe(const EvaluationError& error, const Alphabet& alphabet, LetterId letter, const double* values,
                     std::uint32_t step) {
    ModuleString module;
    module.append(letter, {values, static_cast<std::size_t>(alphabet.arity(letter))});
    return fmt::format("{}{}{}, in module {} at step {}{}", to_string(error.place), error.place.known() ? ": " : "",
                       error.what(), to_text(module, alphabet), step, excerpt(error.place));
}

}  // namespace espalier::lsystem

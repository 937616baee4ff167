#include "matching.h"

#include "espalier/base/excerpt.h"
#include "espalier/base/text.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier {

const CompiledProduction* Matcher::choose(const CompiledRules& rules, const Site& site) {
    const std::uint32_t begin = rules.first[site.letter];
    const std::uint32_t end = rules.first[site.letter + 1];
    if (begin == end) return nullptr;
    machine_.forget_reseeding();
    if (rules.effects.draws || rules.stochastic) machine_.draw_with(RandomDraws(key_, site.drawer, step_));
    if (rules.stochastic) return choose_by_weight(rules, site);
    for (std::uint32_t k = begin; k < end; ++k) {
        const CompiledProduction& production = rules.productions[rules.candidates[k]];
        if (applies(production, site)) return &production;
    }
    return nullptr;
}

// The order of tests is the language's: strict predecessor, right context, left context, formals, block, condition.
bool Matcher::applies(const CompiledProduction& production, const Site& site) {
    if (production.strict.size() > 1 && !match_strict(production, site)) return false;
    if (!production.right.empty() && !match_right(production, site)) return false;
    if (!production.left.empty() && !match_left(production, site)) return false;
    bind_strict(production, site);
    if (!production.before.empty()) machine_.run(production.before);
    return !production.has_condition || machine_.evaluate(production.condition) != 0;
}

double Matcher::weight(const CompiledProduction& production) {
    if (!production.has_weight) return 1;
    const double weight = machine_.evaluate(production.weight);
    if (weight >= 0 && std::isfinite(weight)) return weight;
    throw EvaluationError(production.source->weight->place,
                          fmt::format("a weight must be a number of at least 0, but is {:g}", weight));
}

const CompiledProduction* Matcher::choose_by_weight(const CompiledRules& rules, const Site& site) {
    pool_.clear();
    double sum = 0;
    for (std::uint32_t k = rules.first[site.letter]; k < rules.first[site.letter + 1]; ++k) {
        const CompiledProduction& production = rules.productions[rules.candidates[k]];
        bound_ = &production;
        if (!applies(production, site)) continue;
        pool_.push_back({&production, weight(production)});
        sum += pool_.back().weight;
    }
    if (!(sum > 0)) return nullptr;
    const CompiledProduction* chosen = nullptr;
    RandomDraws draws = machine_.draws();
    double left = draws.uniform() * sum;
    machine_.draw_with(draws);
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
    bind_strict(production, site);
}

void Matcher::begin_successor(const CompiledProduction& production, const Site& site) {
    const bool draws = production.successor.effects.draws || production.after.effects.draws;
    if (draws && !machine_.reseeded()) machine_.draw_with(RandomDraws(key_, site.drawer, step_, successor_draws));
}

bool Matcher::match_strict(const CompiledProduction& production, const Site& site) const {
    const LetterId* const next = site.following ? site.following : letters_ + site.first + 1;
    if (production.strict.size() - 1 > (site.following ? site.followers : limit_ - site.first - 1)) return false;
    for (std::size_t k = 1; k < production.strict.size(); ++k) {
        if (next[k - 1] != production.strict[k].letter) return false;
    }
    return true;
}

void Matcher::bind_strict(const CompiledProduction& production, const Site& site) {
    double* formals = machine_.formals();
    const double* value = site.values;
    for (const CompiledPattern& pattern : production.strict) {
        for (std::uint32_t k = 0; k < pattern.arity; ++k) formals[pattern.first_formal + k] = *value++;
    }
}

void Matcher::bind_context(const CompiledPattern& pattern, std::size_t module, const Site& site) {
    if (pattern.arity == 0) return;
    std::size_t offset = site.parameters_at;
    if (view_.offsets) {
        offset = view_.offsets[module];
    } else {
        const auto arities = model_.source->alphabet.arities();
        for (std::size_t i = site.first; i < module; ++i) offset += arities[letters_[i]];
        for (std::size_t i = module; i < site.first; ++i) offset -= arities[letters_[i]];
    }
    const double* value = view_.string->parameters.data() + offset;
    double* formals = machine_.formals() + pattern.first_formal;
    for (std::uint32_t k = 0; k < pattern.arity; ++k) formals[k] = value[k];
}

// Leftwards: finished branches are skipped, an opening bracket is stepped over to the parent axis (ABOP 1.8).
bool Matcher::match_left(const CompiledProduction& production, const Site& site) {
    std::size_t at = site.first;  // the module to the right of the next one to look at
    bool wrapped = !model_.ring;
    for (std::size_t k = 0; k < production.left.size();) {
        if (at == 0) {
            if (wrapped) return false;
            wrapped = true;
            at = size_;
        }
        const LetterId letter = letters_[at - 1];
        const CompiledPattern& pattern = production.left[k];
        if (letter == pattern.letter && (letter <= Alphabet::close_bracket || !model_.ignored[letter])) {
            bind_context(pattern, at - 1, site);
            ++k;
            --at;
        } else if (letter == Alphabet::close_bracket) {
            at = view_.partner[at - 1];
            if (at == BranchLinks::none) return false;
        } else if (letter == Alphabet::open_bracket || model_.ignored[letter]) {
            --at;
        } else {
            return false;
        }
    }
    return true;
}

// Rightwards: the filter is looked at before the brackets, so a `consider` list without them flattens branches.
bool Matcher::match_right(const CompiledProduction& production, const Site& site) {
    std::size_t at = site.first + (site.width > 0 ? site.width : production.strict.size());
    bool wrapped = !model_.ring;
    for (std::size_t k = 0; k < production.right.size();) {
        const CompiledPattern& pattern = production.right[k];
        if (pattern.skip_branch) {
            at = end_of_branch(at);
            ++k;
            continue;
        }
        if (at == size_) {
            if (wrapped) return false;
            wrapped = true;
            at = 0;
        }
        const LetterId letter = letters_[at];
        if (model_.ignored[letter]) {
            ++at;
        } else if (letter == pattern.letter) {
            bind_context(pattern, at, site);
            ++k;
            ++at;
        } else if (letter == Alphabet::open_bracket && view_.partner[at] != BranchLinks::none) {
            at = std::size_t{view_.partner[at]} + 1;
        } else {
            return false;
        }
    }
    return true;
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

}  // namespace espalier

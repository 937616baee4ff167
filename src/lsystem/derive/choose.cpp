#include "lsystem/derive/choose.h"

#include "espalier/base/stop.h"

#include "base/math_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>

namespace espalier::lsystem {
namespace {

// What a module's neighbours are to the table of outcomes, from the columns that were found.

struct NoClasses {
    LetterId operator()(std::size_t) const { return 0; }
};

template <bool Left, bool Right>
struct FoundClasses {
    const std::uint8_t *left, *right;
    LetterId rights;

    LetterId operator()(std::size_t module) const {
        LetterId place = 0;
        if constexpr (Left) place = static_cast<LetterId>(left[module] * rights);
        if constexpr (Right) place = static_cast<LetterId>(place + right[module]);
        return place;
    }
};

struct ClassesAtPositions {
    const LetterId* letters;
    const Choosing& choosing;
    const Neighbours& neighbours;

    LetterId operator()(std::size_t module) const {
        const ContextSides& sides = choosing.sides;
        return static_cast<LetterId>(class_at(sides.left, neighbours.left, module) * choosing.right_classes +
                                     class_at(sides.right, neighbours.right, module));
    }
    std::uint32_t class_at(const ContextSide& side, const Column<std::uint32_t>& positions, std::size_t module) const {
        if (!side.wanted || positions[module] == Neighbours::none) return 0;
        return side.codes[letters[positions[module]]] & 0xFF;
    }
};

/// Appends the modules that are replaced, by their places in the table of outcomes, which are as good as random: it is
/// no branch. Returns where the list ends; `parameters_at` goes on to what begins behind the last module.
Replacement* look_up(const Lookup* lookups, const LetterId* places, std::size_t begin, std::size_t end,
                     Replacement* replacement, std::size_t& parameters_at) {
    std::size_t at = parameters_at;
    for (std::size_t i = begin; i < end; ++i) {
        const Lookup& found = lookups[places[i]];
        *replacement = {at, static_cast<std::uint32_t>(i), places[i]};
        replacement += found.replaced;
        at += found.arity;
    }
    parameters_at = at;
    return replacement;
}

constexpr std::size_t looked_up_at_once = 256;

/// Whether conditions are tested for many modules at once where they can be.
enum class Tests { together, alone };

/// Chooses for the modules of one chunk.
class Chooser {
public:
    Chooser(const StepInput& input, Chunk& chunk, Machine& machine, Tests tests, Replacement* replacements)
        : input_(input),
          tests_(tests),
          choosing_(input.system.choosing),
          plans_(input.system.plans),
          letters_(input.from.letters.data()),
          chunk_(chunk),
          machine_(machine),
          matcher_(input.system, input.view, machine),
          begin_(replacements),
          end_(replacements),
          becomes_{chunk.end - chunk.begin, chunk.parameters_end - chunk.parameters_begin, 0},
          samples_(input.system.rules.deciding_samples()) {
        matcher_.set_random(input.key, input.step);
    }

    /// `outcomes` has room for a place a module of the string.
    void run(LetterId* outcomes);

private:
    template <class ClassOf>
    void scan(const ClassOf& class_of, LetterId* outcomes);
    void choose(Replacement* first);
    void follow(const Outcome& outcome, Replacement& replacement);
    const CompiledProduction* match(const Candidates& trial, const Replacement& replacement);
    const CompiledProduction* spell(const Candidates& trial, const Replacement& replacement) const;
    void test(std::uint32_t trial, const Replacement& replacement);
    void decide(std::uint32_t trial);
    using Choices = std::array<LetterId, ColumnProgram::lanes>;
    bool choose_first(const Candidates& trial, Batch& batch, Choices& taken);
    bool weigh(const CompiledProduction& production, Batch& batch, double* weights);
    bool choose_by_weight(const Candidates& trial, Batch& batch, Choices& taken);
    const double* run(const ColumnProgram& program, Batch& batch);
    void decide_one_by_one(std::uint32_t trial);
    void sample();
    void take(Replacement& replacement, std::uint32_t plan);
    void take(Replacement& replacement, const CompiledProduction* production);
    const double* values_of(const Replacement& replacement) const {
        return input_.from.parameters.data() + replacement.parameters_at;
    }
    /// Returns the plan of a choice among those of a module's letter.
    std::uint32_t plan_of(const Replacement& replacement, std::uint32_t choice) const {
        return plans_.first[letters_[replacement.module]] + choice;
    }

    const StepInput& input_;
    Tests tests_;
    const Choosing& choosing_;
    const Plans& plans_;
    const LetterId* const letters_;
    Chunk& chunk_;
    Machine& machine_;
    Matcher matcher_;
    Replacement *begin_, *end_;
    Extent becomes_;               ///< sums of differences: wraps around while it is added up
    std::size_t replaced_ = 0;     ///< modules before this one are replaced together with others before them
    const bool samples_;           ///< what decides may take random numbers
    std::vector<double> weights_;  ///< of each candidate, for all modules that wait
    StopCheck<64> check_stop_;

    // Replacements that wait for their random numbers.
    static constexpr std::size_t sampled_at_once = 256;
    struct Waiting {
        Replacement* replacement;
        std::uint32_t pool;
    };
    std::array<Waiting, sampled_at_once> waiting_;
    std::size_t waiting_count_ = 0;
};

void Chooser::run(LetterId* outcomes) {
    const ContextSides& sides = choosing_.sides;
    const Neighbours* const found = input_.view.neighbours;
    machine_.clear_batches();
    if (!found || choosing_.places() == 1) {
        scan(NoClasses{}, outcomes);
    } else if (sides.positions) {
        scan(ClassesAtPositions{letters_, choosing_, *found}, outcomes);
    } else {
        const std::uint8_t* const left = found->left_classes.data();
        const std::uint8_t* const right = found->right_classes.data();
        const auto rights = static_cast<LetterId>(choosing_.right_classes);
        if (!sides.left.wanted)
            scan(FoundClasses<false, true>{left, right, rights}, outcomes);
        else if (!sides.right.wanted)
            scan(FoundClasses<true, false>{left, right, rights}, outcomes);
        else
            scan(FoundClasses<true, true>{left, right, rights}, outcomes);
    }
    sample();
    for (std::uint32_t trial = 0; trial < choosing_.trials.size(); ++trial) decide(trial);
    chunk_.replacements = {begin_, end_};
    chunk_.becomes = becomes_;
}

template <class ClassOf>
void Chooser::scan(const ClassOf& class_of, LetterId* outcomes) {
    const auto places = static_cast<LetterId>(choosing_.places());
    std::size_t parameters_at = chunk_.parameters_begin;
    for (std::size_t begin = chunk_.begin; begin < chunk_.end; begin += looked_up_at_once) {
        const std::size_t end = std::min(begin + looked_up_at_once, chunk_.end);
        const LetterId* found = letters_;
        if constexpr (!std::is_same_v<ClassOf, NoClasses>) {
            for (std::size_t i = begin; i < end; ++i) {
                outcomes[i] = static_cast<LetterId>(letters_[i] * places + class_of(i));
            }
            found = outcomes;
        }
        Replacement* const first = end_;
        end_ = look_up(choosing_.lookups.data(), found, begin, end, end_, parameters_at);
        choose(first);
    }
}

[[gnu::always_inline]] inline void Chooser::take(Replacement& replacement, std::uint32_t plan) {
    replacement.plan = plan;
    const Plan& taken = plans_.choices[plan];
    becomes_.modules += taken.length - std::size_t{taken.width};
    becomes_.parameters += taken.parameters - std::size_t{taken.reads};
    becomes_.siblings += taken.bears;
}

/// Chooses for replacements from one on.
void Chooser::choose(Replacement* first) {
    for (Replacement* replacement = first; replacement != end_; ++replacement) {
        if (replacement->module < replaced_) continue;
        const Outcome& outcome = choosing_.outcomes[replacement->plan];
        if (outcome.way == Outcome::Way::known) {
            take(*replacement, outcome.index);
        } else if (outcome.way == Outcome::Way::sampled) {
            waiting_[waiting_count_] = {replacement, outcome.index};
            if (++waiting_count_ == sampled_at_once) sample();
        } else {
            follow(outcome, *replacement);
        }
    }
}

void Chooser::follow(const Outcome& outcome, Replacement& replacement) {
    if (outcome.way == Outcome::Way::tested && tests_ == Tests::together)
        test(outcome.index, replacement);
    else if (outcome.way == Outcome::Way::spelled)
        take(replacement, spell(choosing_.trials[outcome.index], replacement));
    else
        take(replacement, match(choosing_.trials[outcome.index], replacement));
}

/// The first candidate whose strict predecessor stands there.
const CompiledProduction* Chooser::spell(const Candidates& trial, const Replacement& replacement) const {
    const Site site{replacement.module, replacement.parameters_at, letters_[replacement.module]};
    for (std::uint32_t k = trial.begin; k < trial.end; ++k) {
        const CompiledProduction& production = input_.system.rules.productions[choosing_.candidates[k]];
        if (production.strict.size() == 1 || matcher_.match_strict(production, site)) return &production;
    }
    return nullptr;
}

const CompiledProduction* Chooser::match(const Candidates& trial, const Replacement& replacement) {
    const std::span<const std::uint32_t> tried(choosing_.candidates.data() + trial.begin, trial.end - trial.begin);
    check_stop_();
    const std::size_t module = replacement.module;
    const Site site{module, replacement.parameters_at, letters_[module], values_of(replacement),
                    input_.identity(module)};
    try {
        return matcher_.choose(input_.system.rules, tried, site);
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, input_.system.source->alphabet, site.letter, site.values, input_.step));
    }
}

void Chooser::test(std::uint32_t trial, const Replacement& replacement) {
    Batch& batch = machine_.batch(trial);
    add_to(batch, input_, replacement.module, values_of(replacement));
    if (samples_) {
        batch.owners[batch.count] = input_.identity(replacement.module);
        batch.numbers[batch.count] = 0;
    }
    batch.places[batch.count] = static_cast<std::uint32_t>(&replacement - begin_);
    if (++batch.count == ColumnProgram::lanes) decide(trial);
}

/// Chooses for all modules that wait for the candidates of a trial.
void Chooser::decide(std::uint32_t trial) {
    Batch& batch = machine_.batch(trial);
    if (batch.count == 0) return;
    Choices taken{};
    const Candidates& candidates = choosing_.trials[trial];
    const bool decided = input_.system.rules.stochastic ? choose_by_weight(candidates, batch, taken)
                                                        : choose_first(candidates, batch, taken);
    if (!decided) return decide_one_by_one(trial);
    for (std::size_t i = 0; i < batch.count; ++i) {
        Replacement& replacement = begin_[batch.places[i]];
        take(replacement, plan_of(replacement, taken[i]));
    }
    batch.count = 0;
}

/// A value of each module that waits; null if it cannot be computed for one of them.
const double* Chooser::run(const ColumnProgram& program, Batch& batch) {
    return machine_.run(program, batch, input_.key, input_.step) ? machine_.result(program, 0) : nullptr;
}

/// The first candidate whose condition holds.
bool Chooser::choose_first(const Candidates& trial, Batch& batch, Choices& taken) {
    for (std::uint32_t k = trial.begin; k < trial.end; ++k) {
        const std::uint32_t candidate = choosing_.candidates[k];
        const CompiledProduction& production = input_.system.rules.productions[candidate];
        const LetterId choice = choosing_.ranks[candidate];
        const double* const holds = production.has_condition ? run(*production.tests, batch) : nullptr;
        if (production.has_condition && !holds) return false;
        for (std::size_t i = 0; i < batch.count; ++i) {
            taken[i] = taken[i] == 0 && (!holds || holds[i] != 0) ? choice : taken[i];
        }
    }
    return true;
}

/// The weight of a candidate for each module that waits, 0 where it does not apply. False if one is none.
bool Chooser::weigh(const CompiledProduction& production, Batch& batch, double* weights) {
    std::fill_n(weights, batch.count, 1);
    if (production.has_condition) {
        const double* const holds = run(*production.tests, batch);
        if (!holds) return false;
        for (std::size_t i = 0; i < batch.count; ++i) weights[i] = holds[i] != 0;
    }
    if (!production.has_weight) return true;
    const double* const weighs = run(*production.weighs, batch);
    if (!weighs) return false;
    bool sound = true;
    for (std::size_t i = 0; i < batch.count; ++i) {
        sound &= weights[i] == 0 || (weighs[i] >= 0 && std::isfinite(weighs[i]));
        weights[i] = weights[i] != 0 ? weighs[i] : 0;
    }
    return sound;
}

/// One of the candidates that apply, with the sums and differences of Matcher::choose_by_weight.
bool Chooser::choose_by_weight(const Candidates& trial, Batch& batch, Choices& taken) {
    weights_.resize((trial.end - trial.begin) * ColumnProgram::lanes);
    std::array<double, ColumnProgram::lanes> left{};
    double* weights = weights_.data();
    for (std::uint32_t k = trial.begin; k < trial.end; ++k, weights += ColumnProgram::lanes) {
        if (!weigh(input_.system.rules.productions[choosing_.candidates[k]], batch, weights)) return false;
        for (std::size_t i = 0; i < batch.count; ++i) left[i] += weights[i];
    }
    std::array<std::uint64_t, ColumnProgram::lanes> numbers;
    samples_of(input_.key, input_.step, {batch.owners.data(), batch.count}, batch.numbers.data(), numbers.data());
    for (std::size_t i = 0; i < batch.count; ++i) left[i] *= static_cast<double>(numbers[i]) * 0x1p-53;
    weights = weights_.data();
    for (std::uint32_t k = trial.begin; k < trial.end; ++k, weights += ColumnProgram::lanes) {
        const LetterId choice = choosing_.ranks[choosing_.candidates[k]];
        for (std::size_t i = 0; i < batch.count; ++i) {
            taken[i] = weights[i] != 0 && left[i] >= 0 ? choice : taken[i];
            left[i] -= weights[i];
        }
    }
    return true;
}

/// Some condition cannot be tested for all of them, perhaps for none who comes to it.
void Chooser::decide_one_by_one(std::uint32_t trial) {
    Batch& batch = machine_.batch(trial);
    for (std::size_t i = 0; i < batch.count; ++i) {
        Replacement& replacement = begin_[batch.places[i]];
        take(replacement, match(choosing_.trials[trial], replacement));
    }
    batch.count = 0;
}

void Chooser::take(Replacement& replacement, const CompiledProduction* production) {
    const CompiledProduction* const first = input_.system.rules.productions.data();
    take(replacement, plan_of(replacement, production ? choosing_.ranks[production - first] : LetterId{0}));
    replaced_ = replacement.module + (production ? production->strict.size() : 1);
}

void Chooser::sample() {
    std::array<Identity, sampled_at_once> identities;
    std::array<std::uint64_t, sampled_at_once> numbers;
    for (std::size_t k = 0; k < waiting_count_; ++k) {
        identities[k] = input_.from.identity(waiting_[k].replacement->module);
    }
    first_samples(input_.key, input_.step, {identities.data(), waiting_count_}, numbers.data());
    for (std::size_t k = 0; k < waiting_count_; ++k) {
        const Pool& pool = choosing_.pools[waiting_[k].pool];
        std::size_t selected = 0;
        for (const std::uint64_t limit : pool.limits) selected += numbers[k] >= limit;
        take(*waiting_[k].replacement, pool.plans[selected]);
    }
    waiting_count_ = 0;
}

}  // namespace

void add_to(Batch& batch, const StepInput& input, std::size_t module, const double* values) {
    using enum ColumnProgram::Whose;
    batch.modules[own][batch.count] = values;
    if (!input.view.places) return;
    const double* const parameters = input.from.parameters.data();
    const auto add = [&](ColumnProgram::Whose whose, const ContextSide& side, const Column<std::uint32_t>& positions) {
        if (!side.wanted || positions[module] == Neighbours::none) return;  // then no production asks
        batch.modules[whose][batch.count] = parameters + (*input.view.places)[positions[module]];
    };
    add(left, input.system.choosing.sides.left, input.view.neighbours->left);
    add(right, input.system.choosing.sides.right, input.view.neighbours->right);
}

void choose_replacements(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine) {
    const auto run = [&](Tests tests) {
        Chooser(input, chunk, machine, tests, scratch.replacements.data() + chunk.room).run(scratch.outcomes.data());
    };
    try {
        run(Tests::together);
    } catch (const RunError&) {
        run(Tests::alone);  // those that waited may be wrong, and stand before
    }
}

std::size_t list_known_replacements(const StepInput& input, const Chunk& chunk, Column<Replacement>& replacements) {
    if (replacements.size() <= chunk.end - chunk.begin) replacements.resize(chunk.end - chunk.begin + 1);
    std::size_t parameters_at = chunk.parameters_begin;
    const Replacement* const end = look_up(input.system.plans.lookups.data(), input.from.letters.data(), chunk.begin,
                                           chunk.end, replacements.data(), parameters_at);
    const auto count = static_cast<std::size_t>(end - replacements.data());
    const std::uint32_t* const known = input.system.plans.known.data();
    for (std::size_t k = 0; k < count; ++k) replacements[k].plan = known[replacements[k].plan];
    return count;
}

}  // namespace espalier::lsystem

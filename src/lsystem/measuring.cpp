#include "measuring.h"

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

namespace espalier {
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
        return static_cast<LetterId>(look(choosing.gazes.left, neighbours.left, module) * choosing.right_classes +
                                     look(choosing.gazes.right, neighbours.right, module));
    }
    std::uint32_t look(const Gaze& gaze, const Column<std::uint32_t>& positions, std::size_t module) const {
        if (!gaze.wanted || positions[module] == Neighbours::none) return 0;
        return gaze.codes[letters[positions[module]]] & 0xFF;
    }
};

constexpr std::size_t looked_up_at_once = 256;  // their measures are added up in one number

/// Where the changes of a chunk have room among those of all.
std::size_t room(const Scratch& scratch, const Chunk& chunk) {
    return chunk.begin + static_cast<std::size_t>(&chunk - scratch.chunks.data());
}

/// Chooses and measures the modules of one chunk.
class Measuring {
public:
    Measuring(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine)
        : input_(input),
          choosing_(input.model.choosing),
          letters_(input.from.letters.data()),
          choices_(scratch.choices.data()),
          changes_(scratch.changes.data() + room(scratch, chunk)),
          wants_changes_(!keeps_places(input)),
          machine_(machine),
          matcher_(input.model, input.view, machine) {
        matcher_.set_draws(input.key, input.step);
    }

    void run(Chunk& chunk);

private:
    template <class ClassOf>
    void run(Chunk& chunk, const ClassOf& class_of);
    void add_up(std::size_t begin, std::size_t end);
    void look_up(const LetterId* places, std::size_t begin, std::size_t end);
    void pass_replaced(std::size_t begin, std::size_t end);
    void find_out(const Outcome& outcome, std::size_t module, const double* values);
    void replace(std::size_t begin, std::size_t end);
    void match(const Trial& trial, std::size_t module, const double* values);
    void spell(const Trial& trial, std::size_t module, const double* values);
    void test(std::uint32_t trial, std::size_t module, const double* values);
    void decide(std::uint32_t trial);
    void draw(std::uint32_t lottery, std::size_t module) {
        waiting_[waiting_count_] = {static_cast<std::uint32_t>(module), lottery};
        if (++waiting_count_ == drawn_at_once) hold_lotteries();
    }
    void hold_lotteries();
    void take(std::size_t module, LetterId choice);
    void take(std::size_t module, const CompiledProduction* production);

    const StepInput& input_;
    const Choosing& choosing_;
    const LetterId* const letters_;
    LetterId* const choices_;
    Change* const changes_;
    const bool wants_changes_;
    Machine& machine_;
    Matcher matcher_;
    std::size_t modules_ = 0, parameters_ = 0;
    std::size_t looked_up_ = 0;  ///< modules before this one have been looked up
    std::size_t replaced_ = 0;   ///< modules before this one are replaced by productions chosen for others before them

    // Of the chunk, as far as it has been looked up.
    std::size_t begin_ = 0;
    std::uint32_t change_count_ = 0;
    std::uint32_t passed_ = 0;  ///< parameters

    // Modules that wait for their draws.
    static constexpr std::size_t drawn_at_once = 256;
    struct Draw {
        std::uint32_t module, lottery;
    };
    std::array<Draw, drawn_at_once> waiting_;
    std::size_t waiting_count_ = 0;
};

void Measuring::run(Chunk& chunk) {
    const Gazes& gazes = choosing_.gazes;
    const Neighbours* const found = input_.view.neighbours;
    if (!found || choosing_.places() == 1) return run(chunk, NoClasses{});
    if (gazes.positions) return run(chunk, ClassesAtPositions{letters_, choosing_, *found});
    const std::uint8_t* const left = found->left_classes.data();
    const std::uint8_t* const right = found->right_classes.data();
    const auto rights = static_cast<LetterId>(choosing_.right_classes);
    if (!gazes.left.wanted) return run(chunk, FoundClasses<false, true>{left, right, rights});
    if (!gazes.right.wanted) return run(chunk, FoundClasses<true, false>{left, right, rights});
    run(chunk, FoundClasses<true, true>{left, right, rights});
}

template <class ClassOf>
void Measuring::run(Chunk& chunk, const ClassOf& class_of) {
    const auto places = static_cast<LetterId>(choosing_.places());
    const auto place_of = [&](std::size_t i) { return static_cast<LetterId>(letters_[i] * places + class_of(i)); };
    const double* values = input_.from.parameters.data() + chunk.parameters_at;
    const bool letters_are_places = std::is_same_v<ClassOf, NoClasses> && wants_changes_;
    begin_ = chunk.begin;
    machine_.clear_batches();
    for (std::size_t begin = chunk.begin; begin < chunk.end; begin += looked_up_at_once) {
        const std::size_t end = std::min(begin + looked_up_at_once, chunk.end);
        if (!letters_are_places) {
            for (std::size_t i = begin; i < end; ++i) choices_[i] = place_of(i);
        }
        if (!wants_changes_) {
            add_up(begin, end);
            continue;
        }
        looked_up_ = end;
        const std::uint32_t first = change_count_, passed = passed_;
        const std::size_t free = std::clamp(replaced_, begin, end);
        pass_replaced(begin, free);
        look_up(letters_are_places ? letters_ : choices_, free, end);
        for (std::uint32_t k = first; k < change_count_; ++k) {
            const std::size_t module = chunk.begin + changes_[k].module;
            if (choices_[module] != Choosing::untold) continue;
            const Outcome& outcome = choosing_.outcomes[place_of(module)];
            if (outcome.way == Outcome::Way::drawn)
                draw(outcome.index, module);
            else
                find_out(outcome, module, values + (changes_[k].parameters - passed));
        }
        values += passed_ - passed;
    }
    hold_lotteries();
    for (std::uint32_t trial = 0; trial < choosing_.trials.size(); ++trial) decide(trial);
    changes_[change_count_] = {static_cast<std::uint32_t>(chunk.end - chunk.begin), passed_};
    chunk.changes = changes_;
    chunk.change_count = change_count_;
    chunk.out_end = modules_;
    chunk.out_parameters_end = parameters_;
}

/// Modules that are replaced together with one that was looked up before them.
void Measuring::pass_replaced(std::size_t begin, std::size_t end) {
    const std::uint16_t* const arities = input_.model.source->alphabet.arities().data();
    for (std::size_t i = begin; i < end; ++i) {
        choices_[i] = choosing_.nothing[letters_[i]];
        passed_ += arities[letters_[i]];
    }
}

/// Measures modules by their places in the table.
void Measuring::add_up(std::size_t begin, std::size_t end) {
    const Told* const told = choosing_.told.data();
    std::uint64_t measure = 0;
    for (std::size_t i = begin; i < end; ++i) measure += told[choices_[i]].measure;
    modules_ += static_cast<std::uint32_t>(measure);
    parameters_ += measure >> 32;
}

/// Turns places in the table into choices. What changes is as good as random: collecting it is no branch.
void Measuring::look_up(const LetterId* places, std::size_t begin, std::size_t end) {
    const Told* const told = choosing_.told.data();
    LetterId* const choices = choices_;
    Change* change = changes_ + change_count_;
    std::uint64_t measure = 0;
    std::uint32_t passed = passed_;
    for (std::size_t i = begin; i < end; ++i) {
        const Told& here = told[places[i]];
        choices[i] = here.choice;
        measure += here.measure;
        *change = {static_cast<std::uint32_t>(i - begin_), passed};
        change += here.changes;
        passed += here.arity;
    }
    change_count_ = static_cast<std::uint32_t>(change - changes_);
    passed_ = passed;
    modules_ += static_cast<std::uint32_t>(measure);
    parameters_ += measure >> 32;
}

void Measuring::find_out(const Outcome& outcome, std::size_t module, const double* values) {
    if (outcome.way == Outcome::Way::tested)
        test(outcome.index, module, values);
    else if (outcome.way == Outcome::Way::matched)
        match(choosing_.trials[outcome.index], module, values);
    else if (outcome.way == Outcome::Way::spelled)
        spell(choosing_.trials[outcome.index], module, values);
    else
        take(module, static_cast<LetterId>(outcome.index));
}

void Measuring::match(const Trial& trial, std::size_t module, const double* values) {
    const std::span<const std::uint32_t> tried(choosing_.tried.data() + trial.begin, trial.end - trial.begin);
    try {
        const CompiledRules& rules = input_.model.rules;
        const CompiledProduction* const chosen = matcher_.choose(rules, tried, site_of(input_, module, values));
        take(module, chosen);
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, input_.model.source->alphabet, letters_[module], values, input_.step));
    }
}

void Measuring::test(std::uint32_t trial, std::size_t module, const double* values) {
    Batch& batch = machine_.batch(trial);
    batch.values[batch.count] = values;
    batch.modules[batch.count] = static_cast<std::uint32_t>(module);
    if (++batch.count == ColumnProgram::lanes) decide(trial);
}

/// Takes the first production of a trial whose condition holds, for all modules that wait for it.
void Measuring::decide(std::uint32_t trial) {
    Batch& batch = machine_.batch(trial);
    if (batch.count == 0) return;
    std::array<LetterId, ColumnProgram::lanes> taken{};
    const auto [begin, end] = choosing_.trials[trial];
    for (std::uint32_t k = end; k > begin; --k) {
        const std::uint32_t tried = choosing_.tried[k - 1];
        const CompiledProduction& production = input_.model.rules.productions[tried];
        const LetterId choice = choosing_.ranks[tried];
        if (!production.has_condition) {
            taken.fill(choice);
            continue;
        }
        machine_.run(*production.tests, batch);
        const double* const holds = machine_.result(*production.tests, 0);
        for (std::size_t i = 0; i < batch.count; ++i) taken[i] = holds[i] != 0 ? choice : taken[i];
    }
    for (std::size_t i = 0; i < batch.count; ++i) take(batch.modules[i], taken[i]);
    batch.count = 0;
}

void Measuring::spell(const Trial& trial, std::size_t module, const double* values) {
    const Site site = site_of(input_, module, values);
    const CompiledProduction* spelled = nullptr;
    for (std::uint32_t k = trial.begin; k < trial.end && !spelled; ++k) {
        const CompiledProduction& production = input_.model.rules.productions[choosing_.tried[k]];
        if (matcher_.match_strict(production, site)) spelled = &production;
    }
    take(module, spelled);
}

void Measuring::take(std::size_t module, LetterId choice) {
    const Plan& plan = input_.model.plans.of_letter[letters_[module]].choices[choice];
    choices_[module] = choice;
    modules_ += plan.length;
    parameters_ += plan.parameters;
}

void Measuring::take(std::size_t module, const CompiledProduction* production) {
    if (!production) return take(module, LetterId{0});
    const CompiledProduction* const productions = input_.model.rules.productions.data();
    take(module, choosing_.ranks[static_cast<std::size_t>(production - productions)]);
    replaced_ = module + production->strict.size();
    replace(module + 1, std::min(replaced_, looked_up_));
}

/// Takes back what the table told of modules that are replaced together with one before them.
void Measuring::replace(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        if (choices_[i] != Choosing::untold) {
            const Plan& plan = input_.model.plans.of_letter[letters_[i]].choices[choices_[i]];
            modules_ -= plan.length;
            parameters_ -= plan.parameters;
        }
        choices_[i] = choosing_.nothing[letters_[i]];
    }
}

void Measuring::hold_lotteries() {
    if (waiting_count_ == 0) return;
    std::array<Identity, drawn_at_once> drawers;
    std::array<std::uint64_t, drawn_at_once> draws;
    const Identity* const identities = input_.from.identities.data();
    for (std::size_t k = 0; k < waiting_count_; ++k) drawers[k] = identities[waiting_[k].module];
    first_draws(input_.key, input_.step, {drawers.data(), waiting_count_}, draws.data());
    for (std::size_t k = 0; k < waiting_count_; ++k) {
        const Lottery& lottery = choosing_.lotteries[waiting_[k].lottery];
        std::size_t fallen = 0;
        for (const std::uint64_t limit : lottery.limits) fallen += draws[k] >= limit;
        const auto [choice, measure] = lottery.prizes[fallen];
        choices_[waiting_[k].module] = choice;
        modules_ += static_cast<std::uint32_t>(measure);
        parameters_ += measure >> 32;
    }
    waiting_count_ = 0;
}

}  // namespace

void measure(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine) {
    Measuring(input, scratch, chunk, machine).run(chunk);
}

}  // namespace espalier

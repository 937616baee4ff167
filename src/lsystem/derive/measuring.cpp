#include "lsystem/derive/measuring.h"

#include <algorithm>
#include <array>
#include <numeric>
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

constexpr std::size_t looked_up_at_once = 256;

/// Whether conditions are tested for many modules at once where they can be.
enum class Tests { together, alone };

/// Chooses and measures the modules of one chunk.
class Measuring {
public:
    Measuring(const StepInput& input, Chunk& chunk, Machine& machine, Tests tests = Tests::together)
        : input_(input),
          tests_(tests),
          choosing_(input.model.choosing),
          plans_(input.model.plans),
          letters_(input.from.letters.data()),
          identities_(input.from.identities.data()),
          values_(input.from.parameters.data() + chunk.parameters_at),
          chunk_(chunk),
          machine_(machine),
          matcher_(input.model, input.view, machine) {
        matcher_.set_draws(input.key, input.step);
    }

    /// Reads the whole chunk; `changes` have room for one more than its modules.
    void scan(LetterId* told, Change* changes);
    /// What changes is known.
    void follow();

private:
    template <class ClassOf>
    void scan(const ClassOf& class_of, LetterId* told);
    void look_up(const LetterId* places, std::size_t begin, std::size_t end);
    void choose(std::size_t first);
    void end();
    Site site_at(const Change& change) const;
    void find_out(const Outcome& outcome, Change& change);
    const CompiledProduction* choose(const Trial& trial, const Change& change);
    void spell(const Trial& trial, Change& change);
    void test(std::uint32_t trial, const Change& change);
    void decide(std::uint32_t trial);
    void decide_one_by_one(std::uint32_t trial);
    void hold_lotteries();
    void take(Change& change, std::uint32_t plan) {
        change.plan = plan;
        growth_ += plans_.growths[plan];
    }
    void take(Change& change, const CompiledProduction* production);
    /// Among the choices of a letter; null: it stays what it is.
    LetterId rank_of(const CompiledProduction* production) const {
        if (!production) return 0;
        return choosing_.ranks[static_cast<std::size_t>(production - input_.model.rules.productions.data())];
    }
    /// Of a choice among those of a module's letter.
    std::uint32_t plan_of(const Change& change, std::uint32_t choice) const {
        const Plan* const choices = plans_.of_letter[letters_[change.module]].choices;
        return static_cast<std::uint32_t>(choices - plans_.choices.data()) + choice;
    }

    const StepInput& input_;
    Tests tests_;
    const Choosing& choosing_;
    const Plans& plans_;
    const LetterId* const letters_;
    const Identity* const identities_;
    const double* const values_;  ///< of the chunk
    Chunk& chunk_;
    Machine& machine_;
    Matcher matcher_;
    Growth growth_;
    std::size_t replaced_ = 0;  ///< modules before this one are replaced by productions chosen for others before them
    std::uint64_t held_ = 0;    ///< before the module that is looked up

    // Changes that wait for their draws.
    static constexpr std::size_t drawn_at_once = 256;
    struct Draw {
        std::uint32_t change, lottery;
    };
    std::array<Draw, drawn_at_once> waiting_;
    std::array<Identity, drawn_at_once> drawers_;
    std::size_t waiting_count_ = 0;
};

void Measuring::scan(LetterId* told, Change* changes) {
    const Gazes& gazes = choosing_.gazes;
    const Neighbours* const found = input_.view.neighbours;
    chunk_.changes = changes;
    if (!found || choosing_.places() == 1) return scan(NoClasses{}, told);
    if (gazes.positions) return scan(ClassesAtPositions{letters_, choosing_, *found}, told);
    const std::uint8_t* const left = found->left_classes.data();
    const std::uint8_t* const right = found->right_classes.data();
    const auto rights = static_cast<LetterId>(choosing_.right_classes);
    if (!gazes.left.wanted) return scan(FoundClasses<false, true>{left, right, rights}, told);
    if (!gazes.right.wanted) return scan(FoundClasses<true, false>{left, right, rights}, told);
    scan(FoundClasses<true, true>{left, right, rights}, told);
}

template <class ClassOf>
void Measuring::scan(const ClassOf& class_of, LetterId* told) {
    const auto places = static_cast<LetterId>(choosing_.places());
    const auto find_places = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) told[i] = static_cast<LetterId>(letters_[i] * places + class_of(i));
    };
    const bool wants_changes = !keeps_places(input_);
    const bool letters_are_places = std::is_same_v<ClassOf, NoClasses> && wants_changes;
    held_ = (std::uint64_t{chunk_.parameters_at} << 32) + chunk_.drawers_at;
    machine_.clear_batches();
    for (std::size_t begin = chunk_.begin; begin < chunk_.end; begin += looked_up_at_once) {
        const std::size_t end = std::min(begin + looked_up_at_once, chunk_.end), first = chunk_.change_count;
        if (!letters_are_places) find_places(begin, end);
        if (wants_changes) {
            look_up(letters_are_places ? letters_ : told, begin, end);
            choose(first);
        } else {
            growth_.modules +=
                std::accumulate(told + begin, told + end, std::int64_t{0},
                                [&](std::int64_t sum, LetterId place) { return sum + choosing_.lengths[place] - 1; });
        }
    }
    chunk_.changes[chunk_.change_count] = {held_, static_cast<std::uint32_t>(chunk_.end), 0};
    end();
}

void Measuring::follow() {
    machine_.clear_batches();
    choose(0);
    end();
}

/// Decides what becomes of changes, from one on.
void Measuring::choose(std::size_t first) {
    const bool packed = input_.ancestry == Ancestry::drawers;
    std::size_t waiting = waiting_count_;  // at hand: what is stored might be the member, for all C++ knows
    for (std::size_t k = first; k < chunk_.change_count; ++k) {
        Change& change = chunk_.changes[k];
        if (change.module < replaced_) continue;
        const Outcome& outcome = choosing_.outcomes[change.plan];
        if (outcome.way != Outcome::Way::drawn) {
            find_out(outcome, change);
            continue;
        }
        drawers_[waiting] = identities_[packed ? change.drawers() : change.module];
        waiting_[waiting] = {static_cast<std::uint32_t>(k), outcome.index};
        if (++waiting < drawn_at_once) continue;
        waiting_count_ = waiting;
        hold_lotteries();
        waiting = 0;
    }
    waiting_count_ = waiting;
}

void Measuring::end() {
    hold_lotteries();
    for (std::uint32_t trial = 0; trial < choosing_.trials.size(); ++trial) decide(trial);
    chunk_.out_end = chunk_.end - chunk_.begin + static_cast<std::size_t>(growth_.modules);
    chunk_.out_parameters_end =
        chunk_.parameters_end - chunk_.parameters_at + static_cast<std::size_t>(growth_.parameters);
    chunk_.out_drawers_end = chunk_.drawers_end - chunk_.drawers_at + static_cast<std::size_t>(growth_.drawers);
    chunk_.out_changes_end = static_cast<std::size_t>(growth_.ahead);
}

/// Collects what changes by the places in the table. That is as good as random: it is no branch.
void Measuring::look_up(const LetterId* places, std::size_t begin, std::size_t end) {
    const Told* const told = choosing_.told.data();
    Change* change = chunk_.changes + chunk_.change_count;
    std::uint64_t held = held_;
    for (std::size_t i = begin; i < end; ++i) {
        const Told& here = told[places[i]];
        *change = {held, static_cast<std::uint32_t>(i), places[i]};
        change += here.changes;
        held += here.holding;
    }
    chunk_.change_count = static_cast<std::size_t>(change - chunk_.changes);
    held_ = held;
}

Site Measuring::site_at(const Change& change) const {
    const double* const values =
        values_ + static_cast<std::uint32_t>(change.parameters() - static_cast<std::uint32_t>(chunk_.parameters_at));
    return site_of(input_, change.module, values, change.drawers());
}

void Measuring::find_out(const Outcome& outcome, Change& change) {
    if (outcome.way == Outcome::Way::known)
        take(change, plan_of(change, outcome.index));
    else if (outcome.way == Outcome::Way::tested && tests_ == Tests::together)
        test(outcome.index, change);
    else if (outcome.way != Outcome::Way::spelled)
        take(change, choose(choosing_.trials[outcome.index], change));
    else
        spell(choosing_.trials[outcome.index], change);
}

const CompiledProduction* Measuring::choose(const Trial& trial, const Change& change) {
    const std::span<const std::uint32_t> tried(choosing_.tried.data() + trial.begin, trial.end - trial.begin);
    const Site site = site_at(change);
    try {
        return matcher_.choose(input_.model.rules, tried, site);
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, input_.model.source->alphabet, site.letter, site.values, input_.step));
    }
}

void Measuring::test(std::uint32_t trial, const Change& change) {
    Batch& batch = machine_.batch(trial);
    add_to(batch, input_, change.module, site_at(change).values);
    batch.changes[batch.count] = static_cast<std::uint32_t>(&change - chunk_.changes);
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
        if (!machine_.run(*production.tests, batch)) return decide_one_by_one(trial);
        const double* const holds = machine_.result(*production.tests, 0);
        for (std::size_t i = 0; i < batch.count; ++i) taken[i] = holds[i] != 0 ? choice : taken[i];
    }
    for (std::size_t i = 0; i < batch.count; ++i) {
        Change& change = chunk_.changes[batch.changes[i]];
        take(change, plan_of(change, taken[i]));
    }
    batch.count = 0;
}

/// Some condition cannot be tested for all of them, perhaps for none who comes to it.
void Measuring::decide_one_by_one(std::uint32_t trial) {
    Batch& batch = machine_.batch(trial);
    for (std::size_t i = 0; i < batch.count; ++i) {
        Change& change = chunk_.changes[batch.changes[i]];
        take(change, plan_of(change, rank_of(choose(choosing_.trials[trial], change))));
    }
    batch.count = 0;
}

void Measuring::spell(const Trial& trial, Change& change) {
    const Site site = site_at(change);
    const CompiledProduction* spelled = nullptr;
    for (std::uint32_t k = trial.begin; k < trial.end && !spelled; ++k) {
        const CompiledProduction& production = input_.model.rules.productions[choosing_.tried[k]];
        if (matcher_.match_strict(production, site)) spelled = &production;
    }
    take(change, spelled);
}

void Measuring::take(Change& change, const CompiledProduction* production) {
    take(change, plan_of(change, rank_of(production)));
    replaced_ = change.module + plans_.choices[change.plan].width;
}

void Measuring::hold_lotteries() {
    if (waiting_count_ == 0) return;
    std::array<std::uint64_t, drawn_at_once> draws;
    Growth growth;
    first_draws(input_.key, input_.step, {drawers_.data(), waiting_count_}, draws.data());
    for (std::size_t k = 0; k < waiting_count_; ++k) {
        const Lottery& lottery = choosing_.lotteries[waiting_[k].lottery];
        std::size_t fallen = 0;
        for (const std::uint64_t limit : lottery.limits) fallen += draws[k] >= limit;
        const std::uint32_t plan = lottery.prizes[fallen];
        chunk_.changes[waiting_[k].change].plan = plan;
        growth += plans_.growths[plan];
    }
    growth_ += growth;
    waiting_count_ = 0;
}

}  // namespace

void measure(const StepInput& input, Scratch& scratch, Chunk& chunk, Machine& machine) {
    // Changes have room among those of all chunks.
    const std::size_t room = chunk.begin + static_cast<std::size_t>(&chunk - scratch.chunks.data());
    const auto scan = [&](Tests tests) {
        chunk.change_count = 0;
        Measuring(input, chunk, machine, tests).scan(scratch.told.data(), scratch.changes.data() + room);
    };
    try {
        scan(Tests::together);
    } catch (const RunError&) {
        scan(Tests::alone);  // those that waited may be wrong, and stand before
    }
}

void measure_changes(const StepInput& input, Chunk& chunk, Machine& machine) {
    Measuring(input, chunk, machine).follow();
}

}  // namespace espalier

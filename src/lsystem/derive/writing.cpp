#include "lsystem/derive/writing.h"

#include "lsystem/derive/lanes.h"
#include "lsystem/derive/measuring.h"

#include <algorithm>
#include <numeric>

namespace espalier {
namespace {

inline void copy_letters(const LetterId* from, LetterId* to) {
    std::memcpy(to, from, letter_block * sizeof(LetterId));
}

inline void copy_values(const double* from, double* to) {
    std::memcpy(to, from, value_block * sizeof(double));
}

/// Where reading and writing are.
struct Cursor {
    const LetterId* in;
    const double* values;
    LetterId* out;
    double* out_values;
    std::size_t drawers;     ///< read before, where programs may ask for them
    std::uint64_t next = 0;  ///< Plan::next of what was written since the stretch began

    /// `Spelled`: the plan may replace several modules.
    template <bool Valued = true, bool Spelled = false>
    void pass(const Plan& plan) {
        in += Spelled ? plan.width : 1;
        out += plan.length;
        if constexpr (Valued) {
            values += Spelled ? plan.reads : plan.arity;
            out_values += plan.parameters;
        }
        next += plan.next;
    }
    /// Passes modules that live on, where nothing is foreseen: some letters need choosing.
    void pass(std::size_t modules, std::size_t parameters) {
        in += modules;
        values += parameters;
        out += modules;
        out_values += parameters;
    }
};

class Writer {
public:
    Writer(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to);

    bool write();

private:
    std::size_t safe_count() const;
    void write_round(std::size_t count);
    template <bool Valued, bool Spelled>
    void write_each(std::size_t count);
    template <std::size_t block>
    void write_letters(std::size_t count);
    template <bool Valued>
    void write_runs(std::size_t count);
    template <bool Valued>
    void write_run(std::size_t count);
    template <bool Valued>
    bool write_successor(const Plan& plan, const Cursor& at);
    const Plan& plan();
    bool write_module();
    bool write_rounds();
    void wait(const CompiledProduction& production, const LetterId* in, const double* values, double* to);
    void settle(const CompiledProduction& production);
    Batch& batch(const CompiledProduction& production) {
        return machine_.batch(static_cast<std::size_t>(&production - input_.model.rules.productions.data()));
    }
    void run(const Program& program, const Plan& plan, const Cursor& at);
    // By value: a cursor whose address is known to others would be kept in memory by the loop that moves it.
    bool write_rest(const Plan& plan, Cursor at);
    void write_values(const Plan& plan, Cursor at);
    [[noreturn]] void report(const EvaluationError& error, const Cursor& at) const;
    std::size_t module_at(const LetterId* in) const { return static_cast<std::size_t>(in - letters_); }
    void end_stretch();

    const StepInput& input_;
    const Scratch& scratch_;
    const Plans& plans_;
    const LetterId* const letters_;
    const LetterId* const told_;
    const Chunk& chunk_;
    std::vector<Stretch>& stretches_;
    Machine& machine_;
    Matcher matcher_;
    const bool valued_;
    /// Modules that live on are copied together, between those that were found to change.
    const bool in_runs_;
    const Change* change_;  ///< the next one
    bool finite_ = true;    ///< all values that were computed in columns
    bool waits_ = false;    ///< a module for values
    Cursor at_, stretch_;
    const LetterId* const in_end_;
    const double* const values_end_;  ///< of the whole string: blocks may be read beyond the chunk
    LetterId* const out_end_;
    double* const out_values_end_;
};

Writer::Writer(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to)
    : input_(input),
      scratch_(scratch),
      plans_(input.model.plans),
      letters_(input.from.letters.data()),
      told_(scratch.told.data()),
      chunk_(chunk),
      stretches_(scratch.stretches[static_cast<std::size_t>(&chunk - scratch.chunks.data())]),
      machine_(machine),
      matcher_(input.model, input.view, machine),
      valued_(plans_.valued()),
      in_runs_(!plans_.all_known && !keeps_places(input)),
      change_(chunk.changes),
      at_{letters_ + chunk.begin, input.from.parameters.data() + chunk.parameters_at, to.letters.data() + chunk.out,
          to.parameters.data() + chunk.out_parameters, chunk.drawers_at},
      stretch_(at_),
      in_end_(letters_ + chunk.end),
      values_end_(input.from.parameters.data() + input.from.parameters.size()),
      out_end_(to.letters.data() + chunk.out_end),
      out_values_end_(to.parameters.data() + chunk.out_parameters_end) {
    matcher_.set_draws(input.key, input.step);
}

/// How many modules can be written in whole blocks even if each of them becomes as long as any.
std::size_t Writer::safe_count() const {
    const auto left = static_cast<std::size_t>(in_end_ - at_.in);
    std::size_t count = std::min(left, std::max(grain / plans_.longest, std::size_t{1}));
    if (chunk_.in_blocks) return count;
    const auto limit = [&](std::ptrdiff_t room, std::size_t most, std::size_t block) {
        // Blocks of modules that live on are copied, too.
        const std::size_t more = in_runs_ ? letter_block : 0;
        const auto last = static_cast<std::ptrdiff_t>(whole_blocks(std::max<std::size_t>(most, 1), block) + more);
        if (room < last)
            count = 0;
        else if (most > 0)
            count = std::min(count, static_cast<std::size_t>(room - last) / most + 1);
    };
    limit(out_end_ - at_.out, plans_.longest, letter_block);
    if (in_runs_) limit(letters_ + input_.from.size() - at_.in, 1, 1);
    if (valued_) {
        limit(out_values_end_ - at_.out_values, plans_.most_parameters, value_block);
        limit(values_end_ - at_.values, plans_.most_read, value_block);
    }
    return count;
}

/// Writes in whole blocks; false if a value is not finite.
template <bool Valued>
[[gnu::always_inline]] inline bool Writer::write_successor(const Plan& plan, const Cursor& at) {
    copy_letters(plan.block.data(), at.out);
    if (plan.length > letter_block) {
        for (std::size_t k = letter_block; k < plan.length; k += letter_block) {
            copy_letters(plan.letters + k, at.out + k);
        }
    }
    if constexpr (Valued) {
        if (plan.kind == Plan::Kind::lanes) return write_lanes(plan, at.values, at.out_values);
        if (plan.kind == Plan::Kind::copy || plan.kind == Plan::Kind::wide_copy) {
            copy_run<value_block>(at.values, at.out_values, plan.arity);
        } else if (plan.kind == Plan::Kind::program) {
            if (plan.production->values)
                wait(*plan.production, at.in, at.values, at.out_values);
            else
                write_values(plan, at);
        } else if (plan.kind == Plan::Kind::mixed) {
            if (!write_lanes(plan, at.values, at.out_values)) return false;
            if (!plan.production->values) return write_rest(plan, at);
            wait(*plan.production, at.in, at.values, at.out_values);
        }
    }
    return true;
}

template <bool Valued, bool Spelled>
void Writer::write_each(std::size_t count) {
    const Plan* const plans =
        plans_.of_letter.data();  // at hand: blocks may be written over members, for all C++ knows
    const LetterId* const string_end = letters_ + input_.from.size();
    const LetterId* const end = at_.in + count;
    Cursor at = at_;
    while (at.in < end) {
        const Plan& own = plans[*at.in];
        if (own.kind == Plan::Kind::copy) {
            *at.out = *at.in;
            if constexpr (Valued) copy_values(at.values, at.out_values);
            at.pass<Valued>(own);
            continue;
        }
        const Plan& plan = Spelled ? spelled_plan(own, at.in, string_end) : own;
        if (!write_successor<Valued>(plan, at)) break;
        at.pass<Valued, Spelled>(plan);
    }
    const bool whole = at.in >= end;
    at_ = at;
    // A value is not finite: what is wrong is found out module by module.
    if (!whole) write_module();
}

/// Writes letters alone. Choices are as good as random, so that there is no branch for what lives on.
template <std::size_t block>
void Writer::write_letters(std::size_t count) {
    const Plan* const* const plans = input_.model.choosing.plans.data();
    const LetterId* const told = told_ + module_at(at_.in);
    LetterId* out = at_.out;
    for (std::size_t i = 0; i < count; ++i) {
        const Plan& plan = *plans[told[i]];
        std::memcpy(out, plan.block.data(), block * sizeof(LetterId));
        if (block == letter_block && plan.length > letter_block) {
            for (std::size_t k = block; k < plan.length; k += block) copy_letters(plan.letters + k, out + k);
        }
        out += plan.length;
    }
    at_.in += count;
    at_.out = out;
}

/// Writes up to the last change among so many modules.
template <bool Valued>
void Writer::write_runs(std::size_t count) {
    const std::size_t done = module_at(at_.in);
    while (change_->module < done) ++change_;
    if (change_->module >= done + count) return write_run<Valued>(count);
    const Plan* const plans = plans_.choices.data();
    const double* const values = input_.from.parameters.data();
    const auto end = static_cast<std::uint32_t>(done + count);
    const Change* change = change_;
    Cursor at = at_;
    bool whole = true;
    for (; change->module < end; ++change) {
        const LetterId* const in = letters_ + change->module;
        if (in < at.in) continue;  // replaced with one before it
        const auto modules = static_cast<std::size_t>(in - at.in);
        const auto parameters = change->parameters() - static_cast<std::uint32_t>(at.values - values);
        copy_run<letter_block>(at.in, at.out, modules);
        if constexpr (Valued) copy_run<run_value_block>(at.values, at.out_values, parameters);
        at.pass(modules, parameters);
        at.drawers = change->drawers();
        const Plan& plan = plans[change->plan];
        whole = write_successor<Valued>(plan, at);
        if (!whole) break;
        at.in += plan.width;
        at.values += plan.reads;
        at.out += plan.length;
        at.out_values += plan.parameters;
        at.drawers += plan.read_drawers;
    }
    change_ = change;
    at_ = at;
    // A value is not finite: what is wrong is found out module by module.
    if (!whole) write_module();
}

/// Writes so many modules that live on.
template <bool Valued>
void Writer::write_run(std::size_t count) {
    const std::uint64_t held =
        std::accumulate(at_.in, at_.in + count, std::uint64_t{0},
                        [&](std::uint64_t sum, LetterId letter) { return sum + plans_.holdings[letter]; });
    const std::size_t parameters = held >> 32;
    copy_run<letter_block>(at_.in, at_.out, count);
    if constexpr (Valued) copy_run<run_value_block>(at_.values, at_.out_values, parameters);
    at_.pass(count, parameters);
    at_.drawers += static_cast<std::uint32_t>(held);
}

void Writer::write_round(std::size_t count) {
    if (in_runs_)
        valued_ ? write_runs<true>(count) : write_runs<false>(count);
    else if (plans_.spelled && plans_.all_known)
        valued_ ? write_each<true, true>(count) : write_each<false, true>(count);
    else if (plans_.all_known)
        valued_ ? write_each<true, false>(count) : write_each<false, false>(count);
    else
        plans_.longest <= letter_block / 2 ? write_letters<letter_block / 2>(count)
                                           : write_letters<letter_block>(count);
}

/// Of the module at hand.
const Plan& Writer::plan() {
    const Plan& plan = plans_.of_letter[*at_.in];
    if (plans_.all_known) return spelled_plan(plan, at_.in, letters_ + input_.from.size());
    if (!in_runs_) return *input_.model.choosing.plans[told_[module_at(at_.in)]];
    while (change_->module < module_at(at_.in)) ++change_;
    return change_->module == module_at(at_.in) ? plans_.choices[change_->plan] : plan.choices[0];
}

bool Writer::write_module() {
    const Plan& plan = this->plan();
    if (out_end_ - at_.out < std::ptrdiff_t{plan.length} || values_end_ - at_.values < std::ptrdiff_t{plan.reads} ||
        out_values_end_ - at_.out_values < std::ptrdiff_t{plan.parameters}) {
        return false;
    }
    std::copy_n(plan.production ? plan.letters : plan.block.data(), plan.length, at_.out);
    if (plan.kind == Plan::Kind::program || plan.kind == Plan::Kind::mixed ||
        (plan.kind == Plan::Kind::lanes &&
         !write_lanes_exactly(*plan.lanes, plan.parameters, plan.reads > 0, at_.values, at_.out_values))) {
        write_values(plan, at_);
    } else if (plan.kind != Plan::Kind::lanes) {
        std::copy_n(at_.values, plan.parameters, at_.out_values);
    }
    at_.in += plan.width;
    at_.values += plan.reads;
    at_.out += plan.length;
    at_.out_values += plan.parameters;
    at_.drawers += plan.read_drawers;
    at_.next += plan.next;
    return true;
}

/// Runs a program for the successor of a module, with its formals bound.
void Writer::run(const Program& program, const Plan& plan, const Cursor& at) {
    const CompiledProduction& production = *plan.production;
    if (production.reads_context || production.writes_draw) {
        const Site site = site_of(input_, module_at(at.in), at.values, at.drawers);
        matcher_.bind(production, site);
        matcher_.begin_successor(production, site);
    } else {
        matcher_.bind_strict(production, at.values);
    }
    if (!production.after.empty()) machine_.run(production.after);
    machine_.run(program);
}

/// Writes over the lanes what a program has to compute; false if a value is not finite.
bool Writer::write_rest(const Plan& plan, const Cursor at) {
    bool finite = true;
    const CompiledProduction& production = *plan.production;
    try {
        run(production.rest, plan, at);
    } catch (const EvaluationError& error) {
        report(error, at);
    }
    for (std::size_t k = 0; k < production.rest_places.size(); ++k) {
        const double value = machine_.value(production.rest.results[k]);
        at.out_values[production.rest_places[k]] = value;
        finite &= value - value == 0;
    }
    return finite;
}

void Writer::write_values(const Plan& plan, const Cursor at) {
    const CompiledProduction& production = *plan.production;
    try {
        run(production.successor, plan, at);
        for (std::size_t k = 0; k < production.parameters; ++k) {
            at.out_values[k] = machine_.value(production.successor.results[k]);
        }
        require_finite(production, at.out_values);
    } catch (const EvaluationError& error) {
        report(error, at);
    }
}

void Writer::report(const EvaluationError& error, const Cursor& at) const {
    throw RunError(describe(error, input_.model.source->alphabet, *at.in, at.values, input_.step));
}

void Writer::end_stretch() {
    stretches_.push_back({static_cast<std::size_t>(at_.out - stretch_.out),
                          static_cast<std::size_t>(at_.out_values - stretch_.out_values), at_.next});
    at_.next = 0;
    stretch_ = at_;
}

/// Lets a module wait until the values of many are computed.
void Writer::wait(const CompiledProduction& production, const LetterId* in, const double* values, double* to) {
    Batch& waiting = batch(production);
    add_to(waiting, input_, module_at(in), values);
    waiting.to[waiting.count] = to;
    waits_ = true;
    if (++waiting.count == ColumnProgram::lanes) settle(production);
}

/// Computes the values that modules wait for.
void Writer::settle(const CompiledProduction& production) {
    Batch& waiting = batch(production);
    if (waiting.count == 0) return;
    finite_ &= machine_.run(*production.values, waiting);
    double difference = 0;  // to themselves
    for (std::size_t r = 0; r < production.values->results(); ++r) {
        const double* const results = machine_.result(*production.values, r);
        const std::size_t place = production.rest_places.empty() ? r : production.rest_places[r];
        for (std::size_t k = 0; k < waiting.count; ++k) {
            waiting.to[k][place] = results[k];
            difference += results[k] - results[k];
        }
    }
    finite_ &= difference == 0;
    waiting.count = 0;
}

bool Writer::write() {
    if (!input_.model.computes_columns) return write_rounds();
    const Cursor begin = at_;
    const std::vector<CompiledProduction>& productions = input_.model.rules.productions;
    machine_.clear_batches();
    try {
        if (!write_rounds()) return false;
        if (!waits_) return true;
        for (const CompiledProduction& production : productions) settle(production);
        if (finite_) return true;
    } catch (const RunError&) {
        // Those that wait may be wrong, and stand before.
    }
    at_ = stretch_ = begin;
    change_ = chunk_.changes;
    stretches_.clear();
    while (at_.in < in_end_) {
        if (!write_module()) return false;
    }
    end_stretch();
    return at_.in == in_end_;
}

bool Writer::write_rounds() {
    stretches_.clear();
    while (at_.in < in_end_) {
        if (const std::size_t count = safe_count(); count > 0)
            write_round(count);
        else if (!write_module())
            return false;
        if (at_.out - stretch_.out >= static_cast<std::ptrdiff_t>(grain)) end_stretch();
    }
    end_stretch();
    return at_.in == in_end_ && at_.out == out_end_ && at_.out_values == out_values_end_ &&
           at_.values == input_.from.parameters.data() + chunk_.parameters_end;
}

}  // namespace

bool write(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to) {
    return Writer(input, scratch, chunk, machine, to).write();
}

}  // namespace espalier

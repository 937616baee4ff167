#include "lsystem/derive/write.h"

#include "lsystem/derive/choose.h"
#include "lsystem/derive/lanes.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

/// Where reading and writing are.
struct Cursor {
    const LetterId* in;
    const double* values;
    LetterId* out;
    double* out_values;

    /// Passes modules that live on.
    void pass(std::size_t modules, std::size_t parameters) {
        in += modules;
        values += parameters;
        out += modules;
        out_values += parameters;
    }
    void pass(const Plan& plan) {
        in += plan.width;
        values += plan.reads;
        out += plan.length;
        out_values += plan.parameters;
    }
};

class Writer {
public:
    Writer(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements, Machine& machine,
           ModuleString& to);

    void run();

private:
    enum class How { in_blocks, exactly };
    template <bool Valued, How how>
    void write_all();
    template <bool Valued>
    void write_all_in_blocks();
    template <bool Valued>
    bool has_room(const Cursor& at, std::size_t modules, std::size_t parameters, const Plan& plan) const;
    template <bool Valued>
    bool write_successor(const Plan& plan, const Cursor& at);
    // Cursors by value: one whose address is known to others would be kept in memory by the loop that moves it.
    void write_exactly(const Plan& plan, Cursor at);
    void write_rest_of_chunk(Cursor at);
    void wait(const CompiledProduction& production, const LetterId* in, const double* values, double* to);
    void settle(const CompiledProduction& production);
    void run(const Program& program, const Plan& plan, const Cursor& at);
    bool write_mixed(const Plan& plan, Cursor at);
    void run_program(const Plan& plan, Cursor at);
    [[noreturn]] void report(const EvaluationError& error, const Cursor& at) const;
    std::size_t module_at(const LetterId* in) const {
        return static_cast<std::size_t>(in - input_.from.letters.data());
    }
    std::size_t parameter_at(const double* value) const {
        return static_cast<std::size_t>(value - input_.from.parameters.data());
    }

    const StepInput& input_;
    const Plans& plans_;
    const Chunk& chunk_;
    const std::span<const Replacement> replacements_;
    Machine& machine_;
    Matcher matcher_;
    bool finite_ = true;  ///< all values that were computed in columns
    bool waits_ = false;  ///< a module for values
    const Cursor begin_;
    // Where blocks may be read and written.
    const LetterId* const in_end_;
    const double* const values_end_;
    LetterId* const out_end_;
    double* const out_values_end_;
};

Writer::Writer(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements, Machine& machine,
               ModuleString& to)
    : input_(input),
      plans_(input.system.plans),
      chunk_(chunk),
      replacements_(replacements),
      machine_(machine),
      matcher_(input.system, input.view, machine),
      begin_{input.from.letters.data() + chunk.begin, input.from.parameters.data() + chunk.parameters_begin,
             to.letters.data() + chunk.at.modules, to.parameters.data() + chunk.at.parameters},
      in_end_(input.from.letters.data() + reach(input.from.letters, input.from.size(), spare_letters, true)),
      values_end_(input.from.parameters.data() +
                  reach(input.from.parameters, input.from.parameters.size(), spare_values, true)),
      out_end_(to.letters.data() +
               reach(to.letters, chunk.at.modules + chunk.becomes.modules, spare_letters, chunk.is_last)),
      out_values_end_(to.parameters.data() + reach(to.parameters, chunk.at.parameters + chunk.becomes.parameters,
                                                   spare_values, chunk.is_last)) {
    matcher_.set_random(input.key, input.step);
}

/// In whole blocks, where they stay within the chunk's part of the string.
template <bool Valued>
inline bool Writer::has_room(const Cursor& at, std::size_t modules, std::size_t parameters, const Plan& plan) const {
    const auto m = static_cast<std::ptrdiff_t>(modules + letter_block);
    if (in_end_ - at.in < m || out_end_ - at.out < m + std::ptrdiff_t(plan.length)) return false;
    if (!Valued) return true;
    const auto p = static_cast<std::ptrdiff_t>(parameters + run_value_block);
    return values_end_ - at.values >= p + std::ptrdiff_t(plan.reads) &&
           out_values_end_ - at.out_values >= p + std::ptrdiff_t(plan.parameters);
}

/// Writes in whole blocks; false if a value is not finite.
template <bool Valued>
[[gnu::always_inline]] inline bool Writer::write_successor(const Plan& plan, const Cursor& at) {
    copy_run<letter_block>(plan.length > letter_block ? plan.letters : plan.block.data(), at.out, plan.length);
    if constexpr (Valued) {
        if (plan.kind == Plan::Kind::lanes) return write_lanes(plan, at.values, at.out_values);
        if (plan.kind == Plan::Kind::copy) {
            copy_run<value_block>(at.values, at.out_values, plan.parameters);
        } else if (plan.kind == Plan::Kind::program) {
            if (plan.production->values)
                wait(*plan.production, at.in, at.values, at.out_values);
            else
                run_program(plan, at);
        } else if (plan.kind == Plan::Kind::mixed) {
            if (!write_lanes(plan, at.values, at.out_values)) return false;
            if (!plan.production->values) return write_mixed(plan, at);
            wait(*plan.production, at.in, at.values, at.out_values);
        }
    }
    return true;
}

template <bool Valued, Writer::How how>
void Writer::write_all() {
    const Plan* const plans = plans_.choices.data();
    const LetterId* const letters = input_.from.letters.data();
    Cursor at = begin_;
    for (const Replacement& replacement : replacements_) {
        const LetterId* const in = letters + replacement.module;
        if (in < at.in) continue;  // replaced with one before it
        const Plan& plan = plans[replacement.plan];
        const auto modules = static_cast<std::size_t>(in - at.in);
        const std::size_t parameters = Valued ? replacement.parameters_at - parameter_at(at.values) : 0;
        if (how == How::in_blocks && has_room<Valued>(at, modules, parameters, plan)) {
            copy_run<letter_block>(at.in, at.out, modules);
            if constexpr (Valued) copy_run<run_value_block>(at.values, at.out_values, parameters);
            at.pass(modules, parameters);
            if (!write_successor<Valued>(plan, at)) write_exactly(plan, at);
        } else {
            copy_exactly(at.in, at.out, modules);
            copy_exactly(at.values, at.out_values, parameters);
            at.pass(modules, parameters);
            write_exactly(plan, at);
        }
        at.pass(plan);
    }
    write_rest_of_chunk(at);
}

void Writer::write_rest_of_chunk(const Cursor at) {
    copy_exactly(at.in, at.out, chunk_.end - module_at(at.in));
    copy_exactly(at.values, at.out_values, chunk_.parameters_end - parameter_at(at.values));
}

/// Nothing behind the successor is written over. Throws RunError if a value is not finite.
void Writer::write_exactly(const Plan& plan, const Cursor at) {
    copy_exactly(plan.production ? plan.letters : plan.block.data(), at.out, plan.length);
    if (plan.kind == Plan::Kind::copy)
        copy_exactly(at.values, at.out_values, plan.parameters);
    else if (plan.kind == Plan::Kind::program || plan.kind == Plan::Kind::mixed ||
             (plan.kind == Plan::Kind::lanes &&
              !write_lanes_exactly(*plan.lanes, plan.parameters, plan.reads > 0, at.values, at.out_values)))
        run_program(plan, at);
}

/// Runs a program for the successor of a module, with its formals bound.
void Writer::run(const Program& program, const Plan& plan, const Cursor& at) {
    const CompiledProduction& production = *plan.production;
    if (production.reads_context || production.writing_samples) {
        const std::size_t module = module_at(at.in);
        const Site site{module, parameter_at(at.values), *at.in, at.values, input_.identity(module)};
        matcher_.bind(production, site);
        matcher_.begin_successor(production, site);
    } else {
        matcher_.bind_strict(production, at.values);
    }
    if (!production.after.empty()) machine_.run(production.after);
    machine_.run(program);
}

/// Writes over the lanes what a program has to compute; false if a value is not finite.
bool Writer::write_mixed(const Plan& plan, const Cursor at) {
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

void Writer::run_program(const Plan& plan, const Cursor at) {
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
    throw RunError(describe(error, input_.system.source->alphabet, *at.in, at.values, input_.step));
}

/// Lets a module wait until the values of many are computed.
void Writer::wait(const CompiledProduction& production, const LetterId* in, const double* values, double* to) {
    Batch& waiting = machine_.batch(static_cast<std::size_t>(&production - input_.system.rules.productions.data()));
    add_to(waiting, input_, module_at(in), values);
    if (production.writing_samples) {
        waiting.owners[waiting.count] = input_.identity(module_at(in));
        waiting.numbers[waiting.count] = Matcher::first_of_successor;
    }
    waiting.to[waiting.count] = to;
    waits_ = true;
    if (++waiting.count == ColumnProgram::lanes) settle(production);
}

/// Computes the values that modules wait for.
void Writer::settle(const CompiledProduction& production) {
    Batch& waiting = machine_.batch(static_cast<std::size_t>(&production - input_.system.rules.productions.data()));
    if (waiting.count == 0) return;
    finite_ &= machine_.run(*production.values, waiting, input_.key, input_.step);
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

template <bool Valued>
void Writer::write_all_in_blocks() {
    machine_.clear_batches();
    try {
        write_all<Valued, How::in_blocks>();
        if (!waits_) return;
        for (const CompiledProduction& production : input_.system.rules.productions) settle(production);
        if (finite_) return;
    } catch (const RunError&) {
        if (!waits_) throw;  // else one that waits may be wrong, and stand before
    }
    // A value is not finite: the first one in the string is to be named.
    write_all<Valued, How::exactly>();
}

void Writer::run() {
    plans_.valued() ? write_all_in_blocks<true>() : write_all_in_blocks<false>();
}

}  // namespace

void write(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements, Machine& machine,
           ModuleString& to) {
    Writer(input, chunk, replacements, machine, to).run();
}

}  // namespace espalier::lsystem

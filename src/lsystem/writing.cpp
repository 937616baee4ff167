#include "writing.h"

#include "measuring.h"

#include <algorithm>
#include <cstring>

namespace espalier {
namespace {

inline void copy_letters(const LetterId* from, LetterId* to) {
    std::memcpy(to, from, letter_block * sizeof(LetterId));
}

inline void copy_values(const double* from, double* to) {
    std::memcpy(to, from, value_block * sizeof(double));
}

/// Writes lanes in whole blocks; false if a value is not finite.
inline bool write_lanes(const Plan& plan, const double* values, double* out) {
    const std::uint32_t* const sources = plan.lanes->sources.data();
    const double* const scales = plan.lanes->scales.data();
    const double* const offsets = plan.lanes->offsets.data();
    const auto lane = [&](std::size_t k) { return values[sources[k]] * scales[k] + offsets[k]; };
    static_assert(value_block == 4);
    double even = 0, odd = 0;  // differences of values to themselves: 0 as long as all are finite
    for (std::size_t k = 0; k < plan.parameters; k += value_block) {
        const double a = lane(k), b = lane(k + 1), c = lane(k + 2), d = lane(k + 3);
        out[k] = a;
        out[k + 1] = b;
        out[k + 2] = c;
        out[k + 3] = d;
        even += (a - a) + (c - c);
        odd += (b - b) + (d - d);
    }
    return even + odd == 0;
}

/// The same for one module's values alone; false if one of them is not finite.
bool write_lanes_exactly(const Plan& plan, const double* values, double* out) {
    static constexpr double none = 0;
    const double* const source = plan.reads > 0 ? values : &none;
    bool finite = true;
    for (std::uint32_t k = 0; k < plan.parameters; ++k) {
        const double value = source[plan.lanes->sources[k]] * plan.lanes->scales[k] + plan.lanes->offsets[k];
        out[k] = value;
        finite &= value - value == 0;
    }
    return finite;
}

/// Where reading and writing are.
struct Cursor {
    const LetterId* in;
    const double* values;
    LetterId* out;
    double* out_values;
    std::uint64_t next = 0;  ///< Plan::next of what was written since the stretch began

    template <bool Valued = true, bool LooksAhead = true>
    void pass(const Plan& plan) {
        ++in;
        out += plan.length;
        if constexpr (Valued) {
            values += plan.arity;
            out_values += plan.parameters;
        }
        if constexpr (LooksAhead) next += plan.next;
    }
};

class Writer {
public:
    Writer(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to);

    bool write();

private:
    std::size_t safe_count() const;
    void write_round(std::size_t count);
    template <bool Valued, bool Choosing>
    void write_round(std::size_t count);
    bool write_module();
    void run(const Program& program, const Plan& plan, const Cursor& at);
    // By value: a cursor whose address is known to others would be kept in memory by the loop that moves it.
    bool write_rest(const Plan& plan, Cursor at);
    void write_values(const Plan& plan, Cursor at);
    [[noreturn]] void report(const EvaluationError& error, const Cursor& at) const;
    const Plan& plan_at(const LetterId* in) const;
    void end_stretch();

    const StepInput& input_;
    const Plans& plans_;
    const Scratch& scratch_;
    const Chunk& chunk_;
    std::vector<Stretch>& stretches_;
    Machine& machine_;
    Matcher matcher_;
    const bool valued_;
    Cursor at_, stretch_;
    const LetterId* const in_end_;
    const double* const values_end_;  ///< of the whole string: blocks may be read beyond the chunk
    LetterId* const out_end_;
    double* const out_values_end_;
};

Writer::Writer(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to)
    : input_(input),
      plans_(input.model.plans),
      scratch_(scratch),
      chunk_(chunk),
      stretches_(scratch.stretches[static_cast<std::size_t>(&chunk - scratch.chunks.data())]),
      machine_(machine),
      matcher_(input.model, input.view, machine),
      valued_(plans_.most_read + plans_.most_parameters > 0),
      at_{input.from.letters.data() + chunk.begin, input.from.parameters.data() + chunk.parameters_at,
          to.letters.data() + chunk.out, to.parameters.data() + chunk.out_parameters},
      stretch_(at_),
      in_end_(input.from.letters.data() + chunk.end),
      values_end_(input.from.parameters.data() + input.from.parameters.size()),
      out_end_(to.letters.data() + chunk.out_end),
      out_values_end_(to.parameters.data() + chunk.out_parameters_end) {
    matcher_.set_draws(input.key, input.step);
}

/// How many modules can be written in whole blocks even if each of them becomes as long as any.
std::size_t Writer::safe_count() const {
    std::size_t count =
        std::min(static_cast<std::size_t>(in_end_ - at_.in), std::max(grain / plans_.longest, std::size_t{1}));
    const auto limit = [&](std::ptrdiff_t room, std::size_t most, std::size_t block) {
        const auto last = static_cast<std::ptrdiff_t>(whole_blocks(std::max<std::size_t>(most, 1), block));
        if (room < last)
            count = 0;
        else if (most > 0)
            count = std::min(count, static_cast<std::size_t>(room - last) / most + 1);
    };
    limit(out_end_ - at_.out, plans_.longest, letter_block);
    if (valued_) {
        limit(out_values_end_ - at_.out_values, plans_.most_parameters, value_block);
        limit(values_end_ - at_.values, plans_.most_read, value_block);
    }
    return count;
}

template <bool Valued, bool Choosing>
void Writer::write_round(std::size_t count) {
    const Plan* const plans = plans_.of_letter.data();
    const LetterId* const letters = input_.from.letters.data();
    const LetterId* const choices = scratch_.choices.data();
    Cursor at = at_;
    for (const LetterId* const end = at.in + count; at.in != end;) {
        const Plan* plan = plans + *at.in;
        if constexpr (Choosing) {
            plan = plan->choices + choices[at.in - letters];
        }
        // Choices are as good as random: where nothing else depends on it, whether a module lives on is no branch.
        if constexpr (Valued || !Choosing) {
            if (plan->kind == Plan::Kind::copy) {
                *at.out = *at.in;
                if constexpr (Valued) copy_values(at.values, at.out_values);
                at.pass<Valued, !Choosing>(*plan);
                continue;
            }
        }
        copy_letters(plan->block.data(), at.out);
        if (plan->length > letter_block) {
            for (std::size_t k = letter_block; k < plan->length; k += letter_block) {
                copy_letters(plan->letters + k, at.out + k);
            }
        }
        if constexpr (Valued) {
            if (plan->kind == Plan::Kind::lanes) {
                if (!write_lanes(*plan, at.values, at.out_values)) break;
            } else if (plan->kind == Plan::Kind::wide_copy) {
                for (std::size_t k = 0; k < plan->arity; k += value_block) {
                    copy_values(at.values + k, at.out_values + k);
                }
            } else if (plan->kind == Plan::Kind::program) {
                write_values(*plan, at);
            } else if (plan->kind == Plan::Kind::mixed) {
                if (!write_lanes(*plan, at.values, at.out_values) || !write_rest(*plan, at)) break;
            }
        }
        at.pass<Valued, !Choosing>(*plan);
    }
    const bool whole = at.in == at_.in + count;
    at_ = at;
    // A value is not finite: what is wrong is found out module by module.
    if (!whole) write_module();
}

void Writer::write_round(std::size_t count) {
    if (plans_.all_known)
        valued_ ? write_round<true, false>(count) : write_round<false, false>(count);
    else
        valued_ ? write_round<true, true>(count) : write_round<false, true>(count);
}

const Plan& Writer::plan_at(const LetterId* in) const {
    const Plan& plan = plans_.of_letter[*in];
    if (plans_.all_known) return plan;
    return plan.choices[scratch_.choices[static_cast<std::size_t>(in - input_.from.letters.data())]];
}

/// Writes what replaces a module and nothing beyond it; false if it does not fit the chunk's measure.
bool Writer::write_module() {
    const Plan& plan = plan_at(at_.in);
    if (out_end_ - at_.out < std::ptrdiff_t{plan.length} || values_end_ - at_.values < std::ptrdiff_t{plan.reads} ||
        out_values_end_ - at_.out_values < std::ptrdiff_t{plan.parameters}) {
        return false;
    }
    std::copy_n(plan.production ? plan.letters : plan.block.data(), plan.length, at_.out);
    if (plan.kind == Plan::Kind::program || plan.kind == Plan::Kind::mixed ||
        (plan.kind == Plan::Kind::lanes && !write_lanes_exactly(plan, at_.values, at_.out_values))) {
        write_values(plan, at_);
    } else if (plan.kind != Plan::Kind::lanes) {
        std::copy_n(at_.values, plan.parameters, at_.out_values);
    }
    at_.pass(plan);
    return true;
}

/// Runs a program for the successor of a module, with its formals bound.
void Writer::run(const Program& program, const Plan& plan, const Cursor& at) {
    const CompiledProduction& production = *plan.production;
    if (production.reads_context || production.writes_draw) {
        const Site site = site_of(input_, static_cast<std::size_t>(at.in - input_.from.letters.data()), at.values);
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

bool Writer::write() {
    stretches_.clear();
    while (at_.in != in_end_) {
        if (const std::size_t count = safe_count(); count > 0)
            write_round(count);
        else if (!write_module())
            return false;
        if (at_.out - stretch_.out >= static_cast<std::ptrdiff_t>(grain)) end_stretch();
    }
    end_stretch();
    return at_.out == out_end_ && at_.out_values == out_values_end_ &&
           at_.values == input_.from.parameters.data() + chunk_.parameters_end;
}

}  // namespace

bool write(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to) {
    return Writer(input, scratch, chunk, machine, to).write();
}

}  // namespace espalier

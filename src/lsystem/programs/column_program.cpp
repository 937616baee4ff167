#include "lsystem/programs/column_program.h"

#include "base/math_columns.h"
#include "base/vector_clones.h"
#include "lsystem/programs/machine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace espalier::lsystem {
namespace {

constexpr std::size_t lanes = ColumnProgram::lanes;

bool is_jump(Opcode op) {
    return op >= Opcode::jump && op <= Opcode::jump_if_true;
}

/// Whether the instruction at `at` can be run in columns.
bool runs_in_columns(const Instruction& instruction, std::size_t at) {
    if (is_jump(instruction.op)) return instruction.b > at;
    if (instruction.op == Opcode::call) {
        return is_pure(instruction.function) || instruction.function == Function::ran ||
               instruction.function == Function::nran;
    }
    return instruction.op == Opcode::load_global ||
           (instruction.op >= Opcode::copy && instruction.op <= Opcode::single);
}

bool may_divide_by_zero(const Instruction& instruction, std::span<const double> constants) {
    const bool truncates = instruction.op == Opcode::remainder;
    if (!truncates && instruction.op != Opcode::divide) return false;
    if (instruction.b >= constants.size()) return true;
    return (truncates ? std::trunc(constants[instruction.b]) : constants[instruction.b]) == 0;
}

/// The modules that an instruction is run for.
struct Running {
    const double* goes_on;  ///< for each module, the number of the instruction where it goes on; null: all run
    double at;              ///< number of the instruction
    std::size_t count;

    bool runs(std::size_t k) const { return !goes_on || goes_on[k] <= at; }
};

/// Puts value(k) where the result of module k goes.
template <class Value>
[[gnu::always_inline]] inline void each(double* target, const Running& running, const Value& value) {
    if (!running.goes_on) {
        for (std::size_t k = 0; k < running.count; ++k) target[k] = value(k);
        return;
    }
    for (std::size_t k = 0; k < running.count; ++k) {
        const double computed = value(k);
        target[k] = running.goes_on[k] <= running.at ? computed : target[k];
    }
}

using Values = std::array<double, lanes>;

void store(const Values& values, double* target, const Running& running) {
    each(target, running, [&](std::size_t k) { return values[k]; });
}

void power_each(double* columns, std::uint32_t base, std::uint32_t exponent, double* target, const Running& running) {
    Values powers;
    math::pow({columns + base * lanes, running.count}, {columns + exponent * lanes, running.count}, powers.data());
    store(powers, target, running);
}

/// Functions of one value that are computed for several modules at a time; false for others.
bool compute(Function function, std::span<const double> a, double* values) {
    const bool of_angle = function == Function::sin || function == Function::cos;
    for (std::size_t k = 0; k < a.size(); ++k) values[k] = of_angle ? a[k] * degree : a[k];
    const std::span<const double> given(values, a.size());
    switch (function) {
        case Function::sin:
            math::sin(given, values);
            return true;
        case Function::cos:
            math::cos(given, values);
            return true;
        case Function::exp:
            math::exp(given, values);
            return true;
        case Function::log:
            math::log(given, values);
            return true;
        default:
            return false;
    }
}

/// A pure function of one value or several.
void call_each(double* columns, const Instruction& i, const Running& running, Arithmetic arithmetic) {
    double* const target = columns + i.target * lanes;
    if (i.function == Function::pow) return power_each(columns, i.a, i.a + 1, target, running);
    Values computed;
    if (compute(i.function, {columns + i.a * lanes, running.count}, computed.data()))
        return store(computed, target, running);
    std::vector<double> values(i.count);
    for (std::size_t k = 0; k < running.count; ++k) {
        if (!running.runs(k)) continue;
        for (std::size_t v = 0; v < values.size(); ++v) values[v] = columns[(i.a + v) * lanes + k];
        target[k] = call(i.function, values, arithmetic);
    }
}

/// The next random number in [0, 1) of each module; those that run are one further then.
void draw(const ColumnSamples& samples, const Running& running, Values& uniform) {
    std::array<std::uint64_t, lanes> drawn;
    samples_of(samples.key, samples.step, {samples.owners, running.count}, samples.numbers, drawn.data());
    for (std::size_t k = 0; k < running.count; ++k) {
        uniform[k] = static_cast<double>(drawn[k]) * 0x1p-53;
        samples.numbers[k] += running.runs(k);
    }
}

/// Normal deviates as RandomSamples::normal() makes them.
void draw_normal(const ColumnSamples& samples, const Running& running, Values& deviates) {
    Values angles;
    draw(samples, running, deviates);
    draw(samples, running, angles);
    for (std::size_t k = 0; k < running.count; ++k) {
        deviates[k] = 1 - deviates[k];
        angles[k] *= 2 * std::numbers::pi;
    }
    math::log({deviates.data(), running.count}, deviates.data());
    math::cos({angles.data(), running.count}, angles.data());
    for (std::size_t k = 0; k < running.count; ++k) deviates[k] = std::sqrt(-2 * deviates[k]) * angles[k];
}

/// False if an argument is not finite.
bool sample_each(double* columns, const Instruction& i, const Running& running, const ColumnSamples& samples) {
    const double* const a = columns + i.a * lanes;
    const double* const b = i.count > 1 ? a + lanes : a;
    for (std::size_t k = 0; k < running.count; ++k) {
        if (running.runs(k) && !(std::isfinite(a[k]) && std::isfinite(b[k]))) return false;
    }
    double* const target = columns + i.target * lanes;
    Values drawn;
    if (i.function == Function::ran) {
        draw(samples, running, drawn);
        each(target, running, [&](std::size_t k) { return a[k] * drawn[k]; });
    } else {
        draw_normal(samples, running, drawn);
        each(target, running, [&](std::size_t k) { return a[k] + b[k] * drawn[k]; });
    }
    return true;
}

/// True if a divisor is zero.
[[gnu::always_inline]] inline bool divides_by_zero(const double* columns, const Instruction& i,
                                                   const Running& running) {
    const double* const b = columns + i.b * lanes;
    unsigned zero = 0;
    for (std::size_t k = 0; k < running.count; ++k) {
        const double divisor = i.op == Opcode::remainder ? std::trunc(b[k]) : b[k];
        zero |= unsigned{divisor == 0} & unsigned{running.runs(k)};
    }
    return zero != 0;
}

/// Those for whom `jumps(a)` holds go on at instruction b.
template <class Jumps>
[[gnu::always_inline]] inline void jump_each(const double* columns, const Instruction& i, const Running& running,
                                             double* goes_on, const Jumps& jumps) {
    const double* const a = columns + i.a * lanes;
    for (std::size_t k = 0; k < running.count; ++k) {
        goes_on[k] = goes_on[k] <= running.at && jumps(a[k]) ? double(i.b) : goes_on[k];
    }
}

/// `goes_on`: for each module, the instruction where it does; null if no module jumps.
ESPALIER_VECTOR_CLONES
bool run_code(std::span<const ColumnProgram::Step> steps, double* columns, std::size_t count, double* goes_on,
              const Variables& variables, Arithmetic arithmetic, const ColumnSamples& samples) {
    static const Place nowhere;
    for (std::size_t n = 0; n < steps.size(); ++n) {
        const Instruction i = steps[n].instruction;
        const Running running{steps[n].is_skipped ? goes_on : nullptr, double(n), count};
        if (steps[n].may_divide_by_zero && arithmetic != Arithmetic::cpfg && divides_by_zero(columns, i, running))
            return false;
        double* const target = columns + i.target * lanes;
        const auto with = [&](const auto& operation) __attribute__((always_inline)) {
            const double* const a = columns + i.a * lanes;
            const double* const b = columns + i.b * lanes;
            each(
                target, running, [&](std::size_t k) __attribute__((always_inline)) { return operation(a[k], b[k]); });
        };
        switch (i.op) {
            case Opcode::copy:
                with([](double a, double) { return a; });
                break;
            case Opcode::negate:
                with([](double a, double) { return -a; });
                break;
            case Opcode::logical_not:
                with([](double a, double) { return a == 0 ? 1.0 : 0.0; });
                break;
            case Opcode::power:
                power_each(columns, i.a, i.b, target, running);
                break;
            case Opcode::multiply:
                with([](double a, double b) { return a * b; });
                break;
            case Opcode::divide:
                with([](double a, double b) { return b != 0 ? a / b : a; });
                break;
            case Opcode::remainder:
                with([](double a, double b) { return remainder(a, b, Arithmetic::cpfg, nowhere); });
                break;
            case Opcode::add:
                with([](double a, double b) { return a + b; });
                break;
            case Opcode::subtract:
                with([](double a, double b) { return a - b; });
                break;
            case Opcode::less:
                with([](double a, double b) { return a < b ? 1.0 : 0.0; });
                break;
            case Opcode::less_equal:
                with([](double a, double b) { return a <= b ? 1.0 : 0.0; });
                break;
            case Opcode::greater:
                with([](double a, double b) { return a > b ? 1.0 : 0.0; });
                break;
            case Opcode::greater_equal:
                with([](double a, double b) { return a >= b ? 1.0 : 0.0; });
                break;
            case Opcode::equal:
                with([](double a, double b) { return a == b ? 1.0 : 0.0; });
                break;
            case Opcode::not_equal:
                with([](double a, double b) { return a != b ? 1.0 : 0.0; });
                break;
            case Opcode::is_true:
                with([](double a, double) { return a != 0 ? 1.0 : 0.0; });
                break;
            case Opcode::held:
                with([](double a, double) { return held_by_or(a); });
                break;
            case Opcode::single:
                with([](double a, double) { return stored(a, Arithmetic::cpfg); });
                break;
            case Opcode::call:
                if (is_pure(i.function))
                    call_each(columns, i, running, arithmetic);
                else if (!sample_each(columns, i, running, samples))
                    return false;
                break;
            case Opcode::load_global:
                each(target, running, [value = variables.globals[i.a]](std::size_t) { return value; });
                break;
            case Opcode::jump:
                jump_each(columns, i, running, goes_on, [](double) { return true; });
                break;
            case Opcode::jump_if_false:
                jump_each(columns, i, running, goes_on, [](double a) { return a == 0; });
                break;
            case Opcode::jump_if_true:
                jump_each(columns, i, running, goes_on, [](double a) { return a != 0; });
                break;
            default:
                break;
        }
    }
    return true;
}

/// Gives registers columns: constants and parameters as they are met, temporaries behind them in their own order.
class Columns {
public:
    Columns(std::uint32_t constants, std::uint32_t formals) : constants_(constants), formals_(formals) {}

    void meet(std::uint32_t reg) {
        if (is_temporary(reg))
            temporaries_ = std::max(temporaries_, reg - constants_ - formals_ + 1);
        else
            met_.try_emplace(reg, static_cast<std::uint32_t>(met_.size()));
    }
    void meet(const Instruction& instruction) {
        if (!is_jump(instruction.op)) meet(instruction.target);
        if (reads_a(instruction.op)) meet(instruction.a);
        if (reads_b(instruction.op)) meet(instruction.b);
        // Several arguments are temporaries, side by side.
        for (std::uint32_t k = 1; k < instruction.count; ++k) meet(instruction.a + k);
    }
    /// Puts columns in the place of registers.
    void place(Instruction& instruction) const {
        instruction.target = is_jump(instruction.op) ? 0 : (*this)(instruction.target);
        if (reads_a(instruction.op)) instruction.a = (*this)(instruction.a);
        if (!is_jump(instruction.op)) instruction.b = reads_b(instruction.op) ? (*this)(instruction.b) : 0;
    }
    bool is_temporary(std::uint32_t reg) const { return reg >= constants_ + formals_; }
    std::uint32_t operator()(std::uint32_t reg) const {
        if (!is_temporary(reg)) return met_.at(reg);
        return static_cast<std::uint32_t>(met_.size()) + reg - constants_ - formals_;
    }
    std::size_t size() const { return met_.size() + temporaries_; }
    const std::map<std::uint32_t, std::uint32_t>& met() const { return met_; }

private:
    std::uint32_t constants_, formals_, temporaries_ = 0;
    std::map<std::uint32_t, std::uint32_t> met_;
};

}  // namespace

std::optional<ColumnProgram> ColumnProgram::make(const Program& program, std::span<const double> constants,
                                                 std::uint32_t formals, const Place& place) {
    ColumnProgram made;
    Columns columns(static_cast<std::uint32_t>(constants.size()), formals);
    std::uint32_t jumped_to = 0;
    for (const Instruction& instruction : program.code) {
        if (instruction.op == Opcode::end) break;
        const std::size_t at = made.steps_.size();
        if (!runs_in_columns(instruction, at)) return std::nullopt;
        columns.meet(instruction);
        made.steps_.push_back({instruction, at < jumped_to, may_divide_by_zero(instruction, constants)});
        if (is_jump(instruction.op)) jumped_to = std::max(jumped_to, instruction.b);
    }
    made.jumps_ = jumped_to > 0;
    for (const std::uint32_t result : program.results) columns.meet(result);
    for (Step& step : made.steps_) columns.place(step.instruction);
    for (const auto& [reg, column] : columns.met()) {
        if (reg < constants.size()) {
            made.constants_.push_back({column, constants[reg]});
            continue;
        }
        const std::optional<Source> source = place(reg - static_cast<std::uint32_t>(constants.size()));
        if (!source) return std::nullopt;
        made.inputs_.push_back({column, *source});
    }
    for (const std::uint32_t result : program.results) made.results_.push_back(columns(result));
    made.width_ = columns.size();
    return made;
}

bool ColumnProgram::run(const Modules& modules, std::size_t count, const Variables& variables, Arithmetic arithmetic,
                        const ColumnSamples& samples, std::vector<double>& columns) const {
    if (columns.size() < (width_ + 1) * lanes) columns.resize((width_ + 1) * lanes);
    double* const to = columns.data();
    double* const goes_on = to + width_ * lanes;
    if (jumps_) std::fill_n(goes_on, count, 0);
    for (const Constant& constant : constants_) std::fill_n(to + constant.column * lanes, count, constant.value);
    for (const Input& input : inputs_) {
        double* const column = to + input.column * lanes;
        const double* const* const values = modules[input.source.whose].data();
        for (std::size_t k = 0; k < count; ++k) column[k] = values[k][input.source.place];
    }
    return run_code(steps_, to, count, goes_on, variables, arithmetic, samples);
}

}  // namespace espalier::lsystem

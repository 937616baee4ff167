#include "column_program.h"

#include "espalier/base/vector_clones.h"

#include "machine.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier {
namespace {

constexpr std::size_t lanes = ColumnProgram::lanes;

bool has_two_operands(Opcode op) {
    return op >= Opcode::power && op <= Opcode::not_equal;
}

/// Whether an instruction can be run for modules whose other lanes are not to be looked at.
bool runs_in_columns(const Instruction& instruction, std::span<const double> constants) {
    switch (instruction.op) {
        case Opcode::remainder:
            return false;
        case Opcode::divide:
            return instruction.b < constants.size() && constants[instruction.b] != 0;
        case Opcode::call:
            return is_pure(instruction.function);
        case Opcode::load_global:
            return true;
        default:
            return instruction.op >= Opcode::copy && instruction.op <= Opcode::is_true;
    }
}

template <class Operation>
[[gnu::always_inline]] inline void each(double* columns, const Instruction& i, std::size_t count,
                                        const Operation& operation) {
    double* const target = columns + i.target * lanes;
    const double* const a = columns + i.a * lanes;
    const double* const b = columns + i.b * lanes;
    for (std::size_t k = 0; k < count; ++k) target[k] = operation(a[k], b[k]);
}

void call_each(double* columns, const Instruction& i, std::size_t count, bool quirks) {
    std::vector<double> values(i.count);
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t v = 0; v < values.size(); ++v) values[v] = columns[(i.a + v) * lanes + k];
        columns[i.target * lanes + k] = call(i.function, values, quirks);
    }
}

ESPALIER_VECTOR_CLONES
void run_code(const Instruction* code, std::size_t size, double* columns, std::size_t count, const Variables& variables,
              bool quirks) {
    for (std::size_t n = 0; n < size; ++n) {
        const Instruction i = code[n];
        const auto with = [&](const auto& operation) [[gnu::always_inline]] { each(columns, i, count, operation); };
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
                with([](double a, double b) { return std::pow(a, b); });
                break;
            case Opcode::multiply:
                with([](double a, double b) { return a * b; });
                break;
            case Opcode::divide:
                with([](double a, double b) { return a / b; });
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
            case Opcode::call:
                call_each(columns, i, count, quirks);
                break;
            case Opcode::load_global:
                std::fill_n(columns + i.target * lanes, count, variables.globals[i.a]);
                break;
            default:
                break;
        }
    }
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
    for (const Instruction& instruction : program.code) {
        if (instruction.op == Opcode::end) break;
        if (!runs_in_columns(instruction, constants)) return std::nullopt;
        columns.meet(instruction.target);
        if (instruction.op == Opcode::call) {
            if (!columns.is_temporary(instruction.a)) return std::nullopt;
            for (std::uint32_t k = 0; k < instruction.count; ++k) columns.meet(instruction.a + k);
        } else if (instruction.op != Opcode::load_global) {
            columns.meet(instruction.a);
            if (has_two_operands(instruction.op)) columns.meet(instruction.b);
        }
        made.code_.push_back(instruction);
    }
    for (const std::uint32_t result : program.results) columns.meet(result);
    for (Instruction& instruction : made.code_) {
        instruction.target = columns(instruction.target);
        if (instruction.op != Opcode::load_global) instruction.a = columns(instruction.a);
        instruction.b = has_two_operands(instruction.op) ? columns(instruction.b) : 0;
    }
    for (const auto& [reg, column] : columns.met()) {
        if (reg < constants.size()) {
            made.constants_.push_back({column, constants[reg]});
            continue;
        }
        const std::optional<std::uint32_t> at = place(reg - static_cast<std::uint32_t>(constants.size()));
        if (!at) return std::nullopt;
        made.inputs_.push_back({column, *at});
    }
    for (const std::uint32_t result : program.results) made.results_.push_back(columns(result));
    made.width_ = columns.size();
    return made;
}

void ColumnProgram::run(const double* const* values, std::size_t count, const Variables& variables, bool quirks,
                        std::vector<double>& columns) const {
    if (columns.size() < width_ * lanes) columns.resize(width_ * lanes);
    double* const to = columns.data();
    for (const Constant& constant : constants_) std::fill_n(to + constant.column * lanes, count, constant.value);
    for (const Input& input : inputs_) {
        double* const column = to + input.column * lanes;
        for (std::size_t k = 0; k < count; ++k) column[k] = values[k][input.place];
    }
    run_code(code_.data(), code_.size(), to, count, variables, quirks);
}

}  // namespace espalier

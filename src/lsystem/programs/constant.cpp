#include "lsystem/programs/constant.h"

#include "lsystem/programs/functions.h"

#include <cmath>
#include <vector>

namespace espalier::lsystem {
namespace {

std::optional<double> called(const Expression& expression, Arithmetic arithmetic, std::span<const double> formals) {
    const Arguments allowed = arguments_of(expression.function);
    const auto count = static_cast<int>(expression.operands.size());
    if (!is_pure(expression.function) || count < allowed.fewest || (allowed.most >= 0 && count > allowed.most)) {
        return std::nullopt;
    }
    std::vector<double> values;
    for (const Expression& operand : expression.operands) {
        const std::optional<double> value = constant_value(operand, arithmetic, formals);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    return call(expression.function, values, arithmetic);
}

std::optional<double> applied(const Expression& expression, Arithmetic arithmetic, std::span<const double> formals) {
    const Operator op = expression.op;
    const std::optional<double> a = constant_value(expression.operands[0], arithmetic, formals);
    if (!a) return std::nullopt;
    if (expression.operands.size() == 1) return apply(op, *a, 0);
    if (op == Operator::logical_and && *a == 0) return 0;
    if (op == Operator::logical_or && *a != 0) {
        return arithmetic == Arithmetic::cpfg && keeps_left_of_or(expression) ? held_by_or(*a) : 1;
    }
    const std::optional<double> b = constant_value(expression.operands[1], arithmetic, formals);
    if (!b) return std::nullopt;
    if (op != Operator::divide && op != Operator::remainder) return apply(op, *a, *b);
    // A division by zero is a mistake only where it is evaluated, as in if (N > 0) { x = 1 / N; }.
    const bool by_zero = (op == Operator::divide ? *b : std::trunc(*b)) == 0;
    if (by_zero && arithmetic != Arithmetic::cpfg) return std::nullopt;
    return op == Operator::divide ? divide(*a, *b, arithmetic, expression.place)
                                  : remainder(*a, *b, arithmetic, expression.place);
}

}  // namespace

std::optional<double> constant_value(const Expression& expression, Arithmetic arithmetic,
                                     std::span<const double> formals) {
    switch (expression.kind) {
        case Expression::Kind::number:
            return expression.value;
        case Expression::Kind::formal:
            return expression.index < formals.size() ? std::optional(formals[expression.index]) : std::nullopt;
        case Expression::Kind::call:
            return called(expression, arithmetic, formals);
        case Expression::Kind::apply:
            return applied(expression, arithmetic, formals);
        case Expression::Kind::conditional: {
            const std::optional<double> condition = constant_value(expression.operands[0], arithmetic, formals);
            if (!condition) return std::nullopt;
            return constant_value(expression.operands[*condition != 0 ? 1 : 2], arithmetic, formals);
        }
        default:
            return std::nullopt;
    }
}

}  // namespace espalier::lsystem

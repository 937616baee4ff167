#include "language/constant.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace espalier::language {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::optional<double> applied(Operator op, const std::vector<double>& v) {
    switch (op) {
        case Operator::negate:
            return -v[0];
        case Operator::logical_not:
            return v[0] == 0;
        case Operator::power:
            return std::pow(v[0], v[1]);
        case Operator::multiply:
            return v[0] * v[1];
        case Operator::divide:
            return v[0] / v[1];
        case Operator::remainder:
            // Both sides are truncated to integers first.
            if (std::trunc(v[1]) == 0) return std::nullopt;
            return std::fmod(std::trunc(v[0]), std::trunc(v[1]));
        case Operator::add:
            return v[0] + v[1];
        case Operator::subtract:
            return v[0] - v[1];
        case Operator::less:
            return v[0] < v[1];
        case Operator::less_equal:
            return v[0] <= v[1];
        case Operator::greater:
            return v[0] > v[1];
        case Operator::greater_equal:
            return v[0] >= v[1];
        case Operator::equal:
            return v[0] == v[1];
        case Operator::not_equal:
            return v[0] != v[1];
        case Operator::logical_and:
            return v[0] != 0 && v[1] != 0;
        case Operator::logical_or:
            return v[0] != 0 || v[1] != 0;
    }
    return std::nullopt;
}

std::optional<double> called(Function function, const std::vector<double>& v) {
    switch (function) {
        case Function::sin:
            return std::sin(v[0] * degree);
        case Function::cos:
            return std::cos(v[0] * degree);
        case Function::tan:
            return std::tan(v[0] * degree);
        case Function::asin:
            return std::asin(v[0]) / degree;
        case Function::acos:
            return std::acos(v[0]) / degree;
        case Function::atan:
            return std::atan(v[0]) / degree;
        case Function::atan2:
            return std::atan2(v[0], v[1]) / degree;
        case Function::exp:
            return std::exp(v[0]);
        case Function::log:
            return std::log(v[0]);
        case Function::sqrt:
            return std::sqrt(v[0]);
        case Function::pow:
            return std::pow(v[0], v[1]);
        case Function::fabs:
            return std::fabs(v[0]);
        case Function::floor:
            return std::floor(v[0]);
        case Function::ceil:
            return std::ceil(v[0]);
        case Function::round:
            return std::round(v[0]);
        case Function::sign:
            return v[0] > 0 ? 1 : v[0] < 0 ? -1 : 0;
        case Function::trunc:
            return std::trunc(v[0]);
        case Function::min:
            return std::fmin(v[0], v[1]);
        case Function::max:
            return std::fmax(v[0], v[1]);
        case Function::clamp:
            return std::fmin(std::fmax(v[0], v[1]), v[2]);
        case Function::lerp:
            return v[0] + (v[1] - v[0]) * v[2];
        default:
            return std::nullopt;
    }
}

}  // namespace

std::optional<double> constant_value(const Expression& expression) {
    std::vector<double> values;
    for (const Expression& operand : expression.operands) {
        const std::optional<double> value = constant_value(operand);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    const std::optional<double> result = [&]() -> std::optional<double> {
        switch (expression.kind) {
            case Expression::Kind::number:
                return expression.value;
            case Expression::Kind::apply:
                return applied(expression.op, values);
            case Expression::Kind::conditional:
                return values[0] != 0 ? values[1] : values[2];
            case Expression::Kind::call:
                return called(expression.function, values);
            default:
                return std::nullopt;
        }
    }();
    return result && std::isfinite(*result) ? result : std::nullopt;
}

}  // namespace espalier::language

#include "language/parser/timed.h"

#include "language/parser/constant.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace espalier::language {
namespace {

/// What sums of time steps may lack of an age.
constexpr double tolerance = 1e-9;
/// Generations in one step.
constexpr double usual_depth = 1000;

Expression binary(Operator op, Expression left, Expression right) {
    Expression result;
    result.kind = Expression::Kind::apply;
    result.op = op;
    result.place = left.place;
    result.operands = {std::move(left), std::move(right)};
    return result;
}

Expression at_least_zero(Expression value) {
    Expression result;
    result.kind = Expression::Kind::call;
    result.function = Function::max;
    result.place = value.place;
    result.operands = {Expression::number(0, value.place), std::move(value)};
    return result;
}

Expression formal(std::uint32_t index, const Place& place) {
    Expression result;
    result.kind = Expression::Kind::formal;
    result.index = index;
    result.place = place;
    return result;
}

/// `age == terminal age` in a condition, which may go on: age == 2 && vigour > 1. Null if it begins otherwise.
Expression* comparison_of_age(std::optional<Expression>& condition) {
    if (!condition) return nullptr;
    Expression* node = &*condition;
    const auto is = [&](Operator op) { return node->kind == Expression::Kind::apply && node->op == op; };
    while (is(Operator::logical_and)) node = &node->operands.front();
    const bool compares = is(Operator::equal) && node->operands.front().kind == Expression::Kind::formal &&
                          node->operands.front().index == 0;
    return compares ? node : nullptr;
}

/// The production by which the modules of a letter grow older.
Production growing_older(LetterId letter, int arity, const Expression& time_step) {
    Production production;
    production.place = time_step.place;
    production.strict = {{letter, 0, false, time_step.place}};
    ModuleTemplate older{letter, {}, time_step.place};
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(arity); ++i) {
        production.formals.push_back(fmt::format("x{}", i));
        older.arguments.push_back(formal(i, time_step.place));
    }
    older.arguments.front() = binary(Operator::add, std::move(older.arguments.front()), time_step);
    production.successor = {std::move(older)};
    return production;
}

/// The production by which a module of its terminal age or more is replaced.
Production at_terminal_age(Production production, const std::set<LetterId>& timed) {
    Expression& comparison = *comparison_of_age(production.condition);
    const Expression terminal = comparison.operands.back();
    const Expression over = at_least_zero(binary(Operator::subtract, formal(0, terminal.place), terminal));
    comparison.op = Operator::greater_equal;
    comparison.operands.back() = binary(Operator::subtract, terminal, Expression::number(tolerance, terminal.place));
    for (ModuleTemplate& module : production.successor) {
        if (!timed.contains(module.letter)) continue;
        Expression& age = module.arguments.front();
        age = binary(Operator::add, std::move(age), over);
    }
    return production;
}

}  // namespace

void TimedRules::require_terminal_age(const Production& production, Location at) {
    if (!production.left.empty() || !production.right.empty() || production.strict.size() != 1) {
        throw SyntaxError{at, "a timed production replaces one module, without context"};
    }
    if (production.weight) throw SyntaxError{at, "a timed production has no weight"};
    std::optional<Expression> condition = production.condition;
    const Expression* const comparison = comparison_of_age(condition);
    if (!comparison) {
        throw SyntaxError{at, "a timed production says at which age it replaces the module: A(age) : age == 1 --> ..."};
    }
    const std::optional<double> age = constant_value(comparison->operands.back());
    if (age && *age <= 0) throw SyntaxError{at, fmt::format("a terminal age must be greater than 0, not {}", *age)};
}

void TimedRules::add_to(LSystem& system, const Alphabet& alphabet) const {
    if (!rules.present) return;
    std::set<LetterId> timed;
    for (const Production& production : rules.productions) timed.insert(production.strict.front().letter);
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        const auto letter = static_cast<LetterId>(i);
        const bool is_listed = std::find(ageing.begin(), ageing.end(), alphabet.symbol_of(letter)) != ageing.end();
        if (is_listed && alphabet.arity(letter) > 0) timed.insert(letter);
    }
    const Expression step = time_step.value_or(Expression::number(1));
    for (const LetterId letter : timed)
        system.productions.push_back(growing_older(letter, alphabet.arity(letter), step));
    system.decomposition.present = true;
    system.decomposition.maximum_depth = rules.maximum_depth.value_or(Expression::number(usual_depth));
    for (const Production& production : rules.productions)
        system.decomposition.productions.push_back(at_terminal_age(production, timed));
}

}  // namespace espalier::language

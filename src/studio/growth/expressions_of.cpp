#include "studio/growth/expressions_of.h"

#include <algorithm>

namespace espalier::studio {
namespace {

bool holds_in_block(const Block& block, const ExpressionTest& test) {
    return std::any_of(block.begin(), block.end(), [&](const Statement& statement) {
        return std::any_of(statement.expressions.begin(), statement.expressions.end(),
                           [&](const std::optional<Expression>& one) { return holds_in(one, test); }) ||
               std::any_of(statement.bodies.begin(), statement.bodies.end(),
                           [&](const Block& body) { return holds_in_block(body, test); });
    });
}

bool holds_in_modules(const std::vector<ModuleTemplate>& modules, const ExpressionTest& test) {
    return std::any_of(modules.begin(), modules.end(), [&](const ModuleTemplate& module) {
        return std::any_of(module.arguments.begin(), module.arguments.end(),
                           [&](const Expression& argument) { return holds_in(argument, test); });
    });
}

bool holds_in_productions(const std::vector<Production>& productions, const ExpressionTest& test) {
    return std::any_of(productions.begin(), productions.end(), [&](const Production& production) {
        return holds_in_block(production.before, test) || holds_in(production.condition, test) ||
               holds_in_block(production.after, test) || holds_in_modules(production.successor, test) ||
               holds_in(production.weight, test);
    });
}

}  // namespace

bool holds_in(const Expression& expression, const ExpressionTest& test) {
    return test(expression) || std::any_of(expression.operands.begin(), expression.operands.end(),
                                           [&](const Expression& operand) { return holds_in(operand, test); });
}

bool holds_in(const std::optional<Expression>& expression, const ExpressionTest& test) {
    return expression && holds_in(*expression, test);
}

bool holds_in_derivation(const LSystem& system, const ExpressionTest& test) {
    return holds_in_block(system.start, test) || holds_in_block(system.start_each, test) ||
           holds_in_block(system.end_each, test) || holds_in_block(system.end, test) ||
           holds_in_modules(system.axiom, test) || holds_in_productions(system.productions, test) ||
           holds_in_productions(system.decomposition.productions, test);
}

bool holds_in_homomorphism(const LSystem& system, const ExpressionTest& test) {
    return holds_in_productions(system.homomorphism.productions, test);
}

}  // namespace espalier::studio

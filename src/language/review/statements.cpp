// Statements and conditions.
#include "language/parser/visit.h"
#include "language/review/parts.h"

namespace espalier::language {
namespace {

bool acts(const Expression& expression) {
    bool found = false;
    visit_expression(expression, [&](const Expression& part) {
        found |= part.kind == Expression::Kind::assign || part.kind == Expression::Kind::call;
    });
    return found;
}

void review_condition(const Expression& condition, Findings& findings) {
    if (condition.kind != Expression::Kind::assign) return;
    findings.warn(condition.place, "this condition assigns ('==' compares)");
}

void review_block(const Block& block, Findings& findings) {
    for (const Statement& statement : block) {
        const bool plain = statement.kind == Statement::Kind::expression;
        if (plain && !acts(*statement.expressions.front())) {
            findings.warn(statement.place, "this statement changes nothing ('=' assigns)");
        }
        const bool conditional = !plain && statement.kind != Statement::Kind::for_loop;
        for (const std::optional<Expression>& expression : statement.expressions) {
            if (conditional && expression) review_condition(*expression, findings);
        }
        for (const Block& body : statement.bodies) review_block(body, findings);
    }
}

}  // namespace

void review_statements(const LSystem& system, Findings& findings) {
    for (const Block* block : {&system.start, &system.start_each, &system.end_each, &system.end}) {
        review_block(*block, findings);
    }
    for_each_production(system, [&](const Production& production) {
        review_block(production.before, findings);
        if (production.condition) review_condition(*production.condition, findings);
        review_block(production.after, findings);
    });
}

}  // namespace espalier::language

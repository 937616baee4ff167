// Visits every expression of an L-system.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include <optional>
#include <vector>

namespace espalier::language {

/// Works on const and non-const trees alike; `visit` sees a node before its operands.
template <class Tree, class Visit>
void visit_expression(Tree& expression, Visit&& visit) {
    visit(expression);
    for (auto& operand : expression.operands) visit_expression(operand, visit);
}

template <class Statements, class Visit>
void visit_block(Statements& block, Visit&& visit) {
    for (auto& statement : block) {
        for (auto& expression : statement.expressions) {
            if (expression) visit_expression(*expression, visit);
        }
        for (auto& body : statement.bodies) visit_block(body, visit);
    }
}

template <class Rule, class Visit>
void visit_production(Rule& production, Visit&& visit) {
    visit_block(production.before, visit);
    if (production.condition) visit_expression(*production.condition, visit);
    visit_block(production.after, visit);
    for (auto& module : production.successor) {
        for (auto& argument : module.arguments) visit_expression(argument, visit);
    }
    if (production.weight) visit_expression(*production.weight, visit);
}

template <class System, class Visit>
void for_each_expression(System& system, Visit&& visit) {
    const auto visit_optional = [&](auto& expression) {
        if (expression) visit_expression(*expression, visit);
    };
    visit_optional(system.seed);
    visit_optional(system.derivation_length);
    for (auto& array : system.arrays) {
        for (auto& dimension : array.dimensions) visit_expression(dimension, visit);
        for (auto& value : array.values) visit_expression(value, visit);
    }
    for (auto* block : {&system.start, &system.start_each, &system.end_each, &system.end}) visit_block(*block, visit);
    for (auto& module : system.axiom) {
        for (auto& argument : module.arguments) visit_expression(argument, visit);
    }
    for (auto& production : system.productions) visit_production(production, visit);
    for (auto* rules : {&system.decomposition, &system.homomorphism}) {
        visit_optional(rules->maximum_depth);
        visit_optional(rules->seed);
        for (auto& production : rules->productions) visit_production(production, visit);
    }
}

}  // namespace espalier::language

#include "lsystem/compile/locals.h"

#include "lsystem/programs/constant.h"
#include "lsystem/programs/functions.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::lsystem {
namespace {

using Assigned = std::vector<bool>;  ///< by global: it has been, on every way here

/// Follows programs in the order in which they are evaluated.
class Follower {
public:
    explicit Follower(std::size_t globals) : local_(globals, true), assigned_(globals) {
        std::fill_n(local_.begin(), std::min<std::size_t>(2, globals),
                    false);  // the step and the length are everybody's
    }

    /// What follows is evaluated on its own: nothing is assigned yet.
    void begin() { assigned_.assign(local_.size(), false); }
    void follow(const Expression& expression);
    void follow(const Block& block) {
        for (const Statement& statement : block) follow(statement);
    }
    void follow(const std::vector<ModuleTemplate>& modules) {
        for (const ModuleTemplate& module : modules) {
            for (const Expression& argument : module.arguments) follow(argument);
        }
    }
    template <class Part>
    void follow(const std::optional<Part>& part) {
        if (part) follow(*part);
    }
    const std::vector<bool>& locals() const { return local_; }

private:
    void follow(const Statement& statement);
    void branch(const Statement& statement);
    void loop(const Statement& statement);

    std::vector<bool> local_;
    Assigned assigned_;
};

Assigned both(Assigned a, const Assigned& b) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = a[k] && b[k];
    return a;
}

void Follower::follow(const Expression& expression) {
    using Kind = Expression::Kind;
    const std::vector<Expression>& operands = expression.operands;
    if (expression.kind == Kind::global) {
        if (!assigned_[expression.index]) local_[expression.index] = false;
    } else if (expression.kind == Kind::assign) {
        const Expression& target = operands[0];
        for (const Expression& subscript : target.operands) follow(subscript);
        follow(operands[1]);
        if (target.kind == Kind::global) assigned_[target.index] = true;
    } else if (expression.kind == Kind::conditional) {
        follow(operands[0]);
        const Assigned before = assigned_;
        follow(operands[1]);
        const Assigned then = std::exchange(assigned_, before);
        follow(operands[2]);
        assigned_ = both(assigned_, then);
    } else if (expression.kind == Kind::apply &&
               (expression.op == Operator::logical_and || expression.op == Operator::logical_or)) {
        follow(operands[0]);
        const Assigned before = assigned_;  // the right side may be left out
        follow(operands[1]);
        assigned_ = before;
    } else {
        for (const Expression& operand : operands) follow(operand);
    }
}

void Follower::follow(const Statement& statement) {
    using Kind = Statement::Kind;
    if (statement.kind == Kind::branch)
        branch(statement);
    else if (statement.kind == Kind::expression)
        for (const auto& expression : statement.expressions) follow(expression);
    else
        loop(statement);
}

void Follower::loop(const Statement& statement) {
    const bool counted = statement.kind == Statement::Kind::for_loop;
    const auto expression = [&](std::size_t k) {
        if (k < statement.expressions.size()) follow(statement.expressions[k]);
    };
    if (counted) expression(0);
    const Assigned before = assigned_;  // no turn may be done, or none to its end
    const bool tested_last = statement.kind == Statement::Kind::do_loop;
    if (!tested_last) expression(counted ? 1 : 0);
    for (const Block& body : statement.bodies) follow(body);
    if (tested_last) expression(0);
    if (counted) expression(2);
    assigned_ = before;
}

void Follower::branch(const Statement& statement) {
    std::optional<Assigned> after;
    const auto end = [&] { after = after ? both(*after, assigned_) : assigned_; };
    for (std::size_t k = 0; k < statement.bodies.size(); ++k) {
        if (k < statement.expressions.size()) follow(statement.expressions[k]);
        const Assigned before = assigned_;
        follow(statement.bodies[k]);
        end();
        assigned_ = before;
    }
    if (statement.expressions.size() >= statement.bodies.size()) end();  // no body is run
    assigned_ = *after;
}

/// Calls look(expression) for all expressions of a part.
template <class Look>
void for_each_expression(const Expression& expression, const Look& look) {
    look(expression);
    for (const Expression& operand : expression.operands) for_each_expression(operand, look);
}

template <class Look>
void for_each_expression(const Block& block, const Look& look) {
    for (const Statement& statement : block) {
        for (const auto& expression : statement.expressions) {
            if (expression) for_each_expression(*expression, look);
        }
        for (const Block& body : statement.bodies) for_each_expression(body, look);
    }
}

/// Whether something is done that others may notice, other than by the values of `locals`.
template <class Part>
bool is_noticed(const Part& part, const std::vector<bool>& locals) {
    bool noticed = false;
    for_each_expression(part, [&](const Expression& expression) {
        if (expression.kind == Expression::Kind::call) noticed |= has_order(expression.function);
        if (expression.kind != Expression::Kind::assign) return;
        const Expression& target = expression.operands[0];
        const bool own = target.kind == Expression::Kind::formal ||
                         (target.kind == Expression::Kind::global && locals[target.index]);
        noticed |= !own;
    });
    return noticed;
}

template <class Part>
bool contains(const Part& part, bool (*property)(const Expression&)) {
    bool found = false;
    for_each_expression(part, [&](const Expression& expression) { found |= property(expression); });
    return found;
}

bool assigns(const Expression& expression) {
    return expression.kind == Expression::Kind::assign;
}

bool takes_samples(const Expression& expression) {
    return expression.kind == Expression::Kind::call && samples(expression.function);
}

/// A division by zero, a subscript out of range, or what other functions refuse.
bool may_fail(const Expression& expression) {
    using Kind = Expression::Kind;
    if (expression.kind == Kind::element) return true;
    if (expression.kind == Kind::call) return !is_pure(expression.function);
    const bool divides = expression.op == Operator::divide || expression.op == Operator::remainder;
    if (expression.kind != Kind::apply || !divides) return false;
    const std::optional<double> divisor = constant_value(expression.operands[1], Arithmetic::double_precision);
    return !divisor || std::trunc(*divisor) == 0;
}

bool has_loops(const Block& block) {
    return std::any_of(block.begin(), block.end(), [](const Statement& statement) {
        using Kind = Statement::Kind;
        const bool loops = statement.kind != Kind::expression && statement.kind != Kind::branch;
        return loops || std::any_of(statement.bodies.begin(), statement.bodies.end(), has_loops);
    });
}

bool may_fail(const Block& block) {
    return contains(block, static_cast<bool (*)(const Expression&)>(may_fail)) || has_loops(block);
}

/// Whether a production can be applied in any order, though what its block before the condition computes is computed
/// again for the successor.
bool is_free(const Production& production, bool stochastic, const std::vector<bool>& locals) {
    if (is_noticed(production.before, locals) || is_noticed(production.after, locals)) return false;
    if (contains(production.before, takes_samples) || (stochastic && !production.before.empty())) return false;
    for (const auto* tested : {&production.condition, &production.weight}) {
        if (*tested && (is_noticed(**tested, locals) || contains(**tested, assigns))) return false;
    }
    bool computes = false;
    for (const ModuleTemplate& module : production.successor) {
        for (const Expression& argument : module.arguments) {
            if (is_noticed(argument, locals)) return false;
            computes = true;
        }
    }
    // Without values to compute nobody would run the blocks, and learn of their mistakes.
    return computes || !(may_fail(production.before) || may_fail(production.after));
}

void follow(const std::vector<Production>& productions, Follower& follower) {
    for (const Production& production : productions) {
        follower.begin();
        follower.follow(production.before);
        follower.follow(production.condition);
        follower.begin();
        follower.follow(production.weight);
        follower.begin();
        follower.follow(production.before);
        follower.follow(production.after);
        follower.follow(production.successor);
    }
}

}  // namespace

bool is_needed(const Block& block, const Expression& expression) {
    if (may_fail(block)) return true;
    bool assigned = false;
    for_each_expression(block, [&](const Expression& one) {
        if (one.kind != Expression::Kind::assign) return;
        for_each_expression(expression, [&](const Expression& read) {
            assigned |= read.kind == one.operands[0].kind && read.index == one.operands[0].index;
        });
    });
    return assigned;
}

std::optional<std::vector<bool>> find_locals(const LSystem& system) {
    Follower follower(system.globals.size());
    for (const auto* rules : {&system.productions, &system.decomposition.productions, &system.homomorphism.productions})
        follow(*rules, follower);
    for (const Block* block : {&system.start, &system.start_each, &system.end_each, &system.end}) {
        follower.begin();
        follower.follow(*block);
    }
    follower.begin();
    follower.follow(system.axiom);
    follower.begin();
    follower.follow(system.derivation_length);
    follower.begin();
    follower.follow(system.seed);
    const std::vector<bool>& locals = follower.locals();
    const bool any_block = std::any_of(system.productions.begin(), system.productions.end(),
                                       [](const Production& p) { return !p.before.empty() || !p.after.empty(); });
    const bool stochastic = system.seed.has_value();
    const bool free =
        std::all_of(system.productions.begin(), system.productions.end(),
                    [&](const Production& production) { return is_free(production, stochastic, locals); }) &&
        std::all_of(system.decomposition.productions.begin(), system.decomposition.productions.end(),
                    [&](const Production& production) { return is_free(production, false, locals); });
    return free && any_block ? std::optional(locals) : std::nullopt;
}

}  // namespace espalier::lsystem

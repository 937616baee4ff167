// Reads expressions and statements.
#pragma once

#include "espalier/lsystem/arithmetic.h"
#include "espalier/lsystem/expression.h"

#include "language/parser/names.h"
#include "language/parser/scanner.h"

#include <string>

namespace espalier::language {

/// Operators, tightest first: ! ; unary - ; ^ ; * / % ; + - ; < <= > >= ; == != <> ; && ; || ; ?: ; = += -= *= /=.
/// All binary operators associate to the left, ^ too; unary minus binds tighter than ^.
class ExpressionParser {
public:
    ExpressionParser(Scanner& in, Names& names, Mistakes& mistakes, Arithmetic arithmetic)
        : in_(in), names_(names), mistakes_(mistakes), arithmetic_(arithmetic) {}

    Expression expression();
    /// The same, ended by the arrow of a production, which elsewhere could be read as operators.
    Expression condition();
    /// A module's or a function's argument, which may be text.
    Expression argument(bool may_be_text);
    /// `{ ... }`
    Block block();
    /// Forgets what a mistake interrupted.
    void reset() { ends_at_arrow_ = false, loops_ = 0; }

private:
    // Expressions.
    Expression conditional();
    Expression binary(int least_precedence);
    Expression unary();
    Expression primary();
    Expression number();
    Expression text();
    Expression call(std::string_view name, Location at);
    bool is_before_braces() const;
    Expression normalised(Expression call, Location at);
    Expression element(std::string_view name, Location at);
    Expression address();
    Expression name_or_call();
    struct Infix {
        std::size_t length = 0;
        Operator op = Operator::add;
        int precedence = 0;
    };
    Infix infix();
    bool at_arrow() const;
    struct AssignmentSign {
        std::size_t length = 0;
        std::optional<Operator> op = std::nullopt;
        bool step = false;  // ++ or --
    };
    static AssignmentSign assignment_sign(std::string_view text);
    AssignmentSign sign_after_name();
    Expression assignment(Expression target, Location at);
    Expression apply(Operator op, Location at, Expression left, std::optional<Expression> right = std::nullopt);
    Expression infixed(Operator op, Location at, Expression left, Expression right);
    void check_height(Location at) const;

    // Statements.
    void statement(Block& block);
    Statement branch();
    Statement loop(Statement::Kind kind);
    Statement for_loop();
    Statement do_loop();
    Expression step_or_expression();
    Expression step_target();
    Expression parenthesised(std::string_view after);
    void end_of_statement();
    void recover_in_block();

    class DepthGuard;

    Scanner& in_;
    Names& names_;
    Mistakes& mistakes_;
    Arithmetic arithmetic_;
    int depth_ = 0;   // depth of the recursion at hand
    int height_ = 0;  // height of the tree read last
    int loops_ = 0;   // loops around the statement at hand
    bool ends_at_arrow_ = false;
};

}  // namespace espalier::language

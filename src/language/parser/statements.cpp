// The statements of blocks.
#include "language/parser/depth.h"
#include "language/parser/expressions.h"

#include <fmt/format.h>

#include <utility>

namespace espalier::language {

Block ExpressionParser::block() {
    const Scanner::Inside inside(in_, Scanner::Inside::braces);
    const DepthGuard guard(depth_, in_);
    const bool ends_at_arrow = std::exchange(ends_at_arrow_, false);
    in_.skip();
    const Location begin = in_.here();
    in_.expect("{", "to begin a block");
    const int loops = loops_;
    Block result;
    while (!in_.accept("}")) {
        if (in_.at_end()) throw SyntaxError{begin, "this block is never closed: '}' is missing"};
        const std::size_t start = in_.position();
        try {
            statement(result);
        } catch (const SyntaxError& mistake) {
            mistakes_.error(mistake);
            ends_at_arrow_ = false;
            loops_ = loops;
            recover_in_block();
            names_.note_skipped(in_.text(start, in_.position()));
        }
    }
    ends_at_arrow_ = ends_at_arrow;
    return result;
}

// Goes on behind the next ';' or the block the faulty statement has, and the 'else' that belongs to it.
void ExpressionParser::recover_in_block() {
    for (int braces = 0; !in_.at_end_of_text(); in_.take(1)) {
        const char c = in_.peek();
        if (c == '}' && braces == 0) return;
        if (c == '\n' && in_.ends_inside(in_.position(), true)) return;
        braces += c == '{' ? 1 : c == '}' ? -1 : 0;
        if ((c == ';' || c == '}') && braces == 0) {
            in_.take(1);
            if (in_.looking_at_name() != "else") return;
        }
    }
}

void ExpressionParser::statement(Block& block) {
    in_.skip();
    if (in_.accept(";")) return;
    if (in_.peek() == '{') {
        Block inner = this->block();
        std::move(inner.begin(), inner.end(), std::back_inserter(block));
        return;
    }
    const Place place = names_.place(in_.here());
    const std::string_view word = in_.looking_at_name();
    // A variable of an old model may have the name of a keyword.
    const bool assigned = sign_after_name().length > 0;
    Statement result;
    if (word == "if" && !assigned) {
        result = branch();
    } else if (word == "while" && !assigned) {
        result = loop(Statement::Kind::while_loop);
    } else if (word == "for" && !assigned) {
        result = for_loop();
    } else if (word == "do" && !assigned) {
        result = do_loop();
    } else if (word == "break" && !assigned) {
        if (loops_ == 0) mistakes_.error(in_.here(), "'break' is outside any loop");
        in_.take(word.size());
        end_of_statement();
        result.kind = Statement::Kind::break_loop;
    } else if (word == "else" && !assigned) {
        throw SyntaxError{in_.here(), "'else' without 'if'"};
    } else {
        result.expressions.push_back(step_or_expression());
        end_of_statement();
    }
    result.place = place;
    block.push_back(std::move(result));
}

// The ';' of the last statement of a block may be missing.
void ExpressionParser::end_of_statement() {
    if (in_.accept(";") || in_.looking_at("}")) return;
    in_.expected("';' after the statement");
}

Expression ExpressionParser::parenthesised(std::string_view after) {
    const Scanner::Inside inside(in_);
    in_.expect("(", fmt::format("after '{}'", after));
    Expression result = expression();
    in_.expect(")", fmt::format("after the condition of '{}'", after));
    return result;
}

Statement ExpressionParser::branch() {
    Statement result;
    result.kind = Statement::Kind::branch;
    while (true) {
        in_.accept_name();  // if
        result.expressions.push_back(parenthesised("if"));
        result.bodies.push_back(block());
        if (in_.looking_at_name() != "else") return result;
        in_.accept_name();
        if (in_.looking_at_name() == "if") continue;
        result.bodies.push_back(block());
        return result;
    }
}

Statement ExpressionParser::loop(Statement::Kind kind) {
    Statement result;
    result.kind = kind;
    in_.accept_name();
    result.expressions.push_back(parenthesised("while"));
    ++loops_;
    result.bodies.push_back(block());
    --loops_;
    return result;
}

Statement ExpressionParser::do_loop() {
    Statement result;
    result.kind = Statement::Kind::do_loop;
    in_.accept_name();
    ++loops_;
    result.bodies.push_back(block());
    --loops_;
    if (in_.looking_at_name() != "while") in_.expected("'while' after the block of 'do'");
    in_.accept_name();
    result.expressions.push_back(parenthesised("while"));
    end_of_statement();
    return result;
}

Statement ExpressionParser::for_loop() {
    Statement result;
    result.kind = Statement::Kind::for_loop;
    in_.accept_name();
    in_.expect("(", "after 'for'");
    for (const std::string_view end : {";", ";", ")"}) {
        if (in_.looking_at(end)) {
            result.expressions.emplace_back();
        } else {
            result.expressions.push_back(step_or_expression());
        }
        in_.expect(end, "in 'for (start; condition; step)'");
    }
    ++loops_;
    result.bodies.push_back(block());
    --loops_;
    return result;
}

// x++, x--, ++x, --x, or any expression.
Expression ExpressionParser::step_or_expression() {
    in_.skip();
    const Location at = in_.here();
    const bool increased = in_.accept("++");
    if (increased || in_.accept("--")) {
        Expression target = step_target();
        Expression sum =
            apply(increased ? Operator::add : Operator::subtract, at, target, Expression::number(1, target.place));
        Expression result;
        result.kind = Expression::Kind::assign;
        result.place = target.place;
        result.operands = {std::move(target), std::move(sum)};
        return result;
    }
    if (sign_after_name().step) return assignment(names_.assigned(in_.accept_name(), at), at);
    Expression result = expression();
    if (assignment_sign(in_.rest()).step) {
        if (result.kind != Expression::Kind::element) {
            throw SyntaxError{at, "only a variable or an element of an array can be increased or decreased"};
        }
        return assignment(std::move(result), at);
    }
    return result;
}

Expression ExpressionParser::step_target() {
    in_.skip();
    const Location at = in_.here();
    const std::string_view name = in_.accept_name();
    if (name.empty()) in_.expected("the name of a variable");
    return in_.looking_at("[") ? element(name, at) : names_.assigned(name, at);
}

}  // namespace espalier::language

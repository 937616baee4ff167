#include "language/parser/expressions.h"

#include "base/number.h"
#include "base/text.h"
#include "language/parser/constant.h"
#include "language/parser/depth.h"
#include "language/parser/functions.h"
#include "language/parser/visit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace espalier::language {
namespace {

constexpr int highest_tree = 400;

bool has_side_effects(const Expression& expression) {
    bool found = false;
    visit_expression(expression, [&](const Expression& node) {
        found = found || node.kind == Expression::Kind::assign ||
                (node.kind == Expression::Kind::call && !constant_value(node));
    });
    return found;
}

}  // namespace

Expression ExpressionParser::condition() {
    ends_at_arrow_ = true;
    Expression result = expression();
    ends_at_arrow_ = false;
    return result;
}

ExpressionParser::AssignmentSign ExpressionParser::assignment_sign(std::string_view text) {
    const char c = text.empty() ? '\0' : text[0];
    const char next = text.size() > 1 ? text[1] : '\0';
    if (c == '=') return next == '=' ? AssignmentSign{} : AssignmentSign{1};
    constexpr std::array<std::pair<char, Operator>, 4> compound{
        {{'+', Operator::add}, {'-', Operator::subtract}, {'*', Operator::multiply}, {'/', Operator::divide}}};
    for (const auto& [sign, op] : compound) {
        if (c == sign && next == '=') return {2, op};
    }
    // x++ and x-- are statements; within an expression the second sign is that of the operand.
    if (c != next || (c != '+' && c != '-')) return {};
    const std::size_t after = text.find_first_not_of(" \t", 2);
    if (after != std::string_view::npos && text[after] != ';' && text[after] != ')' && text[after] != '}') return {};
    return {2, c == '+' ? Operator::add : Operator::subtract, true};
}

ExpressionParser::AssignmentSign ExpressionParser::sign_after_name() {
    if (in_.looking_at_name().empty()) return {};
    Scanner ahead = in_;
    ahead.accept_name();
    ahead.skip();
    return assignment_sign(ahead.rest());
}

Expression ExpressionParser::expression() {
    const DepthGuard guard(depth_, in_);
    in_.skip();
    const Location at = in_.here();
    if (const AssignmentSign sign = sign_after_name(); sign.length > 0 && !sign.step) {
        const std::string_view name = in_.accept_name();
        return assignment(names_.assigned(name, at), at);
    }
    Expression left = conditional();
    in_.skip();
    const AssignmentSign sign = assignment_sign(in_.rest());
    if (sign.length == 0 || sign.step) return left;
    if (left.kind != Expression::Kind::element) {
        throw SyntaxError{at, "only a variable or an element of an array can be assigned ('==' compares)"};
    }
    return assignment(std::move(left), at);
}

// The sign stands here, behind the target.
Expression ExpressionParser::assignment(Expression target, Location at) {
    in_.skip();
    const AssignmentSign sign = assignment_sign(in_.rest());
    in_.take(sign.length);
    Expression value = sign.step ? Expression::number(1, target.place) : expression();
    if (sign.op) {
        if (std::any_of(target.operands.begin(), target.operands.end(), has_side_effects)) {
            throw SyntaxError{at, "this subscript would be evaluated twice: write the assignment out"};
        }
        value = apply(*sign.op, at, target, std::move(value));
    }
    Expression result;
    result.kind = Expression::Kind::assign;
    result.place = target.place;
    result.operands.reserve(2);
    result.operands.push_back(std::move(target));
    result.operands.push_back(std::move(value));
    ++height_;
    check_height(at);
    return result;
}

Expression ExpressionParser::conditional() {
    Expression test = binary(1);
    if (!in_.accept("?")) return test;
    const DepthGuard guard(depth_, in_);
    const int test_height = height_;
    Expression result;
    result.kind = Expression::Kind::conditional;
    result.place = test.place;
    result.operands.push_back(std::move(test));
    result.operands.push_back(expression());
    const int then_height = height_;
    in_.expect(":", "after the second part of '? :'");
    result.operands.push_back(expression());
    height_ = std::max({test_height, then_height, height_}) + 1;
    check_height(in_.here());
    return result;
}

// No expression holds "-->"; "-o>" is an arrow only where a production's may stand.
bool ExpressionParser::at_arrow() const {
    return in_.rest().starts_with("-->") || (ends_at_arrow_ && in_.arrow() > 0);
}

ExpressionParser::Infix ExpressionParser::infix() {
    in_.skip();
    if (at_arrow()) return {};
    const char c = in_.peek();
    const char next = in_.peek(1);
    switch (c) {
        case '|':
        case '&':
            if (next != c) throw SyntaxError{in_.here(), fmt::format("'{0}' is no operator here: write '{0}{0}'", c)};
            return c == '|' ? Infix{2, Operator::logical_or, 1} : Infix{2, Operator::logical_and, 2};
        case '=':
            return next == '=' ? Infix{2, Operator::equal, 3} : Infix{};
        case '!':
            return next == '=' ? Infix{2, Operator::not_equal, 3} : Infix{};
        case '<':
            if (next == '>') return {2, Operator::not_equal, 3};
            return next == '=' ? Infix{2, Operator::less_equal, 4} : Infix{1, Operator::less, 4};
        case '>':
            return next == '=' ? Infix{2, Operator::greater_equal, 4} : Infix{1, Operator::greater, 4};
        case '^':
            return {1, Operator::power, 7};
        case '%':
            return {1, Operator::remainder, 6};
        default:
            break;
    }
    if (assignment_sign(in_.rest()).length > 0) return {};
    switch (c) {
        case '+':
            return {1, Operator::add, 5};
        case '-':
            return {1, Operator::subtract, 5};
        case '*':
            return {1, Operator::multiply, 6};
        case '/':
            return {1, Operator::divide, 6};
        default:
            return {};
    }
}

Expression ExpressionParser::binary(int least_precedence) {
    Expression left = unary();
    for (Infix next = infix(); next.length > 0 && next.precedence >= least_precedence; next = infix()) {
        const Location at = in_.here();
        in_.take(next.length);
        const int left_height = height_;
        Expression right = binary(next.precedence + 1);
        height_ = std::max(left_height, height_);
        left = infixed(next.op, at, std::move(left), std::move(right));
    }
    return left;
}

// In cpfg, parentheses do not separate the condition of ?: from what stands before them: 5*(c?a:b) is (5*c)?a:b.
Expression ExpressionParser::infixed(Operator op, Location at, Expression left, Expression right) {
    if (arithmetic_ != Arithmetic::cpfg || right.kind != Expression::Kind::conditional) {
        return apply(op, at, std::move(left), std::move(right));
    }
    right.operands[0] = apply(op, at, std::move(left), std::move(right.operands[0]));
    return right;
}

Expression ExpressionParser::unary() {
    const DepthGuard guard(depth_, in_);
    in_.skip();
    const Location at = in_.here();
    if (in_.peek() == '!' && in_.peek(1) != '=') {
        in_.take(1);
        return apply(Operator::logical_not, at, unary());
    }
    if (in_.peek() == '-' && !at_arrow()) {
        in_.take(1);
        return apply(Operator::negate, at, unary());
    }
    if (in_.accept("+")) return unary();
    return primary();
}

Expression ExpressionParser::apply(Operator op, Location at, Expression left, std::optional<Expression> right) {
    Expression result;
    result.kind = Expression::Kind::apply;
    result.op = op;
    result.place = names_.place(at);
    result.operands.reserve(right ? 2 : 1);
    result.operands.push_back(std::move(left));
    if (right) result.operands.push_back(std::move(*right));
    ++height_;
    check_height(at);
    return result;
}

void ExpressionParser::check_height(Location at) const {
    if (height_ > highest_tree) throw SyntaxError{at, "this expression is too long: more than 400 operations in a row"};
}

Expression ExpressionParser::primary() {
    in_.skip();
    height_ = 1;
    const char c = in_.peek();
    if (c == '(') {
        const Scanner::Inside inside(in_);
        const bool ends_at_arrow = std::exchange(ends_at_arrow_, false);
        in_.take(1);
        Expression result = expression();
        in_.expect(")", "to close '('");
        ends_at_arrow_ = ends_at_arrow;
        return result;
    }
    if (is_digit(c) || (c == '.' && is_digit(in_.peek(1)))) return number();
    if (is_name_start(c)) return name_or_call();
    if (c == '"') throw SyntaxError{in_.here(), "text cannot stand here, only numbers"};
    if (c == '&') throw SyntaxError{in_.here(), "'&' may be only before variables that fscanf reads"};
    in_.expected("a number, a name or '('");
}

Expression ExpressionParser::number() {
    const std::string_view rest = in_.rest();
    const Location at = in_.here();
    double value = 0;
    const auto [end, error] = read_number(rest.data(), rest.data() + rest.size(), value);
    const auto length = static_cast<std::size_t>(end - rest.data());
    const std::string_view digits = rest.substr(0, length);
    // What is too small is 0; what is too large is a mistake.
    const bool small = digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos;
    if (error == std::errc::result_out_of_range && !small) {
        throw SyntaxError{at, fmt::format("the number {} is too large", digits)};
    }
    in_.take(length);
    if (is_name_start(in_.peek())) {
        throw SyntaxError{in_.here(), fmt::format("expected an operator after the number, found {}", in_.found())};
    }
    return Expression::number(value, names_.place(at));
}

Expression ExpressionParser::text() {
    const Location at = in_.here();
    Expression result;
    result.kind = Expression::Kind::text;
    result.place = names_.place(at);
    const std::string_view rest = in_.rest();
    std::size_t i = 1;
    for (; i < rest.size() && rest[i] != '"' && rest[i] != '\n'; ++i) {
        if (rest[i] != '\\' || i + 1 >= rest.size() || rest[i + 1] == '\n') {
            result.text += rest[i];
            continue;
        }
        const char escaped = rest[++i];
        result.text += escaped == 'n' ? '\n' : escaped == 't' ? '\t' : escaped == 'r' ? '\r' : escaped;
    }
    if (i >= rest.size() || rest[i] != '"') throw SyntaxError{at, "this text is never closed: '\"' is missing"};
    in_.take(i + 1);
    height_ = 1;
    return result;
}

Expression ExpressionParser::argument(bool may_be_text) {
    in_.skip();
    if (may_be_text && in_.peek() == '"') return text();
    return expression();
}

Expression ExpressionParser::name_or_call() {
    const Location at = in_.here();
    const std::string_view name = in_.accept_name();
    in_.skip();
    if (in_.peek() == '(') return call(name, at);
    if (in_.peek() == '[') return element(name, at);
    return names_.read(name, at);
}

Expression ExpressionParser::element(std::string_view name, Location at) {
    const bool ends_at_arrow = std::exchange(ends_at_arrow_, false);
    const std::optional<std::uint32_t> array = names_.subscripted(name, at);
    if (!array) throw SyntaxError{at, fmt::format("'{}' is not a declared array{}", name, names_.suggestion(name))};
    Expression result;
    result.kind = Expression::Kind::element;
    result.index = *array;
    result.place = names_.place(at);
    int highest = 0;
    while (in_.accept("[")) {
        const Scanner::Inside inside(in_);
        result.operands.push_back(expression());
        highest = std::max(highest, height_);
        if (in_.looking_at(",")) throw SyntaxError{in_.here(), "each dimension has its own brackets: a[i][j]"};
        in_.expect("]", "after a subscript");
    }
    names_.check_subscripts(*array, result.operands.size(), at);
    height_ = highest + 1;
    ends_at_arrow_ = ends_at_arrow;
    return result;
}

Expression ExpressionParser::address() {
    const Location at = in_.here();
    in_.take(1);
    in_.skip();
    const Location target_at = in_.here();
    const std::string_view name = in_.accept_name();
    if (name.empty()) in_.expected("the name of a variable after '&'");
    Expression result;
    result.kind = Expression::Kind::address;
    result.place = names_.place(at);
    result.operands.push_back(in_.looking_at("[") ? element(name, target_at) : names_.assigned(name, target_at));
    return result;
}

/// True if the parentheses that open here are followed by braces, as those of `if (...) {` are.
bool ExpressionParser::is_before_braces() const {
    const std::string_view rest = in_.rest();
    int depth = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        depth += rest[i] == '(' ? 1 : rest[i] == ')' ? -1 : 0;
        if (depth > 0) continue;
        const std::size_t next = rest.find_first_not_of(" \t\n", i + 1);
        return next != std::string_view::npos && rest[next] == '{';
    }
    return false;
}

Expression ExpressionParser::call(std::string_view name, Location at) {
    const Scanner::Inside inside(in_);
    const DepthGuard guard(depth_, in_);
    const bool ends_at_arrow = std::exchange(ends_at_arrow_, false);
    const FunctionEntry* entry = find_function(name);
    if (!entry) {
        std::vector<std::string> known = function_names();
        if (is_before_braces()) known.insert(known.end(), {"if", "for", "while"});
        throw SyntaxError{at, fmt::format("there is no function '{}'{}", name, did_you_mean(name, known))};
    }
    Expression result;
    result.kind = Expression::Kind::call;
    result.function = entry->function;
    result.index = entry->index;
    result.place = names_.place(at);
    int highest = 0;
    in_.take(1);
    if (!in_.accept(")")) {
        do {
            height_ = 1;
            const bool is_address = entry->function == Function::file_scan && in_.looking_at("&");
            result.operands.push_back(is_address ? address() : argument(entry->takes_text));
            highest = std::max(highest, height_);
        } while (in_.accept(","));
        if (!in_.accept(")")) in_.expected(fmt::format("')' after the arguments of '{}'", name));
    }
    const int given = static_cast<int>(result.operands.size());
    if (given < entry->least || given > entry->most) {
        const std::string wanted = entry->most == any_number     ? fmt::format("at least {}", entry->least)
                                   : entry->least == entry->most ? std::to_string(entry->least)
                                                                 : fmt::format("{} or {}", entry->least, entry->most);
        throw SyntaxError{
            at, fmt::format("'{}' takes {} argument{}, not {}", name, wanted, wanted == "1" ? "" : "s", given)};
    }
    height_ = highest + 1;
    check_height(at);
    ends_at_arrow_ = ends_at_arrow;
    return normalised(std::move(result), at);
}

// The engine knows each function in one form only.
Expression ExpressionParser::normalised(Expression call, Location at) {
    std::vector<Expression>& operands = call.operands;
    if (call.function == Function::atan && operands.size() == 2) {
        call.function = Function::atan2;
        std::swap(operands[0], operands[1]);
    }
    if (call.function == Function::noise) {
        while (operands.size() < 3) operands.push_back(Expression::number(0, call.place));
    }
    if (call.function == Function::view_extent) operands.clear();
    // Nothing is shown or played.
    if (call.function == Function::display && operands[0].kind == Expression::Kind::text) {
        operands[0] = Expression::number(0, call.place);
    }
    const bool chained = call.function == Function::min || call.function == Function::max;
    while (chained && operands.size() > 2) {
        Expression inner;
        inner.kind = call.kind;
        inner.function = call.function;
        inner.place = call.place;
        inner.operands.reserve(2);
        inner.operands.push_back(std::move(operands[0]));
        inner.operands.push_back(std::move(operands[1]));
        operands.erase(operands.begin());
        operands[0] = std::move(inner);
        ++height_;
        check_height(at);
    }
    return call;
}

}  // namespace espalier::language

#include "language/sdl/formula.h"

#include "espalier/base/math.h"

#include "base/characters.h"
#include "base/text.h"
#include "language/text/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace espalier::language::sdl {
namespace {

struct Function {
    const char* name;
    int arguments;
};
constexpr std::array<Function, 9> functions{
    {{"sin", 1}, {"cos", 1}, {"sqrt", 1}, {"exp", 1}, {"abs", 1}, {"floor", 1}, {"min", 2}, {"max", 2}, {"noise", 3}}};

/// Only a root and a power of known numbers may have none.
bool is_finite(std::string_view function, double argument) {
    return function == "sqrt" ? argument >= 0 : function != "exp" || std::isfinite(math::exp(argument));
}

std::string written(double value) {
    return format_exact(value == 0 ? 0 : value);
}

Formula constant(double value) {
    return {written(value), value, true};
}

std::string in_parentheses(const Formula& formula) {
    return begins_with_minus(formula) ? "(" + formula.text + ")" : formula.text;
}

class FormulaParser {
public:
    FormulaParser(TokenReader& in, std::span<const std::string> names, std::string_view what)
        : in_(in), names_(names), what_(what) {}

    Formula sum() {
        Formula left = product();
        while (in_.looking_at("+") || in_.looking_at("-")) {
            const Token sign = in_.take();
            left = combined(left, sign, product());
            left.is_product = left.number.has_value();
        }
        return left;
    }

private:
    Formula product() {
        Formula left = signed_value();
        while (in_.looking_at("*") || in_.looking_at("/")) {
            const Token sign = in_.take();
            left = combined(left, sign, signed_value());
            left.is_product = true;
        }
        return left;
    }

    Formula signed_value() {
        if (++depth_ > 50) throw SyntaxError{in_.next().at, "the expression is nested more than 50 deep"};
        Formula value = in_.accept("-") ? negative(signed_value()) : (in_.accept("+"), simple());
        --depth_;
        return value;
    }

    static Formula negative(const Formula& value) {
        if (value.number) return constant(-*value.number);
        return {fmt::format("-{}", value.text), {}, true};
    }

    Formula simple() {
        if (in_.next().kind == Token::Kind::number) return constant(in_.expect_number("a number"));
        if (in_.accept("(")) {
            Formula inner = sum();
            in_.expect(")", "after the expression");
            if (!inner.number) inner = {fmt::format("({})", inner.text), {}, true};
            return inner;
        }
        if (in_.next().kind != Token::Kind::name) in_.fail(fmt::format("a number for {}", what_));
        for (const Function& function : functions) {
            if (in_.looking_at(function.name)) return call(function);
        }
        if (std::find(names_.begin(), names_.end(), in_.next().text) == names_.end()) fail_name();
        const Token name = in_.take();
        return {marked(name.text, name.at), {}, true};
    }

    Formula call(const Function& function) {
        const Location at = in_.next().at;
        std::vector<double> known;
        std::string text = marked(in_.take().text, at) + "(";
        in_.expect("(", fmt::format("after '{}'", function.name));
        for (int k = 0; k < function.arguments; ++k) {
            if (k > 0)
                in_.expect(",", fmt::format("in '{}', which has {} arguments", function.name, function.arguments));
            const Formula argument = sum();
            if (argument.number) known.push_back(*argument.number);
            text += (k > 0 ? ", " : "") + argument.text;
        }
        in_.expect(")", fmt::format("after the arguments of '{}'", function.name));
        if (!known.empty() && !is_finite(function.name, known.front())) {
            throw SyntaxError{at, fmt::format("{}) is no finite number", without_marks(text))};
        }
        return {text + ")", {}, true};
    }

    [[noreturn]] void fail_name() const {
        std::vector<std::string> known(names_.begin(), names_.end());
        for (const Function& function : functions) known.emplace_back(function.name);
        in_.fail(
            fmt::format("a number for {}{}", what_, names_.empty() ? "" : ", or an expression of " + joined(names_)),
            known);
    }

    static std::string joined(std::span<const std::string> names) {
        std::string list;
        for (std::size_t k = 0; k < names.size(); ++k) {
            list += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
        }
        return list;
    }

    static Formula combined(const Formula& a, const Token& sign, const Formula& b) {
        if (a.number && b.number) {
            const double x = *a.number, y = *b.number;
            const double value = sign.text == "+" ? x + y : sign.text == "-" ? x - y : sign.text == "*" ? x * y : x / y;
            if (sign.text == "/" && y == 0) throw SyntaxError{sign.at, "this divides by zero"};
            if (!std::isfinite(value)) {
                throw SyntaxError{sign.at, "the result is too large for a number, which is at most 1.8e308"};
            }
            return constant(value);
        }
        return {fmt::format("{} {} {}", a.text, marked(sign.text, sign.at), in_parentheses(b)), {}, false};
    }

    TokenReader& in_;
    std::span<const std::string> names_;
    std::string_view what_;
    int depth_ = 0;
};

}  // namespace

Formula parse_formula(TokenReader& in, std::span<const std::string> names, std::string_view what) {
    return FormulaParser(in, names, what).sum();
}

bool begins_with_minus(const Formula& formula) {
    return without_marks(formula.text).starts_with('-');
}

std::string sum(const std::string& base, const Formula& formula) {
    if (formula.number && *formula.number == 0) return base;
    if (base == "0") return formula.text;
    if (formula.number && *formula.number < 0) return base + " - " + format_exact(-*formula.number);
    return base + " + " + (in_parentheses(formula));
}

std::string factor(const Formula& formula) {
    return formula.is_product ? formula.text : "(" + formula.text + ")";
}

std::string with_value(const std::string& text, std::string_view name, const std::string& value) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && is_name_part(text[end])) ++end;
        const std::string word = text.substr(at, std::max(end, at + 1) - at);
        result += word == name ? value : word;
        at += word.size();
    }
    return result;
}

}  // namespace espalier::language::sdl

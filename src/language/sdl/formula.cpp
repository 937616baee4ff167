#include "language/sdl/formula.h"

#include "base/characters.h"
#include "base/text.h"

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

std::string written(double value) {
    return format_exact(value == 0 ? 0 : value);
}

Formula constant(double value) {
    return {written(value), value, true};
}

class FormulaParser {
public:
    FormulaParser(TokenReader& in, std::span<const std::string> names) : in_(in), names_(names) {}

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
        if (in_.next().kind != Token::Kind::name) in_.fail("a number");
        for (const Function& function : functions) {
            if (in_.looking_at(function.name)) return call(function);
        }
        if (std::find(names_.begin(), names_.end(), in_.next().text) == names_.end()) fail_name();
        return {in_.take().text, {}, true};
    }

    Formula call(const Function& function) {
        std::string text = in_.take().text + "(";
        in_.expect("(", fmt::format("after '{}'", function.name));
        for (int k = 0; k < function.arguments; ++k) {
            if (k > 0)
                in_.expect(",", fmt::format("in '{}', which has {} arguments", function.name, function.arguments));
            text += (k > 0 ? ", " : "") + sum().text;
        }
        in_.expect(")", fmt::format("after the arguments of '{}'", function.name));
        return {text + ")", {}, true};
    }

    [[noreturn]] void fail_name() const {
        std::vector<std::string> known(names_.begin(), names_.end());
        for (const Function& function : functions) known.emplace_back(function.name);
        in_.fail("a number, or an expression of " + joined(names_), known);
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
            if (!std::isfinite(value)) throw SyntaxError{sign.at, "a division by zero, or too large a number"};
            return constant(value);
        }
        const bool needs_parentheses = b.text.starts_with("-");
        return {fmt::format("{} {} {}", a.text, sign.text, needs_parentheses ? "(" + b.text + ")" : b.text), {}, false};
    }

    TokenReader& in_;
    std::span<const std::string> names_;
    int depth_ = 0;
};

}  // namespace

Formula parse_formula(TokenReader& in, std::span<const std::string> names) {
    return FormulaParser(in, names).sum();
}

std::string sum(const std::string& base, const Formula& formula) {
    if (formula.number && *formula.number == 0) return base;
    if (base == "0") return formula.text;
    if (formula.number && *formula.number < 0) return base + " - " + format_exact(-*formula.number);
    return base + " + " + (formula.text.starts_with("-") ? "(" + formula.text + ")" : formula.text);
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

// The integer expressions of #if.
#include "base/characters.h"
#include "language/preprocessor/preprocessor.h"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace espalier::language {
namespace {

struct BinaryOperator {
    std::string_view spelling;
    int precedence;
};

// Longer spellings first, so that the first that fits is the right one.
constexpr std::array<BinaryOperator, 18> binary_operators{{{"||", 1},
                                                           {"&&", 2},
                                                           {"==", 6},
                                                           {"!=", 6},
                                                           {"<=", 7},
                                                           {">=", 7},
                                                           {"<<", 8},
                                                           {">>", 8},
                                                           {"|", 3},
                                                           {"^", 4},
                                                           {"&", 5},
                                                           {"<", 7},
                                                           {">", 7},
                                                           {"+", 9},
                                                           {"-", 9},
                                                           {"*", 10},
                                                           {"/", 10},
                                                           {"%", 10}}};

class Condition {
public:
    Condition(std::string_view text, Location at) : text_(text), at_(at) {}

    long long value() {
        const long long result = conditional();
        skip();
        if (position_ < text_.size()) fail(fmt::format("unexpected '{}' in the condition", text_[position_]));
        return result;
    }

private:
    [[noreturn]] void fail(std::string message) const { throw SyntaxError{at_, std::move(message)}; }

    void skip() {
        while (position_ < text_.size() && (is_blank(text_[position_]) || text_[position_] == '\n')) ++position_;
    }

    bool accept(std::string_view token) {
        skip();
        if (!text_.substr(position_).starts_with(token)) return false;
        position_ += token.size();
        return true;
    }

    long long conditional() {
        if (++depth_ > 200) fail("the condition is nested more than 200 deep");
        long long result = binary(1);
        if (accept("?")) {
            const long long then = conditional();
            if (!accept(":")) fail("expected ':' after '?' in the condition");
            const long long otherwise = conditional();
            result = result ? then : otherwise;
        }
        --depth_;
        return result;
    }

    const BinaryOperator* next_operator() {
        skip();
        for (const BinaryOperator& candidate : binary_operators) {
            if (text_.substr(position_).starts_with(candidate.spelling)) return &candidate;
        }
        return nullptr;
    }

    // After a false `&&` or a true `||` the right side is read but not judged.
    long long binary(int least) {
        long long left = unary();
        for (const BinaryOperator* next = next_operator(); next && next->precedence >= least; next = next_operator()) {
            position_ += next->spelling.size();
            const bool decided = (next->spelling == "&&" && !left) || (next->spelling == "||" && left);
            ignored_ += decided;
            const long long right = binary(next->precedence + 1);
            ignored_ -= decided;
            left = apply(next->spelling, left, right);
        }
        return left;
    }

    long long apply(std::string_view op, long long a, long long b) {
        const auto u = [](long long value) { return static_cast<unsigned long long>(value); };
        const auto s = [](unsigned long long value) { return static_cast<long long>(value); };
        if (op == "||") return a || b;
        if (op == "&&") return a && b;
        if (op == "|") return a | b;
        if (op == "^") return a ^ b;
        if (op == "&") return a & b;
        if (op == "==") return a == b;
        if (op == "!=") return a != b;
        if (op == "<=") return a <= b;
        if (op == ">=") return a >= b;
        if (op == "<") return a < b;
        if (op == ">") return a > b;
        if (op == "<<") return s(u(a) << (u(b) & 63));
        if (op == ">>") return a >> (u(b) & 63);
        if (op == "+") return s(u(a) + u(b));
        if (op == "-") return s(u(a) - u(b));
        if (op == "*") return s(u(a) * u(b));
        if (b == 0) {
            if (ignored_ > 0) return 0;
            fail("division by zero in the condition");
        }
        if (b == -1) return op == "/" ? s(0 - u(a)) : 0;
        return op == "/" ? a / b : a % b;
    }

    long long unary() {
        if (++depth_ > 200) fail("the condition is nested more than 200 deep");
        const long long result = [&]() -> long long {
            if (accept("!")) return !unary();
            if (accept("-")) return static_cast<long long>(0 - static_cast<unsigned long long>(unary()));
            if (accept("+")) return unary();
            if (accept("~")) return ~unary();
            return primary();
        }();
        --depth_;
        return result;
    }

    long long primary() {
        if (accept("(")) {
            const long long result = conditional();
            if (!accept(")")) fail("expected ')' in the condition");
            return result;
        }
        skip();
        const std::size_t start = position_;
        while (position_ < text_.size() && (is_name_part(text_[position_]) || text_[position_] == '.')) ++position_;
        const std::string_view word = text_.substr(start, position_ - start);
        if (word.empty()) {
            if (start >= text_.size()) fail("the condition ends where a number or a name was expected");
            fail(fmt::format("expected a number or a name in the condition, not '{}'", text_[start]));
        }
        return is_digit(word.front()) ? number(word) : 0;
    }

    long long number(std::string_view word) {
        std::string digits(word);
        while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos) {
            digits.pop_back();
        }
        try {
            std::size_t used = 0;
            const unsigned long long value = std::stoull(digits, &used, 0);
            if (used == digits.size()) return static_cast<long long>(value);
        } catch (const std::exception&) {
        }
        fail(fmt::format("'{}' is not an integer; conditions compute with integers", word));
    }

    std::string_view text_;
    Location at_;
    std::size_t position_ = 0;
    int depth_ = 0;
    int ignored_ = 0;
};

}  // namespace

long long condition_value(std::string_view text, Location at) {
    return Condition(text, at).value();
}

}  // namespace espalier::language

#include "language/sdl/token_reader.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace espalier::language::sdl {
namespace {

const std::array<std::string, 5> words{"define", "rules", "fibres", "generations", "NULL"};

}  // namespace

bool TokenReader::accept(std::string_view text) {
    if (!looking_at(text)) return false;
    take();
    return true;
}

Token TokenReader::take() {
    const Token token = next();
    if (!at_end()) ++at_;
    return token;
}

Token TokenReader::expect(std::string_view text, std::string_view where) {
    if (looking_at(text)) return take();
    const std::array<std::string, 1> known{std::string(text)};
    fail(fmt::format("'{}' {}", text, where), known);
}

Token TokenReader::expect_name(std::string_view what) {
    if (next().kind != Token::Kind::name) fail(what);
    if (std::find(words.begin(), words.end(), next().text) != words.end()) {
        throw SyntaxError{
            next().at,
            fmt::format("'{}' is a word of the language and names no component; choose another name", next().text)};
    }
    return take();
}

double TokenReader::expect_number(std::string_view what) {
    const bool negative = accept("-");
    if (!negative) accept("+");
    if (next().kind != Token::Kind::number) fail(what);
    const Token number = take();
    const double value = std::strtod(number.text.c_str(), nullptr);
    if (!std::isfinite(value))
        throw SyntaxError{number.at,
                          fmt::format("{} is too large for a number, which is at most 1.8e308", number.text)};
    return negative ? -value : value;
}

int TokenReader::expect_whole(std::string_view what, int least, int most) {
    const Location at = next().at;
    const double value = expect_number(what);
    if (value == std::floor(value) && value >= least && value <= most) return int(value);
    throw SyntaxError{
        at, fmt::format("{} is a whole number from {} to {}, not {}", what, least, most, format_exact(value))};
}

void TokenReader::fail(std::string_view expected, std::span<const std::string> known) const {
    const std::string hint = next().kind == Token::Kind::end ? "" : did_you_mean(next().text, known);
    throw SyntaxError{next().at, fmt::format("expected {}, found {}{}", expected, next().shown(), hint)};
}

void TokenReader::skip_statement() {
    // A ']' that comes before any '[' ends the list in which the mistake stands.
    for (std::size_t k = at_; k < tokens_.size() && tokens_[k].text != "[" && tokens_[k].text != "}"; ++k) {
        if (tokens_[k].text != "]") continue;
        at_ = k;
        break;
    }
    while (!at_end() && !looking_at("}")) {
        if (take().text == ";") return;
    }
}

}  // namespace espalier::language::sdl

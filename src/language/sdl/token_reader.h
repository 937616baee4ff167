// Reading tokens from left to right, with the messages of what was expected.
#pragma once

#include "language/sdl/tokens.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language::sdl {

class TokenReader {
public:
    explicit TokenReader(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

    const Token& next() const { return tokens_[at_]; }
    bool at_end() const { return next().kind == Token::Kind::end; }
    bool looking_at(std::string_view text) const { return !at_end() && next().text == text; }
    bool accept(std::string_view text);
    Token take();

    /// The token must be this; throws SyntaxError "expected '[' after the name, found ';'".
    Token expect(std::string_view text, std::string_view where);
    /// A name that is no word of the language.
    Token expect_name(std::string_view what);
    /// A number with its sign.
    double expect_number(std::string_view what);
    int expect_whole(std::string_view what, int least, int most);
    /// Throws SyntaxError at the next token, with the nearest of the known words.
    [[noreturn]] void fail(std::string_view expected, std::span<const std::string> known = {}) const;

    /// Goes behind the next `;`, or to the next `}`, whichever comes first.
    void skip_statement();

private:
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
};

}  // namespace espalier::language::sdl

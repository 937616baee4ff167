#include "language/sdl/tokens.h"

#include "base/characters.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace espalier::language::sdl {
namespace {

class Lexer {
public:
    Lexer(const std::string& text, std::uint32_t file, Mistakes& mistakes)
        : text_(text), file_(file), mistakes_(mistakes) {}

    std::vector<Token> tokens() {
        for (skip_blanks(); at_ < text_.size(); skip_blanks()) token();
        add(Token::Kind::end, 0);
        return std::move(tokens_);
    }

private:
    char at(std::size_t offset) const { return at_ + offset < text_.size() ? text_[at_ + offset] : '\0'; }

    void skip_blanks() {
        while (at_ < text_.size()) {
            if (text_[at_] == '\n') {
                ++line_;
                line_start_ = ++at_;
            } else if (is_blank(text_[at_])) {
                ++at_;
            } else if (at(0) == '/' && at(1) == '/') {
                while (at_ < text_.size() && text_[at_] != '\n') ++at_;
            } else {
                return;
            }
        }
    }

    void token() {
        if (at(0) == '/' && at(1) == '*') return block_comment();
        constexpr std::string_view signs = "{}[]();,:*+-/^|";
        if (is_name_start(at(0))) return add(Token::Kind::name, name_length(0));
        if (text_.compare(at_, 8, "#include") == 0) return include_line();
        if (at(0) == '#' && is_name_start(at(1))) return add(Token::Kind::directive, 1 + name_length(1));
        if (is_digit(at(0)) || (at(0) == '.' && is_digit(at(1)))) return add(Token::Kind::number, number_length());
        if (at(0) == '-' && at(1) == '>') return add(Token::Kind::sign, 2);
        if (signs.find(at(0)) != std::string_view::npos) return add(Token::Kind::sign, 1);
        std::size_t length = 1;
        while (is_continuation_byte(at(length))) ++length;
        const bool is_letter = static_cast<unsigned char>(at(0)) >= 0x80;
        mistakes_.error(here(),
                        fmt::format("'{}' has no meaning here{}", text_.substr(at_, length),
                                    is_letter ? "; names consist of the letters a to z and A to Z, digits and _" : ""));
        at_ += length;
    }

    void include_line() {
        mistakes_.error(here(), "'#include' has no meaning here; a skeleton is one file");
        at_ = std::min(text_.find('\n', at_), text_.size());
    }

    void block_comment() {
        mistakes_.error(here(), "'/*' begins no comment here; begin each line of a comment with '//'");
        const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
        for (; at_ < end; ++at_) {
            if (text_[at_] != '\n') continue;
            ++line_;
            line_start_ = at_ + 1;
        }
    }

    std::size_t name_length(std::size_t from) const {
        std::size_t length = 0;
        while (is_name_part(at(from + length))) ++length;
        return length;
    }

    std::size_t number_length() const {
        std::size_t length = 0;
        while (is_digit(at(length))) ++length;
        if (at(length) == '.') ++length;
        while (is_digit(at(length))) ++length;
        if (at(length) != 'e' && at(length) != 'E') return length;
        const std::size_t exponent = length + (at(length + 1) == '-' || at(length + 1) == '+' ? 2 : 1);
        if (!is_digit(at(exponent))) return length;
        length = exponent;
        while (is_digit(at(length))) ++length;
        return length;
    }

    /// Columns are counted on from the token before, so that long lines cost no more than short ones.
    Location here() {
        if (counted_ < line_start_) {
            counted_ = line_start_;
            column_ = 1;
        }
        for (; counted_ < at_; ++counted_) column_ += !is_continuation_byte(text_[counted_]);
        return {file_, line_, column_};
    }

    void add(Token::Kind kind, std::size_t length) {
        tokens_.push_back({kind, text_.substr(at_, length), here()});
        at_ += length;
    }

    const std::string& text_;
    const std::uint32_t file_;
    Mistakes& mistakes_;
    std::size_t at_ = 0, line_start_ = 0, counted_ = 0;
    int line_ = 1, column_ = 1;
    std::vector<Token> tokens_;
};

}  // namespace

std::string Token::shown() const {
    return kind == Kind::end ? "the end of the file" : "'" + text + "'";
}

std::vector<Token> tokens_of(const std::string& text, std::uint32_t file, Mistakes& mistakes) {
    return Lexer(text, file, mistakes).tokens();
}

}  // namespace espalier::language::sdl

// Walks over preprocessed text: where statements end, which token comes next, what to say when it is the wrong one.
#pragma once

#include "espalier/base/stop.h"

#include "base/characters.h"
#include "language/text/source.h"

#include <string>
#include <string_view>

namespace espalier::language {

/// A newline ends a statement unless the next line begins with a TAB, plainly cannot begin a statement of its own,
/// or stands inside braces or parentheses.
class Scanner {
public:
    explicit Scanner(const MappedText& source) : source_(source), text_(source.text()) {}

    /// While one lives, newlines are blanks, except before a line that is plainly a statement of its own.
    class Inside {
    public:
        enum Kind { parentheses, braces };
        explicit Inside(Scanner& scanner, Kind kind = parentheses) : scanner_(scanner), braces_(kind == braces) {
            ++scanner_.inside_;
            scanner_.inside_braces_ += braces_;
        }
        ~Inside() {
            --scanner_.inside_;
            scanner_.inside_braces_ -= braces_;
        }
        Inside(const Inside&) = delete;
        Inside& operator=(const Inside&) = delete;

    private:
        Scanner& scanner_;
        bool braces_;
    };

    std::size_t position() const { return position_; }
    void seek(std::size_t position) { position_ = last_end_ = position; }
    char peek(std::size_t ahead = 0) const {
        return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
    }
    bool at_end_of_text() const { return position_ >= text_.size(); }
    std::string_view rest() const { return text_.substr(position_); }
    std::string_view text(std::size_t from, std::size_t to) const { return text_.substr(from, to - from); }
    Location here() const { return source_.location(position_); }
    Location location(std::size_t position) const { return source_.location(position); }
    /// Takes `length` bytes as part of a token.
    void take(std::size_t length) { last_end_ = position_ += length; }

    /// Skips blanks as far as the statement goes.
    void skip();
    /// Skips blanks and newlines, to the next statement.
    void skip_lines();
    /// After blanks: nothing more in this statement.
    bool at_end();
    bool looking_at(std::string_view token);
    bool accept(std::string_view token);
    /// Throws SyntaxError: "expected 'token' <where>".
    void expect(std::string_view token, std::string_view where);
    /// Throws SyntaxError unless the statement ends here; a ';' before the end is allowed.
    void end_statement(std::string_view what);
    /// The name that stands here, or "".
    std::string_view looking_at_name();
    std::string_view accept_name();

    /// Length of an arrow `-->` or `-o>` that stands here, or 0.
    std::size_t arrow() const;
    bool looking_at_keyword(std::string_view keyword);
    bool accept_keyword(std::string_view keyword);

    /// Where something is missing: here, or behind the last token if this is a later line.
    Location missing_at() const;
    /// What stands here, for messages: "'x'", "the end of the line".
    std::string found() const;
    [[noreturn]] void expected(std::string_view what, std::string_view hint = {}) const;

    /// Whether the line after `newline` shows that a '}' or ')' is missing.
    bool ends_inside(std::size_t newline, bool in_braces) const;
    /// After a mistake: goes to the end of the statement that began at `start`.
    void recover(std::size_t start);
    std::size_t end_of_line(std::size_t position) const;
    std::size_t next_line(std::size_t position) const { return end_of_line(position) + 1; }
    std::size_t text_size() const { return text_.size(); }
    bool line_has_arrow(std::size_t position) const;
    /// Whether an arrow stands between here and the end of the statement.
    bool statement_has_arrow();
    static constexpr std::size_t npos = std::string_view::npos;

private:
    bool continues(std::size_t newline);
    bool decide_continuation(std::size_t newline);
    bool indented_statement(std::size_t newline, std::size_t first);
    bool arrow_is_missing(std::size_t position);
    bool begins_statement(std::size_t line) const;
    std::size_t arrow_at(std::size_t position) const;
    std::size_t after_blanks(std::size_t position) const;

    const MappedText& source_;
    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t last_end_ = 0;
    std::size_t statement_ = 0;  // where the statement at hand begins
    std::size_t arrow_searched_ = 0;
    bool arrow_seen_ = true;
    int inside_ = 0;
    int inside_braces_ = 0;
    std::size_t decided_newline_ = npos;
    bool decision_ = false;
    std::size_t joined_from_ = 0;  // newlines of a statement that goes on behind blank lines
    std::size_t joined_to_ = 0;
    StopCheck<4096> check_stop_;
};

}  // namespace espalier::language

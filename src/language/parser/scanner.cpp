#include "language/parser/scanner.h"

#include "language/parser/keywords.h"
#include "language/parser/lookalikes.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language {

void Scanner::skip() {
    check_stop_();
    while (position_ < text_.size()) {
        const char c = text_[position_];
        if (c != '\n' && !is_blank(c)) return;
        if (c == '\n' && !(inside_ > 0 ? !ends_inside(position_, inside_braces_ > 0) : continues(position_))) return;
        ++position_;
    }
}

void Scanner::skip_lines() {
    while (position_ < text_.size() && (is_blank(text_[position_]) || text_[position_] == '\n')) ++position_;
    last_end_ = statement_ = position_;
}

bool Scanner::at_end() {
    skip();
    return at_end_of_text() || peek() == '\n';
}

bool Scanner::looking_at(std::string_view token) {
    skip();
    return rest().starts_with(token);
}

bool Scanner::accept(std::string_view token) {
    if (!looking_at(token)) return false;
    take(token.size());
    return true;
}

void Scanner::expect(std::string_view token, std::string_view where) {
    if (!accept(token)) expected(fmt::format("'{}' {}", token, where));
}

void Scanner::end_statement(std::string_view what) {
    accept(";");
    if (!at_end()) expected(fmt::format("the end of the line after {}", what));
}

std::string_view Scanner::looking_at_name() {
    skip();
    if (!is_name_start(peek())) return {};
    std::size_t end = position_;
    while (end < text_.size() && is_name_part(text_[end])) ++end;
    return text(position_, end);
}

std::string_view Scanner::accept_name() {
    const std::string_view name = looking_at_name();
    if (!name.empty()) take(name.size());
    return name;
}

std::size_t Scanner::arrow_at(std::size_t position) const {
    const std::string_view here = text_.substr(position, 3);
    return here == "-->" || here == "-o>" ? 3 : 0;
}

std::size_t Scanner::arrow() const {
    return arrow_at(position_);
}

bool Scanner::looking_at_keyword(std::string_view keyword) {
    skip();
    return keyword_length(rest(), keyword) > 0;
}

bool Scanner::accept_keyword(std::string_view keyword) {
    skip();
    const std::size_t length = keyword_length(rest(), keyword);
    if (length > 0) take(length);
    return length > 0;
}

Location Scanner::missing_at() const {
    const std::string_view between = text(std::min(last_end_, position_), position_);
    return source_.location(between.find('\n') == npos ? position_ : last_end_);
}

std::string Scanner::found() const {
    const std::string_view between = text(std::min(last_end_, position_), position_);
    if (at_end_of_text()) return "the end of the file";
    if (peek() == '\n' || between.find('\n') != npos) return "the end of the line";
    if (const std::size_t length = arrow()) return fmt::format("'{}'", text(position_, position_ + length));
    if (const std::string other = lookalike(rest()); !other.empty()) return other;
    std::size_t end = position_ + 1;
    if (is_name_part(peek())) {
        while (end < text_.size() && is_name_part(text_[end]) && end - position_ < 40) ++end;
    }
    while (end < text_.size() && is_continuation_byte(text_[end])) ++end;
    return fmt::format("'{}'", text(position_, end));
}

void Scanner::expected(std::string_view what, std::string_view hint) const {
    throw SyntaxError{missing_at(), fmt::format("expected {}, found {}{}", what, found(), hint)};
}

std::size_t Scanner::end_of_line(std::size_t position) const {
    return std::min(text_.find('\n', position), text_.size());
}

std::size_t Scanner::after_blanks(std::size_t position) const {
    while (position < text_.size() && is_blank(text_[position])) ++position;
    return position;
}

bool Scanner::line_has_arrow(std::size_t position) const {
    const std::string_view line = text(position, end_of_line(position));
    return line.find("-->") != npos || line.find("-o>") != npos;
}

bool Scanner::statement_has_arrow() {
    int braces = 0;
    int parentheses = 0;
    for (std::size_t i = position_; i < text_.size(); ++i) {
        const char c = text_[i];
        if (arrow_at(i) > 0) return true;
        braces += c == '{' ? 1 : c == '}' ? -1 : 0;
        parentheses += c == '(' ? 1 : c == ')' ? -1 : 0;
        const bool inside = braces > 0 || parentheses > 0;
        if (c == '\n' && (inside ? ends_inside(i, braces > 0) : !continues(i))) return false;
    }
    return false;
}

bool Scanner::begins_statement(std::size_t line) const {
    return line_has_arrow(line) || begins_with_keyword(text(after_blanks(line), end_of_line(line)));
}

bool Scanner::continues(std::size_t newline) {
    if (newline >= joined_from_ && newline < joined_to_) return true;
    if (newline != decided_newline_) {
        decided_newline_ = newline;
        decision_ = decide_continuation(newline);
    }
    return decision_;
}

bool Scanner::ends_inside(std::size_t newline, bool in_braces) const {
    const std::string_view line = text(newline + 1, end_of_line(newline + 1));
    if (fits_no_block(line)) return true;
    if (line.empty() || is_blank(line.front()) || in_braces) return false;
    int open = 0;
    for (std::size_t i = 0; i < line.size() && open >= 0; ++i) {
        if (open == 0 && arrow_at(newline + 1 + i) > 0) return true;
        open += line[i] == '(' ? 1 : line[i] == ')' ? -1 : 0;
    }
    return false;
}

// Only the first rule is the reference's; the others read what it rejects and what can mean nothing else.
bool Scanner::decide_continuation(std::size_t newline) {
    std::size_t line = newline + 1;
    if (line >= text_.size()) return false;
    if (text_[line] == '\t') return true;
    const std::size_t first = after_blanks(line);
    if (first < text_.size() && text_[first] != '\n') return first != line && !indented_statement(newline, first);
    // Blank lines and lines of comment do not end a statement that a line beginning with TAB goes on with.
    while (line < text_.size() && after_blanks(line) == end_of_line(line)) line = end_of_line(line) + 1;
    const bool joined =
        line < text_.size() && text_[line] == '\t' && (!begins_statement(line) || arrow_at(after_blanks(line)) > 0);
    if (joined) joined_from_ = newline, joined_to_ = line;
    return joined;
}

// Whether the line indented by blanks after `newline` is a statement of its own.
bool Scanner::indented_statement(std::size_t newline, std::size_t first) {
    const auto joins = [](char c) { return c == ':' || c == '<' || c == '>'; };
    std::size_t before = newline;
    while (before > 0 && is_blank(text_[before - 1])) --before;
    if (joins(text_[first]) || arrow_at(first) > 0 || (before > 0 && joins(text_[before - 1]))) return false;
    const std::size_t end = end_of_line(first);
    if (resembles_keyword(text(first, end))) return true;
    if (arrow_is_missing(newline)) return false;
    return line_has_arrow(first) || arrow_at(after_blanks(end + 1)) > 0;
}

// Whether the statement at hand is a production whose arrow does not stand before `position`.
bool Scanner::arrow_is_missing(std::size_t position) {
    if (arrow_searched_ < statement_) {
        arrow_searched_ = statement_;
        arrow_seen_ = begins_with_keyword(text_.substr(statement_));
    }
    for (; !arrow_seen_ && arrow_searched_ < position; ++arrow_searched_) arrow_seen_ = arrow_at(arrow_searched_) > 0;
    return !arrow_seen_;
}

void Scanner::recover(std::size_t start) {
    int braces = 0;
    const auto count = [&](char c) { braces += c == '{' ? 1 : c == '}' ? -1 : 0; };
    for (std::size_t i = start; i < last_end_; ++i) count(text_[i]);
    position_ = std::max(last_end_, start);
    for (; position_ < text_.size(); ++position_) {
        count(text_[position_]);
        if (text_[position_] != '\n' || continues(position_)) continue;
        if (braces <= 0 || begins_statement(position_ + 1)) break;
    }
    last_end_ = position_;
}

}  // namespace espalier::language

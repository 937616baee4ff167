#include "base/text_cursor.h"

#include "base/characters.h"
#include "base/number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier {

TextCursor::TextCursor(std::string_view text, std::string name)
    : TextCursor(plain_text(std::string(text), std::move(name))) {}

TextCursor::TextCursor(std::shared_ptr<const SourceText> text)
    : source_(std::move(text)), end_(source_->text().size()) {}

void TextCursor::skip(std::string_view characters) {
    while (!at_end() && characters.find(next()) != std::string_view::npos) ++at_;
}

bool TextCursor::accept(std::string_view literal) {
    if (!rest().starts_with(literal)) return false;
    at_ += literal.size();
    return true;
}

std::optional<double> TextCursor::number() {
    const std::size_t begin = at_;
    const std::optional<double> value = exact_number();
    if (value && std::isfinite(static_cast<float>(*value))) return static_cast<float>(*value);
    at_ = begin;
    return std::nullopt;
}

std::optional<double> TextCursor::exact_number() {
    std::string_view digits = rest();
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const std::size_t sign = digits.starts_with('-') && digits.data() == rest().data() ? 1 : 0;
    // Neither "inf" nor "nan" is a number here.
    const std::size_t first = digits.substr(sign).starts_with('.') ? sign + 1 : sign;
    if (first >= digits.size() || !is_digit(digits[first])) return std::nullopt;
    double value = 0;
    const auto [end, error] = read_number(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc()) return std::nullopt;
    at_ += std::size_t(end - rest().data());
    return value;
}

std::optional<int> TextCursor::integer() {
    std::string_view digits = rest();
    if (digits.starts_with('+')) digits.remove_prefix(1);
    if (digits.starts_with('-') && digits.data() != rest().data()) return std::nullopt;
    int value = 0;
    const auto [end, error] = read_number(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc()) return std::nullopt;
    at_ += std::size_t(end - rest().data());
    return value;
}

std::string_view TextCursor::word(std::string_view ends) {
    const std::string_view left = rest();
    const std::string_view word = left.substr(0, left.find_first_of(ends));
    at_ += word.size();
    return word;
}

TextCursor TextCursor::line() {
    TextCursor line = *this;
    line.end_ = std::min(text().find('\n', at_), end_);
    at_ = std::min(line.end_ + 1, end_);
    if (line.end_ > line.at_ && text()[line.end_ - 1] == '\r') --line.end_;
    return line;
}

TextCursor TextCursor::continued_line() {
    TextCursor line = this->line();
    while (line.end_ > line.at_ && text()[line.end_ - 1] == '\\' && !at_end()) line.end_ = this->line().end_;
    return line;
}

Place TextCursor::place() const {
    return source_->place(at_);
}

Diagnostic TextCursor::diagnostic(const std::string& message, Diagnostic::Severity severity) const {
    return {severity, place(), message, source_->source_line(at_)};
}

void TextCursor::fail(const std::string& message) const {
    throw UserError({diagnostic(message)});
}

}  // namespace espalier

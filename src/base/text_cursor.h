// A place of reading in a plain text file: numbers, words and lines, each with its place for messages.
#pragma once

#include "espalier/base/error.h"

#include "base/source_text.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace espalier {

/// Side files are read from left to right; what does not fit is left where it stands. Copies share the text.
class TextCursor {
public:
    static constexpr std::string_view blanks = " \t\r";
    static constexpr std::string_view white_space = " \t\r\n\v\f";

    /// `name` is the file's, for the places.
    TextCursor(std::string_view text, std::string name);
    explicit TextCursor(std::shared_ptr<const SourceText> text);

    bool at_end() const { return at_ == end_; }
    /// The character here; '\0' at the end.
    char next() const { return at_end() ? '\0' : text()[at_]; }
    std::string_view rest() const { return text().substr(at_, end_ - at_); }
    /// How many characters of the text stand before this place.
    std::size_t offset() const { return at_; }

    void skip(std::string_view characters);
    /// Whether exactly this text stands here; goes behind it if so.
    bool accept(std::string_view literal);
    /// A number in the decimal notation, kept with 32 bits as cpfg keeps it; none if the text here is none.
    std::optional<double> number();
    /// The same with all its digits.
    std::optional<double> exact_number();
    /// The whole number the text here begins with; none if it begins with none or with one beyond 32 bits.
    std::optional<int> integer();
    /// What stands before the next of the characters that end a word; may be empty.
    std::string_view word(std::string_view ends = white_space);
    /// The rest of this line, without its end; goes on to the next line.
    TextCursor line();
    /// The same with the lines that follow it where it ends in a backslash.
    TextCursor continued_line();

    Place place() const;
    Diagnostic diagnostic(const std::string& message,
                          Diagnostic::Severity severity = Diagnostic::Severity::error) const;
    /// Throws UserError with this place.
    [[noreturn]] void fail(const std::string& message) const;

private:
    std::string_view text() const { return source_->text(); }

    std::shared_ptr<const SourceText> source_;
    std::size_t at_ = 0, end_ = 0;
};

}  // namespace espalier

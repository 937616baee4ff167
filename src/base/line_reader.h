// Side files that are lists of lines, read line by line: "points: 5", then five lines of numbers.
#pragma once

#include "base/text_cursor.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// Goes from line to line; empty lines and blanks before a line are skipped. What is missing or too large is
/// refused with its place.
class LineReader {
public:
    static constexpr int most_lines = 100000;    ///< most lines of points
    static constexpr int most_points = 1000000;  ///< most points of all lines, each as often as its multiplicity says

    explicit LineReader(TextCursor text) : text_(std::move(text)) { skip_blanks(); }

    bool at_end() const { return text_.at_end(); }
    /// Whether the next line begins with this.
    bool next_is(std::string_view key) const { return text_.rest().starts_with(key); }
    TextCursor take_line();
    /// The line that begins with `key`, from what follows it.
    TextCursor take_line(std::string_view key);
    /// A whole number from `least` to `most` behind `key`.
    int take_integer(std::string_view key, int least, int most);
    /// What editors keep for themselves: a picture behind the points (two lines) and marked places.
    void skip_editor_lines();
    /// The rest, for readers that go on from here.
    const TextCursor& text() const { return text_; }

private:
    void skip_blanks();

    TextCursor text_;
};

/// A whole number in the line, from `least` to `most`; `what` names it.
int take_integer(TextCursor& line, std::string_view what, int least, int most);
/// All numbers of a line, which has nothing else. Goes behind the last one.
std::vector<double> take_numbers(TextCursor& line);
std::vector<double> numbers_of(TextCursor line);

}  // namespace espalier

#include "base/line_reader.h"

#include <fmt/format.h>

namespace espalier {

void LineReader::skip_blanks() {
    text_.skip(TextCursor::white_space);
}

TextCursor LineReader::take_line() {
    if (at_end()) text_.fail("the file ends too early");
    const TextCursor line = text_.line();
    skip_blanks();
    return line;
}

TextCursor LineReader::take_line(std::string_view key) {
    if (at_end()) text_.fail(fmt::format("the file ends where '{}' is expected", key));
    if (!next_is(key)) text_.fail(fmt::format("'{}' is expected here", key));
    TextCursor line = take_line();
    line.accept(key);
    line.skip(TextCursor::blanks);
    return line;
}

int LineReader::take_integer(std::string_view key, int least, int most) {
    TextCursor line = take_line(key);
    return espalier::take_integer(line, key, least, most);
}

void LineReader::skip_editor_lines() {
    if (next_is("b")) {
        take_line();
        take_line();
    }
    if (!next_is("markers:")) return;
    for (int left = take_integer("markers:", 0, most_lines); left > 0; --left) take_line();
}

int take_integer(TextCursor& line, std::string_view what, int least, int most) {
    line.skip(TextCursor::blanks);
    const TextCursor start = line;
    const std::optional<int> number = line.integer();
    if (number && *number >= least && *number <= most) return *number;
    start.fail(least < 0 ? fmt::format("'{}' needs a whole number, at most {}", what, most)
                         : fmt::format("'{}' needs a whole number from {} to {}", what, least, most));
}

std::vector<double> take_numbers(TextCursor& line) {
    std::vector<double> numbers;
    TextCursor next = line;
    for (next.skip(TextCursor::blanks); !next.at_end(); next.skip(TextCursor::blanks)) {
        const std::optional<double> number = next.number();
        if (!number) next.fail(fmt::format("'{}' is no number", TextCursor(next).word()));
        numbers.push_back(*number);
        line = next;
    }
    return numbers;
}

std::vector<double> numbers_of(TextCursor line) {
    return take_numbers(line);
}

}  // namespace espalier

// The table of a species as the paper prints it: name = value.
#include "base/characters.h"
#include "base/number.h"
#include "language/weber_penn/species_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace espalier::language::weber_penn {
namespace {

/// A part of a line between commas, with its column, which counts from 0.
struct LinePart {
    std::string text;
    std::size_t column;
};

std::vector<LinePart> parts_between_commas(const std::string& line, std::size_t begin, std::size_t end) {
    std::vector<LinePart> parts;
    for (std::size_t from = begin; from <= end;) {
        const std::size_t comma = std::min(line.find(',', from), end);
        std::size_t first = from, last = comma;
        while (first < last && is_blank(line[first])) ++first;
        while (last > first && is_blank(line[last - 1])) --last;
        parts.push_back({line.substr(first, last - first), first});
        from = comma + 1;
    }
    return parts;
}

class SpeciesReader {
public:
    SpeciesReader(const std::string& text, const std::string& file) : source_(text), builder_(text, file, "species") {}

    Species read() {
        std::istringstream bare(without_comments(source_));
        for (std::string line; std::getline(bare, line);) {
            ++number_;
            if (std::any_of(line.begin(), line.end(), [](char c) { return !is_blank(c); })) read_line(line);
        }
        return builder_.finished();
    }

private:
    /// The text with blanks instead of comments.
    static std::string without_comments(std::string text) {
        for (std::size_t k = 0; k < text.size(); ++k) {
            const bool is_block = text.compare(k, 2, "/*") == 0;
            if (!is_block && text.compare(k, 2, "//") != 0) continue;
            const std::size_t close = is_block ? text.find("*/", k + 2) : text.find('\n', k);
            const std::size_t end = close == std::string::npos ? text.size() : close + (is_block ? 2 : 0);
            for (; k < end; ++k) {
                if (text[k] != '\n') text[k] = ' ';
            }
        }
        return text;
    }

    SpeciesBuilder::At at(std::size_t column) const { return {number_, static_cast<int>(column) + 1}; }

    void read_line(const std::string& line) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) {
            return builder_.mistake(at(line.size()), "expected '=' between the names of parameters and their values");
        }
        const std::vector<LinePart> names = parts_between_commas(line, 0, equals);
        const std::vector<LinePart> values = parts_between_commas(line, equals + 1, line.size());
        if (names.size() != values.size()) {
            return builder_.mistake(
                at(values.front().column),
                fmt::format("as many values as names, which are {}, and not {}", names.size(), values.size()));
        }
        for (std::size_t k = 0; k < names.size(); ++k) read_parameter(names[k], values[k]);
    }

    void read_parameter(const LinePart& name, const LinePart& value) {
        const std::optional<double> number = finite_number(value.text);
        if (number || !SpeciesBuilder::is_known(name.text)) {
            return builder_.set(name.text, number.value_or(0), at(name.column), at(value.column));
        }
        builder_.mistake(at(value.column), fmt::format("'{}' is a number, not '{}'", name.text, value.text));
    }

    std::string source_;
    int number_ = 0;
    SpeciesBuilder builder_;
};

/// The first character that is not blank, behind a name and `=` if a brace follows.
char begins_with(const std::string& text) {
    const auto skip_blanks = [&](std::size_t at) {
        return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    };
    const std::size_t first = skip_blanks(0);
    std::size_t at = first;
    while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_')) ++at;
    at = skip_blanks(at);
    if (at < text.size() && text[at] == '=') at = skip_blanks(at + 1);
    if (at < text.size() && text[at] == '{') return '{';
    return first < text.size() ? text[first] : ' ';
}

}  // namespace

Species parse(const std::string& text, const std::string& name) {
    const char first = begins_with(text);
    if (first == '<') return parse_arbaro(text, name);
    if (first == '{' || first == '#') return parse_tree_gen(text, name);
    return SpeciesReader(text, name).read();
}

}  // namespace espalier::language::weber_penn

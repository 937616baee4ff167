#include "base/part_help.h"

#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace espalier {
namespace {

using Kind = HelpBlock::Kind;

bool is_part_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '-';
}

// Where one of the characters stands outside quotes and brackets; npos if nowhere.
std::size_t find_outside(std::string_view text, std::string_view characters, std::size_t from = 0) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = from; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (depth == 0 && characters.find(c) != std::string_view::npos) return i;
        if (c == '(' || c == '[' || c == '{') ++depth;
        if (c == ')' || c == ']' || c == '}') --depth;
    }
    return std::string_view::npos;
}

std::vector<std::string_view> items_of(std::string_view text) {
    std::vector<std::string_view> items;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(find_outside(text, ",", begin), text.size());
        items.push_back(trimmed(text.substr(begin, end - begin)));
        begin = end + 1;
    }
    return items;
}

bool is_number(std::string_view word) {
    const bool only_digits = word.find_first_not_of("0123456789.e-") == std::string_view::npos;
    return only_digits && std::any_of(word.begin(), word.end(), [](char c) { return std::isdigit(c) != 0; });
}

bool is_range(std::string_view item) {
    if (item.starts_with('<') || item.starts_with('>') || item.starts_with("or \"")) return true;
    if (item.starts_with("or ")) return item.find('|') != std::string_view::npos;
    const std::size_t to = item.find(" to ");
    return to != std::string_view::npos && is_number(item.substr(0, to)) && is_number(item.substr(to + 4));
}

// What stands alone before or behind "required" and "none".
bool is_unit(std::string_view item) {
    return item == "m" || item == "m2" || item == "m3" || item == "s" || item == "degrees" || item == "text";
}

// Where the value at the beginning of the text ends: a number, a text, a list, a table or a flag; 0 if it begins with
// none.
std::size_t end_of_value(std::string_view text) {
    if (text.empty()) return 0;
    if (text[0] == '"' || text[0] == '[' || text[0] == '{') {
        const std::size_t end = text[0] == '"' ? text.find('"', 1) : find_outside(text, ",;: ");
        return end == std::string_view::npos ? text.size() : end + (text[0] == '"' ? 1 : 0);
    }
    const std::string_view word = text.substr(0, std::min(text.find_first_of(" ,;:"), text.size()));
    return is_number(word) || word == "true" || word == "false" || word == "required" || word == "none" ? word.size()
                                                                                                        : 0;
}

// "m", "points/m3", "umol m-2 s-1"; not a sentence.
bool is_short(std::string_view unit) {
    const bool is_plain = unit.find_first_of("(:;\"=") == std::string_view::npos && !unit.starts_with("or ");
    return is_plain && std::count(unit.begin(), unit.end(), ' ') <= 2;
}

// "0.5 m": a value, and perhaps its unit.
bool is_value_with_unit(std::string_view text) {
    const std::size_t end = end_of_value(text);
    return end > 0 && is_short(trimmed(text.substr(end)));
}

// "half of the voxel": a default in words.
bool is_default_in_words(std::string_view item) {
    return !is_unit(item) && item.find_first_of("(:=") == std::string_view::npos && item.size() < 60;
}

// "0.5 m, > 0". False if it is none of this, but already tells what the row means.
bool read_value(std::string_view text, HelpRow& row) {
    for (const std::string_view item : items_of(text)) {
        const std::size_t end = end_of_value(item);
        const bool is_another_word = !row.range.empty() && item.starts_with('"');
        if (is_range(item) || is_another_word) {
            row.range += (row.range.empty() ? "" : ", ") + std::string(item);
        } else if (row.fallback.empty() && is_value_with_unit(item)) {
            row.fallback = item.substr(0, end);
            if (const std::string_view unit = trimmed(item.substr(end)); !unit.empty()) row.unit = unit;
        } else if (is_unit(item) && row.unit.empty()) {
            row.unit = item;
        } else if (row.fallback.empty() && row.unit.empty() && is_default_in_words(item)) {
            row.fallback = item;
        } else {
            return false;
        }
    }
    return true;
}

// Behind a semicolon, or behind a colon that follows a value, stands the meaning.
void read_meaning(std::string_view text, HelpRow& row) {
    const std::size_t colon = find_outside(text, ":"), end = find_outside(text, ";");
    const bool is_at_colon = colon < end && is_value_with_unit(text.substr(0, colon));
    const std::size_t at = is_at_colon ? colon : end;
    HelpRow read = row;
    const bool has_value = at != std::string_view::npos || is_value_with_unit(text);
    if (!has_value || !read_value(text.substr(0, at), read)) {
        row.meaning = text;
        return;
    }
    row = read;
    row.meaning = at == std::string_view::npos ? "" : trimmed(text.substr(at + 1));
}

// The names that a row begins with, as in "attractors, inhibitors   ...": their end, or 0.
std::size_t end_of_names(std::string_view line) {
    std::size_t i = 0;
    while (true) {
        const std::size_t begin = i;
        while (i < line.size() && is_part_of_name(line[i])) ++i;
        if (i == begin) return 0;
        if (line.substr(i, 2) != ", ") break;
        i += 2;
    }
    const bool stands_apart = line.substr(i, 2) == "  " || i == line.size();
    return stands_apart ? i : 0;
}

// "?name(l), ?name(l, x, y, z)"
std::size_t end_of_queries(std::string_view line) {
    std::size_t end = 0;
    while (true) {
        while (end < line.size() && (line[end] == '?' || is_part_of_name(line[end]))) ++end;
        if (line.substr(end, 1) == "(") end = std::min(line.find(')', end), line.size() - 1) + 1;
        if (line.substr(end, 3) != ", ?") return end;
        end += 2;
    }
}

/// Reads line after line, and keeps what the lines that stand further in may belong to.
class HelpReader {
public:
    void read(std::string_view line) {
        const std::size_t indent = line.find_first_not_of(' ');
        if (indent == std::string_view::npos) return end_block();
        if (is_open_ && (indent >= column_ || indent > margin_ + 4)) return go_on(line.substr(indent));
        const std::string_view text = line.substr(indent);
        const std::size_t names = indent <= (is_open_ ? 4U : 2U) ? end_of_names(text) : 0;
        if (text.starts_with('[') && indent == 0 && is_table_name(text)) return heading(text);
        if (text.starts_with('?') && (text.find("->") != text.npos || text.find("  ") != text.npos)) return query(text);
        if (names > 0 && names < text.size()) return parameter(text, names, indent);
        if (indent >= 4 && !in_text_) return verbatim(line);
        paragraph(text);
    }

    std::vector<HelpBlock> blocks;

private:
    void end_block() {
        is_open_ = in_text_ = false;
        ends_ = true;
    }

    void go_on(std::string_view text) {
        text_ += ' ';
        text_ += text;
        put(text_);
    }

    static bool is_table_name(std::string_view text) {
        const std::size_t end = text.find("]  ");
        return end != std::string_view::npos || text.ends_with(']');
    }

    void heading(std::string_view text) {
        const std::size_t end = text.find("  ");
        blocks.push_back({Kind::heading, std::string(text.substr(0, end))});
        end_block();
        if (end != std::string_view::npos) paragraph(trimmed(text.substr(end)));
    }

    HelpBlock& block(Kind kind) {
        if (blocks.empty() || blocks.back().kind != kind || ends_) blocks.push_back({kind});
        ends_ = false;
        return blocks.back();
    }

    void open_row(Kind kind, std::string_view name, std::size_t indent, std::size_t column, std::string_view text) {
        HelpBlock& rows = block(kind);
        if (rows.rows.empty()) first_margin_ = indent;
        HelpRow& row = rows.rows.emplace_back();
        row.name = name;
        row.depth = indent > first_margin_ ? 1 : 0;
        margin_ = indent;
        column_ = column;
        is_open_ = true;
        in_text_ = false;
        put(text_ = text);
    }

    void put(std::string_view text) {
        HelpRow& row = blocks.back().rows.back();
        row.fallback = row.unit = row.range = "";
        if (blocks.back().kind == Kind::queries) {
            row.meaning = text;
        } else {
            read_meaning(text, row);
        }
    }

    void parameter(std::string_view text, std::size_t names, std::size_t indent) {
        const std::size_t begin = text.find_first_not_of(' ', names);
        open_row(Kind::parameters, text.substr(0, names), indent, indent + begin, text.substr(begin));
    }

    void query(std::string_view text) {
        const std::size_t name = end_of_queries(text);
        std::size_t begin = std::min(text.find_first_not_of(' ', name), text.size());
        if (text.substr(begin, 3) == "-> ") begin += 3;
        open_row(Kind::queries, text.substr(0, name), 0, begin, text.substr(begin));
    }

    void verbatim(std::string_view line) {
        std::string& lines = block(Kind::verbatim).text;
        lines += std::string(line.substr(4)) + "\n";
        is_open_ = false;
    }

    void paragraph(std::string_view text) {
        is_open_ = false;
        const bool goes_on = in_text_;
        std::string& lines = block(Kind::text).text;
        if (!lines.empty()) lines += goes_on ? ' ' : '\n';
        lines += text;
        in_text_ = true;
    }

    bool is_open_ = false, in_text_ = false, ends_ = true;
    std::size_t margin_ = 0, first_margin_ = 0, column_ = 0;
    std::string text_;
};

}  // namespace

std::string described_range(double lowest, double highest) {
    if (std::isfinite(lowest) && std::isfinite(highest))
        return ", " + format_general(lowest) + " to " + format_general(highest);
    if (std::isfinite(lowest)) return ", >= " + format_general(lowest);
    return std::isfinite(highest) ? ", <= " + format_general(highest) : "";
}

std::vector<HelpBlock> read_help(std::string_view help) {
    HelpReader reader;
    std::istringstream in{std::string(help)};
    for (std::string line; std::getline(in, line);) reader.read(line);
    return std::move(reader.blocks);
}

std::vector<HelpRow> parameters_of(std::string_view help) {
    std::vector<HelpRow> rows;
    for (const HelpBlock& block : read_help(help)) {
        if (block.kind == Kind::parameters) rows.insert(rows.end(), block.rows.begin(), block.rows.end());
    }
    return rows;
}

}  // namespace espalier

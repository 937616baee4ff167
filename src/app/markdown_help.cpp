#include "markdown_help.h"

#include "base/part_help.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace espalier::app {
namespace {

// A bar ends a cell even within code.
std::string cell_of(const std::string& markdown) {
    std::string cell;
    for (const char c : markdown) {
        if (c == '|') cell += '\\';
        cell += c;
    }
    return cell;
}

std::string row_of_cells(const std::vector<std::string>& cells, const std::vector<bool>& shown) {
    std::string row = "|";
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (shown[i]) row += " " + cell_of(cells[i]) + " |";
    }
    return row + "\n";
}

// Words such as "required" and defaults that are sentences are no code.
std::string value_cell(const std::string& value) {
    const bool is_word = value == "required" || value == "none" || value.find(' ') != value.npos;
    return is_word && value.find_first_of("[{\"") != 0 ? markdown_text(value) : markdown_code(value);
}

// "or "attenuate"" behind "add", "or none|sphere"; or a range of numbers.
std::string range_cell(const HelpRow& row) {
    if (!row.range.starts_with("or ")) return markdown_text(row.range);
    std::string words = row.range.substr(3);
    std::replace(words.begin(), words.end(), '|', ' ');
    return words.starts_with('"') ? markdown_code(row.fallback + ", " + words) : markdown_code(words);
}

std::string parameter_table(const std::vector<HelpRow>& parameters) {
    std::vector<std::vector<std::string>> rows;
    for (const HelpRow& row : parameters) {
        const std::string indent = row.depth > 0 ? "&emsp;" : "";
        rows.push_back({indent + markdown_code(row.name), value_cell(row.fallback), markdown_text(row.unit),
                        range_cell(row), markdown_text(row.meaning)});
    }
    return markdown_table({"parameter", "default", "unit", "range", "meaning"}, rows);
}

std::string query_table(const std::vector<HelpRow>& queries) {
    std::vector<std::vector<std::string>> rows;
    for (const HelpRow& row : queries) rows.push_back({markdown_code(row.name), markdown_text(row.meaning)});
    return markdown_table({"query", "meaning and answer"}, rows);
}

bool is_word(std::string_view text, std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
}

// Whether Markdown would take the character for more than itself.
bool is_mark(std::string_view text, std::size_t i) {
    switch (text[i]) {
        case '#':
        case '>':
            return i == 0;
        case '<':
            return is_word(text, i + 1) || text.substr(i + 1, 1) == "/" || text.substr(i + 1, 1) == "!";
        case '_':
            return !is_word(text, i - 1) || !is_word(text, i + 1);
        case '*':
            return text.substr(i + 1, 1) != " ";
        case ']':
            return text.substr(i + 1, 1) == "(";
        case '~':
        case '$':
        case '\\':
            return true;
        default:
            return false;
    }
}

std::string markdown_block(const HelpBlock& block) {
    switch (block.kind) {
        case HelpBlock::Kind::heading:
            return fmt::format("## `{}`\n", block.text);
        case HelpBlock::Kind::verbatim:
            return fmt::format("```\n{}```\n", block.text);
        case HelpBlock::Kind::parameters:
            return parameter_table(block.rows);
        case HelpBlock::Kind::queries:
            return query_table(block.rows);
        case HelpBlock::Kind::text:
            break;
    }
    return markdown_text(block.text) + "\n";
}

}  // namespace

std::string markdown_text(std::string_view text) {
    std::string escaped;
    bool is_code = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '`') is_code = !is_code;
        if (!is_code && is_mark(text, i)) escaped += '\\';
        escaped += text[i];
    }
    return escaped;
}

std::string markdown_code(std::string_view text) {
    if (text.empty()) return "";
    const char* const fence = text.find('`') == text.npos ? "`" : "``";
    return fmt::format("{}{}{}", fence, text, fence);
}

std::string markdown_table(const std::vector<std::string>& heading, const std::vector<std::vector<std::string>>& rows) {
    std::vector<bool> shown(heading.size(), false);
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) shown[i] = shown[i] || !row[i].empty();
    }
    std::string table = row_of_cells(heading, shown) + "|";
    for (const bool is_shown : shown) table += is_shown ? "---|" : "";
    table += "\n";
    for (const auto& row : rows) table += row_of_cells(row, shown);
    return table;
}

std::string markdown_help(std::string_view help) {
    std::string markdown;
    for (const HelpBlock& block : read_help(help)) markdown += markdown_block(block) + "\n";
    return markdown;
}

}  // namespace espalier::app

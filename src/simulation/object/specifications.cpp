#include "simulation/object/specifications.h"

#include "espalier/base/file.h"

#include "base/text.h"
#include "simulation/object/plain_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace espalier::simulation {
namespace {

// `rmode: word`, `refresh mode: word`, `refreshMode: word` and the like.
bool sets_refresh_mode(const std::string& line) {
    std::string keyword = in_small_letters(line.substr(0, line.find(':')));
    if (keyword.size() == line.size()) return false;
    std::erase(keyword, ' ');
    return keyword == "rmode" || keyword == "refreshmode";
}

// Words between blanks; quotes hold them together. What another command would get (after ; & | < >) is left out.
std::vector<std::string> shell_words(const std::string& line) {
    std::vector<std::string> words;
    std::string word;
    bool in_word = false;
    char quote = 0;
    for (const char c : line) {
        if (quote) {
            if (c == quote) {
                quote = 0;
            } else {
                word += c;
            }
        } else if (c == '"' || c == '\'') {
            quote = c;
            in_word = true;
        } else if (c == ' ' || c == '\t' || std::string(";&|<>").find(c) != std::string::npos) {
            if (in_word) words.push_back(std::move(word));
            word.clear();
            in_word = false;
            if (c != ' ' && c != '\t') return words;
        } else {
            word += c;
            in_word = true;
        }
    }
    if (in_word) words.push_back(std::move(word));
    return words;
}

}  // namespace

Specifications read_specifications(const std::filesystem::path& path) {
    Specifications result;
    std::set<std::string> names;
    bool in_menu = false, keeps = true;
    for (const PlainLine& line : plain_lines(read_text(path), path.string())) {
        const std::string text(trimmed(line.text, " \t"));
        if (text.empty() || text.starts_with(';')) continue;
        if (in_menu) {
            std::vector<std::string> words = shell_words(text);
            if (!words.empty()) result.commands.push_back({std::move(words), line.place, line.text});
        } else if (text == "*") {
            in_menu = true;
        } else if (text.starts_with("ignore:")) {
            keeps = false;
        } else if (keeps && !sets_refresh_mode(text)) {
            if (names.insert(text).second) {
                result.files.push_back(text);
            } else {
                result.diagnostics.push_back(
                    {Diagnostic::Severity::warning, line.place, fmt::format("'{}' is listed twice", text), line.text});
            }
        }
    }
    if (!in_menu) {
        throw UserError({path.string(), 0, 0},
                        "there is no line with nothing but '*' between the list of files and the menu");
    }
    return result;
}

}  // namespace espalier::simulation

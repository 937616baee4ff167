#include "language/parser/keywords.h"

#include "base/characters.h"
#include "base/text.h"

#include <algorithm>
#include <array>

namespace espalier::language {
namespace {

const std::array<std::string, 16> header{"lsystem", "ring",        "seed",   "derivation length",
                                         "ignore",  "consider",    "define", "start each",
                                         "start",   "end each",    "end",    "axiom",
                                         "module",  "environment", "const",  "field"};
const std::array<std::string, 9> section{"decomposition", "homomorphism", "timed",       "time step", "ageing",
                                         "maximum depth", "warnings",     "no warnings", "endlsystem"};

}  // namespace

std::size_t keyword_length(std::string_view text, std::string_view keyword) {
    std::size_t i = 0;
    bool initial = true;
    for (const char wanted : keyword) {
        if (wanted == ' ') {
            while (i < text.size() && is_blank(text[i])) ++i;
            initial = true;
            continue;
        }
        const char c = i < text.size() ? text[i] : '\0';
        const bool upper_initial = initial && c >= 'A' && c <= 'Z' && c - 'A' + 'a' == wanted;
        if (c != wanted && !upper_initial) return 0;
        initial = false;
        ++i;
    }
    return i < text.size() && is_name_part(text[i]) ? 0 : i;
}

std::span<const std::string> header_keywords() {
    return header;
}

std::span<const std::string> section_keywords() {
    return section;
}

bool begins_with_keyword(std::string_view line) {
    const auto begins = [&](const std::string& keyword) { return keyword_length(line, keyword) > 0; };
    return std::any_of(header.begin(), header.end(), begins) || std::any_of(section.begin(), section.end(), begins);
}

bool resembles_keyword(std::string_view line) {
    if (begins_with_keyword(line)) return true;
    std::string words(line.substr(0, line.find(':')));
    while (!words.empty() && is_blank(words.back())) words.pop_back();
    const auto is_letter = [](char c) { return is_name_start(c) || is_blank(c); };
    if (words.size() < 4 || words.size() > 30 || !std::all_of(words.begin(), words.end(), is_letter)) return false;
    return !nearest_name(words, header).empty() || !nearest_name(words, section).empty();
}

bool fits_no_block(std::string_view line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    for (const char* keyword : {"endlsystem", "decomposition", "homomorphism"}) {
        if (keyword_length(line, keyword) > 0) return true;
    }
    const auto begins = [&](const std::string& keyword) {
        const std::size_t length = keyword_length(line, keyword);
        const std::size_t next = length == 0 ? line.npos : line.find_first_not_of(" \t", length);
        return next != line.npos && line[next] == ':';
    };
    return std::any_of(header.begin(), header.end(), begins);
}

}  // namespace espalier::language

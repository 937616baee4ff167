#include "base/toml_words.h"

#include "base/characters.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {
namespace {

/// "0.1" of "0.1 m", "5 %" or "10cm/h"; empty if the text is no number with a unit.
std::string_view number_before_unit(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [behind, error] = read_number(text.data(), end, number);
    const std::string_view unit = trimmed({behind, static_cast<std::size_t>(end - behind)});
    const auto begins_unit = [](char c) {
        return is_name_start(c) || c == '%' || static_cast<unsigned char>(c) >= 0x80;
    };
    const bool is_unit =
        !unit.empty() && begins_unit(unit.front()) && unit.find_first_of("\"'[]{}=,#") == std::string_view::npos;
    return error == std::errc() && is_unit
               ? std::string_view(text.data(), static_cast<std::size_t>(behind - text.data()))
               : std::string_view();
}

/// The backslashes of C:\plants\oak.l in double quotes, which begin escapes.
bool has_path_of_windows(std::string_view line) {
    constexpr std::string_view escapes = "btnfre\"\\uUx";
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') quoted = !quoted;
        if (!quoted || line[i] != '\\' || ++i == line.size()) continue;
        if (escapes.find(line[i]) == std::string_view::npos) return true;
        // \u and \U stand before digits, but \users does not.
        const bool is_code = line[i] == 'u' || line[i] == 'U' || line[i] == 'x';
        constexpr std::string_view digits = "0123456789abcdefABCDEF";
        if (is_code && (i + 1 == line.size() || digits.find(line[i + 1]) == std::string_view::npos)) return true;
    }
    return false;
}

/// The words of `key = words` without quotes, or nothing.
std::string_view unquoted_text(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return {};
    line.remove_prefix(std::min(line.find_first_not_of(" \t", equals + 1), line.size()));
    line = line.substr(0, line.find('#'));
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    const auto begins_text = [](char c) { return is_name_start(c) || c == '.' || c == '/' || c == '~'; };
    const bool is_text = !line.empty() && begins_text(line.front()) && line.find('"') == std::string_view::npos;
    return is_text ? line : std::string_view();
}

/// What to write in place of a line, behind what is wrong with it.
std::string remedy(std::string_view line) {
    if (has_path_of_windows(line)) {
        return ". In double quotes a backslash begins an escape: write a path with slashes, \"C:/plants/oak.l\", or in "
               "single quotes, 'C:\\plants\\oak.l'";
    }
    const std::string_view text = unquoted_text(line);
    if (text.empty()) return "";
    const char quote = text.find('\\') == std::string_view::npos ? '"' : '\'';
    return fmt::format(". A text stands in quotes: {0}{1}{0}", quote, text);
}

}  // namespace

std::string words_for_toml(std::string_view complaint, std::string_view line) {
    const std::size_t equals = line.find('=');
    const std::string_view value = equals == line.npos ? std::string_view() : trimmed(line.substr(equals + 1));
    if (const std::string_view number = number_before_unit(value); !number.empty()) {
        return fmt::format(
            "a number stands without its unit: {} = {}; the documentation of the key says in which unit it "
            "is",
            trimmed(line.substr(0, equals)), number);
    }
    constexpr std::string_view beginning = "Error while parsing ";
    if (complaint.starts_with(beginning)) complaint.remove_prefix(beginning.size());
    return fmt::format("this is no TOML: {}{}", complaint, remedy(line));
}

}  // namespace espalier

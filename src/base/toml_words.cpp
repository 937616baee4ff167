#include "base/toml_words.h"

#include "base/characters.h"
#include "base/number.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    while (!text.empty() && blanks.find(text.back()) != std::string_view::npos) text.remove_suffix(1);
    return text;
}

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
    return fmt::format("this is no TOML: {}", complaint);
}

}  // namespace espalier

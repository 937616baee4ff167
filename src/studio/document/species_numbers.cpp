#include "studio/document/species_numbers.h"

#include "espalier/language/model_settings.h"
#include "espalier/language/notation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace espalier::studio {
namespace {

struct ListPart {
    std::string text;
    std::size_t offset;  ///< in the file
};

/// The text with blanks in place of its comments.
std::string blank_comments(std::string text) {
    for (std::size_t at = text.find('/'); at < text.size(); at = text.find('/', at + 1)) {
        const bool is_block = text.compare(at, 2, "/*") == 0;
        if (!is_block && text.compare(at, 2, "//") != 0) continue;
        const std::size_t close = is_block ? text.find("*/", at + 2) : text.find('\n', at);
        const std::size_t end = close == std::string::npos ? text.size() : close + (is_block ? 2 : 0);
        std::replace_if(
            text.begin() + std::ptrdiff_t(at), text.begin() + std::ptrdiff_t(end), [](char c) { return c != '\n'; },
            ' ');
    }
    return text;
}

std::vector<ListPart> parts_of_list(const std::string& text, std::size_t begin, std::size_t end) {
    std::vector<ListPart> parts;
    for (std::size_t from = begin; from <= end;) {
        const std::size_t comma = std::min(text.find(',', from), end);
        const std::size_t first = std::min(text.find_first_not_of(" \t\r", from), comma);
        std::size_t last = comma;
        while (last > first && std::isspace(static_cast<unsigned char>(text[last - 1]))) --last;
        parts.push_back({text.substr(first, last - first), first});
        from = comma + 1;
    }
    return parts;
}

bool has_level(const std::string& written) {
    return !written.empty() && std::isdigit(static_cast<unsigned char>(written.front()));
}

/// The setting of the model for a parameter of the file: Length_1 for 1Length.
std::string name_of_setting(const std::string& written) {
    return has_level(written) ? written.substr(1) + "_" + written.front() : written;
}

std::string heading(const std::string& written) {
    if (!has_level(written)) return "Tree";
    return written.front() == '0' ? "Trunk" : fmt::format("Level {}", written.front());
}

/// Many bounds only keep a model from growing without end, such as 100,000 branches. A slider between them would move
/// in steps that are too large, so they are left out; where none is left, zero is in the middle.
void leave_out_guards(WrittenNumber& number) {
    constexpr double usual = 50, turn = 360, infinite = std::numeric_limits<double>::infinity();
    const double size = std::max(1.0, std::abs(number.value));
    if (number.highest > usual * size) number.highest = infinite;
    if (number.lowest < -usual * size) number.lowest = -infinite;
    if (std::isfinite(number.lowest) || std::isfinite(number.highest)) return;
    number.highest = number.unit == "degrees" ? turn : 10 * size;
    number.lowest = -number.highest;
}

/// The parameters of a line of the file, from `begin` to `end`, that are settings.
void add_line(const std::string& text, std::size_t begin, std::size_t end, const std::vector<ModelSetting>& settings,
              std::vector<WrittenNumber>& numbers) {
    const std::size_t equals = text.find('=', begin);
    if (equals >= end) return;
    const std::vector<ListPart> names = parts_of_list(text, begin, equals),
                                values = parts_of_list(text, equals + 1, end);
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
        const std::string name = name_of_setting(names[i].text);
        const auto setting =
            std::find_if(settings.begin(), settings.end(), [&](const ModelSetting& one) { return one.name == name; });
        if (setting == settings.end()) continue;
        numbers.push_back({.name = name,
                           .label = setting->summary,
                           .group = heading(names[i].text),
                           .unit = setting->unit,
                           .text = values[i].text,
                           .whole = setting->whole,
                           .value = setting->value,
                           .lowest = setting->lowest,
                           .highest = setting->highest,
                           .offset = values[i].offset});
        leave_out_guards(numbers.back());
    }
}

}  // namespace

std::vector<WrittenNumber> numbers_of_species(const std::filesystem::path& file, const std::string& text) {
    const std::string model = language::translated(*notation_of(file), text, file).text;
    const ModelSettings settings = ModelSettings::parse(model, file.string(), file.parent_path());
    const std::string bare = blank_comments(text);
    std::vector<WrittenNumber> numbers;
    for (std::size_t begin = 0; begin < bare.size();) {
        const std::size_t end = std::min(bare.find('\n', begin), bare.size());
        add_line(bare, begin, end, settings.list(), numbers);
        begin = end + 1;
    }
    return numbers;
}

}  // namespace espalier::studio

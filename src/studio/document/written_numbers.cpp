#include "studio/document/written_numbers.h"

#include "espalier/base/settings.h"
#include "espalier/language/model_settings.h"
#include "espalier/language/notation.h"

#include "base/characters.h"
#include "base/number.h"
#include "base/text.h"
#include "studio/document/scene_words.h"
#include "studio/document/species_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view white_space = " \t\r\n\v\f";

/// Where each line of a text begins.
class Lines {
public:
    explicit Lines(const std::string& text) : text_(text), begins_{0} {
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '\n') begins_.push_back(i + 1);
        }
    }

    /// Lines count from 1.
    bool has(int line) const { return line > 0 && static_cast<std::size_t>(line) <= begins_.size(); }
    std::size_t begin(int line) const { return begins_[static_cast<std::size_t>(line) - 1]; }
    std::size_t end(int line) const {
        const std::size_t newline = text_.find('\n', begin(line));
        return newline == std::string::npos ? text_.size() : newline;
    }

private:
    const std::string& text_;
    std::vector<std::size_t> begins_;
};

// Behind `word` as a word of its own; npos if it is not there before `end`.
std::size_t behind_word(const std::string& text, const std::string& word, std::size_t begin, std::size_t end) {
    for (std::size_t at = text.find(word, begin); at < end; at = text.find(word, at + 1)) {
        const std::size_t behind = at + word.size();
        if ((at == begin || !is_name_part(text[at - 1])) && (behind == text.size() || !is_name_part(text[behind])))
            return behind;
    }
    return std::string::npos;
}

// Finds the value that its line writes behind its name, in whatever notation; none if it is not written there as it is.
std::optional<std::size_t> place_of_value(const ModelSetting& setting, const std::string& value,
                                          const std::string& text, const Lines& lines) {
    if (!lines.has(setting.place.line) || value.empty()) return std::nullopt;
    const std::size_t end = lines.end(setting.place.line);
    const std::size_t behind = behind_word(text, setting.name, lines.begin(setting.place.line), end);
    if (behind == std::string::npos) return std::nullopt;
    const std::size_t at = text.find(value, behind);
    if (at == std::string::npos || at + value.size() > end) return std::nullopt;
    return at;
}

// What a text begins with and `fits`; goes behind it.
std::string_view taken(std::string_view& text, bool (*fits)(char)) {
    const auto end = std::find_if_not(text.begin(), text.end(), fits);
    const std::string_view front = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(front.size());
    return front;
}

// The decimal number that a text begins with, which may be empty; goes behind it.
std::string_view taken_number(std::string_view& text) {
    const auto accept = [](std::string_view& rest, std::string_view characters) {
        const bool accepted = !rest.empty() && characters.find(rest.front()) != characters.npos;
        if (accepted) rest.remove_prefix(1);
        return accepted;
    };
    std::string_view rest = text;
    accept(rest, "+-");
    std::size_t digits = taken(rest, is_digit).size();
    if (accept(rest, ".")) digits += taken(rest, is_digit).size();
    if (digits == 0) return {};
    std::string_view exponent = rest;
    if (accept(exponent, "eE")) {
        accept(exponent, "+-");
        if (!taken(exponent, is_digit).empty()) rest = exponent;
    }
    const std::string_view number = text.substr(0, text.size() - rest.size());
    text = rest;
    return number;
}

// What the comment says that is all of a text; none if the text is something else.
std::optional<std::string_view> words_of_comment(std::string_view text) {
    constexpr std::size_t mark = 2;
    if (text.empty()) return text;
    if (text.starts_with("//")) {
        text.remove_prefix(mark);
    } else if (text.size() >= 2 * mark && text.starts_with("/*") && text.ends_with("*/")) {
        text = text.substr(mark, text.size() - 2 * mark);
    } else {
        return std::nullopt;
    }
    return trimmed(text, white_space);
}

// A macro that stands for a number and for nothing else, with its comment if there is one.
std::optional<WrittenNumber> plain_definition(const std::string& text, std::size_t begin, std::size_t end) {
    constexpr std::string_view word = "#define";
    std::string_view rest = trimmed(std::string_view(text).substr(begin, end - begin), white_space);
    if (!rest.starts_with(word)) return std::nullopt;
    rest.remove_prefix(word.size());
    if (taken(rest, is_blank).empty()) return std::nullopt;
    const std::string_view name = taken(rest, is_name_part);
    if (name.empty() || taken(rest, is_blank).empty()) return std::nullopt;
    const std::size_t offset = static_cast<std::size_t>(rest.data() - text.data());
    const std::string_view value = taken_number(rest);
    const std::optional<std::string_view> label = words_of_comment(trimmed(rest, white_space));
    if (value.empty() || !label) return std::nullopt;
    WrittenNumber number{.name = std::string(name),
                         .label = std::string(label->empty() ? name : *label),
                         .text = std::string(value),
                         .offset = offset};
    number.value = std::strtod(number.text.c_str(), nullptr);
    return number;
}

// Those that no comment describes with a range.
void add_plain_definitions(const std::string& text, std::vector<WrittenNumber>& numbers) {
    const Lines lines(text);
    for (int line = 1; lines.has(line); ++line) {
        const std::optional<WrittenNumber> number = plain_definition(text, lines.begin(line), lines.end(line));
        if (!number) continue;
        const bool is_known = std::any_of(numbers.begin(), numbers.end(),
                                          [&](const WrittenNumber& other) { return other.name == number->name; });
        if (!is_known) numbers.push_back(*number);
    }
    std::sort(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.offset < b.offset; });
}

std::vector<WrittenNumber> numbers_of_model(const fs::path& file, const std::string& text) {
    std::vector<WrittenNumber> numbers;
    const Lines lines(text);
    const fs::path name = file.lexically_normal();
    const ModelSettings settings = ModelSettings::parse(text, file.string(), file.parent_path());
    for (const ModelSetting& setting : settings.list()) {
        if (fs::path(setting.place.file).lexically_normal() != name) continue;
        const std::string value(trimmed(setting.text, " \t"));
        const std::optional<std::size_t> place = place_of_value(setting, value, text, lines);
        if (!place) continue;
        numbers.push_back({.name = setting.name,
                           .label = setting.summary,
                           .group = setting.group,
                           .unit = setting.unit,
                           .text = value,
                           .whole = setting.whole,
                           .value = setting.value,
                           .lowest = setting.lowest,
                           .highest = setting.highest,
                           .offset = *place});
    }
    if (!notation_of(file)) add_plain_definitions(text, numbers);
    return numbers;
}

/// The numbers and switches of a scene file's tables; of lists, those of positions alone.
class SceneNumbers {
public:
    explicit SceneNumbers(const std::string& text) : text_(text), lines_(text) {}

    std::vector<WrittenNumber> of(const Settings& scene) {
        add(scene, "", "", "");
        return std::move(numbers_);
    }

private:
    // `group`: how people call the table; `help`: the documentation of its keys.
    void add(const Settings& table, const std::string& path, const std::string& group, const std::string& help) {
        for (const std::string& key : table.keys()) {
            if (path.empty() && key == "panel") continue;  // tells of sliders, and has none
            const std::string name = path.empty() ? key : path + "." + key;
            const std::string inner = group.empty() ? key : group + ", " + key;
            if (table.is_table(key)) {
                const std::size_t first = numbers_.size();
                add(table.table(key), name, inner, help_of_table(table.table(key), key, help));
                if (key == "define" && table.has("model")) describe_defines(table.path("model"), first);
            } else if (key == "position" || key == "positions") {
                add_positions(table.place(key), name, group);
            } else if (!add_tables(table, key, name, inner, help)) {
                add(table.place(key), name, group, words_of_key(help, key));
            }
        }
    }

    // Numbers that replace those of a model, from the first on, are what its settings are.
    void describe_defines(const std::filesystem::path& model, std::size_t first) {
        std::vector<ModelSetting> settings;
        try {
            settings = ModelSettings::read(model).list();
        } catch (const UserError&) {
            return;
        }
        for (std::size_t i = first; i < numbers_.size(); ++i) {
            WrittenNumber& number = numbers_[i];
            const auto is_it = [&](const ModelSetting& setting) { return number.name.ends_with("." + setting.name); };
            const auto known = std::find_if(settings.begin(), settings.end(), is_it);
            if (known == settings.end()) continue;
            number.label = known->summary;
            number.unit = known->unit;
            number.whole = known->whole;
            number.lowest = known->lowest;
            number.highest = known->highest;
        }
    }

    // False if the key has no list of tables.
    bool add_tables(const Settings& table, const std::string& key, const std::string& name, const std::string& group,
                    const std::string& help) {
        std::vector<Settings> tables;
        try {
            tables = table.tables(key);
        } catch (const UserError&) {
            return false;
        }
        for (std::size_t i = 0; i < tables.size(); ++i) {
            add(tables[i], fmt::format("{}.{}", name, i), group + name_of(tables[i], i, tables.size()),
                help_of_table(tables[i], key, help));
        }
        return true;
    }

    // The numbers of a position, or of each of several.
    void add_positions(const Place& place, const std::string& name, const std::string& group) {
        constexpr std::size_t most_positions = 8;  // more than these have no sliders
        if (!lines_.has(place.line)) return;
        const std::size_t begin = value_of(place), end = end_of_list(begin);
        if (end == std::string::npos) return;
        const bool is_several = text_[text_.find_first_not_of(" \t\r\n", begin + 1)] == '[';
        std::vector<WrittenNumber> found;
        for (std::size_t at = begin; at < end;) {
            const std::size_t from = text_.find_first_not_of("[], \t\r\n", at);
            at = std::min(text_.find_first_of("[], \t\r\n", from), end);
            if (from >= end) break;
            const std::string text = text_.substr(from, at - from);
            const std::optional<double> value = whole_text_as<double>(text);
            if (!value) return;  // a formula, or a comment
            const char axis = "xyz"[found.size() % 3];
            const std::size_t which = found.size() / 3;
            found.push_back({.name = fmt::format("{}{}.{}", name, is_several ? fmt::format(".{}", which) : "", axis),
                             .label = fmt::format("{} of {}", axis,
                                                  is_several ? fmt::format("position {}", which + 1) : "the position"),
                             .group = group,
                             .unit = "m",
                             .text = text,
                             .value = *value,
                             .offset = from});
        }
        if (found.size() % 3 == 0 && found.size() <= 3 * most_positions)
            numbers_.insert(numbers_.end(), found.begin(), found.end());
    }

    // Where the value of a key begins.
    std::size_t value_of(const Place& key) const {
        const std::size_t at = lines_.begin(key.line) + static_cast<std::size_t>(std::max(key.column, 1)) - 1;
        return text_.find_first_not_of("= \t", text_.find('=', at));
    }

    // Behind the bracket that closes the list; npos if none begins there, or if it is not closed.
    std::size_t end_of_list(std::size_t begin) const {
        int depth = 0;
        if (begin >= text_.size() || text_[begin] != '[') return std::string::npos;
        for (std::size_t at = begin; at < text_.size(); ++at) {
            if (text_[at] == '[') ++depth;
            if (text_[at] == ']' && --depth == 0) return at + 1;
        }
        return std::string::npos;
    }

    // What tells it from others of its list: its name, what stage it is, or its number; "" for the only one.
    static std::string name_of(const Settings& table, std::size_t place, std::size_t count) {
        for (const char* key : {"name", "stage"}) {
            if (table.is_text(key)) return fmt::format(" {}", table.text_or(key, ""));
        }
        return count > 1 ? fmt::format(" {}", place + 1) : "";
    }

    // `place` is the key's; `words` are those of its documentation, which a comment behind it replaces.
    void add(const Place& place, const std::string& name, const std::string& group, const KeyWords& words) {
        if (!lines_.has(place.line)) return;
        const std::size_t end = lines_.end(place.line), at = std::min(value_of(place), end);
        const std::size_t behind = std::min(text_.find_first_of(" \t\r,}]#", at), end);
        const std::string text = at < behind ? text_.substr(at, behind - at) : "";
        const bool is_switch = text == "true" || text == "false";
        const std::optional<double> value =
            is_switch ? std::optional(text == "true" ? 1.0 : 0.0) : whole_text_as<double>(text);
        if (!value) return;
        WrittenNumber found{.name = name, .label = comment(behind, end), .group = group, .text = text};
        if (found.label.empty()) found.label = words.meaning;
        found.unit = words.unit;
        found.is_switch = is_switch;
        found.whole = !is_switch && text.find_first_of(".eE") == std::string::npos;
        found.value = *value;
        found.offset = at;
        numbers_.push_back(std::move(found));
    }

    // What the rest of the line says behind its '#'.
    std::string comment(std::size_t from, std::size_t end) const {
        const std::size_t mark = text_.find('#', from);
        if (mark >= end) return "";
        const std::size_t begin = text_.find_first_not_of("# \t", mark);
        return begin >= end ? "" : text_.substr(begin, end - begin);
    }

    const std::string& text_;
    const Lines lines_;
    std::vector<WrittenNumber> numbers_;
};

}  // namespace

std::vector<WrittenNumber> written_numbers(const fs::path& file, const std::string& text) {
    try {
        if (file.extension() == ".species") return numbers_of_species(file, text);
        if (file.extension() != ".toml") return numbers_of_model(file, text);
        return SceneNumbers(text).of(Settings::parse_toml(text, file.string(), file.parent_path()));
    } catch (const std::exception&) {
        return {};
    }
}

std::string with_number(const std::string& text, const WrittenNumber& number, const std::string& value) {
    std::string changed = text;
    return changed.replace(number.offset, number.text.size(), value);
}

}  // namespace espalier::studio

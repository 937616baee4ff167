#include "studio/document/view_text.h"

#include "espalier/base/error.h"
#include "espalier/turtle/view_setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

namespace espalier::studio {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f", separators = " \t\r\n\v\f,";

/// Where a setting is written: its name from `from` on, its values up to `to`.
struct WrittenPlace {
    std::size_t from, values_from, to;
    std::vector<std::string> values;
};

using Letters = std::vector<std::pair<std::string, std::vector<std::string>>>;

void blank_out(std::string& text, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
        if (text[i] != '\n') text[i] = ' ';
    }
}

/// The text with blanks instead of comments and lines of the preprocessor, so that places stay.
std::string bare(std::string text) {
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        const std::string_view sign(text.data() + i, 2);
        if (sign != "/*" && sign != "//") continue;
        const std::size_t end = sign == "//" ? text.find('\n', i) : text.find("*/", i + 2);
        if (end == std::string::npos && sign == "/*") continue;
        blank_out(text, i, end == std::string::npos ? text.size() : sign == "//" ? end : end + 2);
    }
    for (std::size_t line = 0; line < text.size();) {
        const std::size_t end = std::min(text.find('\n', line), text.size()),
                          first = text.find_first_not_of(" \t", line);
        if (first != std::string::npos && text[first] == '#') blank_out(text, line, end);
        line = end + 1;
    }
    return text;
}

/// The name of another setting may end like this one: only blanks of a line, or the values of one before it, precede a
/// name.
bool may_begin(std::string_view before) {
    before = before.substr(before.rfind('\n') + 1);
    const std::size_t last = before.find_last_not_of(blanks);
    if (last == std::string_view::npos) return true;
    const std::size_t gap = before.size() - 1 - last;
    if (gap == 0) return false;
    const std::string_view until = before.substr(0, last + 1), word = until.substr(until.find_last_of(blanks) + 1);
    const bool is_digit = word.back() >= '0' && word.back() <= '9';
    return gap > 1 || is_digit || word == "on" || word == "off";
}

std::size_t words_of(ViewKind kind) {
    if (kind == ViewKind::letters) return std::numeric_limits<std::size_t>::max();
    return kind == ViewKind::vector || kind == ViewKind::colour ? 3 : 1;
}

/// The words behind a name: so many, or those of the line.
void read_values(const std::string& text, ViewKind kind, WrittenPlace& place) {
    const std::size_t count = words_of(kind);
    const std::string_view between = kind == ViewKind::letters ? std::string_view(" \t\r,") : separators;
    while (place.values.size() < count) {
        const std::size_t from = text.find_first_not_of(between, place.to);
        if (from == std::string::npos || text[from] == '\n') return;
        place.to = std::min(text.find_first_of(separators, from), text.size());
        place.values.push_back(text.substr(from, place.to - from));
    }
}

std::vector<WrittenPlace> places_of(const std::string& text, const ViewSetting& setting) {
    const std::string plain = bare(text);
    std::vector<WrittenPlace> places;
    for (std::size_t at = plain.find(setting.label); at != std::string::npos; at = plain.find(setting.label, at + 1)) {
        if (!may_begin(std::string_view(plain).substr(0, at))) continue;
        const std::size_t end = at + setting.label.size();
        WrittenPlace& place = places.emplace_back(WrittenPlace{at, end, end, {}});
        read_values(plain, setting.value.kind, place);
    }
    return places;
}

void remove(Letters& letters, std::string_view letter) {
    std::erase_if(letters, [&](const auto& entry) { return entry.first == letter; });
}

/// "T 0,-1,0 E 0.1" by letter.
Letters by_letter(const std::vector<std::string>& values) {
    Letters letters;
    for (std::string value : values) {
        std::replace(value.begin(), value.end(), ':', ' ');
        std::istringstream words(value);
        for (std::string word; words >> word;) {
            if (word.size() == 1 && word[0] >= 'A' && word[0] <= 'Z') {
                remove(letters, word);  // of several the last holds
                letters.push_back({word, {}});
            } else if (!letters.empty()) {
                letters.back().second.push_back(word);
            }
        }
    }
    return letters;
}

/// The line after an edit of one letter.
std::string with_letter(const std::vector<std::string>& values, const ViewEdit& edit) {
    Letters letters = by_letter(values);
    const auto known =
        std::find_if(letters.begin(), letters.end(), [&](const auto& entry) { return entry.first == *edit.letter; });
    if (!edit.values) {
        remove(letters, *edit.letter);
    } else if (known != letters.end()) {
        known->second = {*edit.values};
    } else {
        letters.push_back({*edit.letter, {*edit.values}});
    }
    // A light stands at a place or comes from a direction.
    if (edit.name == "light:" && edit.letter == "O") remove(letters, "V");
    if (edit.name == "light:" && edit.letter == "V") remove(letters, "O");
    std::string line;
    for (const auto& [letter, words] : letters) {
        line += (line.empty() ? "" : " ") + letter;
        for (const std::string& word : words) line += word.empty() ? "" : " " + word;
    }
    return line;
}

/// Without its line if nothing else stands there.
std::string without(const std::string& text, const WrittenPlace& place) {
    std::size_t from = place.from, to = place.to;
    const auto is_blank = [&](std::size_t i) { return text[i] == ' ' || text[i] == '\t'; };
    while (from > 0 && is_blank(from - 1)) --from;
    while (to < text.size() && is_blank(to)) ++to;
    const bool alone = (from == 0 || text[from - 1] == '\n') && (to == text.size() || text[to] == '\n');
    return text.substr(0, from) + text.substr(std::min(alone ? to + 1 : to, text.size()));
}

ViewSetting setting_named(const std::string& name) {
    for (const ViewSetting& setting : view_settings()) {
        if (setting.label == name) return setting;
    }
    throw UserError(fmt::format("view files have no setting '{}'", name));
}

}  // namespace

std::vector<ViewEntry> read_view_entries(const std::filesystem::path& file, const std::string& text) {
    std::vector<ViewEntry> entries;
    for (const ViewSetting& setting : view_settings()) {
        if (setting.value.kind == ViewKind::other) continue;
        for (WrittenPlace& place : places_of(text, setting)) {
            ViewEntry& entry = entries.emplace_back();
            entry.path = file.string();
            entry.name = setting.label;
            entry.values = std::move(place.values);
            if (setting.value.kind != ViewKind::letters) continue;
            for (auto& [letter, words] : by_letter(entry.values)) entry.letters[letter] = std::move(words);
        }
    }
    return entries;
}

std::string with_view_edit(const std::string& text, const ViewEdit& edit) {
    if (edit.values && edit.values->find('\n') != std::string::npos) throw UserError("a value is one line");
    const std::vector<WrittenPlace> places = places_of(text, setting_named(edit.name));
    const auto number = static_cast<std::size_t>(edit.number);
    if (number > places.size()) throw UserError(fmt::format("the file has no place {} of '{}'", number, edit.name));
    if (number == places.size()) {
        if (!edit.values) return text;
        const std::string line = edit.letter ? with_letter({}, edit) : *edit.values;
        return fmt::format("{}{}{} {}\n", text, text.empty() || text.ends_with('\n') ? "" : "\n", edit.name, line);
    }
    const WrittenPlace& place = places[number];
    if (!edit.letter && !edit.values) return without(text, place);
    const std::string line = edit.letter ? with_letter(place.values, edit) : *edit.values;
    return fmt::format("{} {}{}", text.substr(0, place.values_from), line, text.substr(place.to));
}

}  // namespace espalier::studio

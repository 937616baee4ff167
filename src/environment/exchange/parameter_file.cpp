#include "parameter_file.h"

#include "espalier/base/file.h"

#include "base/byte_order_mark.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace espalier::environment {
namespace {

constexpr std::size_t most_lines = 100000;

std::vector<std::string> values_of(const std::string& text, bool split_at_x) {
    return words_of(text, split_at_x ? " ,;:\tx" : " ,;:\t");
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* other) { return word == other; });
}

void require_in(double value, Range range, const std::string& key, const Place& place) {
    const bool low = range.open_below ? value <= range.lowest : value < range.lowest;
    if (std::isfinite(value) && !low && value <= range.highest) return;
    const char* bound = range.open_below ? "greater than" : "at least";
    throw UserError(place, fmt::format("'{}' must be a number {} {:g} and at most {:g}, not {:g}", key, bound,
                                       range.lowest, range.highest, value));
}

}  // namespace

std::string scene_key(const std::string& key) {
    std::string name;
    for (const char c : key) {
        const bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (!letter && (name.empty() || name.back() == '_')) continue;
        name += !letter ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name;
}

ParameterFile::ParameterFile(const Settings& table, const EnvironmentContext& context, std::vector<std::string> keys)
    : ParameterFile(table, context, std::move(keys), Dialect()) {}

ParameterFile::ParameterFile(const Settings& table, const EnvironmentContext& context, std::vector<std::string> keys,
                             Dialect dialect)
    : table_(table), dialect_(dialect), warnings_(context.warnings), keys_(std::move(keys)) {
    table_.flag_or("verbose", false);
    keys_.emplace_back("verbose");
    if (const auto path = table_.path_if_any("parameters")) path_ = *path;
    if (has_file()) read();
}

void ParameterFile::read() {
    const std::string text = read_text(path_);
    std::size_t begin = byte_order_mark(text);
    for (int number = 1; begin < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        while (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.find_first_not_of(" \t") == std::string::npos) continue;
        if (dialect_.has_slashes && line.starts_with("//")) continue;
        if (dialect_.goes_on && line.starts_with(':') && !lines_.empty()) {
            lines_.back().value.append(1, ' ').append(line, 1);
            continue;
        }
        const std::size_t colon = std::min(line.find_first_of("\t:"), line.size());
        lines_.push_back(
            {line.substr(0, colon), line.substr(std::min(colon + 1, line.size())), Place{path_.string(), number, 1}});
        if (lines_.size() > most_lines) {
            throw UserError(lines_.back().place, fmt::format("more than {} lines of parameters", most_lines));
        }
        std::string& key = lines_.back().key;
        if (dialect_.any_case) {
            std::transform(key.begin(), key.end(), key.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
        }
        if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) continue;
        warn(lines_.back(), fmt::format("the parameter '{}' is unknown and ignored{}", key, did_you_mean(key, keys_)));
    }
}

// A key given twice: the last one counts, as if the program had read line after line.
const ParameterFile::Line* ParameterFile::last(const std::string& key) const {
    const auto found = std::find_if(lines_.rbegin(), lines_.rend(), [&](const Line& line) { return line.key == key; });
    return found == lines_.rend() ? nullptr : &*found;
}

Place ParameterFile::place(const std::string& key) const {
    if (table_.has(scene_key(key))) return table_.place(scene_key(key));
    const Line* line = last(key);
    return line ? line->place : table_.place();
}

// As atof reads: what follows the number is left over, and what is no number is 0.
double ParameterFile::number_of(const std::string& word, const Line& line, Range range) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end != '\0') warn(line, fmt::format("'{}' is read as the number {:g}", word, value));
    require_in(value, range, line.key, line.place);
    return value;
}

std::vector<double> ParameterFile::numbers_of(const Line& line, bool split_at_x, Range range) {
    std::vector<double> numbers;
    for (const std::string& word : values_of(line.value, split_at_x)) numbers.push_back(number_of(word, line, range));
    return numbers;
}

double ParameterFile::number(const std::string& key, double fallback, Range range) {
    if (const Line* line = last(key)) {
        const std::vector<std::string> words = values_of(line->value, false);
        if (!words.empty()) fallback = number_of(words[0], *line, range);
    }
    return table_.number_or(scene_key(key), fallback, range);
}

std::int64_t ParameterFile::whole(const std::string& key, std::int64_t fallback, Range range) {
    return static_cast<std::int64_t>(number(key, static_cast<double>(fallback), range));
}

std::vector<double> ParameterFile::numbers(const std::string& key, std::vector<double> fallback, Range range) {
    if (const Line* line = last(key)) {
        const std::vector<double> given = numbers_of(*line, true, range);
        std::copy_n(given.begin(), std::min(given.size(), fallback.size()), fallback.begin());
    }
    const std::vector<double> numbers = table_.numbers_or(scene_key(key), fallback);
    if (numbers.size() != fallback.size()) {
        throw UserError(place(key), fmt::format("'{}' must have {} numbers, not {}", scene_key(key), fallback.size(),
                                                numbers.size()));
    }
    for (const double value : numbers) require_in(value, range, scene_key(key), place(key));
    return numbers;
}

bool ParameterFile::flag(const std::string& key, bool fallback, std::initializer_list<const char*> on,
                         std::initializer_list<const char*> off) {
    if (const Line* line = last(key)) {
        const std::vector<std::string> words = values_of(line->value, true);
        const std::string word = words.empty() ? "" : words[0];
        if (is_one_of(word, on)) {
            fallback = true;
        } else if (is_one_of(word, off)) {
            fallback = false;
        } else if (!word.empty()) {
            warn(*line, fmt::format("'{}' is neither on nor off here and changes nothing: write '{}'", word,
                                    *(fallback ? off : on).begin()));
        }
    }
    return table_.flag_or(scene_key(key), fallback);
}

bool ParameterFile::has_numbers_of_cpfg() const {
    return table_.choice_or("numbers", has_file() ? "cpfg" : "exact", {"exact", "cpfg"}) == "cpfg";
}

bool ParameterFile::has(const std::string& key) const {
    return last(key) != nullptr || table_.has(scene_key(key));
}

std::string ParameterFile::text(const std::string& key, const std::string& fallback) {
    std::string value = fallback;
    if (const Line* line = last(key)) {
        const std::size_t first = line->value.find_first_not_of(" \t"), end = line->value.find_last_not_of(" \t");
        value = first == std::string::npos ? "" : line->value.substr(first, end + 1 - first);
    }
    return table_.text_or(scene_key(key), value);
}

std::optional<std::filesystem::path> ParameterFile::file(const std::string& key) {
    const Line* line = last(key);
    const std::vector<std::string> words = line ? values_of(line->value, false) : std::vector<std::string>();
    const std::string name = words.empty() ? "" : words[0];
    const std::string used = table_.text_or(scene_key(key), name);
    if (used.empty()) return std::nullopt;
    if (table_.has(scene_key(key))) return table_.path(scene_key(key));
    return path_.parent_path() / used;
}

std::vector<std::vector<double>> ParameterFile::repeated(const std::string& key, std::size_t fewest, std::size_t most) {
    std::vector<Line> given;
    for (const Line& line : lines_) {
        if (line.key == key) given.push_back(line);
    }
    std::vector<std::string> texts;
    for (const Line& line : given) texts.push_back(line.value);
    texts = table_.texts_or(scene_key(key), texts);
    if (table_.has(scene_key(key))) {
        given.clear();
        for (const std::string& text : texts) given.push_back({scene_key(key), text, place(key)});
    }
    std::vector<std::vector<double>> all;
    for (const Line& line : given) {
        std::vector<double> numbers = numbers_of(line, true, Range::any());
        if (numbers.size() < fewest) {
            throw UserError(line.place,
                            fmt::format("'{}' needs {} numbers or more, not {}", line.key, fewest, numbers.size()));
        }
        numbers.resize(std::min(numbers.size(), most));
        all.push_back(std::move(numbers));
    }
    return all;
}

void ParameterFile::warn(const Line& line, const std::string& message) {
    if (!warnings_) return;
    warnings_->push_back({Diagnostic::Severity::warning, line.place, message, line.key + ":" + line.value});
}

}  // namespace espalier::environment

#include "environment/soil/hydraulics/heads.h"

#include "espalier/base/math.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace espalier::environment {
namespace {

constexpr double pascals_in_cm = 98.0665;
constexpr std::array<std::pair<const char*, double>, 8> units{{{"cm", 1},
                                                               {"mm", 0.1},
                                                               {"m", 100},
                                                               {"Pa", 1 / pascals_in_cm},
                                                               {"hPa", 1e2 / pascals_in_cm},
                                                               {"kPa", 1e3 / pascals_in_cm},
                                                               {"MPa", 1e6 / pascals_in_cm},
                                                               {"bar", 1e5 / pascals_in_cm}}};

/// Of "-1.5 MPa" or "pF 4.2".
double head_of(const std::string& text, const Place& place) {
    std::vector<std::string> words = words_of(text, " ");
    if (words.size() == 2 && words[0] == "pF") std::swap(words[0], words[1]);
    const std::optional<double> number = words.size() == 2 ? finite_number(words[0]) : std::nullopt;
    if (number) return head_unit(words[1], place)(*number);
    throw UserError(place,
                    fmt::format("'{}' is no pressure head: write a number of cm, or a text with a number, a blank "
                                "and a unit, as \"-1.5 MPa\" or \"pF 4.2\"",
                                text));
}

double in_range(double head, const std::string& said, const std::string& key, Range range, const Place& place) {
    if (head >= range.lowest && head <= range.highest) return head;
    throw UserError(place,
                    fmt::format("'{}' is {}, {} cm, which is not between {} and {} cm", key, said, format_general(head),
                                format_general(range.lowest), format_general(range.highest)));
}

}  // namespace

std::function<double(double)> head_unit(const std::string& name, const Place& place) {
    if (name == "pF") return [](double value) { return -math::any_power(10, value); };
    std::vector<std::string> names{"pF"};
    for (const auto& [unit, factor] : units) {
        if (name == unit) return [factor = factor](double value) { return factor * value; };
        names.emplace_back(unit);
    }
    throw UserError(place, fmt::format("'{}' is no unit of a pressure head{}: use one of {}", name,
                                       did_you_mean(name, names), fmt::join(names, ", ")));
}

double read_head(const Settings& settings, const std::string& key, Range range) {
    if (!settings.is_text(key)) return settings.number(key, range);
    const std::string text = settings.text(key);
    return in_range(head_of(text, settings.place(key)), text, key, range, settings.place(key));
}

double read_head_or(const Settings& settings, const std::string& key, double fallback, Range range) {
    return settings.is_text(key) ? read_head(settings, key, range) : settings.number_or(key, fallback, range);
}

std::vector<double> read_heads(const Settings& settings, const std::string& key, Range range) {
    std::vector<double> heads;
    const Place place = settings.place(key);
    if (settings.is_text(key)) {
        for (const std::string& text : settings.texts_or(key, {})) {
            heads.push_back(in_range(head_of(text, place), text, key, range, place));
        }
        return heads;
    }
    for (const double head : settings.numbers(key)) {
        heads.push_back(in_range(head, format_general(head), key, range, place));
    }
    return heads;
}

TimeSeries read_head_series(const Settings& settings, const std::string& key, Range range) {
    if (!settings.is_table(key)) return TimeSeries(read_head(settings, key, range));
    const Settings table = settings.table(key);
    return read_head_column(table, table.text("column"), range);
}

TimeSeries read_head_column(const Settings& table, const std::string& column, Range range) {
    return TimeSeries::column(table, column, range, head_unit(table.text_or("unit", "cm"), table.place("unit")));
}

}  // namespace espalier::environment

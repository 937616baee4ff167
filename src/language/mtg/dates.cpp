#include "language/mtg/dates.h"

#include "base/number.h"

#include <array>
#include <chrono>
#include <string>

namespace espalier::language::mtg {
namespace {

struct Parts {
    std::array<int, 3> number{};
    std::size_t count = 0;
};

std::optional<Parts> parts_of(std::string_view text, char separator) {
    Parts parts;
    while (true) {
        const std::size_t end = std::min(text.find(separator), text.size());
        const std::optional<int> number = whole_text_as<int>(text.substr(0, end));
        if (!number || *number < 0 || parts.count == parts.number.size()) return std::nullopt;
        parts.number[parts.count++] = *number;
        if (end == text.size()) return parts;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> day_number(int year, int month, int day) {
    const int whole = year < 70 ? 2000 + year : year < 100 ? 1900 + year : year;
    const std::chrono::year_month_day date{std::chrono::year(whole), std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (month > 12 || day > 31 || whole > 9999 || !date.ok()) return std::nullopt;
    return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

/// A share of the day.
std::optional<double> time_of(std::string_view text) {
    const std::optional<Parts> parts = parts_of(text, ':');
    if (!parts || parts->number[0] > 24 || parts->number[1] > 59 || parts->number[2] > 59) return std::nullopt;
    return (parts->number[0] + (parts->number[1] + parts->number[2] / 60.0) / 60) / 24;
}

}  // namespace

bool is_type_of_dates(std::string_view type) {
    return type.find("MM") != std::string_view::npos && type.find('/') != std::string_view::npos;
}

std::optional<double> days_of(std::string_view text, std::string_view type) {
    const std::size_t dash = text.find('-');
    const std::optional<Parts> date = parts_of(text.substr(0, dash), '/');
    const std::optional<double> time = dash == std::string_view::npos ? 0 : time_of(text.substr(dash + 1));
    if (!date || date->count < 2 || !time) return std::nullopt;
    const auto& [first, second, third] = date->number;
    std::optional<double> days;
    if (date->count == 3) {
        days = day_number(third, second, first);
    } else if (type.starts_with("MM/YY") || second > 12) {
        days = day_number(second, first, 1);
    } else if (const std::optional<double> in_1970 = day_number(1970, second, first)) {
        days = in_1970;
    }
    return days ? std::optional(*days + *time) : std::nullopt;
}

}  // namespace espalier::language::mtg

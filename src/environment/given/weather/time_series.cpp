#include "environment/given/weather/time_series.h"

#include "base/text.h"
#include "environment/given/weather/series_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::environment {
namespace {

/// A first column without a unit has days, whatever it is called.
SeriesClock clock_of(const CsvRows& table, const CsvRow& header) {
    const ColumnHead first = ColumnHead::of(header.cells.front());
    const bool has_days = first.unit.empty() && first.name != "date";
    const std::optional<SeriesClock> found = has_days ? std::nullopt : SeriesClock::find(table, header);
    return found.value_or(SeriesClock::days_in_first_column());
}

std::size_t find_column(const CsvRows& table, const std::string& name, const Place& place) {
    if (table.rows().empty()) throw UserError(place, fmt::format("this file is empty, and has no column '{}'", name));
    const std::vector<std::string>& header = table.rows().front().cells;
    const auto named = std::find(header.begin() + 1, header.end(), name);
    if (named != header.end()) return static_cast<std::size_t>(named - header.begin());
    throw UserError(place, fmt::format("this file has no column '{}' after the one of the days", name));
}

}  // namespace

TimeSeries TimeSeries::read(const Settings& settings, const std::string& key, double fallback, Range range) {
    if (!settings.is_table(key)) return TimeSeries(settings.number_or(key, fallback, range));
    const Settings table = settings.table(key);
    return column(table, table.text("column"), range);
}

TimeSeries TimeSeries::of(std::function<double(double)> at, std::function<double(double)> next_change) {
    TimeSeries series;
    series.given_ = std::move(at);
    series.given_change_ = std::move(next_change);
    return series;
}

TimeSeries TimeSeries::column(const Settings& settings, const std::string& name, Range range, const Convert& convert) {
    const std::filesystem::path path = settings.path("file");
    const Place file{path.string(), 1, 0};
    const CsvRows table(path);
    const std::size_t column = find_column(table, name, file);
    SeriesClock clock = clock_of(table, table.rows().front());
    TimeSeries series;
    series.name_ = path.filename().string() + ": " + name;
    series.values_.clear();
    for (auto row = table.rows().begin() + 1; row != table.rows().end(); ++row) {
        const double day = clock.days(table, *row);
        if (!series.times_.empty() && day <= series.times_.back()) {
            throw UserError(table.place(*row), fmt::format("day {} is not after day {} of the line before",
                                                           format_general(day), format_general(series.times_.back())));
        }
        const double written = table.measured(*row, column, fmt::format("the series '{}'", name));
        const double value = convert ? convert(written) : written;
        if (value < range.lowest || value > range.highest) {
            throw UserError(table.place(*row, column),
                            fmt::format("'{}' is {}, which is not between {} and {}", name, row->cells[column],
                                        format_general(range.lowest), format_general(range.highest)));
        }
        series.times_.push_back(day);
        series.values_.push_back(value);
    }
    if (series.times_.empty()) throw UserError(file, "this series has no lines");
    return series;
}

double TimeSeries::at(double day) const {
    if (given_) return given_(day);
    if (is_constant()) return values_[0];
    const std::size_t count = times_.size();
    const double span = count > 1 ? times_[count - 1] - times_[count - 2] : std::numeric_limits<double>::infinity();
    const double slack = 1e-9 * (1 + std::abs(day));
    if (day < times_[0] - slack || day > times_.back() + span + slack) {
        throw RunError(fmt::format("{} goes from day {} to {}, but the run is at day {}: give the series more lines",
                                   name_, format_general(times_[0]), format_general(times_.back() + span),
                                   format_general(day)));
    }
    const auto after = std::upper_bound(times_.begin(), times_.end(), day + slack);
    return values_[after == times_.begin() ? 0 : static_cast<std::size_t>(after - times_.begin()) - 1];
}

double TimeSeries::next_change(double day) const {
    if (given_change_) return given_change_(day);
    const auto after = std::upper_bound(times_.begin(), times_.end(), day + 1e-9 * (1 + std::abs(day)));
    return after == times_.end() ? std::numeric_limits<double>::infinity() : *after;
}

}  // namespace espalier::environment

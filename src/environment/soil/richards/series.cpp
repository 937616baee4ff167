#include "environment/soil/richards/series.h"

#include "base/csv_rows.h"
#include "base/text.h"
#include "environment/soil/hydraulics/heads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// A cell as a finite number, which is in the range when it is converted.
double number_in(const CsvRow& row, std::size_t column, const std::string& what, const Place& place, const Range& range,
                 const std::function<double(double)>& convert) {
    const std::string text = column < row.cells.size() ? row.cells[column] : "";
    if (text.empty()) throw UserError(place, fmt::format("there is no '{}' in this line: a series has no gaps", what));
    std::optional<double> value = row.number(column);
    if (!value) throw UserError(place, fmt::format("'{}' is not a number", text));
    if (convert) value = convert(*value);
    if (*value < range.lowest || *value > range.highest) {
        throw UserError(place, fmt::format("'{}' is {}, which is not between {} and {}", what, text,
                                           format_general(range.lowest), format_general(range.highest)));
    }
    return *value;
}

}  // namespace

SoilSeries SoilSeries::read(const Settings& settings, const std::string& key, double fallback, Range range) {
    if (!settings.is_table(key)) return SoilSeries(settings.number_or(key, fallback, range));
    return read_file(settings.table(key), settings.table(key).text("column"), range, {});
}

SoilSeries SoilSeries::of(std::function<double(double)> at, std::function<double(double)> next_change) {
    SoilSeries series;
    series.given_ = std::move(at);
    series.given_change_ = std::move(next_change);
    return series;
}

SoilSeries SoilSeries::read_head(const Settings& settings, const std::string& key, Range range) {
    if (!settings.is_table(key)) return SoilSeries(environment::read_head(settings, key, range));
    const Settings table = settings.table(key);
    return read_head_column(table, table.text("column"), range);
}

SoilSeries SoilSeries::read_head_column(const Settings& table, const std::string& column, Range range) {
    return read_file(table, column, range, head_unit(table.text_or("unit", "cm"), table.place("unit")));
}

SoilSeries SoilSeries::read_file(const Settings& table, const std::string& column_name, Range range,
                                 const Convert& convert) {
    const std::filesystem::path path = table.path("file");
    SoilSeries series;
    series.name_ = path.filename().string() + ": " + column_name;
    series.values_.clear();

    const CsvRows table_rows(path, false);
    const std::vector<CsvRow>& rows = table_rows.rows();
    const std::vector<std::string> header = rows.empty() ? std::vector<std::string>() : rows[0].cells;
    const auto named = std::find(header.begin(), header.end(), column_name);
    const auto column = static_cast<std::size_t>(named - header.begin());
    if (named == header.end() || column == 0) {
        throw UserError({path.string(), 1, 0},
                        fmt::format("this file has no column '{}' behind the one of the days", column_name));
    }
    for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
        const Place place = table_rows.place(*row);
        const double day = number_in(*row, 0, header[0], place, Range::any(), {});
        if (!series.times_.empty() && day <= series.times_.back()) {
            throw UserError(place, fmt::format("day {} is not behind day {} of the line before", format_general(day),
                                               format_general(series.times_.back())));
        }
        series.times_.push_back(day);
        series.values_.push_back(number_in(*row, column, column_name, place, range, convert));
        if (!row->is_missing(column)) continue;
        throw UserError(place,
                        fmt::format("{}: the series '{}' has no gaps", row->words_of_missing(column), column_name));
    }
    if (series.times_.empty()) throw UserError({path.string(), 1, 0}, "this series has no lines");
    return series;
}

double SoilSeries::at(double day) const {
    if (given_) return given_(day);
    if (is_constant()) return values_[0];
    const std::size_t count = times_.size();
    const double span = count > 1 ? times_[count - 1] - times_[count - 2] : std::numeric_limits<double>::infinity();
    const double slack = 1e-9 * (1 + std::abs(day));
    if (day < times_[0] - slack || day > times_.back() + span + slack) {
        throw RunError(fmt::format("{} goes from day {} to {}, but the soil is at day {}: give the series more lines",
                                   name_, format_general(times_[0]), format_general(times_.back() + span),
                                   format_general(day)));
    }
    const auto after = std::upper_bound(times_.begin(), times_.end(), day + slack);
    return values_[after == times_.begin() ? 0 : static_cast<std::size_t>(after - times_.begin()) - 1];
}

double SoilSeries::next_change(double day) const {
    if (given_change_) return given_change_(day);
    const auto after = std::upper_bound(times_.begin(), times_.end(), day + 1e-9 * (1 + std::abs(day)));
    return after == times_.end() ? std::numeric_limits<double>::infinity() : *after;
}

}  // namespace espalier::environment

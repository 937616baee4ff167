// When the rows of a table were measured.
#pragma once

#include "base/csv_rows.h"

#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// A cell of a header: "global (W m-2)" or "Global [W m-2]" as name, in small letters, and unit.
struct ColumnHead {
    std::string name, unit;
    static ColumnHead of(const std::string& cell);
};

/// Throws UserError for a column whose unit is none of these.
[[noreturn]] void refuse_unit(const Place& place, const ColumnHead& head, const std::vector<std::string>& units,
                              const std::string& hint = "");

/// The time of rows: of a column `date`, civil time of the place, or `time` in h, min, s or d.
class SeriesClock {
public:
    /// Of the first such column of a header, or nothing. Throws UserError for another unit.
    static std::optional<SeriesClock> find(const CsvRows& table, const CsvRow& header);
    /// The first column has days, whatever it is called; they may begin below 0.
    static SeriesClock days_in_first_column() { return {0, 24, true}; }

    /// Since the midnight at which the first row's day begins; the rows are asked in their order. Throws UserError.
    double hours(const CsvRows& table, const CsvRow& row);
    double days(const CsvRows& table, const CsvRow& row);
    /// The date of the first row, the day counted from 1 on 1 January; 0 if there are no dates.
    int year() const { return year_; }
    int day() const { return day_; }

private:
    SeriesClock(std::size_t column, double hours, bool may_be_negative)
        : column_(column), hours_(hours), may_be_negative_(may_be_negative) {}
    double number(const CsvRows& table, const CsvRow& row) const;
    double hours_of_date(const CsvRows& table, const CsvRow& row);

    std::size_t column_;
    double hours_;  ///< in one unit of the column; 0: dates
    bool may_be_negative_;
    int year_ = 0, day_ = 0;
    long long first_midnight_ = 0;
};

}  // namespace espalier::environment

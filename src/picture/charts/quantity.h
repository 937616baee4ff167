// Quantities of statistics.csv: their titles, and what several plants' values are in one.
#pragma once

#include "espalier/picture/table_charts.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::picture {

/// With its unit.
std::string quantity_title(const std::string& column);

/// "m3" as "m³", "m3/m3" as "m³/m³".
std::string with_powers(const std::string& unit);

/// Throws UserError for a quantity that no table has, naming the nearest.
void require_quantity(std::span<const PlottedTable> tables, const std::string& quantity);

/// None if the table has no such column.
std::optional<std::size_t> column_of(const RecordedTable& table, const std::string& name);

/// Where a table has a quantity, and of how many values each row's mean, least or greatest is.
class QuantityColumn {
public:
    QuantityColumn(const RecordedTable& table, const std::string& quantity);

    explicit operator bool() const { return value_.has_value(); }
    double value(const std::vector<double>& row) const { return row[*value_]; }
    /// light.queries of light.mean, so that plants which ask nothing, or little, count as much as they asked; else 1.
    double weight(const std::vector<double>& row) const { return weight_ ? row[*weight_] : 1; }

private:
    std::optional<std::size_t> value_, weight_;
};

/// Several plants' values of one step in one, as `chart_page` says.
class Merged {
public:
    explicit Merged(const std::string& quantity) : way_(way_of(quantity)) {}

    /// NaN, and what has no weight, do not count. Weights matter to means only.
    void add(double value, double weight = 1);
    double value() const;  ///< NaN of none

private:
    enum class Way { sum, mean, greatest, least };

    static Way way_of(const std::string& quantity);

    Way way_;
    double value_ = 0, weights_ = 0;
};

}  // namespace espalier::picture

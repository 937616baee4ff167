// Quantities of statistics.csv: their titles, and what several plants' values are in one.
#pragma once

#include "picture/charts/table_charts.h"

#include <cstddef>
#include <span>
#include <string>

namespace espalier::picture {

/// With its unit.
std::string quantity_title(const std::string& column);

/// "m3" as "m³", "m3/m3" as "m³/m³".
std::string with_powers(const std::string& unit);

/// Throws UserError for a quantity that no table has, naming the nearest.
void require_quantity(std::span<const PlottedTable> tables, const std::string& quantity);

/// Several plants' values of one step in one, as `chart_page` says.
class Merged {
public:
    explicit Merged(const std::string& quantity) : way_(way_of(quantity)) {}

    void add(double value);
    double value() const;  ///< NaN of none

private:
    enum class Way { sum, mean, greatest, least };

    static Way way_of(const std::string& quantity);

    Way way_;
    double value_ = 0;
    std::size_t count_ = 0;
};

}  // namespace espalier::picture

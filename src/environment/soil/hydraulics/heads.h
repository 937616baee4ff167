// Pressure heads as a scene says them: in cm of water, or with a unit.
#pragma once

#include "espalier/base/settings.h"

#include "environment/given/weather/time_series.h"

#include <functional>
#include <string>
#include <vector>

namespace espalier::environment {

/// Of water of 1 g/cm3 at 9.80665 m/s2.
inline constexpr double cm_per_megapascal = 1e6 / 98.0665;

/// Of a unit by its name, "cm", "mm", "m", "Pa", "hPa", "kPa", "MPa", "bar" or "pF": what makes a number of it a head
/// in cm, so that 1 MPa is 10197.2 cm; pF is log10 of -head (Schofield 1935). Throws
/// UserError at `place` for another name.
std::function<double(double)> head_unit(const std::string& name, const Place& place);

/// A number is in cm; a text has a unit: "-1.5 MPa". The range is in cm. Throws UserError.
double read_head(const Settings& settings, const std::string& key, Range range);
double read_head_or(const Settings& settings, const std::string& key, double fallback, Range range);

/// A list of numbers in cm, or of texts with units. Throws UserError.
std::vector<double> read_heads(const Settings& settings, const std::string& key, Range range);

/// A head that changes with time: as read_head, or a column of a file, with its unit: { file, column, unit = "hPa" }.
TimeSeries read_head_series(const Settings& settings, const std::string& key, Range range);
/// The same of the column of this name of the file that `table` names.
TimeSeries read_head_column(const Settings& table, const std::string& column, Range range);

}  // namespace espalier::environment

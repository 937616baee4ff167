// The forms in which weather is kept. Each reader throws UserError naming line and column.
#pragma once

#include "environment/given/weather/weather_table.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

struct TextLine {
    int number = 0;  ///< in the file, from 1
    std::string text;
};

/// A header that names columns and units; `text` is that of the file.
WeatherTable read_weather_csv(const std::filesystem::path& path, const std::string& text,
                              const WeatherReading& reading);

// The lines of the file, without those that are empty:
using TextLines = std::span<const TextLine>;

/// EnergyPlus weather (Auxiliary Programs, EnergyPlus documentation): hour 1 ends at 1:00 standard time; radiation and
/// rain are of the hour before, the air is of its end.
WeatherTable read_epw(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading);
/// Typical years of the National Solar Radiation Data Base (Wilcox & Marion 2008).
WeatherTable read_tmy3(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading);
/// Typical years of the European Commission's PVGIS: UTC; radiation is of a moment, some minutes after the stamp.
WeatherTable read_bsrn(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading);
WeatherTable read_pvgis(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading);
/// Hours of NASA's POWER: a stamp is the beginning of its hour.
WeatherTable read_nasa_power(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading);

}  // namespace espalier::environment

#include "base/csv_rows.h"
#include "environment/given/weather/weather_text.h"

#include <algorithm>

namespace espalier::environment {

WeatherTable read_weather_file(const std::filesystem::path& path, const WeatherReading& reading) {
    const std::string text = table_text(path);
    const std::vector<TextLine> lines = weather_lines(text);
    const auto begins = [&](std::size_t i, const char* words) {
        return i < lines.size() && lines[i].text.starts_with(words);
    };
    if (begins(0, "LOCATION,")) return read_epw(path, lines, reading);
    if (begins(1, "Date (MM/DD/YYYY)")) return read_tmy3(path, lines, reading);
    if (begins(0, "Latitude (decimal degrees)")) return read_pvgis(path, lines, reading);
    if (begins(0, "*U0001") || begins(0, "*C0001")) return read_bsrn(path, lines, reading);
    if (begins(0, "-BEGIN HEADER-")) return read_nasa_power(path, lines, reading);
    return read_weather_csv(path, text, reading);
}

}  // namespace espalier::environment

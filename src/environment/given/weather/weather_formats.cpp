#include "environment/given/weather/weather_text.h"

#include <algorithm>

namespace espalier::environment {

WeatherTable read_weather_file(const std::filesystem::path& path, const WeatherReading& reading) {
    const std::vector<TextLine> lines = weather_lines(path);
    const auto begins = [&](std::size_t i, const char* text) {
        return i < lines.size() && lines[i].text.starts_with(text);
    };
    if (begins(0, "LOCATION,")) return read_epw(path, reading);
    if (begins(1, "Date (MM/DD/YYYY)")) return read_tmy3(path, reading);
    if (begins(0, "Latitude (decimal degrees)")) return read_pvgis(path, reading);
    if (begins(0, "-BEGIN HEADER-")) return read_nasa_power(path, reading);
    return read_weather_csv(path, reading);
}

}  // namespace espalier::environment

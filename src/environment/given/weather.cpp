// weather: one air for the whole scene, from numbers, days or a file.
#include "environment/given/weather/weather.h"

#include "espalier/environment/environment_process.h"

#include "base/bytes.h"
#include "environment/leaf/gas/air.h"

#include <algorithm>

namespace espalier::environment {
namespace {

class WeatherProcess final : public EnvironmentProcess {
public:
    WeatherProcess(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : weather_(settings, context.warnings) {
        fields.share(context.name, weather_);
    }

    void advance(const WorldView& world, Queries, Fields&) override {
        const AirOfStep air = weather_.of_step(world.step, world.time, world.dt);
        weather_.set_now(air);
        thermal_ += air.thermal;
        rain_ += air.rain;
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        const AirOfStep& air = weather_.now();
        const double numbers[] = {air.temperature, air.humidity, air.wind, air.carbon_dioxide, air.rain,
                                  air.daylength,   air.thermal,  thermal_, air.radiation,      air.pressure};
        for (std::size_t i = 0; i < queries.size(); ++i) {
            std::copy_n(numbers, std::min(std::size(numbers), answers[i].size()), answers[i].begin());
        }
    }

    std::vector<ChangingSetting> changing_settings() override { return weather_.changing_settings(); }

    std::vector<Quantity> statistics(std::uint32_t) const override {
        const AirOfStep& air = weather_.now();
        const double deficit = leaf::saturation_pressure(air.temperature) * (1 - air.humidity);
        return {{"temperature", air.temperature, "degC"},
                {"highest", air.highest, "degC"},
                {"lowest", air.lowest, "degC"},
                {"humidity", air.humidity},
                {"deficit", deficit, "kPa"},
                {"wind", air.wind, "m/s"},
                {"co2", air.carbon_dioxide, "umol/mol"},
                {"rain", air.rain, "mm"},
                {"radiation", air.radiation, "MJ/m2"},
                {"evaporation", air.evaporation, "mm"},
                {"daylength", air.daylength, "h"},
                {"thermal", air.thermal, "K d"},
                {"thermal_sum", thermal_, "K d"},
                {"rain_sum", rain_, "mm"}};
    }

    std::pair<int, int> query_arity() const override { return {1, 10}; }
    // The sums since the beginning are the same on every rank.
    Spreading spreading() const override { return Spreading::queries; }

    void save(std::ostream& out) const override {
        put(out, thermal_);
        put(out, rain_);
    }
    void restore(std::istream& in) override {
        thermal_ = get<double>(in);
        rain_ = get<double>(in);
    }

private:
    Weather weather_;
    double thermal_ = 0, rain_ = 0;  ///< since the beginning
};

const std::string& help() {
    static const std::string text =
        R"help(The air of a scene by time, which other processes take by the name of this one: leaf-exchange with air = "name",
canopy-light and ray-light with sky = { weather = "name" }, a soil that follows Richards' equation with
boundaries.top = { weather = "name" }. It stands before them in the scene.

?name(temperature)                    -> the step's mean, degrees Celsius
?name(temperature, humidity, wind, co2, rain, daylength)
                                      -> and 0 to 1, m/s at 2 m, umol/mol, mm of the step, hours of its first day
?name(..., thermal, sum, radiation, pressure)
                                      -> and degree-days of the step and since the beginning, MJ/m2 of the step, kPa

)help" + weather_help() +
        R"help(
A CSV has a header that names columns and units; commas, semicolons or tabs separate its cells. Its time is "time (h)" (or s,
min, d) since the midnight at which its first day begins, or "date", as 2025-06-21 13:30 in civil time. The columns are
temperature (degC), dew point (degC), humidity (%), vapour pressure (kPa), wind (m/s), pressure (kPa), global (W m-2), diffuse,
direct and par as canopy-light's series has them, rain (mm, until the next row, or mm/h), co2 (umol/mol). A file with highest
(degC) and lowest (degC) has a row for each day, and global (MJ m-2 d-1) its radiation. EPW, TMY3, PVGIS (typical years as
CSV), BSRN (a month of minutes) and NASA POWER (hours as CSV) are known by their first lines, and say place, date and units
themselves.

Cells that are empty, NA, 9999 and the like, or the codes of those forms, are missing values. Light from -20 to 0 W m-2 is 0.

The course of a day: temperature on half cosines from the lowest at sunrise to the highest two hours after noon by the sun, light
by the sine of the sun's height, vapour pressure as the day has it, rain and wind evenly.

Temperature, humidity, wind and co2 may have keyframes where the scene gives them as numbers.

Statistics of each step: temperature, highest, lowest (degC), humidity, deficit (kPa), wind, co2, rain (mm), radiation (MJ/m2),
evaporation (mm; FAO-56's reference, Allen et al. 1998), daylength (h), thermal (K d); since the beginning: thermal_sum,
rain_sum.)help";
    return text;
}

const Registered<ProcessType> entry{
    {"weather", "one air for the scene: temperature, humidity, wind, light, rain from a file or by days", help(),
     construct<WeatherProcess>}};

}  // namespace
}  // namespace espalier::environment

// One air for a scene, against closed forms and files of the test's own.
#include "environment/given/weather/weather.h"

#include "espalier/base/file.h"

#include "catch.h"
#include "environment/given/weather/day_of_sun.h"
#include "environment/light/sky/daylight.h"
#include "temporary_folder.h"

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

struct FileOfWeather {
    TemporaryFolder folder;
    std::string name;
    std::vector<Diagnostic> warnings;

    FileOfWeather(const std::string& file, const std::string& text) : name(file) {
        write_text(folder.path() / name, text);
    }
    Weather weather(const std::string& lines = "") {
        return Weather(Settings::parse_toml("file = \"" + name + "\"\n" + lines, "scene.toml", folder.path()),
                       &warnings);
    }
    std::string refusal(const std::string& lines = "") {
        try {
            weather(lines);
        } catch (const UserError& error) {
            return error.what();
        }
        return "";
    }
};

/// Two days of an EPW whose hour h has h degrees and 10 h W m-2, 12 to 13 h of them with 100 more.
std::string epw(const std::string& pressure = "100000") {
    std::string text =
        "\xEF\xBB\xBFLOCATION,\"A, town\",X,Y,Z,1,0.0,0.0,0.0,50.0\r\nCOMMENTS 1,one, two, three\r\n"
        "DATA PERIODS,1,1,Data,Sunday, 2/28, 3/1\r\n";
    for (const auto* date : {"2023,2,28", "1999,3,1"}) {
        for (int hour = 1; hour <= 24; ++hour) {
            const int light = hour == 13 ? 600 : 0;
            text += std::string(date) + "," + std::to_string(hour) + ",0,?9," + std::to_string(hour) + ",5,50," +
                    pressure + ",0,0,0," + std::to_string(light) + ",0," + std::to_string(light / 2) +
                    ",0,0,0,0,180,4,0,0,10,77777,9,999999999,0,0,0,88,999,2,1\r\n";
        }
    }
    return text;
}

}  // namespace

TEST_CASE("hour 1 of an EPW ends at one o'clock, and its radiation and rain are of the hour before", "[weather]") {
    FileOfWeather file("a.epw", epw());
    const Weather weather = file.weather("days = 0.0416666666666666667\n");
    const AirOfStep noon = weather.of_step(13, 13, 1);
    CHECK(noon.temperature == Approx(12.5));
    CHECK(noon.radiation == Approx(600 * 3600e-6));
    CHECK(noon.rain == Approx(2));
    CHECK(noon.humidity == Approx(0.5));
    CHECK(noon.pressure == Approx(100));
    CHECK(noon.wind == Approx(4 * 4.87 / std::log(67.8 * 10 - 5.42)));
    CHECK(weather.of_step(14, 14, 1).radiation == Approx(0).margin(1e-12));
    CHECK(weather.day() == 59);
    CHECK_THROWS_WITH(weather.of_step(60, 60, 1), Contains("repeat = true"));
}

TEST_CASE("a column of codes is missing, and a fill needs its hours", "[weather]") {
    FileOfWeather file("a.epw", epw("999999"));
    CHECK(file.weather().of_step(1, 1, 1).pressure == Approx(101.3 * std::pow((293 - 0.0065 * 50) / 293, 5.26)));
    FileOfWeather holes("w.csv", "time (h),temperature (degC)\n0,10\n1,NA\n2,NA\n3,16\n");
    CHECK_THAT(holes.refusal(), Contains("w.csv:3:2") && Contains("fill = \"linear\""));
    CHECK_THAT(holes.refusal("fill = \"linear\"\nfill_hours = 1\n"), Contains("missing for 2 hours"));
    CHECK(holes.weather("fill = \"linear\"\ndays = 0.125\n").of_step(1, 1, 1).temperature == Approx(13));
}

TEST_CASE("what cannot be is told in one line that says what to write", "[weather]") {
    const auto refusal = [](const std::string& column, const std::string& value) {
        return FileOfWeather("w.csv", "time (h)," + column + "\n0," + value + "\n1," + value + "\n").refusal();
    };
    CHECK_THAT(refusal("humidity (1)", "60"), Contains("w.csv:2:2") && Contains("humidity (%)"));
    CHECK_THAT(refusal("humidity (%)", "0.6"), Contains("humidity (1)"));
    CHECK_THAT(refusal("wind (m/s)", "-2"), Contains("below 0"));
    CHECK_THAT(refusal("co2 (Pa)", "40"), Contains("umol/mol"));
    CHECK_THAT(refusal("co2 (umol/mol)", "40"), Contains("40 Pa"));
}

TEST_CASE("thermal time of an even rise is its integral", "[weather]") {
    const ThermalTime warmth{8, 20, 30};
    double sum = 0;
    for (int i = 0; i < 100000; ++i) sum += warmth.at(35 * (i + 0.5) / 100000) / 100000;
    CHECK(warmth.mean_between(0, 35) == Approx(sum).epsilon(1e-6));
}

TEST_CASE("the light of a day follows the sun and has the day's sum", "[weather]") {
    const Weather weather(Settings{{"highest", 25.0}, {"lowest", 10.0}, {"radiation", 20.0}});
    const AirOfStep day = weather.of_step(3, 3, 1);
    CHECK(day.radiation == Approx(20));
    CHECK(day.temperature == Approx(17.5).margin(0.1));
    CHECK(day.highest == Approx(25).margin(0.02));
    CHECK(day.lowest == Approx(10).margin(0.02));
    CHECK(day_of_sun({0, 0, 0}, 2025, 80, 0).length() == Approx(12).margin(0.01));
}

// One air for a scene, against closed forms and files of the test's own.
#include "environment/given/weather/weather.h"

#include "espalier/base/file.h"

#include "catch.h"
#include "environment/given/weather/day_of_sun.h"
#include "environment/light/sky/daylight.h"
#include "temporary_folder.h"

#include <fmt/format.h>

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

/// The row of an EPW whose hour h has h degrees and 600 W m-2 from 12 to 13 h.
std::string epw_row(const std::string& date, int hour, int minute, const std::string& pressure) {
    const int light = hour == 13 ? 600 : 0;
    return fmt::format(
        "{},{},{},?9,{},5,50,{},0,0,0,{},0,{},0,0,0,0,180,4,0,0,10,77777,9,999999999,0,0,0,88,999,2,1\r\n", date, hour,
        minute, hour, pressure, light, light / 2);
}

/// Days of an EPW, with so many records an hour.
std::string epw(const std::string& pressure = "100000",
                const std::vector<std::string>& dates = {"2023,2,28", "1999,3,1"}, int records = 1) {
    std::string text =
        "\xEF\xBB\xBFLOCATION,\"A, town\",X,Y,Z,1,0.0,0.0,0.0,50.0\r\nCOMMENTS 1,one, two, three\r\n"
        "DATA PERIODS,1," +
        std::to_string(records) + ",Data,Sunday, 2/28, 3/1\r\n";
    for (const std::string& date : dates) {
        for (int hour = 1; hour <= 24; ++hour) {
            for (int k = 1; k <= records; ++k)
                text += epw_row(date, hour, records > 1 ? 60 / records * k : 0, pressure);
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

TEST_CASE("a factor makes the rain of a file more or less, and is refused where there is none", "[weather]") {
    FileOfWeather file("town.epw", epw());
    CHECK(file.weather("days = 0.0416666666666666667\nrain_factor = 0.5\n").of_step(13, 13, 1).rain == Approx(1));
    FileOfWeather dry("dry.csv", "time (h),temperature (degC)\n0,10\n24,12\n");
    CHECK_THAT(dry.refusal("rain_factor = 2\n"), Contains("this file has no rain"));
}

TEST_CASE("an EPW may have a 29 February, and several records an hour", "[weather]") {
    FileOfWeather leap("leap.epw", epw("100000", {"2024,2,28", "2024,2,29", "1999,3,1"}));
    const Weather year = leap.weather("days = 0.0416666666666666667\n");
    for (const double noon : {13.0, 37.0, 61.0}) CHECK(year.of_step(1, noon, 1).radiation == Approx(600 * 3600e-6));
    CHECK_THROWS_WITH(year.of_step(74, 74, 1), Contains("repeat = true"));

    FileOfWeather quarters("quarters.epw", epw("100000", {"2023,2,28", "1999,3,1"}, 4));
    const Weather fine = quarters.weather("days = 0.0416666666666666667\n");
    CHECK(fine.of_step(1, 12.75, 0.5).radiation == Approx(300 * 3600e-6));
    CHECK(fine.of_step(1, 12, 0.5).radiation == Approx(0).margin(1e-12));
    REQUIRE(quarters.warnings.size() == 1);
    CHECK_THAT(quarters.warnings[0].message, Contains("4 records an hour"));
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

TEST_CASE("TMY3: hours end at their stamp, months are of their own years, and place and zone are the station's",
          "[weather]") {
    std::string text =
        "723000,\"A STATION\",XX,-6.0,40.0,-90.0,200\r\n"
        "Date (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),DHI (W/m^2),Dry-bulb (C),RHum (%),Pressure (mbar),Wspd "
        "(m/s),Lprecip depth (mm)\r\n";
    for (const char* date : {"01/31/1988", "02/01/1980"}) {
        for (int hour = 1; hour <= 24; ++hour) {
            text += fmt::format("{},{:02}:00,{},{},{},40,990,3,{}\r\n", date, hour, hour == 12 ? 500 : 0,
                                hour == 12 ? 200 : 0, hour, hour == 7 ? "1.5" : "-9900");
        }
    }
    FileOfWeather file("t.csv", text);
    const Weather weather = file.weather("days = 0.0416666666666666667\nrain = 0\n");
    CHECK(weather.of_step(12, 12, 1).radiation == Approx(500 * 3600e-6));
    CHECK(weather.of_step(12, 12, 1).temperature == Approx(11.5));
    CHECK(weather.of_step(36, 36, 1).radiation == Approx(500 * 3600e-6));
    CHECK(weather.of_step(12, 12, 1).pressure == Approx(99));
    CHECK_THAT(file.refusal(), Contains("t.csv:3:9") && Contains("a number 'rain' in the scene replaces the column"));
    CHECK(weather.day() == 31);
    CHECK(weather.place().latitude == 40);
    CHECK(weather.place().longitude == -90);
    CHECK(weather.place().zone == -6);
}

TEST_CASE("PVGIS: radiation is of a moment after the hour, and lines after the rows are no rows", "[weather]") {
    std::string text =
        "Latitude (decimal degrees): 45.0\r\nLongitude (decimal degrees): 8.0\r\nElevation (m): 100.0\r\n"
        "Irradiance Time Offset (h): 0.25\r\n\r\n"
        "time(UTC),T2m,RH,G(h),Gb(n),Gd(h),IR(h),WS10m,WD10m,SP\r\n";
    for (int hour = 0; hour < 48; ++hour) {
        text += fmt::format("200706{:02}:{:02}00,{},50,{},0,0,300,4,0,100000\r\n", 20 + hour / 24, hour % 24, hour % 24,
                            hour % 24 == 12 ? 800 : 0);
    }
    FileOfWeather file("p.csv", text + "\r\nT2m: 2-m air temperature\r\n");
    const Weather weather = file.weather("days = 0.25\n");
    // A triangle of light from 11.25 to 13.25: two hours of half of its height.
    CHECK(weather.of_step(2, 2, 1).radiation + weather.of_step(3, 3, 1).radiation == Approx(800 * 3600e-6));
    CHECK(weather.of_step(3, 3, 1).radiation > weather.of_step(2, 2, 1).radiation);
    CHECK(weather.of_step(1, 1, 1).pressure == Approx(100));
    CHECK(weather.place().latitude == 45);
    CHECK(weather.day() == 171);
}

TEST_CASE("NASA POWER: hours begin at their stamp, and radiation has the unit of the header", "[weather]") {
    const auto text = [](const std::string& unit, double light) {
        std::string all =
            "-BEGIN HEADER-\nNASA/POWER Source Native Resolution Hourly Data\n"
            "Location: latitude  10.5   longitude -20.25\nElevation from MERRA-2: Average = 33.0 meters\n"
            "ALLSKY_SFC_SW_DWN     CERES SYN1deg All Sky Surface Shortwave Downward Irradiance (" +
            unit + ")\n-END HEADER-\nYEAR,MO,DY,HR,T2M,RH2M,WS2M,PS,PRECTOTCORR,ALLSKY_SFC_SW_DWN\n";
        for (int hour = 0; hour < 24; ++hour) {
            all += fmt::format("2021,3,1,{},{},80,2,101,0.5,{}\n", hour, hour, hour == 12 ? light : 0.0);
        }
        return all;
    };
    for (const auto& [unit, light] : {std::pair{"Wh/m^2", 360.0}, std::pair{"MJ/hr", 1.296}}) {
        FileOfWeather file("n.csv", text(unit, light));
        const Weather weather = file.weather("days = 0.0416666666666666667\n");
        CHECK(weather.of_step(13, 13, 1).radiation == Approx(360 * 3600e-6));
        CHECK(weather.of_step(12, 12, 1).radiation == Approx(0).margin(1e-12));
        CHECK(weather.of_step(13, 13, 1).rain == Approx(0.5));
        CHECK(weather.place().latitude == 10.5);
        CHECK(weather.place().longitude == -20.25);
        CHECK(weather.day() == 60);
    }
}

TEST_CASE("BSRN: minutes in two lines, places that count from the pole, and codes of what was not measured",
          "[weather]") {
    std::string text =
        "*C0001\n 77  2 2023  1\n 2 3 4\n*U0004\n -1 -1 -1\n 1 1\n Somewhere\n 1 2\n -1 somebody@example.org\n"
        " 142.250 187.500 120 XXX -1\n*U0100\n";
    for (int minute = 0; minute < 180; ++minute) {
        const int light = minute < 60 ? 0 : 300;
        text += fmt::format(" 28 {:4d}   {:4d} 0.5 {:4d} {:4d}   -999 -99.9 -999 -999\n", minute, light, light, light);
        text += fmt::format("          {:4d} 0.1 {:4d} {:4d}   310 0.2 309 311    {:5.1f}  50.0  995\n", light / 2,
                            light / 2, light / 2, minute == 90 ? -99.9 : 4.5);
    }
    FileOfWeather file("a.dat", text + "*U0300\n 1 2 3\n");
    const std::string minutes = "days = 0.000694444444444444444\nfill = \"linear\"\n";
    const Weather weather = file.weather(minutes);
    CHECK(weather.day() == 59);
    CHECK(weather.place().latitude == Approx(52.25));
    CHECK(weather.place().longitude == Approx(7.5));
    CHECK(weather.of_step(1, 60, 60).radiation == Approx(0).margin(1e-12));
    CHECK(weather.of_step(1, 120, 60).radiation == Approx(300 * 3600e-6));
    CHECK(weather.of_step(1, 92, 4).temperature == Approx(4.5));
    CHECK(weather.of_step(1, 92, 4).pressure == Approx(99.5));
    const std::size_t place = text.find("*U0004");
    FileOfWeather without("c.dat", text.substr(0, place) + text.substr(text.find("*U0100")));
    CHECK_FALSE(without.weather(minutes).table()->place.has_value());
    CHECK_THAT(FileOfWeather("b.dat", text.substr(0, text.size() - 80)).refusal(minutes),
               Contains("two lines of 10 and 11"));
}

TEST_CASE("missing rows of several gaps are filled on lines between their neighbours", "[weather]") {
    FileOfWeather file("w.csv", "time (h),temperature (degC)\n0,0\n1,1\n2,2\n5,5\n6,6\n7,7\n9,9\n10,NA\n11,11\n");
    CHECK_THAT(file.refusal("fill = \"linear\"\nfill_hours = 1\n"), Contains("w.csv:5") && Contains("3 hours since"));
    CHECK_THAT(file.refusal(), Contains("fill = \"linear\" and fill_hours = 2"));
    const Weather weather = file.weather("fill = \"linear\"\ndays = 0.0416666666666666667\n");
    for (int hour = 1; hour <= 11; ++hour) CHECK(weather.of_step(hour, hour, 1).temperature == Approx(hour - 0.5));
}

#include "environment/light/sky/daylight.h"

#include "espalier/base/file.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::environment;

namespace {

constexpr double least_elevation = 0.0349;

Settings table(const std::string& lines) {
    return Settings::parse_toml(lines, "scene.toml");
}

/// A series in a file of its own, and the table that names it.
struct Measured {
    TemporaryFolder folder;
    Settings settings;

    explicit Measured(const std::string& rows, const std::string& lines = "")
        : settings(table("series = \"" + (folder.path() / "light.csv").string() + "\"\n" + lines)) {
        write_text(folder.path() / "light.csv", rows);
    }
    Daylight over(double elapsed, double days) const {
        return DaylightSeries(settings, least_elevation).over(elapsed, days);
    }
    std::string refusal() const {
        return message_of([&] { DaylightSeries(settings, least_elevation); });
    }
    std::vector<Diagnostic> warnings() const {
        std::vector<Diagnostic> all;
        DaylightSeries(settings, least_elevation, &all);
        return all;
    }
};

double from_suns(const Daylight& light) {
    double sum = 0;
    for (const LightBeam& beam : light.beams) sum += beam.is_sun ? beam.photons * beam.towards.y : 0;
    return sum;
}

double beams_on_ground(const Daylight& light) {
    double sum = 0;
    for (const LightBeam& beam : light.beams) sum += beam.photons * beam.towards.y;
    return sum;
}

/// Hours from 0 to 24 with a parabola of light from 6 to 18 h.
std::string parabola(const char* header, double highest) {
    std::string rows = std::string(header) + "\n";
    for (int hour = 0; hour <= 24; ++hour) {
        const double t = (hour - 12) / 6.0;
        rows += std::to_string(hour) + "," + std::to_string(std::max(0.0, highest * (1 - t * t))) + "\n";
    }
    return rows;
}

}  // namespace

TEST_CASE("a series is interpolated, and integrated over each step", "[sky]") {
    const Measured measured(parabola("time (h),global (W m-2)", 600), "latitude = 40\nday = 172\n");
    // Trapezes of the hourly values, exactly: a parabola's are less than its integral by 1 / 72.
    const double joules = 3600 * 600 * (12 * 2 / 3.0 - 1 / 18.0);
    const Daylight day = measured.over(0, 1);
    CHECK(day.energy == Approx(joules).epsilon(1e-9));
    CHECK(day.on_ground == Approx(joules * 0.5 * 4.57e-6).epsilon(1e-9));
    CHECK(beams_on_ground(day) == Approx(day.on_ground).epsilon(1e-9));
    double parts = 0;
    for (int i = 0; i < 10; ++i) parts += measured.over(i / 10.0, 0.1).energy;
    CHECK(parts == Approx(joules).epsilon(1e-9));
    CHECK(measured.over(0, 0.2).energy == 0);
}

TEST_CASE("columns of a series may stand in any order and in other units, with dates, beside others", "[sky]") {
    const Measured watts(
        "wind (m/s),par (W m-2),diffuse (kW m-2),date,global (W/m2)\n"
        "3,100,0.1,2024-06-20 11:00,200\n2,100,0.1,2024-06-20 12:00,200\n1,100,0.1,2024-06-20 13:00,200\n");
    const Daylight light = watts.over(0.5 - 1 / 24.0, 1 / 12.0);
    CHECK(light.energy == Approx(2 * 3600 * 200));
    CHECK(light.on_ground == Approx(2 * 3600 * 100 * 4.57e-6));
    CHECK(from_suns(light) == Approx(0.5 * light.on_ground));
}

TEST_CASE("the diffuse light may be measured in watts, in photons or as a share, and so may the direct light",
          "[sky]") {
    for (const auto& [header, cells] :
         {std::pair{"global (W m-2),diffuse (W m-2)", "400,100"},
          {"global (W m-2),direct (W m-2)", "400,300"},
          {"par (umol m-2 s-1),diffuse (umol m-2 s-1)", "914,228.5"},
          {"PAR (\xC2\xB5mol m\xE2\x81\xBB\xC2\xB2 s\xE2\x81\xBB\xC2\xB9),direct (umol/m2/s)", "914,685.5"},
          {"Global (W m^-2),diffuse (umol m-2 s-1)", "400,228.5"},
          {"global (W m-2),diffuse share (1)", "400,0.25"},
          {"global (W m-2),diffuse share", "400,0.25"},
          {"global (W m-2),diffuse (%)", "400,25"},
          {"par (umol m-2 s-1),diffuse (1)", "914,0.25"}}) {
        const std::string row = std::string(",") + cells + "\n";
        const Measured measured("time (h)," + std::string(header) + "\n11" + row + "12" + row + "13" + row);
        CAPTURE(header);
        CHECK(measured.warnings().empty());
        const Daylight light = measured.over(11 / 24.0, 2 / 24.0);
        CHECK(light.on_ground == Approx(2 * 3600e-6 * 914));
        CHECK(light.energy == Approx(2 * 3600 * 400));
        CHECK(from_suns(light) == Approx(0.75 * light.on_ground));
    }
}

TEST_CASE("diffuse light that sensors and their rounding make more than all is all of it", "[sky]") {
    for (const auto& [global, diffuse] : {std::pair{"0.336", "0.34"}, {"9", "12"}, {"200", "210"}}) {
        const std::string row = std::string(",") + global + "," + diffuse + "\n";
        const Daylight light =
            Measured("time (h),global (W m-2),diffuse (W m-2)\n11" + row + "13" + row).over(11 / 24.0, 2 / 24.0);
        CHECK(light.energy == Approx(7200 * std::stod(global)));
        CHECK(from_suns(light) == 0);
    }
    CHECK(lacks(Measured("time (h),global (W m-2),diffuse share (1)\n11,9,40\n12,9,40\n").refusal(),
                {"light.csv:2", "diffuse share is 40", "%"}) == "");
}

TEST_CASE("codes of missing values are not light: other columns stand for them, or the series is refused", "[sky]") {
    const std::string head = "time (h),global (W m-2),diffuse (W m-2),par (umol m-2 s-1)\n";
    const auto rows = [&](const std::string& noon) {
        return head + "11,400,100,914\n12," + noon + "\n13,400,100,914\n";
    };
    const Daylight whole = Measured(rows("400,100,914")).over(11 / 24.0, 2 / 24.0);
    for (const char* code :
         {"9999", "9999.0", "99999", "-9999", "-999", "-99", "-6999", "7999", "NA", "nan", "", "-"}) {
        CAPTURE(code);
        for (const std::string& noon : {"400,100," + std::string(code), std::string(code) + ",100,914"}) {
            const Measured measured(rows(noon));
            const Daylight light = measured.over(11 / 24.0, 2 / 24.0);
            CHECK(light.on_ground == Approx(whole.on_ground));
            CHECK(light.energy == Approx(whole.energy));
            CHECK(from_suns(light) == Approx(from_suns(whole)));
            REQUIRE(measured.warnings().size() == 1);
            CHECK(lacks(to_string(measured.warnings()[0]),
                        {"light.csv:3", "was not measured in a cell", "other columns"}) == "");
        }
        // What the sky's share is, Erbs et al. tell where nobody measured it.
        const Measured erbs(rows("400," + std::string(code) + ",914"));
        CHECK(erbs.over(11 / 24.0, 2 / 24.0).on_ground == Approx(whole.on_ground));
        CHECK(erbs.warnings().size() == 1);
        const std::string both = std::string(code) + ",100," + code;
        CHECK(lacks(Measured(rows(both)).refusal(), {"light.csv:3:2", "'global'", "no holes", "Fill it"}) == "");
    }
    CHECK(Measured(head + "9,0,NA,0\n10,0,9999,0\n11,400,100,914\n12,400,100,914\n").warnings().empty());
    CHECK(lacks(Measured(head + "11,40000,100,914\n12,1,1,1\n").refusal(), {"light.csv:2:2", "than the sun", "unit"}) ==
          "");
}

TEST_CASE("an hour may be what stands for a missing value elsewhere", "[sky]") {
    const Measured measured("time (h),global (W m-2)\n9996,400\n9999,400\n10002,400\n", "latitude = 85\nday = 120\n");
    CHECK(measured.over(9996 / 24.0, 6 / 24.0).energy == Approx(6 * 3600 * 400));
}

TEST_CASE("what a dark sensor shows below 0 is no light", "[sky]") {
    const Measured measured("time (h),global (W m-2),par (umol m-2 s-1)\n0,-3.5,-0.2\n12,-20,-20\n24,800,1600\n",
                            "latitude = 80\nday = 172\n");
    CHECK(measured.over(0, 0.5).energy == 0);
    CHECK(measured.over(0, 0.5).on_ground == 0);
    CHECK(measured.over(0.5, 0.5).energy == Approx(12 * 3600 * 400));
    CHECK(measured.warnings().empty());
}

TEST_CASE("cells may be separated by semicolons or tabs, behind a byte-order mark", "[sky]") {
    const Daylight commas = Measured("time (h),global (W m-2)\n11,400.5\n12,300.25\n").over(11 / 24.0, 1 / 24.0);
    for (const char* text : {"\xEF\xBB\xBFtime (h),global (W m-2)\n11,400.5\n12,300.25\n",
                             "time (h);global (W m-2)\r\n11;400.5\r\n12;300.25\r\n",
                             "\xEF\xBB\xBFtime (h);global (W m-2)\n11;400,5\n12;300,25\n",
                             "time (h)\tglobal (W m-2)\n11\t400.5\n12\t300,25\n"}) {
        CHECK(Measured(text).over(11 / 24.0, 1 / 24.0).energy == Approx(commas.energy));
    }
    CHECK(lacks(Measured("time (h);glbal (W m-2)\n11;1\n").refusal(),
                {"neither 'global", "which semicolons separate"}) == "");
    CHECK(lacks(Measured("time (h)\tglobal (W m-2)\n11\t1\t1\n").refusal(), {"3 cells", "which tabs separate"}) == "");
    CHECK(lacks(Measured("\xFF\xFEt\0i\0").refusal(), {"light.csv:1", "UTF-16", "UTF-8"}) == "");
    const auto near = Measured("time (h),global (W m-2),difuse (W m-2)\n11,4,4\n12,3,3\n").warnings();
    REQUIRE(near.size() == 1);
    CHECK(lacks(to_string(near[0]), {"light.csv:1:3", "'difuse' is not read", "'diffuse'"}) == "");
}

TEST_CASE("seven steps of a day spend seven days, and step 0 has the light of the first", "[sky]") {
    std::string rows = "time (d),par (umol m-2 s-1)\n";
    for (int day = 0; day <= 7; ++day) rows += std::to_string(day) + "," + std::to_string(100 + 10 * day) + "\n";
    const Measured measured(rows, "latitude = 80\nday = 170\n");
    const DaylightSeries series(measured.settings, least_elevation);
    double sum = 0;
    for (int step = 1; step <= 7; ++step) sum += series.of_step(step, 1).on_ground;
    CHECK(sum == Approx(86400e-6 * 7 * 135));
    CHECK(series.of_step(0, 1).on_ground == series.of_step(1, 1).on_ground);
    CHECK(series.of_step(1, 1).on_ground == Approx(86400e-6 * 105));
}

TEST_CASE("a step of a week counts every row of it", "[sky]") {
    std::string rows = "time (d),par (umol m-2 s-1),direct (W m-2)\n";
    for (int day = 0; day <= 7; ++day) rows += std::to_string(day) + "," + std::to_string(100 * day) + ",0\n";
    CHECK(Measured(rows, "latitude = 80\nday = 170\n").over(0, 7).on_ground == Approx(86400e-6 * 100 * 24.5));
}

TEST_CASE("a series that repeats has the same light in every period", "[sky]") {
    const Measured measured(parabola("time (h),global (W m-2)", 600), "latitude = 0\nday = 80\nrepeat = true\n");
    CHECK(measured.over(5, 1).energy == Approx(measured.over(0, 1).energy).epsilon(0.01));
    const Measured once(parabola("time (h),global (W m-2)", 600), "latitude = 0\nday = 80\n");
    CHECK(lacks(message_of([&] { once.over(1.5, 1); }), {"light.csv", "36 to 60", "repeat"}) == "");
}

TEST_CASE("a series that cannot be is refused with file and line, in one line", "[sky]") {
    const std::string head = "time (h),global (W m-2)\n";
    CHECK(lacks(Measured(head + "0,0\n1,nan\n2,5\n").refusal(), {"light.csv:3:2", "'nan'", "no holes"}) == "");
    CHECK(lacks(Measured(head + "0,0\n1,\n2,5\n").refusal(), {"light.csv:3:2"}) == "");
    CHECK(lacks(Measured(head + "0,0\n1,-21\n2,5\n").refusal(), {"light.csv:3:2", "below 0"}) == "");
    CHECK(lacks(Measured(head + "0,1\n1,1\n5,1\n6,1\n").refusal(), {"light.csv:4", "gap in time", "4 hours"}) == "");
    CHECK(lacks(Measured(head + "0,1\n1,1\n1,1\n").refusal(), {"light.csv:4", "not after"}) == "");
    CHECK(lacks(Measured(head + "0,0\n1,0\n").refusal(), {"no light in any row"}) == "");
    CHECK(lacks(Measured(head + "0,1\n").refusal(), {"two rows"}) == "");
    CHECK(lacks(Measured(head + "0,1\n1,1,1\n").refusal(), {"light.csv:3", "3 cells"}) == "");
    CHECK(lacks(Measured("time (h),global (lux)\n0,1\n1,1\n").refusal(), {"light.csv:1:2", "lux", "W m-2"}) == "");
    CHECK(lacks(Measured("time,global (W m-2)\n0,1\n1,1\n").refusal(), {"light.csv:1:1", "time (h)"}) == "");
    CHECK(lacks(Measured("time (h),glbal (W m-2)\n0,1\n1,1\n").refusal(), {"neither 'global"}) == "");
    CHECK(lacks(Measured("global (W m-2)\n1\n1\n").refusal(), {"no column 'time (h)'"}) == "");
    CHECK(lacks(Measured("date,par (umol m-2 s-1)\n2024-02-30 10:00,1\n").refusal(), {"light.csv:2:1", "no date"}) ==
          "");
    CHECK(lacks(Measured("time (h),global (W m-2),diffuse (W m-2)\n12,100,200\n13,1,1\n").refusal(),
                {"light.csv:2", "more than all"}) == "");
    CHECK(lacks(Measured(head + "0,300\n1,300\n", "latitude = 50\nday = 172\n").refusal(),
                {"light.csv:2", "below the horizon", "longitude and zone"}) == "");
}

TEST_CASE("a sky without light is refused", "[sky]") {
    const auto refusal = [](const std::string& lines) {
        return message_of([&] { DaylightSeries(table(lines), least_elevation); });
    };
    for (const char* key : {"par", "global", "clearness"}) {
        CHECK(lacks(refusal(std::string(key) + " = 0\n"), {"scene.toml:1", key, "without light"}) == "");
    }
    CHECK(lacks(refusal("par = 1\nglobal = 1\n"), {"given twice"}) == "");
    CHECK(lacks(refusal("integration = \"adaptive\"\nhours = [12]\n"), {"leave 'hours' out"}) == "");
}

TEST_CASE("several given suns share the direct light on level ground", "[sky]") {
    const Daylight light = DaylightSeries(table("par = 800\ndiffuse = 0.25\nsuns = [[0, 2, 0], [1, 1, 0], [0, 1, -1]]\n"
                                                "sun_shares = [3, 2, 1]\n"),
                                          least_elevation)
                               .over(0, 1);
    const double all = 800 * 86400e-6;
    CHECK(light.on_ground == Approx(all));
    CHECK(light.seconds == 86400);
    CHECK(beams_on_ground(light) == Approx(all));
    std::vector<double> of_suns;
    for (const LightBeam& beam : light.beams) {
        if (beam.is_sun) of_suns.push_back(beam.photons * beam.towards.y);
    }
    REQUIRE(of_suns.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(of_suns[i] == Approx(0.75 * all * double(3 - i) / 6));

    const auto refusal = [](const std::string& lines) {
        return message_of([&] { DaylightSeries(table("par = 1\ndiffuse = 0\n" + lines), least_elevation); });
    };
    CHECK(lacks(refusal("suns = [[0, 1, 0], [1, 0, 0]]\n"), {"scene.toml:3", "sun 2", "2 degrees above"}) == "");
    CHECK(lacks(refusal("suns = [[0, 0, 0]]\n"), {"sun 1"}) == "");
    CHECK(lacks(refusal("suns = []\n"), {"scene.toml:3", "0 'suns'"}) == "");
    CHECK(lacks(refusal("suns = [[0, 1, 0]]\nsun_shares = [1, 2]\n"), {"scene.toml:4", "each of the 1 'suns'"}) == "");
    CHECK(lacks(refusal("suns = [[0, 1, 0]]\nsun_shares = [-1]\n"), {"from 0 on"}) == "");
    CHECK(lacks(refusal("suns = [[0, 1, 0]]\nsun = [0, 1, 0]\n"), {"given twice"}) == "");
}

TEST_CASE("light in watts is that in photons, over 4.57 umol per joule and the share of PAR", "[sky]") {
    const Daylight watts = DaylightSeries(table("global = 500\n"), least_elevation).over(0, 1);
    CHECK(watts.energy == Approx(500 * 86400));
    CHECK(watts.on_ground == Approx(500 * 86400 * 0.5 * 4.57e-6));
}

TEST_CASE("as many hours as the day's light needs give the integral from sunrise to sunset", "[sky]") {
    for (const double latitude : {-35.0, 0.0, 50.0, 75.0}) {
        for (const double day : {20.0, 172.0, 300.0}) {
            const std::string lines =
                "latitude = " + std::to_string(latitude) + "\nday = " + std::to_string(day) + "\ndiffuse = 0.3\n";
            std::string fine = "hours = [";
            for (int i = 0; i < 2400; ++i) fine += std::to_string(0.005 + i / 100.0) + (i < 2399 ? "," : "]\n");
            const double adaptive =
                DaylightSeries(table(lines + "integration = \"adaptive\"\n"), least_elevation).over(0, 1).on_ground;
            const double exact = DaylightSeries(table(lines + fine), least_elevation).over(0, 1).on_ground;
            CAPTURE(latitude, day);
            CHECK(adaptive == Approx(exact).epsilon(3e-3).margin(1e-6));
        }
    }
}

TEST_CASE("bands have photons by their wavelength, and a share of daylight", "[sky]") {
    CHECK(photons_per_joule(550) == Approx(4.5977).epsilon(1e-4));  // 550 nm over 119.627 nm umol/J
    const LightBand red = read_light_band("red", table("")), far_red = read_light_band("far-red", table(""));
    CHECK(red.share * red.photons / (far_red.share * far_red.photons) == Approx(1.19));
    const LightBand blue = read_light_band("blue", table("share = 0.1\nwavelength = 450\n"));
    CHECK(blue.photons == Approx(450 / 119.627).epsilon(1e-4));
    CHECK(lacks(message_of([] { read_light_band("blue", table("")); }), {"'blue' needs share"}) == "");
    CHECK(lacks(message_of([] { read_light_band("par", table("share = 0.4")); }), {"sky.par_share"}) == "");
    const Daylight light = DaylightSeries(table("global = 1000\n"), least_elevation).over(0, 1);
    CHECK(light.joules(read_light_band("nir", table(""))) == Approx(0.5 * light.energy));
    CHECK(light.joules(read_light_band("par", table(""))) == Approx(0.5 * light.energy));
}

TEST_CASE("a step of an hour gets its share of the light of the whole day", "[sky]") {
    const DaylightSeries series(table("latitude = 50\nday = 100\n"), least_elevation);
    const Daylight day = series.over(0, 1), hour = series.over(3.0 / 24, 1.0 / 24);
    CHECK(hour.on_ground == Approx(day.on_ground / 24).epsilon(1e-12));
    REQUIRE(hour.beams.size() == day.beams.size());
    for (std::size_t i = 0; i < day.beams.size(); ++i) {
        CHECK(hour.beams[i].photons == Approx(day.beams[i].photons / 24).epsilon(1e-12));
        CHECK(glm::length(hour.beams[i].towards - day.beams[i].towards) < 1e-12);
    }
}

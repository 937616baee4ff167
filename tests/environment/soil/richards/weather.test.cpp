// Rain, evaporation, ponding and runoff; the account of a season; soils that solvers find hard.
#include "espalier/base/file.h"

#include "catch.h"
#include "environment/soil/richards/column.h"
#include "environment/soil/richards/reference.h"

#include <cmath>
#include <filesystem>

namespace espalier::test {
namespace {

std::string evaporating(const std::string& soil, double voxel, double head, double mm) {
    return column_of(
        1, voxel,
        fmt::format("soil = {}\ninitial = {{ head = {} }}\nboundaries = {{ top = {{ evaporation = {} }} }}", soil, head,
                    mm));
}

struct Extremes {
    double lowest = 1e300, highest = -1e300;
};

Extremes contents(const SoilBlock& block) {
    Extremes found;
    for (int y = 0; y < block.height(); ++y) {
        found.lowest = std::min(found.lowest, block.content(y));
        found.highest = std::max(found.highest, block.content(y));
    }
    return found;
}

}  // namespace

TEST_CASE("loam evaporates as a fine reference does, in voxels of millimetres and centimetres", "[environment][soil]") {
    const auto reference = [](int cells) {
        ReferenceColumn column({0.08, 0.43, 0.04, 1.6, 50}, 25, cells, -200);
        column.potential_flux = -0.1;
        column.advance(0.9, 60);
        CHECK(column.flux == -0.1);
        column.advance(1.1, 120);
        return -column.passed;
    };
    const double exact = 2 * reference(500) - reference(250);  // its error falls with the first power of the cell
    for (const auto& [voxel, tolerance] : {std::pair{0.002, 0.012}, {0.01, 0.025}, {0.02, 0.04}}) {
        SoilBlock column(evaporating(test_loam, voxel, -200, 1));
        column.advance(0.9);
        CHECK(column.flown().evaporation == Approx(0.09));  // as much as the air takes
        column.advance(1.1);
        CHECK(column.flown().evaporation == Approx(exact).epsilon(tolerance));
    }
}

TEST_CASE("the rate falls with the root of time, as the desorptivity has it", "[environment][soil]") {
    // Vanderborght et al. (2005): 0.0565 cm/d after two days, without gravity; it holds some percent back.
    SoilBlock column(evaporating(test_loam, 0.005, -200, 1));
    column.advance(1.9);
    const double before = column.flown().evaporation;
    column.advance(0.2);
    CHECK((column.flown().evaporation - before) / 0.2 == Approx(0.0565).epsilon(0.07));
}

TEST_CASE("sand, loam and clay evaporate much the same in voxels of one and five millimetres", "[environment][soil]") {
    const double sand = [] {
        SoilBlock fine(evaporating(test_sand, 0.001, -40, 1));
        fine.advance(5);
        return fine.flown().evaporation;
    }();
    SoilBlock coarse(evaporating(test_sand, 0.005, -40, 1));
    coarse.advance(5);
    CHECK(coarse.flown().evaporation == Approx(sand).epsilon(0.03));
    for (const auto& [soil, mm, day5] : {std::tuple{test_loam, 3.0, 0.303}, {test_clay, 3.0, 0.695}}) {
        SoilBlock column(evaporating(soil, 0.01, -200, mm));
        column.advance(5);
        CHECK(column.flown().evaporation == Approx(day5).epsilon(0.02));
    }
}

TEST_CASE("what rain does not enter stands, and then runs off; all is accounted for", "[environment][soil]") {
    SoilBlock column(column_of(1, 0.02,
                               "soil = " + test_clay +
                                   "\ninitial = { head = -400 }\n"
                                   "boundaries = { top = { rain = 400, ponding = 15 } }"));
    column.advance(0.01);
    CHECK(column.flown().runoff == 0);
    column.advance(0.19);
    CHECK(column.soil.ponding()[0] == Approx(1.5));
    CHECK(column.flown().runoff > 1);
    CHECK(column.flown().rain == Approx(8));
    CHECK(std::abs(column.soil.balance().relative_error()) < 1e-12);
    // After the rain the pond seeps away.
    column.parameters.surface.rain.set(0);
    column.advance(3);
    CHECK(column.soil.ponding()[0] == 0);
    CHECK(std::abs(column.soil.balance().relative_error()) < 1e-12);
}

TEST_CASE("soils that are dry or full, rain of 100 mm in an hour, voxels of 1 mm and 10 cm", "[environment][soil]") {
    const std::vector<std::string> beginnings = {"{ head = -10000 }", "{ table = 0 }"};
    for (const std::string& soil : {std::string("\"sand\""), std::string("\"silty clay\""), test_clay}) {
        for (const std::string& begins : beginnings) {
            for (const double voxel : {0.001, 0.1}) {
                INFO(soil << " " << begins << " " << voxel);
                SoilBlock column(column_of(voxel < 0.01 ? 0.1 : 1, voxel,
                                           "soil = " + soil + "\ninitial = " + begins +
                                               "\nboundaries = { top = { rain = 2400, ponding = 5 }, bottom = "
                                               "\"free-drainage\" }"));
                const SoilKind& kind = column.parameters.kinds[0].soil();
                column.advance(1.0 / 24);
                CHECK(column.flown().rain == Approx(10));
                CHECK(contents(column).lowest > kind.residual);
                CHECK(contents(column).highest < kind.saturated + 1e-6);
                CHECK(std::abs(column.soil.balance().relative_error()) < 1e-12);
            }
        }
    }
}

TEST_CASE("a front neither overshoots nor undershoots", "[environment][soil]") {
    SoilBlock column(column_of(1, 0.01,
                               "soil = " + test_sand +
                                   "\ninitial = { head = -10000 }\n"
                                   "boundaries = { top = { rain = 500 } }"));
    for (int hour = 0; hour < 8; ++hour) {
        column.advance(1.0 / 24);
        for (int y = 1; y < column.height(); ++y) {
            // From the wetted top downwards the content falls.
            if (column.depth(y) < column.front(0.1) + 5) CHECK(column.content(y) >= column.content(y - 1) - 1e-6);
            CHECK(column.content(y) >= 0.045);
        }
    }
}

TEST_CASE("a season of weather from a file is accounted for to a millionth", "[environment][soil]") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "espalier-soil-weather";
    std::filesystem::create_directories(folder);
    std::string lines = "day,rain,evaporation\n";
    double rain = 0;
    for (int day = 0; day < 120; ++day) {
        const double today = day * 37 % 11 < 2 ? 4 + day * 53 % 29 : 0;
        rain += 0.1 * today;
        lines += fmt::format("{},{},{}\n", day, today, 2 + day % 5);
    }
    write_text(folder / "weather.csv", lines);
    const std::string file = (folder / "weather.csv").string();
    SoilBlock column(column_of(
        1.2, 0.05,
        fmt::format(
            "soil = \"loam\"\nlayers = [{{ top = -0.4, bottom = -0.7, soil = \"sand\" }}, {{ top = -0.7, soil = "
            "\"clay\" }}]\nboundaries = {{ top = {{ rain = {{ file = \"{0}\", column = \"rain\" }}, evaporation = "
            "{{ file = \"{0}\", column = \"evaporation\" }}, ponding = 3 }}, bottom = \"free-drainage\" }}",
            file)));
    double lowest = 1;
    for (int day = 0; day < 120; ++day) {
        column.advance(1);
        lowest = std::min(lowest, contents(column).lowest);
    }
    CHECK(column.flown().rain == Approx(rain).epsilon(1e-9));
    CHECK(lowest > 0.045);
    CHECK(std::abs(column.soil.balance().relative_error()) < 1e-9);
    try {
        column.advance(1);
        FAIL("the series has ended");
    } catch (const RunError& error) {
        CHECK(std::string(error.what()).find("weather.csv: rain goes from day 0 to 120") != std::string::npos);
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("a series by days, by hours and by dates is the same rain", "[environment][soil]") {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "espalier-soil-clock.csv";
    for (const char* const lines :
         {"day,rain\n0,4\n0.5,0\n2,6\n3,0\n", "time (h),rain\n0,4\n12,0\n48,6\n72,0\n",
          "date,snow,rain\n2024-02-28,9,4\n2024-02-28 12:00,9,0\n2024-03-01,9,6\n2024-03-02,9,0\n"}) {
        write_text(file, lines);
        SoilBlock column(column_of(0.5, 0.05,
                                   fmt::format("soil = \"loam\"\nboundaries = {{ top = {{ rain = {{ file = \"{}\", "
                                               "column = \"rain\" }} }} }}",
                                               file.string())));
        for (const auto& [days, rain] : {std::pair(0.25, 0.1), {0.5, 0.2}, {1.25, 0.2}, {0.5, 0.5}, {0.5, 0.8}}) {
            column.advance(days);
            CHECK(column.flown().rain == Approx(rain).epsilon(1e-9));
        }
    }
    std::filesystem::remove(file);
}

TEST_CASE("hydrostatic soil stands still, through layers too", "[environment][soil]") {
    for (const double voxel : {0.02, 0.1}) {
        SoilBlock column(column_of(1, voxel,
                                   "soil = \"sand\"\nlayers = [{ top = -0.5, soil = \"clay loam\" }]\n"
                                   "initial = { table = -0.9 }\nboundaries = { bottom = { table = -0.9 } }"));
        column.advance(20);
        for (int y = 0; y < column.height(); ++y) {
            CHECK(column.head(y) == Approx(column.depth(y) - 90).margin(0.02));
        }
        CHECK(std::abs(column.flown().bottom) < 1e-4);
    }
}

}  // namespace espalier::test

// soil-water with model = "richards" as a scene meets it.
#include "espalier/base/file.h"

#include "base/png_file.h"
#include "catch.h"
#include "environment/soil/linear/soil.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <filesystem>

namespace espalier::test {
namespace {

const std::string bed = R"(model = "richards"
domain = { lower = [-0.1, -0.3, -0.1], upper = [0.1, 0, 0.1] }
voxel = 0.02
soil = "loam"
initial = { table = -0.5 }
boundaries = { top = { rain = 10, evaporation = 2, ponding = 4 }, bottom = "free-drainage" }
)";

std::string mistake_of(const std::string& text) {
    return user_error([&] { Soil soil(text); });
}

void check_mistake(const std::string& text, const std::string& message) {
    const std::string found = mistake_of(text);
    INFO(found);
    CHECK(found.find(message) != std::string::npos);
}

float value(const Soil& soil, const std::string& field, openvdb::Coord at) {
    return soil.fields.need(field).grid->grid->tree().getValue(at);
}

}  // namespace

TEST_CASE("the soil's head, content, fluxes and ponding are fields in units", "[environment][soil]") {
    Soil soil(bed);
    soil.step();
    CHECK(soil.fields.need("water").unit == "m3/m3");
    CHECK(soil.fields.need("water.head").unit == "cm");
    CHECK(soil.fields.need("water.flux_y").unit == "cm/d");
    CHECK(soil.fields.need("water.ponding").unit == "mm");
    CHECK(soil.fields.need("water.ponding").current()->grid->indexToWorld(openvdb::Coord(0, 0, 0)).y() == Approx(0.01));
    const auto head = soil.fields.need("water.head").current(), flux = soil.fields.need("water.flux_y").current();
    CHECK(head->grid->tree().getValue(openvdb::Coord(3, 14, 3)) < 0);
    CHECK(flux->grid->tree().getValue(openvdb::Coord(3, 13, 3)) < 0);  // the rain goes down
    CHECK(soil.quantity("rain") == Approx(10));
    CHECK(soil.quantity("evaporation") == Approx(2));
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
}

TEST_CASE("frame 0 is the initial state", "[environment][soil]") {
    Soil soil(bed);
    soil.world.step = 0;
    soil.step();
    CHECK(soil.quantity("rain") == 0);
    CHECK(value(soil, "water.head", {0, 0, 0}) == Approx(100 * (-0.5 + 0.29)));
}

TEST_CASE("days say what a unit of time is", "[environment][soil]") {
    Soil soil(bed + "days = 0.25\n");
    soil.step();
    CHECK(soil.quantity("rain") == Approx(2.5));
}

TEST_CASE("a query drinks from the soil, down to the wilting point, and is told the head", "[environment][soil]") {
    Soil soil(bed + "amount = \"volume\"\n");
    const std::vector<double> asked = {1e-7, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const auto answers = soil.step({{{0.01, -0.15, 0.01}, asked}});
    CHECK(answers[0][0] == Approx(1e-7));
    CHECK(answers[0][8] > 0.3);
    CHECK(answers[0][9] < -10);
    CHECK(answers[0][9] > -60);
    CHECK(soil.quantity("drunk") == Approx(1e-7 / (0.2 * 0.2) * 1000));
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
    // A voxel has no more than lies above the wilting point.
    const double obtained = soil.obtain({{0.01, -0.15, 0.01}, {1}});
    CHECK(obtained > 1e-6);
    CHECK(obtained < 8e-6 * 8 * 0.43);
    soil.step();
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
}

TEST_CASE("a soil kept in a checkpoint goes on the same", "[environment][soil]") {
    Soil straight(bed), resumed(bed);
    straight.step();
    std::istringstream bytes(straight.saved());
    resumed.process->restore(bytes);
    straight.step({{{0, -0.1, 0}, {0.1}}});
    resumed.step({{{0, -0.1, 0}, {0.1}}});
    CHECK(resumed.saved() == straight.saved());
}

TEST_CASE("a moving stone is refused, a standing one holds no water", "[environment][soil]") {
    Soil soil(bed + "obstacles = [{ shape = \"box\", lower = [-0.05, -0.2, -0.05], upper = [0.05, -0.1, 0.05] }]\n");
    soil.step();
    CHECK(value(soil, "water", {5, 7, 5}) == 0);
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
}

TEST_CASE("mistakes in a soil are clear lines", "[environment][soil]") {
    const std::string place = "model = \"richards\"\ndomain = { lower = [0, -1, 0], upper = [1, 0, 0] }\nvoxel = 0.1\n";
    check_mistake(place + "soil = \"laom\"", "there is no soil 'laom' (did you mean 'loam'?)");
    check_mistake(place, "soil");
    check_mistake(place + "soil = { theta_r = 0.5, theta_s = 0.4, alpha = 0.04, n = 1.6, ks = 50 }",
                  "must be more than 'theta_r'");
    check_mistake(place + "soil = { theta_r = 0.1, theta_s = 0.4, alpha = 0.04, n = 0.9, ks = 50 }", "'n'");
    check_mistake(place + "soil = { theta_r = 0.1, theta_s = 0.4, alpha = 0.04, n = 1.6 }", "'ks'");
    check_mistake(
        place +
            "soil = \"loam\"\nlayers = [{ top = 0, bottom = -0.4, soil = \"sand\" }, { top = -0.3, soil = \"clay\" }]",
        "overlaps the one from -0.4 to 0 m");
    check_mistake(place + "soil = \"loam\"\nlayers = [{ top = -0.5, bottom = -0.4 }]",
                  "must be higher than its 'bottom'");
    check_mistake(place + "soil = \"loam\"\ninitial = { head = -100, table = -1 }", "give one of 'head'");
    check_mistake(place + "soil = \"loam\"\nboundaries = { top = { rain = -3 } }", "'rain'");
    check_mistake(place + "soil = \"loam\"\nboundaries = { bottom = \"drain\" }", "free-drainage");
    check_mistake(place + "soil = \"loam\"\nboundaries = { bottom = { heads = 3 } }", "give 'head'");
    check_mistake(
        place + "soil = \"loam\"\nsources = [{ shape = \"sphere\", center = [5, 5, 5], radius = 0.1, rate = 1 }]",
        "holds no voxel's centre");
    check_mistake(place + "soil = \"loam\"\nmap = { field = \"ground\", soils = [\"sand\"] }", "ground");
    check_mistake(
        "model = \"richards\"\ndomain = { lower = [0, -1, 0], upper = [1, 0, 1] }\nvoxel = 2e-5\nsoil = \"loam\"",
        "use larger voxels");
}

TEST_CASE("what solves few columns at once counts against the memory", "[environment][soil]") {
    const auto bytes_of_voxel = [](int columns) {
        Soil soil(
            fmt::format("model = \"richards\"\ndomain = {{ lower = [0, -1, 0], upper = [{}, 0, 0] }}\n"
                        "voxel = 0.02\nsoil = \"loam\"",
                        0.02 * columns));
        return static_cast<double>(soil.process->memory().held) / (50 * columns);
    };
    CHECK(bytes_of_voxel(12) - bytes_of_voxel(13) == 8 * 27);
    CHECK(bytes_of_voxel(2) - bytes_of_voxel(1) == 8 * 7);
}

TEST_CASE("a query is told the pressure head and its gradient", "[environment][soil]") {
    Soil soil(bed);
    const std::vector<double> answer = soil.ask({{{0.01, -0.15, 0.03}, std::vector<double>(13, 0.0)}})[0];
    CHECK(answer[9] == Approx(-35).margin(1e-3));  // 35 cm above the water table, at rest
    CHECK(answer[10] == Approx(0).margin(1e-4));
    CHECK(answer[11] == Approx(-1).margin(1e-4));  // cm per cm of height
    CHECK(answer[12] == Approx(0).margin(1e-4));
}

TEST_CASE("a table or a picture places soils", "[environment][soil]") {
    const TemporaryFolder folder;
    const std::string begin =
        "model = \"richards\"\ndomain = { lower = [0, -0.2, 0], upper = [0.3, 0, 0.2] }\nvoxel = 0.1\nsoil = "
        "\"loam\"\ninitial = { head = -1e-3 }\nmap = { soils = [\"sand\", \"clay\"], file = \"" +
        folder.path().string();
    const auto check_profile = [&](const std::string& rest) {
        const Soil soil(begin + rest);
        CHECK(value(soil, "water", {0, 1, 0}) == Approx(0.43).margin(1e-4));  // sand, at the left above
        CHECK(value(soil, "water", {2, 1, 1}) == Approx(0.38).margin(1e-4));  // clay
        CHECK(value(soil, "water", {1, 0, 1}) == Approx(0.43).margin(1e-4));
    };
    write_text(folder.path() / "map.csv", "# a profile\n0, 1, 1\n1, 0, 0\n");
    check_profile("/map.csv\" }");
    const Soil plan(begin + "/map.csv\", plane = \"xz\" }");
    CHECK(value(plan, "water", {0, 0, 1}) == Approx(0.43).margin(1e-4));  // the row of the greatest z
    CHECK(value(plan, "water", {0, 0, 0}) == Approx(0.38).margin(1e-4));

    const OpacityPicture::Pixel sand{200, 160, 96, 255}, clay{96, 64, 32, 255};
    write_text(folder.path() / "map.png", png_bytes({3, 2, {sand, clay, clay, clay, sand, sand}}));
    check_profile("/map.png\", colours = [\"#c8a060\", \"#604020\"] }");
    check_mistake(begin + "/map.png\" }", "a picture needs a colour for each of the 2 soils");
    check_mistake(begin + "/map.png\", colours = [\"#c8a060\", \"#604021\"] }",
                  "the pixel 2 of row 1 from above is #604020, which is none of 'colours'");
    check_mistake(begin + "/map.png\", colours = [\"#c8a060\", \"brown\"] }", "'brown' is no colour");

    write_text(folder.path() / "map.csv", "0,1,1\n1,2,0\n");
    check_mistake(begin + "/map.csv\" }", "map.csv:2:2: '2' is not a number from 0 to 1");
    write_text(folder.path() / "map.csv", "0,1,1\n1,0\n");
    check_mistake(begin + "/map.csv\" }", "map.csv:2: this row has 2 cells, and the first 3");
    check_mistake(begin + "/map.csv\", field = \"ground\" }", "a map needs one of 'file'");
}

TEST_CASE("a series with gaps, words, or days that do not rise names its line", "[environment][soil]") {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "espalier-gaps.csv";
    const auto check_series = [&](const std::string& lines, const std::string& message) {
        write_text(file, lines);
        check_mistake(
            fmt::format("model = \"richards\"\ndomain = {{ lower = [0, -1, 0], upper = [1, 0, 0] }}\nvoxel = "
                        "0.1\nsoil = \"loam\"\nboundaries = {{ top = {{ rain = {{ file = \"{}\", column = \"rain\" "
                        "}} }} }}",
                        file.string()),
            message);
    };
    check_series("day,rain\n0,1\n1,\n2,3\n",
                 "espalier-gaps.csv:3:2: there is no number here: the series 'rain' has no gaps");
    check_series("day,rain\n0,1\n1,wet\n", "espalier-gaps.csv:3:2: 'wet' is not a number");
    check_series("day,rain\n0,1\n1,2\n1,3\n", "espalier-gaps.csv:4: day 1 is not after day 1");
    check_series("date,rain\n2025-06-21,1\n21 June,2\n", "espalier-gaps.csv:3:1: '21 June' is no date");
    check_series("rain,time (week)\n1,0\n", "no column 'rain'");
    check_series("time (week),rain\n0,1\n", "espalier-gaps.csv:1:1: the column 'time' has the unit 'week'");
    check_series("day,rain\n0,nan\n", "'nan' is not a number");
    check_series(
        "day,rain\n0,1\n1,9999\n",
        "espalier-gaps.csv:3:2: '9999' stands for a value that was not measured (if it was, write 9999.01): the "
        "series 'rain'");
    check_series(
        "\xEF\xBB\xBF"
        "day;rain\n0;0,5\n1;wet\n",
        "espalier-gaps.csv:3:2: 'wet' is not a number");
    check_series("day,rain\n0,-4\n", "'rain' is -4");
    check_series("day,snow\n0,1\n", "no column 'rain'");
    check_series("day,rain\n", "no lines");
    check_series("", "no column 'rain'");
    std::filesystem::remove(file);
}

}  // namespace espalier::test

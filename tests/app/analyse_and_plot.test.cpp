// `espalier analyse` and `espalier plot`, on a tree whose answers are known.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <algorithm>

using Catch::Contains;
using Catch::StartsWith;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// Five generations of forks; areas are kept, as Leonardo has it, and each has two leaves at its tips.
const char* const perfect =
    "lsystem: 1\nderivation length: 6\naxiom: A(1)\n"
    "A(s) --> !(s)F(1)[+(40)A(s*sqrt(0.5))][-(40)A(s*sqrt(0.5))]\nendlsystem\n";

/// True where pictures can be drawn; says so where they cannot.
bool drew(const Outcome& outcome) {
    const bool none = outcome.err.find("no picture can be drawn") != std::string::npos;
    if (none) WARN("skipped: " << outcome.err);
    return !none;
}

}  // namespace

TEST_CASE_METHOD(Workplace, "analyse measures what a model grew, as tables and as JSON", "[app]") {
    write("perfect.l", perfect);
    REQUIRE(run("run perfect.l --output run --quiet").code == 0);
    const Outcome outcome = run("analyse run --no-picture");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("strahler") && Contains("step 6"));
    for (const char* file : {"analysis.csv", "orders.csv", "ramification.csv", "layers.csv", "internodes.csv"}) {
        CHECK(fs::exists(path() / "run/analysis" / file));
    }
    CHECK(!fs::exists(path() / "run/analysis/analysis.png"));
    REQUIRE(run("analyse run --step 2:6:2 --format json --output tables --no-picture").code == 0);
    const json result = json::parse(text_of(path() / "tables/analysis.json"));
    REQUIRE(result["frames"].size() == 3);
    const json& plant = result["frames"][2]["plants"][0];
    CHECK(plant["strahler"] == 6);
    CHECK(plant["tips"] == 32);
    CHECK(plant["forks"] == 31);
    CHECK(plant["branching_ratio"].get<double>() == Approx(2));
    CHECK(plant["diameter_ratio"].get<double>() == Approx(std::sqrt(2)));
    CHECK(plant["pipe_exponent"].get<double>() == Approx(2).epsilon(1e-6));
    CHECK(plant["area_error"].get<double>() < 1e-6);
    CHECK(plant["leaf_area_index"].is_null());
    CHECK(plant["ramification"].size() == 5);
    for (const json& row : plant["ramification"]) CHECK(row["parts"].back() == 1);
}

TEST_CASE_METHOD(Workplace, "analyse gives a field's profile over depth as a table and a chart", "[app]") {
    write("root.l", "environment water;\nlsystem: 1\nderivation length: 2\naxiom: ?water(0.1)\nendlsystem\n");
    write("soil.toml",
          "[[plant]]\nmodel = \"root.l\"\nposition = [0.05, -0.05, 0]\n[environment.water]\n"
          "process = \"soil-water\"\nvoxel = 0.1\ninitial = 0.25\n"
          "domain = { lower = [0, -0.3, 0], upper = [0.2, 0, 0] }\n[timeline]\nfields = [\"water\"]\n");
    REQUIRE(run("run soil.toml --output run --quiet").code == 0);
    const Outcome outcome = run("analyse run --field water --step last --output tables --no-picture");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("water-y.csv"));
    const std::string table = text_of(path() / "tables/water-y.csv");
    CHECK_THAT(table,
               Contains("step,y,mean,deviation,minimum,maximum\n2,-0.25,0.25,0,0.25,0.25\n2,-0.15,0.25,0,0.25,0.25\n"));
    CHECK(std::count(table.begin(), table.end(), '\n') == 4);
    CHECK_THAT(run("analyse run --field watr").err, Contains("did you mean 'water'"));
    CHECK(run("analyse run --field water --leaf L").code != 0);
    const Outcome drawn = run("analyse run --field water --profile x");
    CHECK(drawn.code == 0);
    if (drew(drawn)) CHECK(fs::file_size(path() / "run/analysis/water-x.png") > 1000);
}

TEST_CASE_METHOD(Workplace, "analyse and plot draw their charts", "[app]") {
    write("perfect.l", perfect);
    REQUIRE(run("run perfect.l --output run --quiet").code == 0);
    const Outcome analysed = run("analyse run --step 4:");
    CHECK(analysed.code == 0);
    if (!drew(analysed)) return;
    CHECK(fs::file_size(path() / "run/analysis/analysis.png") > 1000);
    CHECK(fs::file_size(path() / "run/analysis/layers.png") > 1000);
    const Outcome one_step = run("analyse run --step first --output first");
    CHECK(one_step.err.empty());
    CHECK(!fs::exists(path() / "first/analysis.png"));
    const Outcome plotted = run("plot run run --quantity height,modules --size 700x500 --dark --output charts.svg");
    INFO(plotted.err);
    CHECK(plotted.code == 0);
    CHECK(plotted.err.empty());
    CHECK_THAT(text_of(path() / "charts.svg"), Contains("width=\"700\" height=\"500\""));
    CHECK(run("plot run").code == 0);
    CHECK(fs::exists(path() / "run/plot.png"));
}

TEST_CASE_METHOD(Workplace, "without EGL and without a display it is said what to install, and the tables are whole",
                 "[app]") {
    write("perfect.l", perfect);
    REQUIRE(run("run perfect.l --output run --quiet").code == 0);
    const std::string blind =
        "unset DISPLAY; export EGL_PLATFORM=none LIBGL_DRIVERS_PATH=/nowhere "
        "__EGL_VENDOR_LIBRARY_DIRS=/nowhere;";
    const Outcome plotted = run("plot run", blind);
    CHECK(plotted.code == 2);
    CHECK_THAT(plotted.err, Contains("apt-get install") && Contains("xvfb-run"));
    CHECK(!fs::exists(path() / "run/plot.png"));
    const Outcome analysed = run("analyse run", blind);
    CHECK(analysed.code == 0);
    CHECK_THAT(analysed.err, Contains("no picture"));
    CHECK(fs::exists(path() / "run/analysis/analysis.csv"));
}

TEST_CASE_METHOD(Workplace, "mistakes of analyse and plot are named, with what was probably meant", "[app]") {
    write("perfect.l", perfect);
    REQUIRE(run("run perfect.l --output run --quiet").code == 0);
    const auto says = [&](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run(arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(words));
    };
    says("plot run --quantity heigth", "did you mean 'height'?");
    says("plot run --output plot.jpg", ".png or a .svg");
    says("plot run --size 12by9", "WIDTHxHEIGHT");
    says("plot run --size 1000000x5", "16384 pixels");
    says("plot nowhere", "nowhere");
    says("analyse run --step 99", "no frame of step 99");
    says("analyse run --step 7:9", "step 0 to 6");
    says("analyse run --step 1:2:0", "FROM:TO");
    says("analyse run --step soon", "FROM:TO");
    says("analyse run --plant perfekt", "did you mean 'perfect'?");
    says("analyse run --leaf Q", "no symbol 'Q'");
    says("analyse run --layer 1e-9 --no-picture", "100,000 layers");
    says("analyse run --voxel -1", "--voxel");
}

TEST_CASE_METHOD(Workplace, "tables and charts tell time, units and names", "[app]") {
    write("root.l",
          "environment water;\nlsystem: 1\nderivation length: 4\naxiom: ?water(0.001)A\n"
          "?water(w) < A --> f(0.01)F(0.1)?water(0.001)A\n?water(w) --> *\nendlsystem\n");
    write("soil.toml",
          "[simulation]\ndt = 0.5\ntime_unit = 'day'\n"
          "[[plant]]\nmodel = 'root.l'\nname = 'left, main'\nheading = [0, -1, 0]\n"
          "[environment.water]\nprocess = 'soil-water'\nvoxel = 0.1\namount = 'volume'\ninitial = 0.3\n"
          "domain = { lower = [-0.5, -1, -0.5], upper = [0.5, 0, 0.5] }\n"
          "[timeline]\nparameters = { obtained = '?water.1' }\n");
    const Outcome grown = run("run soil.toml --output run --quiet");
    INFO(grown.err);
    REQUIRE(grown.code == 0);
    const std::string statistics = text_of(path() / "run/statistics.csv");
    CHECK_THAT(statistics, StartsWith("step,time,plant,name,modules,") && Contains("\n3,1.5,0,\"left, main\","));
    const json record = json::parse(text_of(path() / "run/run.json"));
    CHECK(record["units"]["water.uptake"] == "m3");
    CHECK(record["units"]["water.minimum"] == "m3/m3");

    REQUIRE(run("export run --format csv --output table.csv").code == 0);
    const std::string table = text_of(path() / "table.csv");
    CHECK_THAT(table, StartsWith("step,time,plant,name,kind,") && Contains(",query,"));
    const std::size_t query = table.find(",query,");
    const std::string row = table.substr(query, table.find('\n', query) - query);
    CHECK(std::stod(row.substr(row.rfind(',') + 1)) > 0);

    REQUIRE(run("analyse run --no-picture --range -1:0").code == 0);
    CHECK_THAT(text_of(path() / "run/analysis/layers.csv"),
               StartsWith("step,time,plant,name,from,to,length,surface,leaf_area,density,ground_density,uptake\n") &&
                   Contains("\n4,2,0,\"left, main\",-1,"));
    CHECK(run("analyse run --no-picture --range 0:-1").code == 1);
    const Outcome plotted = run("plot run --quantity water.uptake --output uptake.svg");
    if (!drew(plotted)) return;
    CHECK(drew(run("analyse run --range -1:0")));
}

TEST_CASE_METHOD(Workplace, "a process whose name is misspelt on the command line is found", "[app]") {
    write("bush.l", models::bush);
    write("scene.toml", "[[plant]]\nmodel = 'bush.l'\n[environment.light]\nprocess = 'voxel-shade'\n");
    CHECK_THAT(run("check scene.toml --set environment.licht.voxel=1").err,
               Contains("[environment.licht] does not say which process it is") && Contains("did you mean 'light'?"));
}

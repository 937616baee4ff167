// `espalier analyse` and `espalier plot`, on a tree whose answers are known.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
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

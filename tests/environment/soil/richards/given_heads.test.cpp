// Heads that a scene gives: at the sides, at first, and everywhere in soil that stands still.
#include "catch.h"
#include "environment/soil/linear/soil.h"
#include "environment/soil/richards/column.h"
#include "temporary_folder.h"

#include <cmath>
#include <fstream>

using Catch::Contains;

namespace espalier::test {
namespace {

const std::string gardner_across = "{ model = \"gardner\", theta_r = 0.06, theta_s = 0.4, alpha = 0.05, ks = 30 }";

/// Across, 10 voxels of 2 cm in one row: gravity has no part.
std::string row_of(const std::string& rest) {
    return "domain = { lower = [0, -0.02, 0], upper = [0.2, 0, 0] }\nvoxel = 0.02\nsoil = " + gardner_across + "\n" +
           rest;
}

}  // namespace

TEST_CASE("between two heads at the sides, steady flow is the difference of the flux potentials", "[soil]") {
    SoilBlock soil(
        row_of("initial = { head = -60 }\n[boundaries]\nleft = { head = -20 }\nright = { head = \"-100 cm\" }\n"));
    soil.advance(300);
    const auto potential = [](double head) { return 30 * std::exp(0.05 * head) / 0.05; };
    const double flux = (potential(-20) - potential(-100)) / 20;
    for (int x = 0; x < 10; ++x) {
        CHECK(soil.soil.flux(soil.grid.cell({x, 0, 0}), 0) == Approx(flux).epsilon(1e-4));
        const double exact = potential(-20) - flux * (2 * x + 1);
        CHECK(soil.head(0, x) == Approx(std::log(0.05 * exact / 30) / 0.05).epsilon(1e-4));
    }
    CHECK(std::abs(soil.soil.balance().relative_error()) < 1e-9);
}

TEST_CASE("ditches of one level beside a soil bring it to rest at that level", "[soil]") {
    SoilBlock soil(
        "domain = { lower = [-0.3, -0.6, 0], upper = [0.3, 0, 0] }\nvoxel = 0.1\nsoil = \"sandy loam\"\n"
        "initial = { head = -150 }\n[boundaries]\nleft = { table = -0.3 }\nright = { table = -0.3 }\n");
    soil.advance(400);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            CHECK(soil.head(y, x) == Approx(-30 - 100 * (-0.55 + 0.1 * y)).margin(0.05));
        }
    }
    CHECK(soil.flown().sides > 0);
    CHECK(std::abs(soil.soil.balance().relative_error()) < 1e-9);
}

TEST_CASE("the four sides are alike: a cube that fills from one of them", "[soil]") {
    const auto filled = [](const std::string& side) {
        SoilBlock soil(
            "domain = { lower = [0, -0.06, 0], upper = [0.06, 0, 0.06] }\nvoxel = 0.02\nsoil = \"loam\"\n"
            "initial = { head = -300 }\n[boundaries]\n" +
            side + " = { head = -10 }\n");
        soil.advance(0.05);
        return soil.flown().sides;
    };
    const double left = filled("left");
    CHECK(left > 0);
    for (const char* const side : {"right", "back", "front"}) CHECK(filled(side) == Approx(left).epsilon(1e-6));
}

TEST_CASE("mistakes about sides are clear lines", "[soil]") {
    const auto mistake = [](const std::string& rest) {
        return user_error([&] { SoilBlock soil(row_of("[boundaries]\n" + rest)); });
    };
    CHECK_THAT(mistake("left = { head = -5 }\nsides = \"periodic\"\n"), Contains("where sides are periodic"));
    CHECK_THAT(mistake("back = { head = -5 }\n"), Contains("no side 'back'"));
    CHECK_THAT(mistake("left = { head = -5, table = 1 }\n"), Contains("one of 'head' (cm) and 'table'"));
}

TEST_CASE("a soil begins with no more than it holds, and no less", "[soil]") {
    const auto mistake = [](const std::string& rest) {
        return user_error([&] { SoilBlock soil(column_of(0.4, 0.1, "soil = \"loam\"\n" + rest)); });
    };
    CHECK_THAT(mistake("initial = { content = 0.45 }\n"),
               Contains("loam, cannot hold a content of 0.45") && Contains("0.43 when full"));
    CHECK_THAT(mistake("initial = { content = 0.05 }\n"), Contains("cannot hold a content of 0.05"));
    CHECK_THAT(mistake("initial = { content = 0.4 }\nlayers = [{ top = -0.2, soil = \"clay\" }]\n"),
               Contains("clay, cannot hold a content of 0.4"));
    CHECK_THAT(mistake("initial = { heights = [-0.4, 0], contents = [0.3, 0.6] }\n"), Contains("cannot hold"));
    CHECK(mistake("initial = { content = 0.43 }\n").empty());
}

TEST_CASE("a profile of heads or contents is linear between its heights, and constant beyond", "[soil]") {
    const SoilBlock heads(column_of(
        0.4, 0.1, "soil = \"loam\"\ninitial = { heights = [-0.1, -0.3], heads = [\"-100 cm\", \"-0.05 MPa\"] }\n"));
    const double deep = -0.05e6 / 98.0665;
    CHECK(heads.head(3) == Approx(-100));                        // at -0.05 m
    CHECK(heads.head(2) == Approx(-100 + 0.25 * (deep + 100)));  // at -0.15 m
    CHECK(heads.head(0) == Approx(deep));                        // at -0.35 m
    const SoilBlock contents(
        column_of(0.4, 0.1, "soil = \"loam\"\ninitial = { heights = [-0.35, -0.05], contents = [0.3, 0.15] }\n"));
    CHECK(contents.content(0) == Approx(0.3));
    CHECK(contents.content(2) == Approx(0.2));
    CHECK_THAT(
        user_error([] {
            SoilBlock soil(column_of(0.4, 0.1, "soil = \"loam\"\ninitial = { heights = [0, -1], heads = [-5] }\n"));
        }),
        Contains("as many 'heights' as values: 2 and 1"));
}

TEST_CASE("soil that stands still has the measured heads of the day", "[soil]") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "tensiometers.csv") << "day,shallow,deep\n0,-100,-50\n2,-400,-150\n4,-50,-50\n";
    Soil soil(column_of(0.4, 0.1,
                        "model = \"still\"\nsoil = \"loam\"\n"
                        "measured = { file = \"" +
                            (folder.path() / "tensiometers.csv").string() +
                            "\", heights = [-0.05, -0.35], columns = [\"shallow\", \"deep\"], unit = \"hPa\" }\n"));
    const auto head = [&](double y) { return soil.ask({{{0.05, y, 0.05}, {0, 0, 0, 0.01, 0, 0, 0, 0, 0, 0}}})[0][9]; };
    const double hpa = 100 / 98.0665;
    CHECK(head(-0.05) == Approx(-100 * hpa));
    CHECK(head(-0.15) == Approx(-(100 - 50.0 / 3) * hpa));
    soil.advance(3);
    CHECK(head(-0.05) == Approx(-400 * hpa));
    CHECK(head(-0.35) == Approx(-150 * hpa));
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
    CHECK(soil.obtain({{0.05, -0.05, 0.05}, {0.01}}) == Approx(0.01));
    CHECK(head(-0.05) == Approx(-400 * hpa));  // what was taken is put back
}

TEST_CASE("what soil that stands still has no use for is a mistake", "[soil]") {
    const auto mistake = [](const std::string& rest) {
        return user_error([&] { Soil soil(column_of(0.4, 0.1, "model = \"still\"\nsoil = \"loam\"\n" + rest)); });
    };
    CHECK_THAT(mistake("depletion = true\n"), Contains("knows no depletion"));
    CHECK_THAT(mistake("accuracy = 0.1\n"), Contains("accuracy"));
    CHECK_THAT(mistake("boundaries = { top = { rain = 3 } }\n"), Contains("top"));
}

TEST_CASE("a soil that is described and lies nowhere is named once", "[soil]") {
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.warnings = &warnings;
    const Soil soil(
        column_of(0.4, 0.1,
                  "model = \"richards\"\nsoil = \"mine\"\n[soils]\nmine = " + test_loam + "\nother = { sand = 40 }\n"),
        context);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].message, Contains("nothing of 'water' is of the soil 'other'"));
}

}  // namespace espalier::test

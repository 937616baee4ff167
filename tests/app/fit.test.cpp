// fit: parameters come back from marks with the precision of a pixel.
#include "catch.h"
#include "program.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;

namespace {

const char* const herb =
    "#define ANGLE 60\n#define RATIO 0.7 /* of successive internodes; 0.1..1.5 */\n#define SIDE 0.9\n#define FIRST "
    "0.2\n"
    "lsystem: 1\nderivation length: 6\naxiom: A(FIRST)\n"
    "A(l) --> F(l) [+(ANGLE) F(l * SIDE)] [-(ANGLE) F(l * SIDE)] A(l * RATIO)\nendlsystem\n";

/// The same plant as lines on a picture of 1,000 pixels a metre, with nodes at whole pixels.
std::string picture(double angle, double ratio, double side, double first, bool has_scale) {
    std::string main, branches;
    const auto node = [](double x, double y) { return fmt::format("{:.0f},{:.0f} ", 500 + 1000 * x, 900 - 1000 * y); };
    double height = 0, length = first;
    main += node(0, 0);
    for (int i = 0; i < 6; ++i, length *= ratio) {
        height += length;
        main += node(0, height);
        for (const double turn : {-angle, angle}) {
            const double a = turn * std::numbers::pi / 180;
            branches += "<polyline points=\"" + node(0, height) +
                        node(length * side * std::sin(a), height + length * side * std::cos(a)) + "\"/>";
        }
    }
    const std::string scale = has_scale ? "<line data-length=\"0.3\" x1=\"10\" y1=\"10\" x2=\"310\" y2=\"10\"/>" : "";
    return "<svg xmlns=\"http://www.w3.org/2000/svg\">" + scale + "<polyline points=\"" + main + "\"/>" + branches +
           "</svg>\n";
}

}  // namespace

TEST_CASE("fit recovers the parameters of a plant from its picture", "[app]") {
    const Workplace place;
    place.write("herb.l", herb);
    place.write("herb.svg", picture(38, 0.85, 0.6, 0.14, true));
    const Outcome outcome = place.run(
        "fit herb.l herb.svg --parameter ANGLE --parameter RATIO --parameter SIDE --parameter FIRST --overlay over.svg "
        "--json");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const json found = json::parse(outcome.out)["parameters"];
    CHECK(found["ANGLE"]["value"] == Approx(38).epsilon(0.02));
    CHECK(found["RATIO"]["value"] == Approx(0.85).epsilon(0.02));
    CHECK(found["SIDE"]["value"] == Approx(0.6).epsilon(0.02));
    CHECK(found["FIRST"]["value"] == Approx(0.14).epsilon(0.02));
    CHECK(found["ANGLE"]["error"] < 1.0);
    CHECK_THAT(text_of(place.path() / "over.svg"), Contains("#d43b3b") && Contains("#3b6fd4"));
}

TEST_CASE("fit without a scale finds ratios and angles, and says what the marks do not decide", "[app]") {
    const Workplace place;
    place.write("herb.l", herb);
    place.write("herb.svg", picture(38, 0.85, 0.6, 0.14, false));
    const Outcome ratio =
        place.run("fit herb.l herb.svg --parameter RATIO=0.9 --parameter ANGLE=30 --parameter SIDE --json");
    INFO(ratio.err);
    REQUIRE(ratio.code == 0);
    CHECK(json::parse(ratio.out)["parameters"]["RATIO"]["value"] == Approx(0.85).epsilon(0.02));
    const Outcome size = place.run("fit herb.l herb.svg --parameter FIRST --parameter RATIO");
    CHECK_THAT(size.out,
               Contains("what was measured does not decide it") && Contains("espalier run herb.l --define FIRST="));
    CHECK(place.run("fit herb.l herb.svg").code == 0);  // RATIO, the only setting
}

TEST_CASE("fit explains what it cannot do", "[app]") {
    const Workplace place;
    place.write("herb.l", herb);
    place.write("herb.svg", picture(38, 0.85, 0.6, 0.14, true));
    CHECK_THAT(place.run("fit herb.l herb.svg --parameter ANGEL").err, Contains("--parameter ANGEL"));
    place.write("herb.txt", "a herb\n");
    CHECK_THAT(place.run("fit herb.l herb.txt").err, Contains("is nothing that plants are compared with"));
    CHECK_THAT(place.run("fit herb.l none.svg").err, Contains("none.svg"));
    place.write("bare.l", "lsystem: 1\nderivation length: 1\naxiom: F(1)\nendlsystem\n");
    CHECK_THAT(place.run("fit bare.l herb.svg").err, Contains("has no settings"));
}

TEST_CASE("fit by simulation tells ranges, goes on where it stopped, and is divided among processes", "[app]") {
    const Workplace place;
    place.write("herb.l", herb);
    place.write("herb.csv", "height,length,axis_angle.1\n0.55,1.54,41\n0.6,1.68,40\n");
    const std::string fit = "fit herb.l herb.csv --parameter ANGLE=10:80 --parameter RATIO=0.3:1.2 --simulations 600";
    const Outcome commands = place.run(fit + " --output parts --list 2");
    REQUIRE(commands.code == 0);
    CHECK_THAT(commands.out, Contains("--part 1/2 --method abc") && Contains("--part 2/2 --method abc"));
    REQUIRE(place.run(fit + " --method abc --output parts --part 2/2").code == 0);
    CHECK_FALSE(std::filesystem::exists(place.path() / "parts/posterior.csv"));
    const Outcome rest = place.run(fit + " --method abc --output parts --json");
    INFO(rest.err);
    REQUIRE(rest.code == 0);
    const json found = json::parse(rest.out);
    CHECK(found["parameters"]["ANGLE"]["value"] == Approx(40.5).margin(2));
    CHECK_THAT(found["command"].get<std::string>(), Contains("espalier run herb.l --define ANGLE="));
    REQUIRE(place.run(fit + " --method abc --output whole").code == 0);
    CHECK(text_of(place.path() / "whole/posterior.csv") == text_of(place.path() / "parts/posterior.csv"));
    CHECK(text_of(place.path() / "whole/fit.png").substr(1, 3) == "PNG");
    const Outcome other =
        place.run("fit herb.l herb.csv --parameter ANGLE=10:80 --method abc --simulations 600 --output whole");
    CHECK(other.code == 1);
    CHECK_THAT(other.err, Contains("holds the simulations of another fit"));
    CHECK_THAT(place.run("fit herb.l herb.csv --parameter SIDE --method abc").err, Contains("SIDE=LOW:HIGH"));
}

TEST_CASE("a scene says what is fitted to what", "[app]") {
    const Workplace place;
    place.write("herb.l", herb);
    place.write("course.csv", "step,length\n2,0.9\n4,1.3\n");
    place.write("herb.toml",
                "[[plant]]\nmodel = \"herb.l\"\n[fit]\ntargets = [\"course.csv\"]\n[fit.parameters]\n"
                "\"plant.0.define.RATIO\" = \"0.3:1.2\"\n");
    const Outcome outcome = place.run("fit herb.toml --json");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(json::parse(outcome.out)["parameters"]["plant.0.define.RATIO"]["value"] > 0.3);
    CHECK(place.run("run herb.toml --output out").code == 0);
}

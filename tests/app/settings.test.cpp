// The settings of models on the command line: `espalier list models NAME`, --define.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

using Catch::Contains;
using nlohmann::json;

namespace {

/// A place with a library of two models, one of them with settings.
struct Library : Workplace {
    Library() {
        std::filesystem::create_directories(path() / "models");
        write("models/bush.l", models::bush);
        write("models/twig.l",
              "/* A twig */\n/* --- Shape --- */\n#define LENGTH 2.5 /* of an internode; 0.1..; m */\n"
              "#define AGE 3 /* years; 1..9 whole */\n#define ANGLE 25\nlsystem: 1\nderivation length: AGE\naxiom: A\n"
              "A --> F(LENGTH)+(ANGLE)A\nendlsystem\n");
    }
};

}  // namespace

TEST_CASE_METHOD(Library, "list prints the settings of a model with their default, range, unit and meaning", "[app]") {
    const std::string listed = run("list models twig").out;
    CHECK_THAT(listed, Contains("  Shape\n"));
    CHECK_THAT(listed, Contains("    LENGTH   2.5      0.1..       m     of an internode\n"));
    CHECK_THAT(listed, Contains("    AGE      3        1..9 whole        years\n"));
    CHECK_THAT(listed, !Contains("ANGLE"));
    CHECK_THAT(run("list models bush").out, !Contains("default"));
}

TEST_CASE_METHOD(Library, "list --json has the settings of every model", "[app]") {
    const json listed = json::parse(run("list models --json").out);
    REQUIRE(listed.size() == 2);
    CHECK(listed[0]["settings"].empty());
    REQUIRE(listed[1]["settings"].size() == 2);
    const json& length = listed[1]["settings"][0];
    CHECK(length["name"] == "LENGTH");
    CHECK(length["default"] == 2.5);
    CHECK(length["lowest"] == 0.1);
    CHECK(length["highest"].is_null());
    CHECK(length["unit"] == "m");
    CHECK(length["group"] == "Shape");
    CHECK(length["summary"] == "of an internode");
    CHECK(listed[1]["settings"][1]["whole"] == true);
}

TEST_CASE_METHOD(Library, "--define refuses what a setting may not be, naming its range and unit", "[app]") {
    CHECK(run("derive models/twig.l --define LENGTH=0.1").code == 0);
    for (const char* define : {"LENGTH=0", "LENGTH=long", "LENGTH=-1"}) {
        const Outcome outcome = run(std::string("derive models/twig.l --define ") + define);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("the setting 'LENGTH' (of an internode) must be a number of at least 0.1 m"));
    }
    CHECK_THAT(run("run models/twig.l --define AGE=2.5").err, Contains("a whole number between 1 and 9, not 2.5"));
    CHECK(run("derive models/twig.l --define ANGLE=LENGTH").code == 0);
}

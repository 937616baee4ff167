#include "environment/light/sky/scene_sky.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

using namespace espalier;
using namespace espalier::environment;
using Json = nlohmann::ordered_json;
using Catch::Contains;

namespace {

SceneSky sky_of(const char* process, double dt = 1, const std::filesystem::path& folder = {}) {
    const auto sky = sky_of_processes({{"light", Json::parse(process)}}, dt, folder);
    REQUIRE(sky);
    return *sky;
}

}  // namespace

TEST_CASE("of several given suns the one that brings most light to level ground is shown", "[sky]") {
    const SceneSky sky =
        sky_of(R"({"sky": {"par": 1000, "diffuse": 0.25, "suns": [[1, 1, 0], [0, 1, 1]], "sun_shares": [1, 3]}})");
    const StepSky step = sky.at_step(3);
    REQUIRE(step.sun);
    CHECK(glm::length(*step.sun - glm::normalize(glm::dvec3(0, 1, 1))) < 1e-12);
    CHECK(step.diffuse == Approx(0.25));
    CHECK(step.par == Approx(1000));
}

TEST_CASE("a sky that is covered has no sun, and at night it has no light", "[sky]") {
    const StepSky overcast = sky_of(R"({"sky": {"par": 400}})").at_step(0);
    CHECK(!overcast.sun);
    CHECK(overcast.diffuse == 1);
    CHECK(overcast.par == Approx(400));
    // North of the polar circle in winter.
    const StepSky winter = sky_of(R"({"sky": {"latitude": 80, "day": 355}})").at_step(0);
    CHECK(!winter.sun);
    CHECK(winter.par == 0);
}

TEST_CASE("a step is as many days long as the process says", "[sky]") {
    // A step of a week, of which the middle day stands for all: the fourth has day 100 + 3 weeks + 3.
    const SceneSky weeks = sky_of(R"({"sky": {"latitude": 50, "day": 100, "hours": [12]}, "days": 3.5})", 2);
    const SceneSky day = sky_of(R"({"sky": {"latitude": 50, "day": 124, "hours": [12]}})");
    REQUIRE(weeks.at_step(4).sun);
    CHECK(glm::length(*weeks.at_step(4).sun - *day.at_step(0).sun) < 1e-12);
}

TEST_CASE("the kind of a sky is that of its radiance", "[sky]") {
    using Kind = SceneSky::Kind;
    CHECK(sky_of(R"({"sky": {"par": 1}})").kind() == Kind::overcast);
    CHECK(sky_of(R"({"sky": {"par": 1, "radiance": "uniform"}})").kind() == Kind::uniform);
    CHECK(sky_of(R"({"sky": {"par": 1, "radiance": "cie-6"}})").kind() == Kind::overcast);
    CHECK(sky_of(R"({"sky": {"par": 1, "radiance": "cie-7"}})").kind() == Kind::clear);
    CHECK(sky_of(R"({"sky": {"par": 1, "radiance": "cie-12"}})").kind() == Kind::clear);
}

TEST_CASE("a measured sky is read beside the scene; without its file, or beyond its end, there is a message", "[sky]") {
    const TemporaryFolder folder;
    const char* const process = R"({"sky": {"series": "light.csv", "latitude": 50, "day": 172}, "days": 0.04})";
    CHECK_THROWS_WITH(sky_of(process, 1, folder.path()), Contains("the sky of 'light' cannot be drawn"));
    write_text(folder.path() / "light.csv", "time (h),par (umol m-2 s-1)\n10,800\n11,1000\n12,1000\n");
    const SceneSky sky = sky_of(process, 1, folder.path());
    CHECK(sky.at_step(12).par == Approx(1000 - 200 * 0.44 / 2 * (0.44 / 0.96)).epsilon(1e-3));
    CHECK_THROWS_AS(sky.at_step(40), RunError);
}

TEST_CASE("processes without a table sky have none", "[sky]") {
    CHECK(!sky_of_processes(Json::parse(R"({"light": {"voxel": 0.1}, "vines": {"sky": 3}})"), 1, {}));
    CHECK(!sky_of_run({}));
}

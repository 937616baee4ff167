// What pages are told of the sun and the sky of a scene, step by step.
#include "environment/light/sky/scene_sky.h"
#include "environment/light/sun/sun.h"
#include "session_fixture.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>

using namespace studio_test;
using espalier::environment::sun_position;
using espalier::environment::towards_sun;

namespace {

const char* const sprout = "lsystem: 1\nderivation length: 24\naxiom: !(0.01) A\nA --> F(0.1) A\nendlsystem\n";

/// 800 W/m2 at noon, falling evenly to 0 at six and at eighteen hours.
std::string series() {
    std::string rows = "time (h),global (W m-2),diffuse (W m-2)\n";
    for (int hour = 0; hour <= 25; ++hour) {
        const double light = std::max(0.0, 800 - 800 / 6.0 * std::abs(hour - 12));
        rows += fmt::format("{},{},{}\n", hour, light, light / 4);
    }
    return rows;
}

/// A studio with a sprout in a scene whose steps are hours of a measured day.
struct OpenDay : OpenStudio {
    explicit OpenDay(const std::string& process = "canopy-light") : OpenStudio(sprout) {
        folder.write("day.csv", series());
        options.opened.path = folder.write(
            "scene.toml", fmt::format("[simulation]\nsteps = 23\ndt = 0.041666666666666664\n[[plant]]\nmodel = "
                                      "\"plant.l\"\n[environment.light]\nprocess = \"{}\"\nsky = {{ series = "
                                      "\"day.csv\", latitude = 40, day = 100 }}\n[timeline]\n",
                                      process));
    }

    /// What the page is told with the packet of a step.
    Json sky_of(int step) {
        page.packets.clear();
        page.texts.clear();
        ask({{"do", "look"}, {"step", step}});
        wait([&] { return !page.packets.empty(); });
        const Json told = page.last("sky");
        REQUIRE(!told.is_null());
        CHECK(told["growth"] == number_at<std::uint32_t>(page.packets.back(), 4));
        CHECK(told["step"] == step);
        return told["sky"];
    }
};

glm::dvec3 sun_at(double hour) {
    return towards_sun(sun_position({40, 0, 0}, {2025, 100, hour}), {0, 0, -1});
}

void check_day(OpenDay& studio) {
    // The sun is looked at in each half of the hour; the half nearer to noon has more light.
    // Step 7 ends at seven hours.
    for (const auto& [step, hour] : {std::pair{7, 6.75}, {10, 9.75}, {12, 11.75}, {13, 12.25}, {16, 15.25}}) {
        INFO("step " << step);
        const Json sky = studio.sky_of(step);
        const auto told = sky["sun"].get<std::array<double, 3>>();
        CHECK(glm::length(glm::dvec3(told[0], told[1], told[2]) - sun_at(hour)) < 1e-6);
        CHECK(sky["diffuse"].get<double>() == Approx(0.25).epsilon(1e-6));
        // The mean of the hour, of which half is PAR.
        const double light = 800 - 800 / 6.0 * std::abs(step - 0.5 - 12);
        CHECK(sky["par"].get<double>() == Approx(0.5 * 4.57 * light).epsilon(1e-6));
    }
    CHECK(studio.sky_of(2)["sun"].is_null());
    CHECK(studio.sky_of(2)["par"] == 0);
}

}  // namespace

TEST_CASE("a page is told where the sun of the scene stands in each step, as environment/sky has it", "[studio][sky]") {
    OpenDay studio;
    studio.begin();
    studio.wait_until_grown();
    check_day(studio);
    OpenDay rays("ray-light");
    rays.begin();
    rays.wait_until_grown();
    CHECK(rays.sky_of(9) == studio.sky_of(9));
}

TEST_CASE("the sun is white above and red near the horizon", "[studio][sky]") {
    OpenDay studio;
    studio.begin();
    studio.wait_until_grown();
    const auto low = studio.sky_of(7)["colour"].get<std::array<double, 3>>();
    const auto high = studio.sky_of(12)["colour"].get<std::array<double, 3>>();
    CHECK(high[0] == 1);
    CHECK(high[2] > 0.7);
    CHECK(low[0] == 1);
    CHECK(low[1] > low[2]);
    CHECK(low[2] < 0.5);
}

TEST_CASE("the sun of a recorded run stands where it stood while the run grew", "[studio][sky]") {
    OpenDay studio;
    record(studio.options.opened.path, 23, studio.folder.path() / "run");
    studio.options.opened.path = studio.folder.path() / "run";
    studio.begin();
    studio.wait_until_grown();
    check_day(studio);
}

TEST_CASE("the sun of a recorded run stays where it was when its measured light has changed or gone", "[studio][sky]") {
    const bool goes = GENERATE(true, false);
    OpenDay studio;
    record(studio.options.opened.path, 23, studio.folder.path() / "run");
    studio.folder.write("day.csv", "time (h),global (W m-2)\n0,1\n24,1\n");
    if (goes) std::filesystem::remove(studio.folder.path() / "day.csv");
    studio.options.opened.path = studio.folder.path() / "run";
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("message").is_null());
    check_day(studio);
}

TEST_CASE("of a scene without a sky a page is told nothing of one", "[studio][sky]") {
    OpenStudio studio(sprout);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("sky").is_null());
}

TEST_CASE("a run.json that is cut, nested or mixed up has no sky, or says that it is not what a run writes",
          "[studio][sky]") {
    const TemporaryFolder run;
    const auto sky = [&](const std::string& record) {
        run.write("run.json", record);
        return espalier::environment::sky_of_run(run.path());
    };
    CHECK_FALSE(sky("{"));
    CHECK_FALSE(sky("[1]"));
    CHECK_FALSE(sky(R"({"exit": "done"})"));
    CHECK_FALSE(sky(R"({"command": 3, "scene": [], "processes": {"light": {"sky": {}}}})"));
    CHECK_FALSE(sky(std::string(65, '[') + std::string(65, ']')));
    CHECK_THROWS_AS(sky(R"({"processes": {"light": {"sky": {"radiance": 7}}}})"), espalier::UserError);
}

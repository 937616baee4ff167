// What takes the weather by its name does what it does with the same numbers of its own.
#include "espalier/base/file.h"

#include "catch.h"
#include "environment/light/lit_leaves.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <cmath>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

/// Two days of light, hour by hour, in the air of one temperature.
std::string hours_of_light() {
    std::string text = "time (h),global (W m-2),temperature (degC)\n";
    for (int hour = 0; hour <= 48; ++hour) {
        const double height = std::sin((hour % 24 - 6) / 12.0 * std::numbers::pi);
        text += fmt::format("{},{},21\n", hour, height > 0 ? 820 * height : 0);
    }
    return text;
}

struct Scene {
    TemporaryFolder folder;
    std::vector<Diagnostic> warnings;

    explicit Scene() { write_text(folder.path() / "hours.csv", hours_of_light()); }

    Environment of(const std::string& tables) {
        EnvironmentContext context;
        context.domain = Box{{0, -0.4, 0}, {2, 3, 2}};
        context.plants = 1;
        context.warnings = &warnings;
        const Settings file = Settings::parse_toml(tables, "scene.toml", folder.path());
        std::vector<std::pair<std::string, Settings>> processes;
        for (const std::string& name : file.keys()) processes.emplace_back(name, file.table(name));
        Environment environment(processes, context);
        file.reject_unread();
        return environment;
    }
};

AskingPlants leaf() {
    AskingPlants plants;
    plants.add({{{0.2, 1, 0.1}, {0, 0, 0}}, {{0, 0, 0}, {0}}});
    draw_square(plants.interpretation(0).geometry, 1, {0.2, 1, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.05);
    return plants;
}

const std::string air = "[air]\nprocess = \"weather\"\nfile = \"hours.csv\"\nlatitude = 44\nday = 160\nrain = 6\n";
const std::string series = "sky = { series = \"hours.csv\", latitude = 44, day = 160 }\n";
const std::string by_name = "sky = { weather = \"air\" }\n";

double statistic_of(const Environment& environment, const std::string& name) {
    return environment.statistic(name, 0);
}

}  // namespace

TEST_CASE("a sky by the weather's name is that of its file", "[weather]") {
    const std::string canopy = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\n" + black;
    const std::string rays = "[light]\nprocess = \"ray-light\"\npaths = 4096\n" + black;
    for (const std::string& light : {canopy, rays}) {
        Scene scene;
        Environment own = scene.of(light + series), named = scene.of(air + light + by_name);
        AskingPlants plants = leaf(), others = leaf();
        plants.exchange(own, 1);
        others.exchange(named, 1);
        CHECK(own.organ_values("light.flux", 0)->at(1) > 0);
        CHECK(named.organ_values("light.flux", 0)->at(1) == own.organ_values("light.flux", 0)->at(1));
    }
}

TEST_CASE("leaves in the weather's air do what they do in the same air of their own", "[weather]") {
    Scene scene;
    const std::string light = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\n" + black + by_name;
    const std::string leaves = "[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\n";
    Environment own = scene.of(air + light + leaves + "temperature = 21\nhumidity = 0.6\nwind = 1\nco2 = 400\n");
    Environment named = scene.of(air + light + leaves + "air = \"air\"\n");
    Environment warmer = scene.of(air + light + leaves + "air = \"air\"\ntemperature = 30\n");
    AskingPlants plants = leaf(), others = leaf(), third = leaf();
    plants.exchange(own, 1);
    others.exchange(named, 1);
    third.exchange(warmer, 1);
    CHECK(statistic_of(named, "leaves.gain") == Approx(statistic_of(own, "leaves.gain")).epsilon(1e-12));
    CHECK(statistic_of(named, "leaves.transpiration") > 0);
    CHECK(statistic_of(warmer, "leaves.transpiration") > statistic_of(named, "leaves.transpiration"));
}

TEST_CASE("the weather's rain falls on the soil, and its lawn says what may evaporate", "[weather]") {
    Scene scene;
    const std::string soil =
        "[water]\nprocess = \"soil-water\"\nmodel = \"richards\"\nvoxel = 0.1\nsoil = \"loam\"\n"
        "domain = { lower = [0, -0.4, 0], upper = [0.2, 0, 0.2] }\ninitial = { head = -30 }\n"
        "boundaries.bottom = \"free-drainage\"\nboundaries.top = { weather = \"air\" }\n";
    Environment named = scene.of(air + soil);
    AskingPlants plants;
    plants.add({});
    plants.exchange(named, 1);
    CHECK(statistic_of(named, "water.rain") == Approx(6));
    CHECK(statistic_of(named, "water.evaporation") == Approx(statistic_of(named, "air.evaporation")).epsilon(1e-3));
    CHECK(std::abs(statistic_of(named, "water.balance")) < 1e-12);
    const auto is_of_rain = [](const Diagnostic& one) {
        return one.message.find("knows no rain") != std::string::npos;
    };
    CHECK(std::none_of(scene.warnings.begin(), scene.warnings.end(), is_of_rain));
    scene.of("[air]\nprocess = \"weather\"\nfile = \"hours.csv\"\n" + soil);
    CHECK(std::count_if(scene.warnings.begin(), scene.warnings.end(), is_of_rain) == 1);
}

TEST_CASE("a weather that is not there is told, with what to write above", "[weather]") {
    Scene scene;
    CHECK_THROWS_WITH(scene.of("[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\n" + black + by_name + air),
                      Contains("no weather called 'air' before this"));
    const std::string beside = "boundaries.top = { weather = \"air\", flux = 1 }\n";
    CHECK_THROWS_WITH(scene.of(air +
                               "[water]\nprocess = \"soil-water\"\nmodel = \"richards\"\nvoxel = 0.1\n"
                               "soil = \"loam\"\n" +
                               beside),
                      Contains("'weather' means nothing here"));
}

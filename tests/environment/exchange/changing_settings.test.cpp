// Settings of processes that change between steps.
#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

using namespace espalier;
using namespace espalier::environment;

namespace {

std::string table(const std::string& process, const std::string& lines) {
    return "[light]\nprocess = \"" + process + "\"\n" + lines;
}

/// What a bud, a tip and two others near one another are answered.
std::vector<double> answers(Environment& environment) {
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {1, 0.3, 0.2, 0.1, 0.4}},
                {{0.1, 0.4, 0}, {0.5, 0, 0, 0, 0.3}},
                {{-0.2, 0.7, 0.1}, {1, 0.2, 0, 0, 0.6}},
                {{0, 1.1, 0.2}, {0.7, 0, 0.1, 0, 0.2}}});
    plants.exchange(environment);
    return plants.parameters();
}

std::vector<double> answers_with(const std::string& process, const std::string& lines) {
    Environment environment = environment_of(table(process, lines));
    return answers(environment);
}

}  // namespace

TEST_CASE("a setting that was changed acts as if the scene had said so", "[environment]") {
    const auto [process, lines] = GENERATE(std::pair{"cohen", "fork_distance = 0.1\nfork_rise = 0.5\n"},
                                           std::pair{"chiba", "radius = 0.4\n"}, std::pair{"takenaka", ""},
                                           std::pair{"voxel-shade", "voxel = 0.25\n"}, std::pair{"borchert-honda", ""});
    Environment settings = environment_of(table(process, lines));
    REQUIRE_FALSE(settings.changing_settings(0).empty());
    for (const ChangingSetting& each : settings.changing_settings(0)) {
        const double value = std::min(each.range.highest, std::max(each.range.lowest, 0.0) + 0.35);
        INFO(process << ": " << each.key << " = " << value);
        std::string rest = lines;
        if (const std::size_t at = rest.find(each.key + " ="); at != rest.npos) {
            rest.erase(at, rest.find('\n', at) + 1 - at);
        }
        Environment changed = environment_of(table(process, lines));
        for (const ChangingSetting& same : changed.changing_settings(0)) {
            if (same.key == each.key) same.set(value);
        }
        const std::vector<double> found = answers(changed);
        const std::vector<double> expected = answers_with(process, fmt::format("{}{} = {}\n", rest, each.key, value));
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            CHECK(found[i] == Approx(expected[i]).epsilon(1e-6).margin(1e-9));
    }
}

TEST_CASE("voxel-shade forgets the shadows of another strength", "[voxel-shade]") {
    Environment environment = environment_of(table("voxel-shade", "voxel = 0.25\nstrength = 0.1\n"));
    const auto now = [&](double strength) {
        for (const ChangingSetting& each : environment.changing_settings(0)) {
            if (each.key == "strength") each.set(strength);
        }
        return answers(environment);
    };
    for (const double strength : {0.1, 0.3, 0.0, 0.2}) {
        const auto expected = answers_with("voxel-shade", fmt::format("voxel = 0.25\nstrength = {}\n", strength));
        const auto found = now(strength);
        for (std::size_t i = 0; i < found.size(); ++i)
            CHECK(found[i] == Approx(expected[i]).epsilon(1e-6).margin(1e-7));
    }
}

TEST_CASE("the rate of a source of water changes what it adds", "[soil-water]") {
    Environment environment = environment_of(
        "[light]\nprocess = \"soil-water\"\nvoxel = 0.25\n"
        "domain = { lower = [-1, -1, -1], upper = [1, 0, 1] }\ndiffusion = 0\n"
        "sources = [{ shape = \"box\", lower = [-1, -0.25, -1], upper = [1, 0, 1], rate = 0.5 }]\n");
    const std::vector<ChangingSetting> settings = environment.changing_settings(0);
    const auto rate = std::find_if(settings.begin(), settings.end(),
                                   [](const ChangingSetting& each) { return each.key == "sources.0.rate"; });
    REQUIRE(rate != settings.end());
    double expected = 0;
    for (int step = 0; step < 5; ++step) {
        rate->set(0.1 * step);
        AskingPlants plants;
        plants.add({{{0, -0.5, 0}, {0}}}).exchange(environment, step);
        expected += 0.1 * step * 64;  // light from the 8 x 8 voxels of the source
        for (const Quantity& quantity : environment.statistics(0)) {
            if (quantity.name == "light.added") CHECK(quantity.value == Approx(expected));
        }
    }
}

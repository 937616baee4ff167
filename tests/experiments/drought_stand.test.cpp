// Four plants in one drying soil, whose stomata answer early or late, with deep and with shallow roots.
#include "catch.h"
#include "experiments/growth.h"

#include <array>
#include <cmath>
#include <map>

using namespace espalier;

namespace {

constexpr int a_day = 12;  // steps
constexpr std::uint32_t careful_deep = 0, daring_deep = 1, careful_shallow = 2, daring_shallow = 3;

struct Moment {
    double potential = 0;    ///< of the leaves, MPa
    double conductance = 0;  ///< mean of the leaves, mol m-2 s-1
    double loss = 0;         ///< of conductance, %
    double given = 0, demand = 0, carbon = 0, area = 0;
    double soil = 0;  ///< potential of the soil at the roots, by their shares of the uptake from uniform soil, MPa
};

struct Drought {
    std::vector<std::array<Moment, 4>> steps;
    double balance = 0, soil_balance = 0, residual = 0, taken = 0, drunk = 0;

    const Moment& at(int day, int hour, std::uint32_t plant) const {
        return steps[static_cast<std::size_t>(day * a_day + hour / 2 - 1)][plant];
    }
    double lowest(std::uint32_t plant, int days) const {
        double least = 0;
        for (int step = 0; step < days * a_day; ++step) least = std::min(least, steps[step][plant].potential);
        return least;
    }
};

double mean_of(const World& world, const char* quantity, std::uint32_t plant, const char* weights = nullptr) {
    const auto values = world.environment().organ_values(quantity, plant);
    const auto shares = weights ? world.environment().organ_values(weights, plant) : nullptr;
    double sum = 0, all = 0;
    for (std::size_t m = 0; values && m < values->size(); ++m) {
        const double value = (*values)[m], weight = shares ? (*shares)[m] : 1;
        if (std::isfinite(value) && std::isfinite(weight)) sum += weight * value, all += weight;
    }
    return all > 0 ? sum / all : 0;
}

Drought grown(std::uint64_t seed, const std::vector<std::pair<std::string, std::string>>& overrides = {}) {
    SceneOptions options;
    options.seed = seed;
    options.overrides = overrides;
    World world(read_scene(source_path("environments/drought-stand.toml"), options));
    world.start();
    Drought drought;
    while (!world.at_end()) {
        world.step();
        drought.taken = 0;
        std::array<Moment, 4>& now = drought.steps.emplace_back();
        for (std::uint32_t plant = 0; plant < 4; ++plant) {
            const auto of = [&](const char* name) { return world.environment().statistic(name, plant); };
            now[plant] = {of("leaves.potential"),
                          mean_of(world, "leaves.conductance", plant),
                          of("roots.plc"),
                          of("leaves.water"),
                          of("roots.demand") / a_day,
                          of("carbon.structure"),
                          of("leaves.leaf_area"),
                          mean_of(world, "roots.soil", plant, "roots.fraction") / 10197.16};
            drought.balance = std::max(drought.balance, std::abs(of("roots.water_balance")));
            drought.soil_balance = std::max(drought.soil_balance, std::abs(of("water.balance")));
            drought.residual = std::max(drought.residual, of("leaves.residual"));
            drought.taken += of("roots.total");
            drought.drunk = of("water.drunk") * 57.6;  // mm over 576 cm2
        }
    }
    return drought;
}

/// Grown once for all that is claimed of it.
const Drought& drought_of(std::uint64_t seed) {
    static std::map<std::uint64_t, Drought> known;
    const auto found = known.find(seed);
    return found != known.end() ? found->second : known.emplace(seed, grown(seed)).first->second;
}

}  // namespace

TEST_CASE("careful plants keep their leaves in a drought, daring ones grow until theirs dry", "[drought-stand]") {
    for (const std::uint64_t seed : {3, 5}) {
        const Drought& drought = drought_of(seed);
        const std::array<Moment, 4>&wet = drought.steps[24 * a_day], &dry = drought.steps[36 * a_day + 6];
        for (std::uint32_t plant = 0; plant < 4; ++plant) {
            INFO("seed " << seed << ", plant " << plant << ": lowest " << drought.lowest(plant, 36)
                         << " MPa, carbon on days 24 and 36 " << wet[plant].carbon << " and " << dry[plant].carbon
                         << " g, leaves " << wet[plant].area << " and " << dry[plant].area << " m2, loss on day 30 "
                         << drought.at(30, 14, plant).loss << " %");
            const bool is_daring = plant == daring_deep || plant == daring_shallow;
            CHECK((is_daring ? drought.lowest(plant, 36) < -2.3 : drought.lowest(plant, 36) > -2.1));
            CHECK((is_daring ? drought.at(30, 14, plant).loss > 40 : drought.at(30, 14, plant).loss < 15));
            CHECK((is_daring ? dry[plant].area < wet[plant].area : dry[plant].area > wet[plant].area));
        }
        CHECK(wet[daring_deep].carbon > 1.03 * wet[careful_deep].carbon);
        CHECK(dry[daring_shallow].carbon < 0.97 * dry[careful_shallow].carbon);
        CHECK(dry[careful_deep].carbon > 1.4 * dry[careful_shallow].carbon);
        CHECK(dry[daring_deep].carbon > 1.4 * dry[daring_shallow].carbon);
        CHECK(drought.balance < 1e-10);
        CHECK(drought.soil_balance < 1e-12);
        CHECK(drought.residual < 1e-8);
        CHECK(drought.drunk == Approx(drought.taken).epsilon(1e-9));
    }
}

TEST_CASE("stomata close at noon as the soil dries, and open again in the rain", "[drought-stand]") {
    const Drought& drought = drought_of(5);
    for (std::uint32_t plant = 0; plant < 4; ++plant) {
        const auto afternoon = [&](int day) {
            return drought.at(day, 14, plant).conductance / drought.at(day, 8, plant).conductance;
        };
        INFO("plant " << plant << ": 14 over 8 o'clock on days 2, 30 and 43: " << afternoon(2) << ", " << afternoon(30)
                      << ", " << afternoon(43));
        CHECK(afternoon(30) < 0.4 * afternoon(2));
        if (plant == careful_deep || plant == daring_deep) CHECK(afternoon(43) > 2 * afternoon(30));
    }
    // What of the demand is met falls with the leaves' potential, steeply where f does.
    int open = 0, shut = 0;
    for (int day = 0; day < 40; ++day) {
        const Moment& noon = drought.at(day, 12, careful_deep);
        const double met = noon.given / noon.demand;
        INFO("day " << day << ", " << noon.potential << " MPa");
        if (noon.potential > -0.45) {
            ++open;
            CHECK(met > 0.7);
        } else if (noon.potential < -0.95) {
            ++shut;
            CHECK(met < 0.4);
        }
    }
    CHECK(open > 5);
    CHECK(shut > 5);
}

TEST_CASE("before dawn leaves are at the potential of the soil, less their height", "[drought-stand]") {
    const Drought& drought = drought_of(5);
    for (std::uint32_t plant = 0; plant < 4; ++plant) {
        for (int day = 1; day < 39; ++day) {
            const Moment& dawn = drought.at(day, 4, plant);
            INFO("plant " << plant << ", day " << day << ": " << dawn.potential << " and " << dawn.soil << " MPa");
            CHECK(std::abs(dawn.potential - dawn.soil) < 0.015);
        }
        CHECK(drought.at(38, 4, plant).potential < drought.at(1, 4, plant).potential - 0.02);
    }
}

TEST_CASE("where it rains no plant loses leaves", "[drought-stand]") {
    const Drought moist = grown(5, {{"environment.water.boundaries.top.rain", "6"}, {"simulation.steps", "336"}});
    for (std::uint32_t plant = 0; plant < 4; ++plant) {
        INFO("plant " << plant << ": lowest " << moist.lowest(plant, 28));
        CHECK(moist.lowest(plant, 28) > -2.2);
        for (std::size_t step = 1; step < moist.steps.size(); ++step) {
            REQUIRE(moist.steps[step][plant].area >= moist.steps[step - 1][plant].area - 1e-9);
        }
    }
}

// Stems that grow faster where neighbours send far-red light.
#include "catch.h"
#include "experiments/growth.h"

#include <cmath>

using namespace espalier;

namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

struct Seedlings {
    double height = 0;  ///< mean, m
    double ratio = 0;   ///< red over far-red at the nodes, of daylight's; mean
    double light = 0;   ///< mean light of PAR per leaf area over that on open ground
};

std::ostream& operator<<(std::ostream& out, const Seedlings& mean) {
    return out << mean.height << " m, red over far-red " << mean.ratio << ", light " << mean.light;
}

void add_plant(const ModuleString& string, const Alphabet& alphabet, Seedlings& sums, double& nodes) {
    const std::vector<std::size_t> offsets = parameter_offsets(string, alphabet);
    for (std::size_t i = 0; i < string.size(); ++i) {
        const std::string symbol = alphabet.name(string.letters[i]);
        if (symbol == "I") sums.height += string.parameters[offsets[i]];
        if (symbol != "S") continue;
        sums.ratio += string.parameters[offsets[i]];
        nodes += 1;
    }
}

/// Nine seedlings, so far from each other.
Seedlings seedlings(double spacing, std::uint64_t seed, const Overrides& overrides = {}) {
    const std::string half = std::to_string(1.5 * spacing);
    SceneOptions options;
    options.overrides = {{"simulation.seed", std::to_string(seed)},
                         {"simulation.domain",
                          "{ lower = [-" + half + ", 0, -" + half + "], upper = [" + half + ", 0.6, " + half + "] }"},
                         {"plant.0.grid.spacing", std::to_string(spacing)}};
    options.overrides.insert(options.overrides.end(), overrides.begin(), overrides.end());
    const auto world = grown("environments/shade-avoidance.toml", options);
    Seedlings mean;
    double nodes = 0;
    for (std::size_t plant = 0; plant < world->size(); ++plant) {
        add_plant(world->string(plant), world->model(plant).alphabet, mean, nodes);
        for (const Quantity& quantity : world->environment().statistics(static_cast<std::uint32_t>(plant))) {
            if (quantity.name == "light.mean") mean.light += quantity.value;
        }
    }
    const auto plants = static_cast<double>(world->size());
    return {mean.height / plants, mean.ratio / nodes, mean.light / plants};
}

}  // namespace

TEST_CASE("seedlings are taller the nearer their neighbours are, by the far-red light of their leaves",
          "[shade-avoidance]") {
    Seedlings wider{0, 1, 1};
    for (const double spacing : {0.3, 0.15, 0.075}) {
        const Seedlings own = seedlings(spacing, 5);
        UNSCOPED_INFO(spacing << " m apart: " << own);
        CHECK(own.height > 1.05 * wider.height);
        CHECK(own.ratio < wider.ratio - 0.04);
        CHECK(own.light < wider.light);
        wider = own;
    }
    const Overrides blind{{"plant.0.define.RESPONSE", "0"}},
        no_far_red{{"environment.light.bands.far-red.leaf", "[0.05, 0.05]"}};
    const Seedlings blind_near = seedlings(0.075, 5, blind), blind_far = seedlings(0.3, 5, blind),
                    grey = seedlings(0.075, 5, no_far_red);
    UNSCOPED_INFO("insensitive: " << blind_near << " and " << blind_far << "; no far-red from leaves: " << grey);
    CHECK(blind_near.height == Approx(blind_far.height));
    CHECK(blind_near.ratio < blind_far.ratio - 0.1);  // the signal is there
    CHECK(grey.height == Approx(blind_far.height).epsilon(0.01));
    CHECK(grey.light == Approx(blind_near.light).epsilon(0.01));  // the shade is there, too
}

TEST_CASE("by paths of light, too, seedlings are taller among near neighbours", "[shade-avoidance]") {
    const Overrides rays{
        {"environment.light",
         "{ process = \"ray-light\", paths = 32768, periodic = true, sky = { par = 1000, diffuse = 0.5, "
         "sun = [0.4, 1, 0.2] }, bands = { par = { leaf = [0.05, 0.05] }, red = { leaf = [0.05, 0.05] "
         "}, far-red = { leaf = [0.42, 0.42] } } }"}};
    const Seedlings far = seedlings(0.2, 6, rays), near = seedlings(0.075, 6, rays);
    INFO("0.2 m apart: " << far << "; 0.075 m: " << near);
    CHECK(near.height > 1.1 * far.height);
    CHECK(near.ratio < far.ratio - 0.1);
}

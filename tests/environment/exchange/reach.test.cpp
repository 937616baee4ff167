// What processes say of how far their queries reach, which decides what ranks send each other.
#include "environment/space/neighbours/reach.h"

#include "espalier/base/random.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace espalier;

namespace {

/// Numbers in [0, 1).
using Chance = std::function<double()>;

struct Local {
    std::string table;  ///< of the process "light"
    std::function<Asked(const Chance& chance)> ask;
};

glm::dvec3 anywhere(const Chance& chance) {
    return {20 * chance() - 10, 4 * chance(), 20 * chance() - 10};
}

/// Half of them cast a shadow.
Asked caster(const Chance& chance) {
    return {anywhere(chance), {chance() < 0.5 ? 1.0 : 0.0, 0, 0, 0}};
}

Asked disc_at_height(const Chance& chance, double action, double most) {
    const glm::dvec3 at = anywhere(chance);
    return {{at.x, at.z, at.y}, {action, most * chance()}};
}

const std::vector<Local>& local_processes() {
    static const std::vector<Local> all{
        {"process = 'voxel-shade'\nvoxel = 0.3\ngradient_radius = 0.7\ndepth = 5", caster},
        {"process = 'shadowpyramid'\ngrid_size = 81\ngrid_span = 12\nlight_randomness = 0.1\nshadow_spread = 1.3",
         caster},
        {"process = 'shadowpyramid'\ngrid_size = 40\ngrid_span = 12\nnumbers = 'cpfg'\nsample_radius = 0.3", caster},
        {"process = 'honda81'\nradius = 0.9",
         [](const Chance& chance) {
             return Asked{anywhere(chance), {std::floor(9 * chance()), std::floor(2 * chance())}};
         }},
        {"process = 'honda81'\nradius = 1.7\n3d_case = true",
         [](const Chance& chance) {
             return Asked{anywhere(chance), {chance()}};
         }},
        {"process = 'ecosystem'",
         [](const Chance& chance) {
             return Asked{anywhere(chance), {chance() < 0.1 ? 2 * chance() : 0.4 * chance()}};
         }},
        {"process = 'ecosystem'\n3d_case = true",
         [](const Chance& chance) {
             return Asked{anywhere(chance), {1.5 * chance(), std::floor(2 * chance())}};
         }},
        {"process = 'ornament'\ngrid_size = [30, 60]\ngrid_position = [-10, -10]\ngrid_range = [20, 20]",
         [](const Chance& chance) { return disc_at_height(chance, 0, 2); }},
        {"process = 'clover'\ngrid_size = [50, 40]\ngrid_position = [-10, -10]\ngrid_range = [20, 20]\n"
         "remove_old_leaves = true",
         [](const Chance& chance) { return disc_at_height(chance, std::floor(3 * chance()), 4); }},
        {"process = 'clover'\ngrid_size = [50, 40]\ngrid_position = [-10, -10]\ngrid_range = [20, 20]\n"
         "remove_old_leaves = true\nz_is_up = false\nnumbers = 'cpfg'",
         [](const Chance& chance) {
             return Asked{anywhere(chance), {std::floor(3 * chance()), 4 * chance()}};
         }},
        {"process = 'ulam'\nrule = 'births'\nedge = 0.8\ncorner = 1.2",
         [](const Chance& chance) {
             const glm::dvec3 at = 0.8 * glm::dvec3(std::floor(24 * chance()) - 12, 0, std::floor(24 * chance()) - 12);
             const glm::dvec3 beside(0.004 * chance(), 0.004 * chance(), 0.004 * chance());
             return Asked{at + beside, {chance() < 0.4 ? 1.0 : 0.0, 0, 0}};
         }},
    };
    return all;
}

/// Which of the others' questions are asked.
enum class Others { all, in_reach, none };

struct Outcome {
    std::vector<double> answers;  ///< of the first plant
    std::size_t asked = 0;        ///< questions of the others
};

/// A plant asks from one corner, others from everywhere.
Outcome outcome(const Local& process, std::uint64_t seed, Others others) {
    const RandomKey key(seed, 0, Stream::process, 1);
    RandomSamples samples(key, 1, 0);
    const Chance chance = [&samples] { return samples.uniform(); };
    std::vector<Asked> own, all;
    Box places;
    for (int i = 0; i < 700; ++i) {
        const Asked asked = process.ask(chance);
        const bool in_the_corner = asked.position.x < -4 && asked.position.y + asked.position.z < 0;
        if (in_the_corner && chance() < 0.5) {
            own.push_back(asked);
            places.add(asked.position);
        } else {
            all.push_back(asked);
        }
    }
    EnvironmentContext context;
    context.plants = static_cast<std::uint32_t>(1 + all.size());
    Environment environment = environment_of("[light]\n" + process.table + "\n", context);
    REQUIRE(environment.spreading(0) == Spreading::reach);
    const auto is_in_reach = [&](const Asked& asked) {
        Query query;
        query.pose.position = asked.position;
        query.parameters = asked.parameters;
        return overlap(environment.reach(0, query), places);
    };
    AskingPlants plants;
    plants.add(own);
    Outcome outcome;
    for (const Asked& asked : all) {
        const bool is_asked = others == Others::all || (others == Others::in_reach && is_in_reach(asked));
        plants.add(is_asked ? std::vector<Asked>{asked} : std::vector<Asked>{});
        outcome.asked += is_asked;
    }
    plants.exchange(environment);
    outcome.answers = plants.parameters();
    return outcome;
}

}  // namespace

TEST_CASE("what is asked beyond the reach of a query does not change by it", "[environment]") {
    for (const Local& process : local_processes()) {
        std::size_t changed = 0;
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            INFO(process.table << "\nseed " << seed);
            const Outcome all = outcome(process, seed, Others::all);
            const Outcome in_reach = outcome(process, seed, Others::in_reach);
            CHECK(in_reach.answers == all.answers);
            CHECK(in_reach.asked < all.asked);
            changed += outcome(process, seed, Others::none).answers != all.answers;
        }
        INFO(process.table);
        CHECK(changed > 30);
    }
}

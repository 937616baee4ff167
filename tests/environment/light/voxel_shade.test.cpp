#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace espalier;
using namespace espalier::environment;

namespace {

const std::string palubicki =
    "[light]\nprocess = \"voxel-shade\"\nvoxel = 1\nstrength = 0.25\ndissipation = 2\n"
    "depth = 4\nfull_light = 1\n";

std::vector<double> answers(const std::string& scene, const std::vector<Asked>& questions,
                            const EnvironmentContext& context = {}) {
    Environment environment = environment_of(scene, context);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

/// A crown of `count` questions that cast and ask for the gradient too, without any pattern in the voxels.
std::vector<Asked> crown(int count, const glm::dvec3& centre = {0, 5, 0}) {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 offset(samples.uniform() * 9 - 4.5, samples.uniform() * 9 - 4.5, samples.uniform() * 9 - 4.5);
        questions.push_back({centre + offset, {i % 5 == 0 ? 0 : 0.02 + 0.1 * samples.uniform(), 0, 0, 0}});
    }
    return questions;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

float shade_at(const Environment& environment, const openvdb::Coord& voxel) {
    return environment.fields().need("light.shade").grid->grid->tree().getValue(voxel);
}

}  // namespace

TEST_CASE("one node shades a pyramid of (1 + 2q) x (1 + 2q) voxels by a b^-q in layer q, and nothing else",
          "[environment]") {
    Environment environment = environment_of(palubicki);
    AskingPlants plants;
    plants.add({{{3, 10, -2}, {2}}}).exchange(environment);
    int wrong = 0, shaded = 0;
    for (int x = -8; x <= 14; ++x) {
        for (int y = 0; y <= 16; ++y) {
            for (int z = -13; z <= 9; ++z) {
                const int q = 10 - y;
                const bool inside = q >= 0 && q <= 4 && std::abs(x - 3) <= q && std::abs(z + 2) <= q;
                const double expected = inside ? 2 * 0.25 * std::pow(2.0, -q) : 0;
                wrong += std::abs(shade_at(environment, {x, y, z}) - expected) > 1e-7;
                shaded += inside;
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(shaded == 1 + 9 + 25 + 49 + 81);
    CHECK(environment.fields().need("light.shade").grid->grid->activeVoxelCount() == 165);
}

TEST_CASE("two nodes superpose: the shade of both is the sum of each alone", "[environment]") {
    const Asked one{{0, 5, 0}, {0.7}}, two{{1, 6, -1}, {1.3}};
    Environment a = environment_of(palubicki), b = environment_of(palubicki), both = environment_of(palubicki);
    AskingPlants().add({one}).exchange(a);
    AskingPlants().add({two}).exchange(b);
    AskingPlants().add({one, two}).exchange(both);
    int wrong = 0;
    double most = 0;
    for (int x = -6; x <= 6; ++x) {
        for (int y = 0; y <= 7; ++y) {
            for (int z = -6; z <= 6; ++z) {
                const openvdb::Coord v(x, y, z);
                wrong += std::abs(shade_at(both, v) - (shade_at(a, v) + shade_at(b, v))) > 1e-6;
                most = std::max<double>(most, shade_at(both, v));
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(most > 0.3);
}

TEST_CASE("what is asked below a caster is full light less its shade, and never negative", "[environment]") {
    const std::vector<double> light = answers(palubicki, {{{0, 10, 0}, {1}},
                                                          {{0, 9, 0}, {0}},
                                                          {{1, 8, 1}, {0}},
                                                          {{3, 8, 0}, {0}},
                                                          {{0, 5, 0}, {0}},
                                                          {{0, 20, 0}, {100}},
                                                          {{0, 19, 0}, {0}}});
    const std::vector<double> expected{1, 1 - 0.25 / 2, 1 - 0.25 / 4, 1, 1, 1, 0};
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(light[i] == Approx(expected[i]).epsilon(1e-9));
}

TEST_CASE("light under n closed layers decays geometrically", "[environment]") {
    // Strength 0.4 without dissipation or spread: every organ lets 0.6 through, straight down.
    const std::string scene =
        "[light]\nprocess = \"voxel-shade\"\nvoxel = 1\nmode = \"attenuate\"\nstrength = 0.4\n"
        "dissipation = 1\nspread = 0\ndepth = 40\nfull_light = 2\n";
    for (int n = 0; n <= 12; ++n) {
        std::vector<Asked> questions{{{0.3, 0.4, 0.2}, {0}}};
        for (int layer = 0; layer < n; ++layer) {
            for (int x = -2; x <= 2; ++x) {
                for (int z = -2; z <= 2; ++z) questions.push_back({{x, 5 + 2 * layer, z}, {1}});
            }
        }
        CHECK(answers(scene, questions)[0] == Approx(2 * std::pow(0.6, n)).epsilon(1e-9));
    }
}

TEST_CASE("an opaque organ lets nothing through and still sees full light itself", "[environment]") {
    const std::string scene =
        "[light]\nprocess = \"voxel-shade\"\nvoxel = 1\nmode = \"attenuate\"\nstrength = 1\n"
        "dissipation = 1\nsampling = \"nearest\"\n";
    CHECK(answers(scene, {{{0, 5, 0}, {1}}, {{0, 3, 0}, {0}}}) == std::vector<double>{1, 0});
}

TEST_CASE("a lone caster sees exactly full light and no gradient, wherever it stands", "[environment]") {
    RandomSamples samples({5, 0, Stream::process}, 1, 1);
    for (const std::string mode : {"add", "attenuate"}) {
        for (const std::string sampling : {"trilinear", "nearest"}) {
            const std::string scene =
                "[light]\nprocess = \"voxel-shade\"\nvoxel = 0.3\nstrength = 0.58\n"
                "dissipation = 6.9\nfull_light = 0.9\nmode = \"" +
                mode + "\"\nsampling = \"" + sampling + "\"\n";
            int wrong = 0;
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 at(samples.normal() * 10, samples.normal() * 10, samples.normal() * 10);
                const double s = 3 * samples.uniform();
                wrong += answers(scene, {{at, {s, 9, 9, 9}}}) != std::vector<double>{0.9, 0, 0, 0};
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("removing one's own shade leaves what the others cast", "[environment]") {
    for (const std::string sampling : {"trilinear", "nearest"}) {
        const std::string scene = palubicki + "sampling = \"" + sampling + "\"\n";
        std::vector<Asked> questions = crown(60);
        for (std::size_t i = 0; i < questions.size(); i += 7) {
            const std::vector<double> all = answers(scene, questions);
            std::vector<Asked> without = questions;
            without[i].parameters[0] = 0;
            const std::vector<double> others = answers(scene, without);
            CHECK(same_bytes({all.begin() + long(4 * i), all.begin() + long(4 * i + 4)},
                             {others.begin() + long(4 * i), others.begin() + long(4 * i + 4)}));
        }
    }
}

TEST_CASE("the gradient points away from the shade", "[environment]") {
    for (const std::string mode : {"add", "attenuate"}) {
        // A wall of casters stands at larger x, above.
        std::vector<Asked> questions{{{0, 4, 0}, {1, 0, 0, 0}}};
        for (int z = -4; z <= 4; ++z) questions.push_back({{3, 6, z}, {0.2}});
        const std::vector<double> light =
            answers(palubicki + "mode = \"" + mode + "\"\ngradient_radius = 1.5\n", questions);
        const glm::dvec3 gradient(light[1], light[2], light[3]);
        CHECK(gradient.x < -0.005);
        CHECK(std::abs(gradient.z) < 1e-12);
    }
    // Directly below a closed layer the way out is down, where the shade is thinner: central differences, by hand.
    const std::vector<double> below = answers(palubicki, {{{0, 8, 0}, {0, 0, 0, 0}}, {{0, 10, 0}, {1}}});
    CHECK(below[2] == Approx((0.25 / 8 - 0.25 / 2) / 2).epsilon(1e-9));
}

TEST_CASE("parameters beyond the gradient, and too few for one, stay as they are", "[environment]") {
    CHECK(answers(palubicki, {{{0, 0, 0}, {1, 5, 6}}, {{50, 0, 0}, {0, 1, 2, 3, 7}}}) ==
          std::vector<double>{1, 5, 6, 1, 0, 0, 0, 7});
}

TEST_CASE("the order of the queries changes no answer", "[environment]") {
    for (const std::string mode : {"add", "attenuate"}) {
        const std::string scene = palubicki + "mode = \"" + mode + "\"\n";
        const std::vector<Asked> questions = crown(500);
        std::vector<std::size_t> order(questions.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = (i * 137) % order.size();
        std::vector<Asked> shuffled;
        for (const std::size_t i : order) shuffled.push_back(questions[i]);
        const std::vector<double> straight = answers(scene, questions), other = answers(scene, shuffled);
        std::vector<double> back(straight.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            std::copy_n(other.begin() + long(4 * i), 4, back.begin() + long(4 * order[i]));
        }
        CHECK(same_bytes(straight, back));
        CHECK(*std::min_element(straight.begin(), straight.end()) < 0);  // gradients: something is shaded at all
    }
}

TEST_CASE("one thread and two give the same bytes, of answers and of fields", "[environment]") {
    const std::vector<Asked> questions = crown(3000);
    std::vector<std::vector<double>> all;
    std::vector<float> middle;
    for (const std::size_t threads : {1, 2}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Environment environment = environment_of(palubicki);
        AskingPlants plants;
        plants.add(questions).exchange(environment);
        all.push_back(plants.parameters());
        for (int y = -4; y < 10; ++y) middle.push_back(shade_at(environment, {0, y, 1}));
    }
    CHECK(same_bytes(all[0], all[1]));
    CHECK(std::equal(middle.begin(), middle.begin() + 14, middle.begin() + 14));
}

TEST_CASE("queries that come in parts, of plants that are not in memory, are answered as all at once",
          "[environment]") {
    for (const std::string& scene :
         {palubicki, palubicki + "periodic = true\ndomain = { lower = [-8, -9, -6], upper = [8, 30, 6] }\n"}) {
        Environment whole = environment_of(scene), parts = environment_of(scene);
        AskingPlants all, waiting;
        const std::vector<Asked> questions = crown(9000);
        for (int plant = 0; plant < 20; ++plant) {  // 180,000: more than twenty parts
            std::vector<Asked> own = questions;
            for (Asked& asked : own) asked.position += glm::dvec3(0.7 * plant, 0.1 * plant, 0);
            if (plant == 7) own.clear();
            all.add(own);
            waiting.add(own);
        }
        REQUIRE(parts.takes_parts());
        for (int step = 0; step < 2; ++step) {
            all.exchange(whole, step);
            waiting.exchange_waiting(parts, step);
            for (std::uint32_t plant = 0; plant < 20; ++plant) {
                CHECK(same_bytes(all.parameters(plant), waiting.parameters(plant)));
                const std::vector<Quantity> told = whole.statistics(plant), again = parts.statistics(plant);
                REQUIRE(told.size() == again.size());
                for (std::size_t i = 0; i < told.size(); ++i) {
                    CHECK(same_bytes({told[i].value}, {again[i].value}));
                }
            }
            all.ask_again_with(0.5);
            waiting.ask_again_with(0.5);
        }
        CHECK(shade_at(whole, {3, 2, 1}) == shade_at(parts, {3, 2, 1}));
    }
}

TEST_CASE("a grid that grows with the plants answers as a large fixed one", "[environment]") {
    const std::vector<Asked> questions = crown(300);
    const std::string domain = "domain = { lower = [-40.5, -40.5, -40.5], upper = [40.5, 40.5, 40.5] }\n";
    CHECK(same_bytes(answers(palubicki, questions), answers(palubicki + domain, questions)));
    EnvironmentContext context;
    context.domain = Box{{-30.5, -30.5, -30.5}, {30.5, 30.5, 30.5}};
    CHECK(same_bytes(answers(palubicki, questions), answers(palubicki + "fixed = true\n", questions, context)));
}

TEST_CASE("outside a fixed domain is full light", "[environment]") {
    const std::string scene = palubicki +
                              "sampling = \"nearest\"\n"
                              "domain = { lower = [-2.5, -0.5, -2.5], upper = [2.5, 8.5, 2.5] }\n";
    // The caster stands above the domain; its pyramid reaches into it and past its side.
    const std::vector<double> light =
        answers(scene, {{{1, 10, 0}, {1}}, {{1, 8, 0}, {0}}, {{1, 9, 0}, {0}}, {{2, 8, 0}, {0}}, {{3, 8, 0}, {0}}});
    CHECK(light[1] == Approx(1 - 0.25 / 4));
    CHECK(light[2] == 1);
    CHECK(light[3] == Approx(1 - 0.25 / 4));
    CHECK(light[4] == 1);
}

TEST_CASE("shade reaches the sides of a fixed domain, wherever its sides lie between voxels", "[environment]") {
    // One organ lets half the light through, straight down without end, in whatever voxel it stands.
    const std::string column =
        "[light]\nprocess = \"voxel-shade\"\nvoxel = 0.5\nmode = \"attenuate\"\nstrength = 0.5\n"
        "dissipation = 1\nspread = 0\ndepth = 30\n";
    const std::string sampling = GENERATE("trilinear", "nearest");
    const auto below_caster = [&](double bottom, double top, const glm::dvec3& caster, const glm::dvec3& place) {
        const std::string domain = fmt::format(
            "domain = {{ lower = [-1, {}, -1], upper = [1, {}, 1] }}\nsampling = \"{}\"\n", bottom, top, sampling);
        return answers(column + domain, {{caster, {1}}, {place, {0}}})[1];
    };
    const glm::dvec3 caster(0.25, 0.95, 0.25);
    const auto at = [](double height) { return glm::dvec3(0.25, height, 0.25); };
    for (double top = 0.96; top < 2.1; top += 0.0371) {
        for (const double bottom : {0.0, -0.3, -1.1}) {
            INFO("from " << bottom << " to " << top << ", " << sampling);
            CHECK(below_caster(bottom, top, caster, at(std::min(bottom + 0.01, 0.3))) == Approx(0.5));
            CHECK(below_caster(bottom, top, caster, at(bottom)) == Approx(0.5));
            CHECK(below_caster(bottom, top, caster, at(top + 0.6)) == 1);
            CHECK(below_caster(bottom, top, caster, at(bottom - 0.6)) == 1);
        }
    }
    // In the last half voxel it is as bright as in the middle of the outermost one, also on the side and in a corner.
    for (const double height : {0.8, 0.74, 0.501, 0.45, 0.2}) {
        CHECK(below_caster(0, 1, caster, at(height)) == Approx(0.5));
    }
    CHECK(below_caster(0, 1, {0.75, 1, 0.75}, {1, 0, 1}) == Approx(0.5));
    CHECK(below_caster(0, 1, {1, 1, 1}, {0.75, 0.3, 0.75}) == Approx(0.5));
}

TEST_CASE("voxels cover a domain about its middle, in the soil as in the shade", "[environment]") {
    RandomSamples samples({8, 0, Stream::process}, 1, 1);
    for (int i = 0; i < 100; ++i) {
        const auto number = [&](double most) { return most * (2 * samples.uniform() - 1); };
        const glm::dvec3 lower(number(3), number(3), number(3));
        const glm::dvec3 upper =
            lower + 0.7 + 2.0 * glm::dvec3(samples.uniform(), samples.uniform(), samples.uniform());
        const std::string grid =
            fmt::format("voxel = {}\ndomain = {{ lower = [{}, {}, {}], upper = [{}, {}, {}] }}\n",
                        0.1 + 0.2 * samples.uniform(), lower.x, lower.y, lower.z, upper.x, upper.y, upper.z);
        Environment environment = environment_of("[light]\nprocess = \"voxel-shade\"\n" + grid +
                                                 "[water]\nprocess = \"soil-water\"\n" + grid);
        const FieldGrid& light = *environment.fields().need("light").grid;
        const FieldGrid& water = *environment.fields().need("water").grid;
        CHECK(light.box.dim() == water.box.dim());
        const openvdb::Vec3d first = light.grid->indexToWorld(light.box.min()),
                             last = light.grid->indexToWorld(light.box.max());
        CHECK((first - water.grid->indexToWorld(water.box.min())).length() < 1e-9);
        CHECK((first + last - openvdb::Vec3d(lower.x + upper.x, lower.y + upper.y, lower.z + upper.z)).length() < 1e-9);
    }
}

TEST_CASE("under random leaves that hide a of the ground each, light is Beer's law with k = -ln(1 - a) / a",
          "[environment]") {
    // docs/light.md gives this setting. Each organ lets 1 - a of a voxel's light through, straight down; n organs stand
    // over a column, the leaf area index is n a, and the light (1 - a)^n = exp(-k LAI).
    for (const double a : {0.01, 0.1, 0.37, 0.5, 0.83}) {
        const std::string scene = fmt::format(
            "[light]\nprocess = \"voxel-shade\"\nvoxel = 0.5\nmode = \"attenuate\"\nstrength = {}\n"
            "dissipation = 1\nspread = 0\ndepth = 100\nsampling = \"nearest\"\n",
            a);
        const double k = -std::log(1 - a) / a;
        RandomSamples samples({9, 0, Stream::process}, 1, 1);
        std::vector<Asked> questions;
        for (const int n : {0, 1, 3, 7, 20, 50}) {
            const double x = 2.0 * n;
            questions.push_back({{x, 0, 0}, {0}});
            for (int organ = 0; organ < n; ++organ) {
                questions.push_back({{x + 0.49 * (samples.uniform() - 0.5), 1 + 40 * samples.uniform(),
                                      0.49 * (samples.uniform() - 0.5)},
                                     {1}});
            }
        }
        const std::vector<double> light = answers(scene, questions);
        std::size_t at = 0;
        for (const int n : {0, 1, 3, 7, 20, 50}) {
            CHECK(light[at] == Approx(std::exp(-k * n * a)).epsilon(1e-8).margin(1e-12));
            at += static_cast<std::size_t>(n) + 1;
        }
    }
    // With strengths s = 1 - exp(-k A / voxel^2), any leaf area A counts, and the law holds with k itself.
    const std::string scene =
        "[light]\nprocess = \"voxel-shade\"\nvoxel = 0.25\nmode = \"attenuate\"\nstrength = 1\n"
        "dissipation = 1\nspread = 0\ndepth = 200\nsampling = \"nearest\"\n";
    RandomSamples samples({10, 0, Stream::process}, 1, 1);
    for (const double k : {0.3, 0.5, 0.77}) {
        std::vector<Asked> questions{{{0, 0, 0}, {0}}};
        double area = 0;
        for (int leaf = 0; leaf < 60; ++leaf) {
            const double own = 0.01 * samples.uniform();
            area += own;
            questions.push_back({{0, 0.5 + 30 * samples.uniform(), 0}, {1 - std::exp(-k * own / (0.25 * 0.25))}});
        }
        CHECK(answers(scene, questions)[0] == Approx(std::exp(-k * area / (0.25 * 0.25))).epsilon(1e-7));
    }
}

TEST_CASE("plants far apart do not influence each other at all", "[environment]") {
    const std::vector<Asked> here = crown(400), there = crown(400, {80, 5, 0});
    Environment alone = environment_of(palubicki), together = environment_of(palubicki);
    AskingPlants lone, pair;
    lone.add(here).exchange(alone);
    pair.add(here).add(there).exchange(together);
    CHECK(same_bytes(lone.parameters(0), pair.parameters(0)));
    CHECK(together.statistics(0)[0].value == alone.statistics(0)[0].value);
    CHECK(together.statistics(0)[0].value < 0.95);
}

TEST_CASE("shade is made anew each step: a caster that is gone shades no more", "[environment]") {
    Environment environment = environment_of(palubicki);
    AskingPlants().add({{{0, 10, 0}, {1}}}).exchange(environment);
    AskingPlants later;
    later.add({{{0, 9, 0}, {0}}}).exchange(environment);
    CHECK(later.parameters() == std::vector<double>{1});
    CHECK(environment.fields().need("light").grid->grid->activeVoxelCount() == 0);
}

TEST_CASE("a periodic domain shades across its sides, a lone caster still sees full light", "[environment]") {
    const std::string scene = palubicki +
                              "periodic = true\n"
                              "domain = { lower = [-3.5, -1.5, -3.5], upper = [3.5, 20.5, 3.5] }\n";
    // From x = 3 the pyramid reaches x = 4 one layer below, which is x = -3 of the next period.
    const std::vector<double> light =
        answers(scene, {{{3, 10, 0}, {1}}, {{-3, 9, 0}, {0}}, {{-2, 9, 0}, {0}}, {{11, 9, 7}, {0}}});
    CHECK(light[0] == 1);
    CHECK(light[1] == Approx(1 - 0.25 / 2));
    CHECK(light[2] == 1);
    CHECK(light[3] == Approx(1 - 0.25 / 2));
    // At depth 4 the pyramid is 9 voxels wide where the period is 7: two columns of voxels get it twice.
    CHECK(answers(scene, {{{0, 10, 0}, {1}}, {{3, 6, 0}, {0}}})[1] == Approx(1 - 2 * 0.25 / 16));
}

TEST_CASE("in two dimensions the pyramid is a triangle and z does not matter", "[environment]") {
    const std::string scene = palubicki + "dimensions = 2\n";
    Environment environment = environment_of(scene);
    AskingPlants plants;
    plants.add({{{0, 10, 3}, {1}}, {{1, 9, -500}, {0, 0, 0, 5}}}).exchange(environment);
    CHECK(plants.parameters()[1] == Approx(1 - 0.25 / 2));
    CHECK(plants.parameters()[4] == 0);
    CHECK(environment.fields().need("light.shade").grid->grid->activeVoxelCount() == 1 + 3 + 5 + 7 + 9);
}

TEST_CASE("the light field holds what a query at the same place is told", "[environment]") {
    Environment environment = environment_of(palubicki + "sampling = \"nearest\"\n");
    std::vector<Asked> questions = crown(200);
    for (int i = 0; i < 20; ++i) questions.push_back({{i - 10, 3, 2}, {0, 0, 0, 0}});
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    const openvdb::FloatGrid& light = *environment.fields().need("light").grid->grid;
    double least = 1;
    for (std::size_t i = 0; i < 20; ++i) {
        const double answer = plants.parameters()[4 * (200 + i)];
        const openvdb::Vec3d voxel = light.worldToIndex(openvdb::Vec3d(double(i) - 10, 3, 2));
        CHECK(light.tree().getValue(openvdb::Coord::round(voxel)) == Approx(answer).margin(1e-6));
        least = std::min(least, answer);
    }
    CHECK(least < 0.95);
}

TEST_CASE("statistics sum up one plant's answers", "[environment]") {
    Environment environment = environment_of(palubicki);
    AskingPlants plants;
    plants.add({{{0, 10, 0}, {1}}, {{0, 9, 0}, {0}}}).add({{{40, 0, 0}, {2}}}).add({}).exchange(environment);
    const std::vector<Quantity> first = environment.statistics(0), last = environment.statistics(2);
    const std::vector<double> expected{1 - 0.25 / 4, 1 - 0.25 / 2, 1, 2, 1};
    for (std::size_t i = 0; i < 5; ++i) CHECK(first[i].value == Approx(expected[i]));
    CHECK(environment.statistics(1)[0].value == 1);
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::isnan(last[i].value));  // statistics of nothing
    for (std::size_t i = 3; i < 5; ++i) CHECK(last[i].value == 0);
}

TEST_CASE("bad parameters are refused before anything is allocated", "[environment]") {
    const auto refuse = [](const std::string& lines, EnvironmentContext context = {}) {
        CHECK_THROWS_AS(environment_of("[light]\nprocess = \"voxel-shade\"\n" + lines, context), UserError);
    };
    refuse("voxel = -1");
    refuse("voxel = 0");
    refuse("mode = \"multiply\"");
    refuse("depth = -1");
    refuse("dissipation = 0.5");
    refuse("fixed = true");
    refuse("periodic = true");
    refuse("voxel = 1\ndomain = { lower = [0, 0, 0], upper = [10000, 10000, 10000] }");
    refuse("voxel = 1\nperiodic = true\ndomain = { lower = [0, 0, 0], upper = [4.5, 5, 4] }");
    refuse("domain = { lower = [0, 0, 0], upper = [-1, 5, 4] }");
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {100, 100, 100}};
    refuse("voxel = 0.01", context);
    context.memory = 1 << 20;
    refuse("voxel = 1", context);
}

TEST_CASE("shadows that outgrow memory or numbers stop the run with a message", "[environment]") {
    EnvironmentContext context;
    context.memory = 1 << 16;
    CHECK_THROWS_AS(answers(palubicki, crown(100), context), RunError);
    CHECK_THROWS_AS(answers(palubicki, {{{1e12, 0, 0}, {1}}}), RunError);
    CHECK_THROWS_AS(answers(palubicki, {{{-1e8, -1e8, -1e8}, {1}}, {{1e8, 1e8, 1e8}, {1}}}), RunError);
    CHECK_THROWS_AS(answers(palubicki, {{{0, 0, 0}, {1e300}}}), RunError);
}

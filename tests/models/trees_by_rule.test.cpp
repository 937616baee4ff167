// Trees made by chance or by what flows in them: Oppenheimer, de Reffye, unequal flow, Strahler, pipes.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <map>

using namespace espalier;

namespace {

int segments_of_oppenheimer(int depth, int branches) {
    return depth == 0 ? 1 : 1 + (1 + branches) * segments_of_oppenheimer(depth - 1, branches);
}

// Upper tail of chi-square with k degrees of freedom, by the Wilson-Hilferty normal approximation (1931).
double chi_square_p(double chi_square, int k) {
    const double z = (std::cbrt(chi_square / k) - (1 - 2.0 / (9 * k))) / std::sqrt(2.0 / (9 * k));
    return 0.5 * std::erfc(z / std::sqrt(2));
}

struct Fork {
    double parent = 0;
    std::vector<double> children;
};

// Every internode I with the internodes that grow from its end; `value` is their first parameter.
std::vector<Fork> forks_of(const LonePlant& tree) {
    const auto symbols = symbols_of(tree.string, tree.model->alphabet);
    const auto values = values_of(tree.string, tree.model->alphabet, "I");
    std::vector<Fork> forks;
    std::vector<std::size_t> stack;
    std::size_t last = std::size_t(-1), next = 0;
    for (const std::string& symbol : symbols) {
        if (symbol == "[") stack.push_back(last);
        if (symbol == "]") {
            last = stack.back();
            stack.pop_back();
        }
        if (symbol != "I") continue;
        if (last != std::size_t(-1)) forks[last].children.push_back(values[next]);
        forks.push_back({values[next], {}});
        last = next++;
    }
    return forks;
}

}  // namespace

TEST_CASE("oppenheimer: N(d) = 1 + N(d-1) + n N(d-1) segments and a leaf at every end", "[trees]") {
    for (int branches : {1, 2, 3}) {
        LonePlant tree("models/trees/oppenheimer.l", {{"DEPTH", "5"}, {"BRANCHES", std::to_string(branches)}}, 3);
        tree.grow(6);
        CHECK(tree.counts()["F"] == segments_of_oppenheimer(5, branches));
        CHECK(tree.counts()["L"] == static_cast<int>(std::pow(1 + branches, 5)));
        CHECK(tree.counts()["T"] == 0);
        CHECK(tree.interpretation.geometry.polygons.size() == static_cast<std::size_t>(tree.counts()["L"]));
    }
}

TEST_CASE("oppenheimer: without deviation the ratios are exact, with it they have their mean and deviation",
          "[trees]") {
    LonePlant exact("models/trees/oppenheimer.l", {{"DEVIATION", "0"}});
    exact.grow(5);
    const auto children = children_of(exact.interpretation.geometry);
    for (std::size_t i = 0; i < children.size(); ++i) {
        const Internode& parent = exact.interpretation.geometry.internodes[i];
        for (std::size_t child : children[i]) {
            const Internode& internode = exact.interpretation.geometry.internodes[child];
            const double ratio = internode.order == parent.order ? 0.8 : 0.6;
            CHECK(length_of(internode) == Approx(ratio * length_of(parent)));
        }
    }

    LonePlant varied("models/trees/oppenheimer.l", {{"DEPTH", "9"}, {"BRANCHES", "2"}, {"RATIO_SD", "0.04"}}, 11);
    varied.grow(9);
    std::vector<double> stems, branches;
    const PlantGeometry& geometry = varied.interpretation.geometry;
    std::vector<std::size_t> last_of_order(100, 0);
    for (std::size_t i = 0; i < geometry.internodes.size(); ++i) {
        const Internode& internode = geometry.internodes[i];
        if (i > 0) {
            // The parent is the last segment of this order, or of the one below if this one begins a branch.
            const bool begins = internode.axis != geometry.internodes[last_of_order[internode.order]].axis;
            const std::size_t parent = last_of_order[begins ? internode.order - 1u : internode.order];
            (begins ? branches : stems).push_back(length_of(internode) / length_of(geometry.internodes[parent]));
        }
        last_of_order[internode.order] = i;
    }
    // 3280 and 6560 draws: the mean is known to 0.04 / sqrt(3280) = 0.0007.
    REQUIRE(stems.size() + branches.size() > 9000);
    CHECK(mean_of(stems) == Approx(0.8).margin(0.003));
    CHECK(mean_of(branches) == Approx(0.6).margin(0.002));
    CHECK(deviation_of(stems) == Approx(0.04).epsilon(0.05));
    CHECK(deviation_of(branches) == Approx(0.04).epsilon(0.05));
}

namespace {

std::size_t longest_path(const PlantGeometry& geometry) {
    const auto children = children_of(geometry);
    std::vector<std::size_t> above(children.size(), 1);
    for (std::size_t i = children.size(); i-- > 0;) {
        for (const std::size_t child : children[i]) above[i] = std::max(above[i], 1 + above[child]);
    }
    return above.front();
}

}  // namespace

TEST_CASE("unequal-flow: in every step wood and what the tips still have are the whole material", "[trees]") {
    for (const char* share : {"0.5", "0.58", "0.667", "0.83", "0.9", "0.97", "1"}) {
        LonePlant tree("models/trees/unequal-flow.l", {{"F2", share}});
        for (int step = 0; step < 300; ++step) {
            double sum = tree.counts()["W"];
            for (double flow : values_of(tree.string, tree.model->alphabet, "T")) sum += flow;
            REQUIRE(sum == 255);
            tree.grow(1);
        }
        CHECK(tree.counts()["W"] == 255);
        for (const Internode& wood : tree.interpretation.geometry.internodes) CHECK(length_of(wood) > 0.1);
    }
}

TEST_CASE("unequal-flow: the more unequal the flow, the longer the longest path; an equal flow makes a symmetric tree",
          "[trees]") {
    std::size_t before = 0;
    for (int share = 50; share <= 100; share += 2) {
        LonePlant tree("models/trees/unequal-flow.l", {{"F2", std::to_string(share / 100.0)}});
        tree.grow(256);
        const std::size_t longest = longest_path(tree.interpretation.geometry);
        CHECK(longest >= before);
        before = longest;
        if (share == 50) CHECK(longest == 8);
    }
    CHECK(before == 255);

    LonePlant even("models/trees/unequal-flow.l", {{"F2", "0.5"}, {"ANGLE_1", "30"}, {"ANGLE_2", "30"}});
    even.grow(8);
    CHECK(even.counts()["T"] == 128);
    std::vector<double> left, right;
    for (const Internode& internode : even.interpretation.geometry.internodes) {
        (internode.tip.x < 0 ? left : right).push_back(std::abs(internode.tip.x) + internode.tip.y);
    }
    // The trunk stands on the right side of zero.
    REQUIRE(left.size() + 1 == right.size());
    std::sort(left.begin(), left.end());
    std::sort(right.begin(), right.end());
    right.erase(right.begin());
    for (std::size_t i = 0; i < left.size(); ++i) CHECK(left[i] == Approx(right[i]));
}

TEST_CASE("unequal-flow: tips become fewer over the published shares, but not from each share to the next", "[trees]") {
    // What a tip with so much material ends as: the split written as a recursion.
    const auto expected = [](double share, int units) {
        std::vector<int> tips(static_cast<std::size_t>(units) + 1, 1);
        for (int q = 2; q <= units; ++q) {
            const int second = static_cast<int>(std::floor(share * (q - 1) + 0.5)), first = q - 1 - second;
            tips[static_cast<std::size_t>(q)] =
                tips[static_cast<std::size_t>(second)] + (first > 0 ? tips[static_cast<std::size_t>(first)] : 0);
        }
        return tips.back();
    };
    std::map<double, int> found;
    for (const double share : {0.5, 0.6, 0.667, 0.83, 0.9, 0.95, 0.99, 1.0}) {
        LonePlant tree("models/trees/unequal-flow.l", {{"F2", std::to_string(share)}});
        tree.grow(256);
        found[share] = static_cast<int>(tree.counts()["T"]);
        CHECK(found[share] == expected(share, 255));
    }
    CHECK(std::vector{found[0.5], found[0.667], found[0.9], found[1]} == std::vector{128, 114, 80, 1});
    CHECK(std::vector{found[0.6], found[0.95], found[0.99]} == std::vector{103, 46, 85});
}

TEST_CASE("buds: without death an axis has binomially many internodes, each with one leaf", "[trees]") {
    const int ticks = 20, runs = 2000;
    std::vector<int> found(ticks + 1, 0);
    const auto model = read_model(source_path("models/trees/buds.l"), {{{"DEATH", "0"}, {"PAUSE", "0.3"}}});
    const auto compiled = compile(model);
    for (int seed = 0; seed < runs; ++seed) {
        DerivationSettings settings;
        settings.seed = static_cast<std::uint64_t>(seed);
        Derivation derivation(compiled, settings);
        ModuleString string, next;
        derivation.start(string);
        for (int step = 0; step < 2 * ticks; ++step) {
            derivation.step(string, next);
            std::swap(string, next);
        }
        int internodes = 0, leaves = 0;
        for (const auto& each : parameters_of(string, model->alphabet, "Internode")) {
            leaves += 1;
            if (each[0] == 0) ++internodes;
        }
        CHECK(parameters_of(string, model->alphabet, "Leaf").size() == static_cast<std::size_t>(leaves));
        ++found[static_cast<std::size_t>(internodes)];
    }
    double chi_square = 0, pooled_expected = 0;
    int pooled_found = 0, classes = 0;
    double probability = std::pow(0.3, ticks);
    for (int k = 0; k <= ticks; ++k) {
        pooled_expected += runs * probability;
        pooled_found += found[static_cast<std::size_t>(k)];
        if (pooled_expected >= 10 || k == ticks) {
            chi_square += (pooled_found - pooled_expected) * (pooled_found - pooled_expected) / pooled_expected;
            ++classes;
            pooled_expected = pooled_found = 0;
        }
        probability *= 0.7 / 0.3 * (ticks - k) / (k + 1);
    }
    CHECK(classes > 8);
    CHECK(chi_square_p(chi_square, classes - 1) > 0.01);
}

TEST_CASE("buds: with death the ticks a bud lives are geometric with mean 1 / DEATH", "[trees]") {
    const double death = 0.1;
    const auto compiled = compile(
        read_model(source_path("models/trees/buds.l"), {{{"DEATH", "0.1"}, {"BRANCHING", "0"}, {"PERIOD_0", "1"}}}));
    const LetterId bud = *source_of(*compiled).alphabet.find("Bud", 2);
    std::vector<double> lives;
    int beyond = 0;
    for (int seed = 0; seed < 2000; ++seed) {
        DerivationSettings settings;
        settings.seed = static_cast<std::uint64_t>(seed);
        Derivation derivation(compiled, settings);
        ModuleString string, next;
        derivation.start(string);
        int ticks = 0;
        do {
            derivation.step(string, next);
            std::swap(string, next);
            ++ticks;
        } while (std::count(string.letters.begin(), string.letters.end(), bud) > 0);
        lives.push_back(ticks);
        if (ticks > 10) ++beyond;
    }
    // The mean has a standard error of sqrt(1 - q) / q / sqrt(2000) = 0.21.
    CHECK(mean_of(lives) == Approx(1 / death).margin(0.7));
    CHECK(beyond / 2000.0 == Approx(std::pow(1 - death, 10)).margin(0.04));
}

TEST_CASE("buds: every axis ends in a bud that lives or in the cross of a dead one", "[trees]") {
    for (const std::uint64_t seed : {61u, 62u, 63u}) {
        LonePlant tree("models/trees/buds.l", {{"DEATH", "0.04"}}, seed);
        tree.grow(40);
        auto counts = tree.counts();
        const int branches = counts["["] - counts["Leaf"];
        CHECK(counts["Dead"] > 0);
        CHECK(counts["Dead"] + counts["Bud"] == 1 + branches);
        const auto& internodes = tree.interpretation.geometry.internodes;
        CHECK(static_cast<int>(internodes.size()) == counts["Internode"] + 4 * counts["Dead"]);
    }
}

TEST_CASE("buds: with vigour V a bud rests with probability PAUSE ^ V, and internodes are V times as long", "[trees]") {
    for (const double vigour : {0.6, 1.7}) {
        std::vector<double> lengths;
        for (std::uint64_t seed = 500; seed < 800; ++seed) {
            LonePlant axis("models/trees/buds.l",
                           {{"DEATH", "0"},
                            {"BRANCHING", "0"},
                            {"PAUSE", "0.3"},
                            {"LENGTH", "1"},
                            {"VIGOUR", std::to_string(vigour)}},
                           seed);
            axis.grow(40);
            for (const Internode& internode : axis.interpretation.geometry.internodes) {
                CHECK(length_of(internode) == Approx(vigour));
            }
            lengths.push_back(axis.counts()["Internode"]);
        }
        const double grows = 1 - std::pow(0.3, vigour);
        CHECK(mean_of(lengths) == Approx(20 * grows).margin(4 * std::sqrt(20 * grows * (1 - grows) / 300)));
    }
}

TEST_CASE("buds: a tree of the library never shrinks with age, and the same seed gives the same tree", "[trees]") {
    const std::string species = GENERATE("coffee", "poplar", "spruce");
    const auto size = [](const World& world) {
        glm::dvec2 extent(0);  // height and radius
        for (const Internode& internode : world.interpretation(0).geometry.internodes) {
            extent = glm::max(extent, glm::dvec2(internode.tip.y, std::hypot(internode.tip.x, internode.tip.z)));
        }
        return extent;
    };
    for (const std::uint64_t seed : {81u, 82u}) {
        INFO(species << ", seed " << seed);
        SceneOptions options;
        options.seed = seed;
        const Scene scene = read_scene(source_path("environments/buds/" + species + ".toml"), options);
        World tree(scene), same(scene);
        tree.start();
        same.start();
        double height = 0;
        while (!tree.at_end()) {
            tree.step();
            same.step();
            CHECK(size(tree).x >= height);
            height = size(tree).x;
        }
        CHECK(tree.string(0).parameters == same.string(0).parameters);
        CHECK(height > (species == "coffee" ? 1 : 5));
        CHECK((height > 4 * size(tree).y) == (species == "poplar"));
    }
}

TEST_CASE("buds: coffee has opposite branches in crossing pairs, and spruce whorls of up to five", "[trees]") {
    SceneOptions options;
    options.seed = 83;
    for (const auto& [species, most] : {std::pair{"coffee", 2}, std::pair{"spruce", 5}}) {
        options.overrides = {{"plant.0.turtle.tropism", "[]"}};
        const auto tree = grown(std::string("environments/buds/") + species + ".toml", options);
        // Azimuths of the branches of each node of the trunk, by its height in internodes.
        std::map<long, std::vector<double>> nodes;
        const auto& internodes = tree->interpretation(0).geometry.internodes;
        const double length = internodes.front().tip.y;
        for (const Internode& internode : internodes) {
            if (internode.order != 1 || std::hypot(internode.base.x, internode.base.z) > 1e-9) continue;
            const glm::dvec3 direction = direction_of(internode);
            nodes[std::lround(internode.base.y / length)].push_back(std::atan2(direction.z, direction.x) * 180 /
                                                                    std::numbers::pi);
        }
        CHECK(nodes.size() > 8);
        const double between = 360. / most, turn = most == 2 ? 90 : 37;
        const auto& [first_node, first] = *nodes.begin();
        for (const auto& [node, azimuths] : nodes) {
            CHECK(azimuths.size() <= static_cast<std::size_t>(most));
            const double turned = turn * static_cast<double>(node - first_node);
            for (const double azimuth : azimuths) {
                // The turtle's roll is seen from above, or from below.
                const double left = std::remainder(azimuth - first[0] - turned, between);
                const double right = std::remainder(azimuth - first[0] + turned, between);
                CHECK(std::min(std::abs(left), std::abs(right)) < 1e-6);
            }
        }
    }
}

TEST_CASE("buds: half the period makes twice the nodes, and nodes bear the buds of the table", "[trees]") {
    LonePlant tree("models/trees/buds.l",
                   {{"DEATH", "0"}, {"PAUSE", "0"}, {"BRANCHING", "1"}, {"BUDS_0", "3"}, {"BUDS_1", "2"}});
    tree.grow(12);
    std::map<int, int> internodes, buds;
    for (double order : values_of(tree.string, tree.model->alphabet, "Internode")) ++internodes[int(order)];
    for (double order : values_of(tree.string, tree.model->alphabet, "Bud")) ++buds[int(order)];
    CHECK(internodes[0] == 6);
    CHECK(buds[1] == 3 * internodes[0]);
    CHECK(buds[2] == 2 * internodes[1]);
    CHECK(tree.counts()["Leaf"] == tree.counts()["Internode"]);

    const auto nodes_of_first_branchlet = [](const char* period) {
        LonePlant plant("models/trees/buds.l", {{"DEATH", "0"},
                                                {"PAUSE", "0"},
                                                {"BRANCHING", "1"},
                                                {"BUDS_0", "1"},
                                                {"BUDS_1", "0"},
                                                {"PERIOD_1", period}});
        plant.grow(10);  // the first branch begins at step 2 and has 8 steps
        int count = 0;
        for (const Internode& internode : plant.interpretation.geometry.internodes) {
            if (internode.axis == 1) ++count;
        }
        return count;
    };
    CHECK(nodes_of_first_branchlet("2") == 4);
    CHECK(nodes_of_first_branchlet("1") == 8);
}

TEST_CASE("strahler: a perfect binary tree of depth k has order k + 1, a caterpillar 2", "[trees]") {
    for (int depth = 1; depth <= 6; ++depth) {
        const std::string text = std::to_string(depth);
        LonePlant perfect("models/trees/strahler.l", {{"SHAPE", "0"}, {"DEPTH", text}});
        perfect.grow(2 * depth + 4);
        const auto orders = values_of(perfect.string, perfect.model->alphabet, "I");
        CHECK(orders.size() == (std::size_t(2) << depth) - 1);
        CHECK(orders.front() == depth + 1);

        LonePlant caterpillar("models/trees/strahler.l", {{"SHAPE", "1"}, {"DEPTH", text}});
        caterpillar.grow(2 * depth + 4);
        CHECK(values_of(caterpillar.string, caterpillar.model->alphabet, "I").front() == 2);
    }
}

TEST_CASE("strahler: every fork obeys the rule of equal children", "[trees]") {
    LonePlant tree("models/trees/strahler.l", {{"DEPTH", "10"}});
    tree.grow(30);
    int raised = 0;
    for (const Fork& fork : forks_of(tree)) {
        if (fork.children.empty()) {
            CHECK(fork.parent == 1);
            continue;
        }
        REQUIRE(fork.children.size() == 2);
        const double a = fork.children[0], b = fork.children[1];
        CHECK(fork.parent == (a == b ? a + 1 : std::max(a, b)));
        if (a == b) ++raised;
    }
    CHECK(raised > 5);
}

TEST_CASE("pipe-model: r^n adds up at every fork, and the base carries r0 k^(1/n)", "[trees]") {
    for (double n : {2.0, 2.5, 3.0}) {
        LonePlant tree("models/trees/pipe-model.l", {{"N", std::to_string(n)}});
        tree.grow(tree.derivation.length());
        int forks = 0, unary = 0;
        for (const Fork& fork : forks_of(tree)) {
            REQUIRE(fork.parent > 0);
            if (fork.children.size() == 1) {
                CHECK(fork.parent == fork.children[0]);
                ++unary;
            } else if (fork.children.size() == 2) {
                const double sum = std::pow(fork.children[0], n) + std::pow(fork.children[1], n);
                CHECK(std::pow(fork.parent, n) == Approx(sum).epsilon(1e-9));
                ++forks;
            } else {
                CHECK(fork.parent == 0.01);
            }
        }
        CHECK(forks > 30);
        CHECK(unary > 30);
        CHECK(forks_of(tree).front().parent == Approx(0.01 * std::pow(tree.counts()["T"], 1 / n)).epsilon(1e-9));
    }
}

TEST_CASE("vigour: what buds get adds up to ALPHA times their number; with an even share the tree is full", "[trees]") {
    for (const char* share : {"0.5", "0.58", "0.7"}) {
        LonePlant tree("models/trees/vigour.l", {{"LAMBDA", share}, {"ALPHA", "1.2"}});
        for (int year = 1; year <= 7; ++year) {
            tree.grow(year == 1 ? 31 : 32);  // to the last step of the year
            const std::vector<double> vigour = values_of(tree.string, tree.model->alphabet, "T");
            double sum = 0;
            for (double each : vigour) {
                REQUIRE(each >= 0);
                sum += each;
            }
            const double buds = static_cast<double>(vigour.size());
            CHECK(sum == Approx(1.2 * buds).epsilon(1e-12));
            if (std::string(share) == "0.5") CHECK(vigour.size() == std::size_t(1) << (year - 1));
        }
    }
}

TEST_CASE("vigour: the more the straight axis is favoured, the taller and narrower the tree", "[trees]") {
    double slenderness = 0;
    for (const char* share : {"0.5", "0.58", "0.7"}) {
        LonePlant tree("models/trees/vigour.l", {{"LAMBDA", share}});
        tree.grow(10 * 32);
        const Box& box = tree.interpretation.geometry.bounds;
        const double width = std::max(box.upper.x - box.lower.x, box.upper.z - box.lower.z);
        CHECK(box.upper.y / width > 1.05 * slenderness);
        slenderness = box.upper.y / width;
    }
}

TEST_CASE("maple: the areas of two limbs add up to that of their parent", "[trees]") {
    LonePlant tree("models/trees/maple.l");
    tree.grow(5);
    const PlantGeometry& geometry = tree.interpretation.geometry;
    int forks = 0;
    const auto children = children_of(geometry);
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (children[i].size() != 2) continue;
        double area = 0;
        for (const std::size_t child : children[i]) {
            area += geometry.internodes[child].base_radius * geometry.internodes[child].base_radius;
        }
        CHECK(area == Approx(geometry.internodes[i].tip_radius * geometry.internodes[i].tip_radius));
        ++forks;
    }
    CHECK(forks == 15);
}

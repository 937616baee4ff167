// Plants of published procedures: Holton's strands, Viennot's ramification matrices, Reeves' and Blau's particles.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <fmt/format.h>

#include <map>

using Catch::Contains;
using namespace espalier;

namespace {

/// The modules of one symbol as a tree: parameters, and the places of those that grow from each, side branches first.
struct ModuleTree {
    std::vector<std::vector<double>> nodes;
    std::vector<std::vector<std::size_t>> children;
    std::vector<int> sides;  ///< side of the bracket a node begins: 1 left, -1 right, 0 none
};

ModuleTree tree_of(const LonePlant& plant, const std::string& symbol) {
    constexpr auto none = std::size_t(-1);
    const Alphabet& alphabet = plant.model->alphabet;
    const std::vector<std::size_t> offsets = parameter_offsets(plant.string, alphabet);
    ModuleTree tree;
    tree.nodes = parameters_of(plant.string, alphabet, symbol);
    tree.children.resize(tree.nodes.size());
    tree.sides.resize(tree.nodes.size());
    std::vector<std::size_t> stack;
    std::size_t last = none, next = 0;
    int side = 0;
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        const std::string& name = alphabet.name(plant.string.letters[i]);
        if (name == "[") stack.push_back(last);
        if (name == "+") side = plant.string.parameters[offsets[i]] < 0 ? -1 : 1;
        if (name == "]") {
            last = stack.back();
            stack.pop_back();
        }
        if (name != symbol) continue;
        if (last != none) tree.children[last].push_back(next);
        tree.sides[next] = side;
        last = next++;
    }
    return tree;
}

LonePlant grown_tree(const std::string& name, Defines defines, std::uint64_t seed = 0) {
    LonePlant plant(fmt::format("models/trees/{}.l", name), std::move(defines), seed);
    for (double step = 0; step < plant.derivation.length() && !plant.derivation.stopped(); ++step) plant.grow(1);
    return plant;
}

/// The string alone, which no query changes, at the end of the derivation.
LonePlant derived_tree(const std::string& name, Defines defines, std::uint64_t seed) {
    LonePlant plant(fmt::format("models/trees/{}.l", name), std::move(defines), seed);
    for (double step = 0; step < plant.derivation.length() && !plant.derivation.stopped(); ++step) {
        ModuleString next;
        plant.derivation.step(plant.string, next);
        plant.string = std::move(next);
    }
    return plant;
}

}  // namespace

TEST_CASE("holton: 2500 strands of a fir part into 2461.53 and 38.47, at 1.770 and 113.230 degrees", "[trees]") {
    LonePlant fir("models/trees/holton.l", {{"WHOLE", "0"}});
    fir.grow(1);
    const auto strands = values_of(fir.string, fir.model->alphabet, "Internode");
    REQUIRE(strands.size() == 3);
    CHECK(strands[1] == Approx(38.47).epsilon(1e-12));
    CHECK(strands[2] == Approx(2461.53).epsilon(1e-12));
    const auto& internodes = fir.interpretation.geometry.internodes;
    const glm::dvec3 trunk = direction_of(internodes[0]);
    CHECK(degrees_between(trunk, direction_of(internodes[2])) == Approx(1.770).margin(5e-4));
    CHECK(degrees_between(trunk, direction_of(internodes[1])) == Approx(113.230).margin(5e-4));
}

TEST_CASE("holton: strands and squares of diameters are kept at every fork, and end in as many tips", "[trees]") {
    const LonePlant fir = derived_tree("holton", {{"STRANDS", "600"}}, 0);
    const ModuleTree tree = tree_of(fir, "Internode");
    std::size_t tips = 0, forks = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const double strands = tree.nodes[i][0];
        CHECK(strands == std::floor(strands));
        if (tree.children[i].empty()) {
            CHECK(strands == 1);
            ++tips;
            continue;
        }
        REQUIRE(tree.children[i].size() == 2);
        ++forks;
        CHECK(tree.nodes[tree.children[i][0]][0] + tree.nodes[tree.children[i][1]][0] == strands);
    }
    CHECK(tips == 600);
    CHECK(forks == 599);
    // Diameters and angles, in the drawing.
    const LonePlant small = grown_tree("holton", {{"STRANDS", "60"}});
    const PlantGeometry& geometry = small.interpretation.geometry;
    const auto children = children_of(geometry);
    int measured = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (children[i].size() != 2) continue;
        const Internode &parent = geometry.internodes[i], &off = geometry.internodes[children[i][0]],
                        &on = geometry.internodes[children[i][1]];
        const double area = off.tip_radius * off.tip_radius + on.tip_radius * on.tip_radius;
        CHECK(area == Approx(parent.tip_radius * parent.tip_radius).epsilon(1e-9));
        CHECK(degrees_between(direction_of(off), direction_of(on)) == Approx(parent.order == 0 ? 115 : 35));
        ++measured;
    }
    CHECK(measured == 59);
}

TEST_CASE("holton: shares and angles are those of Gravelius' and Weibel's order, as a separate program finds",
          "[trees]") {
    // A branch of s strands, its order, and the forks that lead to it; then those that grow from it, side branch first.
    struct Tables {
        double share[2][2] = {{0.985, 0.55}, {0.6, 0.7}}, angle[2][2] = {{115, 55}, {35, 45}};
    } const tables;
    for (const int crown : {0, 3, 12}) {
        struct Branch {
            double strands;
            int order, forks;
        };
        std::vector<Branch> expected;
        std::vector<double> angles;
        const auto part = [&](const auto& again, const Branch& branch) -> void {
            expected.push_back(branch);
            if (branch.strands < 2) return;
            const int g = std::min(branch.order, 1), w = branch.forks >= crown;
            const double on = 1 + std::round(tables.share[g][w] * (branch.strands - 2));
            angles.push_back(tables.angle[g][w]);
            again(again, {branch.strands - on, branch.order + 1, branch.forks + 1});
            again(again, {on, branch.order, branch.forks + 1});
        };
        part(part, {90, 0, 0});

        const LonePlant tree =
            grown_tree("holton", {{"STRANDS", "90"}, {"CROWN", std::to_string(crown)}, {"CROWN_SHARE_1", "0.7"}});
        const ModuleTree branches = tree_of(tree, "Internode");
        REQUIRE(branches.nodes.size() == expected.size());
        std::vector<int> forks(expected.size(), 0);
        const auto& internodes = tree.interpretation.geometry.internodes;
        std::map<double, int> found, wanted;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            CHECK(branches.nodes[i][0] == expected[i].strands);
            for (const std::size_t child : branches.children[i]) forks[child] = forks[i] + 1;
            CHECK(forks[i] == expected[i].forks);
        }
        const auto children = children_of(tree.interpretation.geometry);
        for (const auto& pair : children) {
            if (pair.size() != 2) continue;
            ++found[std::round(degrees_between(direction_of(internodes[pair[0]]), direction_of(internodes[pair[1]])))];
        }
        for (const double angle : angles) ++wanted[angle];
        CHECK(found == wanted);
        // The ends of the string know their orders.
        std::size_t end = 0;
        const auto tips = parameters_of(tree.string, tree.model->alphabet, "Tip");
        for (const Branch& branch : expected) {
            if (branch.strands >= 2) continue;
            CHECK(tips[end][2] == branch.order);
            CHECK(tips[end++][3] == branch.forks);
        }
        CHECK(end == tips.size());
    }
}

TEST_CASE("holton: lengths go with the root of the strands, within their bounds; drawn ones do not act on", "[trees]") {
    const LonePlant fir = derived_tree("holton", {{"STRANDS", "200"}}, 0);
    const auto tips = parameters_of(fir.string, fir.model->alphabet, "Tip");
    // The trunk is never clamped: its last end has the length 0.1 sqrt(1 / 200).
    for (const auto& tip : tips) {
        if (tip[2] == 0) CHECK(tip[1] == Approx(0.1 * std::sqrt(1. / 200)).epsilon(1e-9));
    }
    LonePlant first("models/trees/holton.l");
    first.grow(1);
    const auto ends = parameters_of(first.string, first.model->alphabet, "Tip");
    const auto internodes = parameters_of(first.string, first.model->alphabet, "Internode");
    const double off = internodes[1][0], ratio = std::sqrt(off / 2500);
    REQUIRE(off == 38);
    CHECK(ratio < 9);
    CHECK(ends[0][1] == Approx(0.1 * 9));        // at its lower bound
    CHECK(internodes[1][1] == Approx(0.1 * 3));  // drawn at another
    CHECK(internodes[2][1] == Approx(0.1 * std::sqrt(2462. / 2500)));
}

TEST_CASE("ramification: trees have the Strahler number and the matrix that were asked for, from fresh seeds",
          "[trees]") {
    const std::vector<std::vector<double>> mine = {{0.3, 0.7}, {0.6, 0.2, 0.2}, {0.5, 0.3, 0.1, 0.1}};
    const auto wanted_part = [&](int matrix, int k, int j) {
        if (matrix == 0) return std::pow(0.5, std::min(j, k - 1));
        if (matrix == 1) return j == k ? 1. : 0.;
        if (matrix == 2) return j == k ? 0.2 : j == k - 1 ? 0.8 : 0;
        return mine[std::size_t(k - 2)][std::size_t(j - 1)];
    };
    const std::vector<std::pair<int, int>> asked = {{0, 7}, {0, 8}, {1, 9}, {2, 5}, {3, 4}};
    double squares = 0;
    int parts = 0;
    for (const auto& [matrix, order] : asked) {
        for (const std::uint64_t seed : {11u, 12u, 13u}) {
            const LonePlant tree = derived_tree(
                "ramification", {{"MATRIX", std::to_string(matrix)}, {"ORDER", std::to_string(order)}}, seed);
            for (const double left : values_of(tree.string, tree.model->alphabet, "Apex")) REQUIRE(left == 1);
            const ModuleTree edges = tree_of(tree, "Edge");
            CHECK(edges.nodes.front()[0] == order);
            std::map<int, int> forks;
            std::map<std::pair<int, int>, int> bi_orders;
            for (std::size_t i = 0; i < edges.nodes.size(); ++i) {
                const int k = static_cast<int>(edges.nodes[i][0]);
                if (edges.children[i].empty()) {
                    CHECK(k == 1);
                    continue;
                }
                REQUIRE(edges.children[i].size() == 2);
                const int low = static_cast<int>(edges.nodes[edges.children[i][0]][0]);
                const int high = static_cast<int>(edges.nodes[edges.children[i][1]][0]);
                CHECK(k == (low == high ? low + 1 : std::max(low, high)));  // Strahler's rule
                ++forks[k];
                ++bi_orders[{k, low == high ? k : low}];
            }
            for (const auto& [k, count] : forks) {
                for (int j = 1; j <= k; ++j) {
                    const double wanted = wanted_part(matrix, k, j);
                    const double part = bi_orders[{k, j}] / static_cast<double>(count);
                    INFO("matrix " << matrix << ", row " << k << ", column " << j << " of " << count << " forks");
                    if (wanted == 0 || wanted == 1) {
                        CHECK(part == wanted);
                    } else if (count > 100) {
                        const double errors = (part - wanted) / std::sqrt(wanted * (1 - wanted) / count);
                        CHECK(std::abs(errors) < 4);
                        squares += errors * errors;
                        ++parts;
                    }
                }
            }
        }
    }
    CHECK(parts > 60);
    CHECK(squares / parts < 1.5);  // errors of chance have a mean square of 1
}

TEST_CASE("ramification: a matrix that is none is an error, and the default one has a row for each order", "[trees]") {
    const auto derive = [](const std::string& order, const std::string& matrix) {
        return derived_tree("ramification", {{"MATRIX", "3"}, {"ORDER", order}, {"MINE", matrix}}, 1);
    };
    CHECK_THROWS_WITH(derive("2", "0.3, 0.6"),
                      Contains("ramification.l:") && Contains("row 2 of the matrix sums to 0.9"));
    CHECK_THROWS_WITH(derive("2", "-0.5, 1.5"), Contains("row 2 of the matrix has a negative part: -0.5"));
    CHECK_THROWS_WITH(derive("3", "0.3, 0.7"), Contains("MINE has no row 3, and ORDER is 3: add its 3 parts"));
    CHECK(derived_tree("ramification", {{"MATRIX", "3"}}, 1).counts().at("Apex") > 64);
}

TEST_CASE("ramification: widths depend on the order alone, sides are by chance, in turn or one", "[trees]") {
    const LonePlant tree = grown_tree("ramification", {{"ORDER", "5"}}, 2);
    std::map<double, double> widths;
    const auto& geometry = tree.interpretation.geometry;
    const auto orders = values_of(tree.string, tree.model->alphabet, "Edge");
    REQUIRE(orders.size() == geometry.internodes.size());
    for (std::size_t i = 0; i < orders.size(); ++i) {
        const double radius = geometry.internodes[i].tip_radius;
        CHECK(widths.try_emplace(orders[i], radius).first->second == radius);
    }
    CHECK(widths.size() == 5);
    // Sides of the smaller branches along the axis that keeps the order of the root.
    for (const int sides : {0, 1, 2}) {
        const LonePlant fern = grown_tree(
            "ramification", {{"MATRIX", "2"}, {"ORDER", "2"}, {"FERN", "40"}, {"SIDES", std::to_string(sides)}}, 5);
        std::string seen;
        const ModuleTree edges = tree_of(fern, "Edge");
        for (std::size_t i = 0; i < edges.nodes.size(); ++i) {
            if (!edges.children[i].empty()) seen += edges.sides[edges.children[i][0]] > 0 ? 'l' : 'r';
        }
        REQUIRE(seen.size() > 8);
        const bool alternates = seen.find("ll") == std::string::npos && seen.find("rr") == std::string::npos;
        CHECK(alternates == (sides == 1));
        CHECK((seen.find('r') == std::string::npos) == (sides == 2));
    }
}

TEST_CASE("structured-particles: branches end inside the outline, and short ones alone bear particles", "[trees]") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const LonePlant tree = grown_tree("structured-particles", {}, seed);
        CHECK(parameters_of(tree.string, tree.model->alphabet, "Branch").empty());
        const double height = tree.interpretation.geometry.internodes.front().tip.y / 0.22;
        const double middle = height * 0.61, half_height = height * 0.39, half_width = 2.75;
        std::size_t ends = 0;
        for (const Internode& internode : tree.interpretation.geometry.internodes) {
            if (internode.order == 0) continue;
            const glm::dvec3 tip = internode.tip;
            const double square = (tip.x * tip.x + tip.z * tip.z) / (half_width * half_width) +
                                  (tip.y - middle) * (tip.y - middle) / (half_height * half_height);
            CHECK(square <= 1);
            ++ends;
        }
        CHECK(ends > 500);
        const std::vector<double> twigs = values_of(tree.string, tree.model->alphabet, "Twig");
        REQUIRE(twigs.size() > 300);
        for (const double length : twigs) CHECK(length < 0.75);
        CHECK(tree.counts().at("Particle") == 9 * static_cast<int>(twigs.size()));
        // Longer branches are six segments each.
        const auto segments = values_of(tree.string, tree.model->alphabet, "F");
        for (const double length : segments) CHECK(length >= 0.75 / 6 - 1e-12);
    }
}

TEST_CASE("structured-particles: the mean height of 1000 trees is the one that was set", "[trees]") {
    const auto compiled = compile(read_model(source_path("models/trees/structured-particles.l"), {}));
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        DerivationSettings settings;
        settings.seed = seed;
        Derivation derivation(compiled, settings);
        ModuleString string;
        derivation.start(string);
        sum += values_of(string, source_of(*compiled).alphabet, "Trunk", 1).front();
    }
    CHECK(sum / 1000 == Approx(9).epsilon(0.01));
}

TEST_CASE("grass: blades are parabolas that their particles flew, as high on average as the formula says", "[herbs]") {
    constexpr int least = 9, most = 12;
    constexpr double gravity = 0.0045, speed = 0.055, lean = 28 * std::numbers::pi / 180;
    double expected = 0;
    for (int n = least; n <= most; ++n) {
        expected += (n * speed * std::sin(lean) / lean - gravity / 2 * n * n) / (most - least + 1);
    }
    for (const std::uint64_t seed : {71u, 72u, 73u}) {
        LonePlant grass("models/herbs/grass.l", {{"TUFTS", "200"}}, seed);
        grass.grow(most);
        // Blade by blade: each begins on the ground.
        std::vector<std::vector<glm::dvec3>> blades;
        for (const Internode& internode : grass.interpretation.geometry.internodes) {
            CHECK(internode.order == 2);
            if (std::abs(internode.base.y) < 1e-12) blades.push_back({internode.base});
            CHECK(glm::distance(blades.back().back(), internode.base) < 1e-12);
            blades.back().push_back(internode.tip);
        }
        REQUIRE(blades.size() == 200 * 45);
        double heights = 0;
        for (const std::vector<glm::dvec3>& nodes : blades) {
            const int pieces = static_cast<int>(nodes.size()) - 1;
            CHECK((pieces >= least && pieces <= most));
            heights += nodes.back().y;
            for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
                const glm::dvec3 bend = nodes[i + 1] - 2. * nodes[i] + nodes[i - 1];
                CHECK(glm::distance(bend, glm::dvec3(0, -gravity, 0)) < 1e-12);
            }
            const glm::dvec3 first = nodes[1] - nodes[0] + glm::dvec3(0, gravity / 2, 0);
            CHECK(degrees_between(first, {0, 1, 0}) <= 28 + 1e-9);
            CHECK(std::abs(glm::length(first) - speed) <= 0.025 + 1e-12);
        }
        CHECK(heights / static_cast<double>(blades.size()) == Approx(expected).epsilon(0.01));
    }
}

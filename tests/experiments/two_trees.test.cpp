// Two trees that compete for light (Mech & Prusinkiewicz 1996, section 6), and their controls.
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "experiments/growth.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace espalier;

namespace {

constexpr int cycles = 16;

/// The last step of a cycle: cycle c has c + 3 steps.
constexpr int end_of(int cycle) {
    return cycle * (cycle + 7) / 2;
}

/// An internode as the string tells it: I(length, width, flow, terminals).
struct Stem {
    double length, width, flow, terminals;
    bool is_scar() const { return length == 0 && width > 0; }
};

/// A plant's string with what the tests ask of it.
class Tree {
public:
    Tree(const World& world, std::size_t plant)
        : string_(world.string(plant)),
          offsets_(parameter_offsets(string_, world.model(plant).alphabet)),
          internode_(*world.model(plant).alphabet.find("I", 4)),
          cluster_(*world.model(plant).alphabet.find("N", 3)),
          roll_(*world.model(plant).alphabet.find("/", 1)),
          geometry_(world.interpretation(plant).geometry) {
        link_branches(string_, links_);
    }

    std::vector<Stem> stems() const {
        std::vector<Stem> stems;
        for (std::size_t i = 0; i < string_.size(); ++i) {
            if (string_.letters[i] == internode_) stems.push_back(stem(i));
        }
        return stems;
    }
    std::size_t cuts() const {
        return static_cast<std::size_t>(std::count(string_.letters.begin(), string_.letters.end(), Alphabet::cut));
    }

    /// Along x from the trunk, of every leaf cluster that no cut will remove.
    std::vector<double> clusters() const {
        const std::vector<bool> lost = behind_cuts();
        std::vector<double> clusters;
        std::uint32_t last = 0;  // a cluster is drawn as several leaves
        for (const Organ& leaf : geometry_.organs) {
            if (string_.letters[leaf.module] != cluster_ || lost[leaf.module] || leaf.module == last) continue;
            clusters.push_back(leaf.pose.position.x - trunk_x());
            last = leaf.module;
        }
        return clusters;
    }
    double trunk_x() const { return geometry_.internodes.front().base.x; }

    /// The largest relative error of w^2.5 = w1^2.5 + w2^2.5 over all forks.
    double worst_fork() const {
        double worst = 0;
        for (std::size_t i = 0; i < string_.size(); ++i) {
            if (string_.letters[i] != roll_) continue;
            const std::size_t main = i + 1, side = links_.partner[main] + 1;
            const double daughters = std::pow(first_stem(main).width, 2.5) + std::pow(first_stem(side).width, 2.5);
            worst = std::max(worst, std::abs(std::pow(stem_below(i).width, 2.5) / daughters - 1));
        }
        return worst;
    }
    std::size_t forks() const {
        return static_cast<std::size_t>(std::count(string_.letters.begin(), string_.letters.end(), roll_));
    }

private:
    Stem stem(std::size_t i) const {
        const double* p = &string_.parameters[offsets_[i]];
        return {p[0], p[1], p[2], p[3]};
    }
    Stem first_stem(std::size_t bracket) const {
        REQUIRE(string_.letters[bracket] == Alphabet::open_bracket);
        REQUIRE(string_.letters[bracket + 2] == internode_);
        return stem(bracket + 2);
    }
    Stem stem_below(std::size_t roll) const {
        while (string_.letters[roll] != internode_) --roll;
        return stem(roll);
    }
    std::vector<bool> behind_cuts() const {
        std::vector<bool> lost(string_.size());
        for (std::size_t i = 0; i < string_.size(); ++i) {
            if (string_.letters[i] != Alphabet::cut) continue;
            const std::uint32_t open = links_.partner[i];
            const std::size_t end = open == BranchLinks::none ? string_.size() : links_.partner[open];
            std::fill(lost.begin() + static_cast<std::ptrdiff_t>(i), lost.begin() + static_cast<std::ptrdiff_t>(end),
                      true);
        }
        return lost;
    }

    const ModuleString& string_;
    std::vector<std::size_t> offsets_;
    LetterId internode_, cluster_, roll_;
    const PlantGeometry& geometry_;
    BranchLinks links_;
};

/// A crown at the end of a cycle.
struct TurnedCrown {
    double leaves = 0, to_right = 0;

    explicit TurnedCrown(const std::vector<double>& clusters)
        : leaves(static_cast<double>(clusters.size())),
          to_right(
              static_cast<double>(std::count_if(clusters.begin(), clusters.end(), [](double x) { return x > 0; }))) {}
    /// Leaves to the right less leaves to the left, as a fraction of all.
    double asymmetry() const { return (2 * to_right - leaves) / leaves; }
};

/// A tree's life in a scene.
struct Life {
    std::vector<TurnedCrown> crowns;  ///< crowns[c - 1] at the end of cycle c
    std::vector<Stem> cut;            ///< branches that were cut, as they were in the step before
    std::vector<Stem> spared;         ///< those that were not, in the steps in which some tree sheds
    double worst_fork = 0;
    std::size_t forks = 0;
    std::vector<double> trunk_x;  ///< in every frame
    std::string text;             ///< at the end of the last cycle
};

/// Internodes are neither made nor lost in a step that cuts, so they are the same ones in the same order.
void note_cuts(Life& life, const std::vector<Stem>& before, const Tree& tree) {
    const std::vector<Stem> now = tree.stems();
    std::size_t scars = 0;
    REQUIRE(now.size() == before.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (before[i].length == 0) continue;
        scars += now[i].is_scar();
        (now[i].is_scar() ? life.cut : life.spared).push_back(before[i]);
    }
    CHECK(scars == tree.cuts());
}

std::vector<Life> lives(const std::string& file, const SceneOptions& options = {}) {
    const Scene scene = read_scene(source_path("environments/" + file), options);
    World world(scene);
    world.start();
    std::vector<Life> lives(world.size());
    for (std::size_t i = 0; i < world.size(); ++i) lives[i].trunk_x.push_back(Tree(world, i).trunk_x());
    for (int step = 1, cycle = 1; step <= world.last_step(); ++step) {
        std::vector<std::vector<Stem>> before;
        for (std::size_t i = 0; i < world.size(); ++i) before.push_back(Tree(world, i).stems());
        world.step();
        for (std::size_t i = 0; i < world.size(); ++i) {
            const Tree tree(world, i);
            lives[i].trunk_x.push_back(tree.trunk_x());
            if (step != end_of(cycle) || cycle > cycles) {
                CHECK(tree.cuts() == 0);
                continue;
            }
            lives[i].crowns.emplace_back(tree.clusters());
            note_cuts(lives[i], before[i], tree);
            lives[i].worst_fork = std::max(lives[i].worst_fork, tree.worst_fork());
            lives[i].forks += tree.forks();
            lives[i].text = to_text(world.string(i), world.model(i).alphabet);
        }
        cycle += step == end_of(cycle);
    }
    return lives;
}

// Each scene is grown once for all tests.
const std::vector<Life>& two_trees() {
    static const std::vector<Life> run = lives("two-trees.toml");
    return run;
}

const Life& lone_tree() {
    static const std::vector<Life> run = lives("lone-tree.toml");
    return run.front();
}

double ratio_of_last(const Life& life, int count) {
    return std::pow(life.crowns[cycles - 1].leaves / life.crowns[cycles - 1 - count].leaves, 1.0 / count);
}

}  // namespace

TEST_CASE("two trees: both crowns lean away from the neighbour, by more than 0.15 against the lone tree",
          "[two-trees]") {
    for (int cycle : {10, cycles}) {
        const auto lean = [&](const Life& life) { return life.crowns.at(cycle - 1).asymmetry(); };
        const double left = lean(two_trees()[0]) - lean(lone_tree()), right = lean(two_trees()[1]) - lean(lone_tree());
        CAPTURE(cycle, left, right, lean(lone_tree()));
        CHECK(left < -0.15);
        CHECK(right > 0.15);
    }
}

TEST_CASE("two trees: whatever the strength and the kind of shadows, both lean away after 10 cycles", "[two-trees]") {
    using Light = std::vector<std::pair<std::string, std::string>>;
    const std::vector<Light> others{{{"strength", "0.3"}},
                                    {{"strength", "0.7"}},
                                    {{"strength", "0.4"}, {"dissipation", "1.5"}},
                                    {{"strength", "0.2"}, {"mode", "\"add\""}},
                                    {{"strength", "0.15"}, {"voxel", "1"}}};
    for (const Light& light : others) {
        SceneOptions options;
        for (const auto& [key, value] : light) options.overrides.emplace_back("environment.light." + key, value);
        options.steps = end_of(10);
        const std::vector<Life> two = lives("two-trees.toml", options), lone = lives("lone-tree.toml", options);
        const double alone = lone.front().crowns.back().asymmetry();
        CAPTURE(light, alone);
        CHECK(two[0].crowns.back().asymmetry() < alone - 0.1);
        CHECK(two[1].crowns.back().asymmetry() > alone + 0.1);
    }
}

TEST_CASE("two trees: in the light that their drawn leaves leave, by Beer's law and by rays, both lean away",
          "[two-trees][canopy-light][ray-light]") {
    for (const std::string process : {"canopy-light\", voxel = 0.5, beams = 1", "ray-light\", paths = 1024"}) {
        SceneOptions options;
        options.overrides = {{"environment.light", "{ process = \"" + process +
                                                       ", sky = { par = 1000, rings = 3, around = 6 }, bands = { par = "
                                                       "{ leaf = [0, 0], stem = 0, soil = 0 } } }"}};
        options.steps = end_of(10);
        const std::vector<Life> two = lives("two-trees.toml", options), lone = lives("lone-tree.toml", options);
        const double alone = lone.front().crowns.back().asymmetry();
        const TurnedCrown &left = two[0].crowns.back(), &right = two[1].crowns.back();
        CAPTURE(process, alone, left.asymmetry(), right.asymmetry(), left.leaves, right.leaves,
                lone.front().crowns.back().leaves);
        CHECK(left.asymmetry() < alone - 0.1);
        CHECK(right.asymmetry() > alone + 0.1);
        CHECK(left.leaves + right.leaves < 1.8 * lone.front().crowns.back().leaves);
    }
}

TEST_CASE("two trees: less than 0.35 of each tree's leaves are on the side of the neighbour", "[two-trees]") {
    const TurnedCrown &left = two_trees()[0].crowns.back(), &right = two_trees()[1].crowns.back();
    CAPTURE(left.leaves, left.to_right, right.leaves, right.to_right);
    CHECK(left.to_right / left.leaves < 0.35);
    CHECK(1 - right.to_right / right.leaves < 0.35);
    CHECK(std::abs(lone_tree().crowns.back().to_right / lone_tree().crowns.back().leaves - 0.5) < 0.1);
}

TEST_CASE("two trees: neighbours shade each other, so each bears fewer leaves than the lone tree", "[two-trees]") {
    for (const Life& life : two_trees()) CHECK(life.crowns.back().leaves < 0.8 * lone_tree().crowns.back().leaves);
}

TEST_CASE("two trees: 24 m apart each is the lone tree, letter by letter and value by value", "[two-trees]") {
    const std::vector<Life> apart = lives("two-trees-apart.toml");
    REQUIRE(lone_tree().crowns.size() == cycles);
    CHECK(lone_tree().text.size() > 100000);
    CHECK((apart[0].text == lone_tree().text));
    CHECK((apart[1].text == lone_tree().text));
}

TEST_CASE("two trees: without shade they are the unshaded lone tree, and no branch is cut in 7 cycles", "[two-trees]") {
    const std::vector<Life> unshaded = lives("two-trees-unshaded.toml");
    SceneOptions lone;
    lone.overrides = {{"plant.0.define", "{ SHADOW = 0 }"}};
    lone.steps = end_of(7);
    const Life alone = lives("lone-tree.toml", lone).front();
    for (const Life& life : unshaded) {
        REQUIRE(life.crowns.size() == 7);
        CHECK(life.cut.empty());
        CHECK(life.crowns.back().asymmetry() == alone.crowns.back().asymmetry());
        CHECK((life.text == alone.text));
    }
}

TEST_CASE("two trees: what is cut had no flow left and fewer than 25 terminals, and all such branches are cut",
          "[two-trees]") {
    const auto starves = [](const Stem& stem) { return stem.flow <= 0 && stem.terminals < 25; };
    for (const Life& life : two_trees()) {
        CHECK(life.cut.size() > 100);
        CHECK(std::all_of(life.cut.begin(), life.cut.end(), starves));
        CHECK(std::none_of(life.spared.begin(), life.spared.end(), starves));
    }
}

TEST_CASE("two trees: leaves double in each of the first cycles, and grow by less than a quarter in the last",
          "[two-trees]") {
    for (const Life& life : two_trees()) {
        for (std::size_t cycle = 3; cycle <= 7; ++cycle) {
            const double ratio = life.crowns[cycle - 1].leaves / life.crowns[cycle - 2].leaves;
            CAPTURE(cycle);
            CHECK(ratio > 1.9);
            CHECK(ratio < 2.4);
        }
        CHECK(ratio_of_last(life, 1) < 1.25);
        CHECK(ratio_of_last(life, 3) < 1.25);
    }
}

TEST_CASE("two trees: at every fork the widths to the power 2.5 add up", "[two-trees]") {
    for (const Life& life : two_trees()) {
        CHECK(life.forks > 5000);
        CHECK(life.worst_fork < 1e-12);
    }
}

TEST_CASE("two trees: the timeline holds the 90 frames in which the trees are moved apart", "[two-trees]") {
    const TemporaryFolder folder;
    RunOptions options;
    options.output = folder.path() / "timeline";
    const RunResult result = run(read_scene(source_path("environments/two-trees.toml")), options);
    CHECK(result.steps == end_of(cycles) + 90);
    const std::string collection = text_of(options.output / "plants.pvd");
    for (int step = 0; step <= result.steps; ++step) {
        REQUIRE(collection.find("timestep=\"" + std::to_string(step) + "\"") != std::string::npos);
    }
    const std::vector<double>&left = two_trees()[0].trunk_x, &right = two_trees()[1].trunk_x;
    for (int moved = 0; moved <= 90; ++moved) {
        const std::size_t frame = static_cast<std::size_t>(end_of(cycles) + moved);
        REQUIRE(left[frame] == Approx(-2 - 2 * moved / 90.0));
        REQUIRE(right[frame] == Approx(2 + 2 * moved / 90.0));
    }
}

// Species of Weber & Penn 1995: lengths, radii and numbers by the closed formulas of the paper.
#include "espalier/language/notation.h"

#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <fmt/format.h>

#include <set>

using namespace espalier;

namespace {

/// A species of a few lines, grown to its end.
struct GrownSpecies {
    std::shared_ptr<const Model> model;
    ModuleString string;
    PlantGeometry geometry;

    explicit GrownSpecies(const std::string& lines, std::uint64_t seed = 0, const glm::dvec3& foot = glm::dvec3(0))
        : model(read_model_text(registered<NotationType>().at("species")->translate(lines, "tree.species").text,
                                "tree")) {
        DerivationSettings settings;
        settings.seed = seed;
        Derivation derivation(compile(model), settings);
        derivation.start(string);
        TurtleSettings turtle;
        turtle.pose.position = foot;
        for (double step = 0; step <= derivation.length(); ++step) {
            Interpretation look = interpret(*model, string, turtle, &derivation);
            write_turtle_answers(look, string);
            geometry = std::move(look.geometry);
            ModuleString next;
            if (step < derivation.length()) {
                derivation.step(string, next);
                string = std::move(next);
            }
        }
    }

    std::vector<std::vector<double>> wood(int level) const {
        return parameters_of(string, model->alphabet, fmt::format("Wood{}", level));
    }

    /// From the base of each half of a leaf to its tip.
    struct Half {
        glm::dvec3 base, along;
    };
    std::vector<Half> halves() const {
        std::vector<Half> found;
        for (const Polygon& polygon : geometry.polygons) {
            const auto at = [&](std::size_t k) { return glm::dvec3(geometry.vertices[polygon.first + k]); };
            found.push_back({at(0), at(polygon.count - 1) - at(0)});
        }
        return found;
    }

    struct Leaf {
        glm::dvec3 base, along, upper;
    };
    /// Each of two halves, of which the first is the right one.
    std::vector<Leaf> leaves() const {
        std::vector<Leaf> found;
        const std::vector<Half> all = halves();
        for (std::size_t k = 0; k < all.size(); k += 2) {
            const auto& vertices = geometry.vertices;
            const std::size_t first = geometry.polygons[k].first + 2, second = geometry.polygons[k + 1].first + 2;
            const glm::dvec3 across = glm::dvec3(vertices[second]) - glm::dvec3(vertices[first]);
            found.push_back({all[k].base, all[k].along, glm::normalize(glm::cross(across, all[k].along))});
        }
        return found;
    }
};

LonePlant grown_species(const std::string& name, Defines defines) {
    LonePlant plant(fmt::format("models/species/{}.species", name), std::move(defines));
    plant.grow(static_cast<int>(plant.derivation.length()));
    return plant;
}

std::vector<std::vector<double>> first_segments(const ModuleString& string, const Alphabet& alphabet, int level) {
    std::vector<std::vector<double>> first;
    for (const auto& wood : parameters_of(string, alphabet, fmt::format("Wood{}", level))) {
        if (wood[0] == 0) first.push_back(wood);
    }
    return first;
}

/// The level of the stem that an internode is of, from the name of its module.
int level_of_wood(const LonePlant& plant, const Internode& internode) {
    return plant.model->alphabet.name(plant.string.letters[internode.module]).back() - '0';
}

double published_shape(int shape, double r) {
    const double degree = std::numbers::pi / 180;
    switch (shape) {
        case 0:
            return 0.2 + 0.8 * r;
        case 1:
            return 0.2 + 0.8 * std::sin(180 * degree * r);
        case 2:
            return 0.2 + 0.8 * std::sin(90 * degree * r);
        case 3:
            return 1;
        case 4:
            return 0.5 + 0.5 * r;
        case 5:
            return r <= 0.7 ? r / 0.7 : (1 - r) / 0.3;
        case 6:
            return 1 - 0.8 * r;
        default:
            return r <= 0.7 ? 0.5 + 0.5 * r / 0.7 : 0.5 + 0.5 * (1 - r) / 0.3;
    }
}

double willow_envelope(double ratio) {
    if (ratio <= 0 || ratio >= 1) return 0;
    return ratio < 0.4 ? std::pow(ratio / 0.4, 0.5) : std::pow((1 - ratio) / 0.6, 0.001);
}

}  // namespace

TEST_CASE("species: branches are as long as each shape says", "[species]") {
    for (int shape = 0; shape < 8; ++shape) {
        const GrownSpecies tree(
            fmt::format("Levels = 2\nScale = 10\nBaseSize = 0.2\n1Branches = 20\nShape = {}\n"
                        "1Length = 0.4\n0CurveRes, 1CurveRes = 4, 1\n",
                        shape));
        const auto branches = tree.wood(1);
        REQUIRE(branches.size() == 20);
        for (std::size_t j = 0; j < 20; ++j) {
            const double from_top = 1 - (static_cast<double>(j) + 0.5) / 20;
            CHECK(branches[j][1] == Approx(10 * 0.4 * published_shape(shape, from_top)).epsilon(1e-12));
        }
    }
}

TEST_CASE("species: the quaking aspen has the lengths, radii and numbers of its table", "[species]") {
    const LonePlant aspen = grown_species("quaking-aspen", {{"ScaleV", "0"}});
    const Alphabet& alphabet = aspen.model->alphabet;
    double height = 0;
    for (const auto& wood : parameters_of(aspen.string, alphabet, "Wood0")) {
        height += wood[1];
        CHECK(wood[2] == Approx(0.195).epsilon(1e-12));
    }
    CHECK(height == Approx(13));
    CHECK(aspen.interpretation.geometry.internodes.front().tip_radius == Approx(0.195 * (1 + 0.6 * 0.99) * 0.93));
    const auto branches = first_segments(aspen.string, alphabet, 1);
    REQUIRE(branches.size() == 50);
    int twigs = 0;
    for (std::size_t j = 0; j < 50; ++j) {
        const double from_top = 1 - (static_cast<double>(j) + 0.5) / 50;
        const double length = 13 * 0.3 * published_shape(7, from_top);
        CHECK(5 * branches[j][1] == Approx(length).epsilon(1e-12));
        CHECK(branches[j][2] <= 0.195 * std::pow(length / 13, 1.2) * (1 + 1e-12));
        twigs += static_cast<int>(std::floor(30 * (0.2 + 0.8 * length / 13 / 0.3) + 0.5));
    }
    CHECK(branches[0][2] == Approx(0.195 * std::pow(13 * 0.3 * published_shape(7, 0.99) / 13, 1.2)));
    CHECK(first_segments(aspen.string, alphabet, 2).size() == static_cast<std::size_t>(twigs));
}

TEST_CASE("species: of every level there are stems, children become shorter along their parent", "[species]") {
    const LonePlant tupelo = grown_species(
        "black-tupelo",
        {{"ScaleV", "0"}, {"LengthV_1", "0"}, {"LengthV_2", "0"}, {"Branches_1", "3"}, {"QUALITY", "0.1"}});
    const auto branches = first_segments(tupelo.string, tupelo.model->alphabet, 1);
    const auto boughs = first_segments(tupelo.string, tupelo.model->alphabet, 2);
    REQUIRE(branches.size() == 3);
    // The first branch of level 1 bears n of level 2, each 0.6 (length - 0.6 offset) long.
    const double length = 10 * branches[0][1], ratio = length / 23 / 0.3;
    CHECK(length == Approx(23 * 0.3 * published_shape(4, 1 - 0.5 / 3)));
    const int n = static_cast<int>(std::floor(25 * (0.2 + 0.8 * ratio) + 0.5));
    for (int j = 0; j < n; ++j) {
        const double offset = (j + 0.5) / n * length;
        CHECK(10 * boughs[static_cast<std::size_t>(j)][1] == Approx(0.6 * (length - 0.6 * offset)));
    }
    CHECK(first_segments(tupelo.string, tupelo.model->alphabet, 3).size() > 200);
}

TEST_CASE("species: with PruneRatio 1 every branch lies in the envelope of the crown, with 0 it does not",
          "[species]") {
    const auto outside = [](const char* ratio) {
        const LonePlant willow = grown_species(
            "weeping-willow", {{"ScaleV", "0"}, {"PruneRatio", ratio}, {"Branches_3", "4"}, {"QUALITY", "0.07"}});
        int count = 0;
        for (const Internode& internode : willow.interpretation.geometry.internodes) {
            if (level_of_wood(willow, internode) == 0) continue;
            const double radius = std::hypot(internode.tip.x, internode.tip.z);
            const double limit = 15 * 0.4 * willow_envelope((15 - internode.tip.y) / (15 - 0.05 * 15));
            count += radius > limit + 1e-6;
        }
        return count;
    };
    CHECK(outside("1") == 0);
    CHECK(outside("0") > 20);
}

TEST_CASE("species: the oak splits in three at its first segment, and its clones share 40 branches", "[species]") {
    const LonePlant oak = grown_species("black-oak", {{"ScaleV", "0"}, {"Branches_2", "10"}, {"QUALITY", "0.2"}});
    std::map<int, int> trunks;
    for (const auto& wood : parameters_of(oak.string, oak.model->alphabet, "Wood0"))
        ++trunks[static_cast<int>(wood[0])];
    CHECK(trunks[0] == 1);
    CHECK(trunks[1] == 3);
    // A stem of CurveRes 8 without base splits would split 0.4 times at each of the joints 2 to 7.
    CHECK(trunks[7] > 3);
    CHECK(first_segments(oak.string, oak.model->alphabet, 1).size() == 40);
}

TEST_CASE("species: clones keep the number of splits and turn away less, the more their stem leans", "[species]") {
    const GrownSpecies upright("Levels = 1\n0SegSplits = 1\n0SplitAngle = 20\n0CurveRes = 5\n");
    std::map<double, int> segments;
    for (const auto& wood : upright.wood(0)) ++segments[wood[0]];
    for (int k = 0; k < 5; ++k) CHECK(segments[k] == 1 << k);
    int turned = 0;
    for (const Internode& internode : upright.geometry.internodes) {
        const double angle = degrees_between(direction_of(internode), {0, 1, 0});
        CHECK(angle < 20 + 1e-6);
        turned += angle > 19.9;
    }
    CHECK(turned >= 2);
}

TEST_CASE("species: CurveV may exceed a full turn", "[species]") {
    const GrownSpecies curl("Levels = 1\n0CurveRes = 12\n0CurveV = 500\n");
    CHECK(curl.geometry.internodes.size() == 13);  // the first hundredth is one of its own
}

TEST_CASE("species: a negative CurveV makes a helix with this angle to its axis", "[species]") {
    const GrownSpecies helix("Levels = 1\n0CurveRes = 12\n0CurveV = -30\n");
    glm::dvec3 sum(0);
    for (const Internode& internode : helix.geometry.internodes) {
        CHECK(degrees_between(direction_of(internode), {0, 1, 0}) == Approx(30));
        sum += internode.tip - internode.base;
    }
    CHECK(std::hypot(sum.x, sum.z) < 0.05 * sum.y);
}

TEST_CASE("species: tapers are those of a cylinder, a cone, a round end and a chain of spheres", "[species]") {
    const auto radii = [](const std::string& taper) {
        const GrownSpecies tree("Levels = 1\nScale = 8\nRatio = 0.0625\n0CurveRes = 1\n0Taper = " + taper + "\n");
        std::vector<std::pair<double, double>> found;
        // The first hundredth of a stem has the width of its base.
        const auto& internodes = tree.geometry.internodes;
        for (std::size_t k = 1; k < internodes.size(); ++k) {
            found.emplace_back(internodes[k].tip.y, internodes[k].tip_radius);
        }
        return found;
    };
    for (const auto& [height, radius] : radii("0")) CHECK(radius == Approx(0.5));
    for (const auto& [height, radius] : radii("0.5"))
        CHECK(radius == Approx(0.5 * (1 - 0.5 * height / 8)).margin(0.01));
    for (const auto& [height, radius] : radii("2")) {
        const double from_tip = std::min(8 - height, 0.5);
        CHECK(radius == Approx(std::sqrt(std::max(0., 0.25 - std::pow(0.5 - from_tip, 2)))).margin(0.02));
    }
    for (const auto& [height, radius] : radii("3")) {
        const double in_sphere = std::fmod(8 - height, 1.0) - 0.5;
        CHECK(radius == Approx(std::sqrt(std::max(0., 0.25 - in_sphere * in_sphere))).margin(0.1));
    }
}

TEST_CASE("species: boughs bend by nCurve and back by nCurveBack; the larch hangs its twigs", "[species]") {
    const auto mean_end = [](const char* attraction) {
        const LonePlant larch = grown_species("european-larch", {{"QUALITY", "0.05"}, {"AttractionUp", attraction}});
        std::map<std::uint32_t, double> ends;
        for (const Internode& internode : larch.interpretation.geometry.internodes) {
            if (level_of_wood(larch, internode) == 2) ends[internode.axis] = direction_of(internode).y;
        }
        double sum = 0;
        for (const auto& [axis, height] : ends) sum += height;
        return sum / static_cast<double>(ends.size());
    };
    CHECK(mean_end("-3") < mean_end("0") - 0.1);
    const GrownSpecies bough("Levels = 1\n0CurveRes, 0Curve, 0CurveBack = 10, 25, -75\n");
    // The joints 1 to 4 turn by 2 * 25 / 10 degrees, 5 to 9 by 2 * -75 / 10.
    const auto& internodes = bough.geometry.internodes;
    REQUIRE(internodes.size() == 11);
    CHECK(degrees_between(direction_of(internodes[0]), direction_of(internodes[5])) == Approx(20));
    CHECK(degrees_between(direction_of(internodes[5]), direction_of(internodes[10])) == Approx(75));
}

TEST_CASE("species: fir branches at the foot are five times as long as at the top; the poplar is a column",
          "[species]") {
    const LonePlant fir = grown_species("balsam-fir", {{"ScaleV", "0"}, {"LengthV_1", "0"}, {"LEVELS", "2"}});
    const auto branches = first_segments(fir.string, fir.model->alphabet, 1);
    CHECK(branches.front()[1] / branches.back()[1] == Approx(5).epsilon(0.02));
    const LonePlant poplar = grown_species("lombardy-poplar", {{"QUALITY", "0.1"}});
    const Box& box = poplar.interpretation.geometry.bounds;
    CHECK(box.upper.y > 3 * std::max(box.upper.x - box.lower.x, box.upper.z - box.lower.z));
}

TEST_CASE("species: the palm bears its 26 fronds at the top, with 90 leaflets at most", "[species]") {
    const LonePlant palm = grown_species("coconut-palm", {{"ScaleV", "0"}});
    const auto fronds = first_segments(palm.string, palm.model->alphabet, 1);
    CHECK(fronds.size() == 26);
    int leaflets = 0;
    for (int j = 0; j < 26; ++j) {
        leaflets += static_cast<int>(std::lround(90 * (0.5 + 0.5 * (0.96 + 0.04 * (j + 0.5) / 26))));
    }
    CHECK(palm.counts()["Leaf"] == leaflets);
}

TEST_CASE("species: leaves have two halves, three leaflets six; a fan stands at the end of its stem", "[species]") {
    for (int shape = 0; shape <= 5; ++shape) {
        const GrownSpecies tree(fmt::format("Levels = 1\nScale = 2\nLeaves = 7\nLeafShape = {}\n", shape));
        CHECK(tree.geometry.polygons.size() == (shape == 5 ? 42 : 14));
    }
    const GrownSpecies fan("Levels = 1\nScale = 2\n1DownAngle, 1Rotate = 0, 90\nLeaves, LeafScale = -5, 0.3\n");
    CHECK(fan.geometry.polygons.size() == 10);
    for (const Polygon& polygon : fan.geometry.polygons) {
        CHECK(glm::distance(fan.geometry.vertices[polygon.first], {0, 2, 0}) < 1e-9);
    }
}

TEST_CASE("species: leaves with LeafBend 1 lie level and look away from the trunk, as far as they can", "[species]") {
    const std::string tree =
        "Levels = 2\nScale = 4\nRatio = 0.01\n1Branches = 12\n1Length = 0.4\n1DownAngle = 70\n2DownAngle = 50\n"
        "Leaves = 10\nLeafScale = 0.1\n";
    const auto mean_slope = [&](const std::string& bend) {
        double sum = 0;
        const auto halves = GrownSpecies(tree + bend).halves();
        REQUIRE(halves.size() == GrownSpecies(tree).geometry.polygons.size());
        for (const auto& half : halves) {
            CHECK(glm::length(half.along) == Approx(0.1).epsilon(1e-3));
            sum += std::abs(half.along.y) / 0.1;
        }
        return sum / static_cast<double>(halves.size());
    };
    CHECK(mean_slope("LeafBend = 1\n") < 1e-4);
    CHECK(mean_slope("LeafBend = 0.5\n") < 0.8 * mean_slope(""));
    CHECK(mean_slope("LeafBend = 0.5\n") > 0.1);
    CHECK(mean_slope("LeafOrient = 0.5\n") == mean_slope("LeafBend = 0.5\n"));
}

TEST_CASE("species: LeafBend turns leaves as section 4.9 of the paper says, wherever the tree stands", "[species]") {
    const std::string lines =
        "Levels = 2\nScale = 4\nRatio = 0.01\n1Branches = 9\n1Length = 0.4\n1DownAngle = 70\n1Curve = 30\n"
        "2DownAngle = 50\nLeaves = 8\nLeafScale = 0.1\nLeafBend = ";
    const auto before = GrownSpecies(lines + "0\n").leaves();
    for (const double bend : {0.3, 0.7, 1.0}) {
        for (const glm::dvec3 foot : {glm::dvec3(0), glm::dvec3(5, 1, -7)}) {
            const auto after = GrownSpecies(lines + std::to_string(bend) + "\n", 0, foot).leaves();
            REQUIRE(after.size() == before.size());
            for (std::size_t k = 0; k < before.size(); ++k) {
                CHECK(glm::distance(after[k].base, before[k].base + foot) < 1e-6);
                // Azimuths of the leaf's middle and of its upper side, as the paper's theta.
                const glm::dvec3 middle = before[k].base + 0.5 * before[k].along, upper = before[k].upper;
                double theta = std::atan2(middle.z, middle.x) - std::atan2(upper.z, upper.x);
                theta = bend * std::remainder(theta, 2 * std::numbers::pi);
                const auto around = [theta](const glm::dvec3& v) {
                    return glm::dvec3(v.x * std::cos(theta) - v.z * std::sin(theta), v.y,
                                      v.x * std::sin(theta) + v.z * std::cos(theta));
                };
                const glm::dvec3 along = around(before[k].along), face = around(upper) * glm::length(along);
                const double lift = bend * std::atan2(along.y, face.y);
                const glm::dvec3 expected = along * std::cos(lift) - face * std::sin(lift);
                CHECK(glm::distance(after[k].along, expected) < 1e-4);
            }
        }
    }
    CHECK_FALSE(GrownSpecies(lines + "0\n").model->alphabet.find("LeafBud", 0));  // then no leaf asks
}

TEST_CASE("species: a stalk of LeafStemLen leaf lengths stands between stem and leaf", "[species]") {
    const std::string tree = "Levels = 1\nScale = 2\nLeaves, LeafScale = 7, 0.3\n";
    const auto sessile = GrownSpecies(tree).halves(), stalked = GrownSpecies(tree + "LeafStemLen = 0.5\n").halves();
    REQUIRE(sessile.size() == stalked.size());
    for (std::size_t k = 0; k < sessile.size(); ++k) {
        CHECK(glm::distance(stalked[k].base, sessile[k].base + 0.5 * sessile[k].along) < 1e-4);
    }
}

TEST_CASE("species: LeafDistrib and LeafQuality say how many leaves stand where", "[species]") {
    const std::string tree = "Levels = 2\nScale = 5\n1Branches = 10\nBaseSize = 0\nLeaves = 100\n";
    for (const int shape : {0, 3, 4, 6}) {
        double expected = 0;
        for (int j = 0; j < 10; ++j) expected += std::floor(100 * published_shape(shape, (j + 0.5) / 10) + 0.5);
        const GrownSpecies grown(tree + fmt::format("LeafDistrib = {}\n", shape));
        CHECK(static_cast<double>(grown.geometry.polygons.size()) == 2 * expected);
    }
    const GrownSpecies few(tree + "LeafDistrib = 3\nLeafQuality = 0.25\n");
    CHECK(few.geometry.polygons.size() == 2 * 10 * 25);
    CHECK(glm::length(few.halves()[0].along) == Approx(0.15 / std::sqrt(0.25)).epsilon(1e-3));
}

TEST_CASE("species: negative splits are at random, from none to that many, each as often", "[species]") {
    std::map<std::size_t, int> stems;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const GrownSpecies tree("Levels = 1\n0CurveRes = 2\n0BaseSplits = -3\n0SplitAngle = 30\n", seed);
        std::size_t tops = 0;
        for (const auto& wood : tree.wood(0)) tops += wood[0] == 1;
        ++stems[tops];
    }
    REQUIRE(stems.size() == 4);
    double chi_square = 0;
    for (const auto& [tops, count] : stems) chi_square += std::pow(count - 100.0, 2) / 100;
    CHECK(chi_square < 16.3);  // 3 degrees of freedom, p = 0.001
    int clones = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const GrownSpecies tree("Levels = 1\n0CurveRes = 2\n0SegSplits = -1\n0SplitAngle = 30\n", seed);
        clones += static_cast<int>(tree.wood(0).size()) - 2;
    }
    CHECK(clones == Approx(100).margin(25));
}

TEST_CASE("species: children stand where BaseSize and BranchDist of their level say", "[species]") {
    const auto places = [](const std::string& lines) {
        const GrownSpecies tree("Levels = 2\nScale = 10\nBaseSize = 0\n0CurveRes = 4\n1Branches = 12\n" + lines);
        std::vector<double> found;
        for (const Internode& internode : tree.geometry.internodes) {
            const bool is_first = internode.order == 1 && std::hypot(internode.base.x, internode.base.z) < 1e-6;
            if (is_first) found.push_back(internode.base.y);
        }
        std::set<double> heights;
        for (const double height : found) heights.insert(std::round(1e6 * height) / 1e6);
        return heights;
    };
    CHECK(places("1BranchDist = 0\n1CurveRes = 1\n") == std::set<double>{0, 2.5, 5, 7.5});
    CHECK(places("1CurveRes = 1\n").size() > 6);
    const std::string deep =
        "Levels = 2\n1CurveRes = 3\n2DownAngle = 40\nLeaves, LeafScale = 12, 0.02\n1Branches = 1\n"
        "1Length = 0.5\nScale = 10\nBaseSize = 0.5\n";
    const GrownSpecies even(deep), bare(deep + "1BaseSize = 0.5\n");
    double nearest = 9, nearest_bare = 9;
    const auto nearer = [](const GrownSpecies& tree, double& least) {
        for (const auto& half : tree.halves()) least = std::min(least, std::hypot(half.base.x, half.base.z));
    };
    nearer(even, nearest);
    nearer(bare, nearest_bare);
    CHECK(nearest_bare > 3 * nearest);
}

TEST_CASE("species: nScale thickens stems, and nBendV bends them to their sides at random", "[species]") {
    const std::string tree = "Levels = 2\nScale = 10\n1Branches = 10\n1Length = 0.3\n1CurveRes = 8\n";
    const auto thin = GrownSpecies(tree).wood(1), thick = GrownSpecies(tree + "1Scale = 1.5\n").wood(1);
    CHECK(thick[0][2] == Approx(1.5 * thin[0][2]));
    const auto turned = [](const GrownSpecies& bent) {
        const auto& internodes = bent.geometry.internodes;
        return degrees_between(direction_of(internodes[1]), direction_of(internodes.back()));
    };
    double most = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::string stem = "Levels = 1\n0CurveRes = 8\n";
        CHECK(turned(GrownSpecies(stem, seed)) == Approx(0).margin(1e-5));
        const double angle = turned(GrownSpecies(stem + "0BendV = 80\n", seed));
        CHECK(angle < 80);
        most = std::max(most, angle);
    }
    CHECK(most > 15);
}

TEST_CASE("species: pruned stems that bend to their sides stay in the envelope", "[species]") {
    const GrownSpecies tree(
        "Levels = 2\nScale = 10\n1Branches = 30\n1Length = 0.8\n1CurveRes = 6\n1BendV = 120\nPruneRatio = 1\n"
        "PruneWidth, PruneWidthPeak = 0.3, 0.5\n0CurveRes = 3\n");
    int inside = 0;
    for (const Internode& internode : tree.geometry.internodes) {
        if (internode.order == 0) continue;
        const double ratio = (10 - internode.tip.y) / (10 - 2.5);
        const double limit =
            ratio <= 0 || ratio >= 1 ? 0 : 10 * 0.3 * std::pow(ratio < 0.5 ? ratio / 0.5 : (1 - ratio) / 0.5, 0.5);
        CHECK(std::hypot(internode.tip.x, internode.tip.z) <= limit + 1e-6);
        inside += 1;
    }
    CHECK(inside > 60);
}

TEST_CASE("species: the surface of a trunk has lobes of the depth that was set", "[species]") {
    const GrownSpecies tree(
        "Levels = 1\nScale = 5\nRatio = 0.1\n0Taper = 0\nLobes, LobeDepth = 5, 0.2\n0CurveRes = 3\n");
    double least = 9, most = 0;
    for (const auto& vertex : tree.geometry.mesh.vertices) {
        const double distance = std::hypot(vertex.position.x, vertex.position.z);
        if (distance < 0.1) continue;  // the middle of a cap
        least = std::min(least, distance);
        most = std::max(most, distance);
    }
    CHECK(least == Approx(0.5 * 0.8).epsilon(0.01));
    CHECK(most == Approx(0.5 * 1.2).epsilon(0.01));
}

TEST_CASE("species: an aspen sways in a gust, and is at rest before and after", "[species]") {
    World world(read_scene(source_path("environments/wind.toml"),
                           {{{"plant.0.stage.0.speed", "0"}, {"plant.0.define.QUALITY", "0.02"}}, {}, {}}));
    world.start();
    const Column<Internode>& at_rest = world.interpretation(0).geometry.internodes;
    const auto top = std::max_element(at_rest.begin(), at_rest.end(),
                                      [](const auto& a, const auto& b) { return a.tip.y < b.tip.y; }) -
                     at_rest.begin();
    std::vector<double> distances;
    for (;; world.step()) {
        const auto& drawn = world.frame().plants[0].interpretation->geometry.internodes;
        const auto& grown = world.interpretation(0).geometry.internodes;
        distances.push_back(glm::distance(drawn[std::size_t(top)].tip, grown[std::size_t(top)].tip));
        if (world.at_end()) break;
    }
    CHECK(distances.size() == 49);
    CHECK(distances.front() == 0);
    CHECK(distances.back() == 0);
    const double most = *std::max_element(distances.begin(), distances.end());
    CHECK(most > 0.3);
    CHECK(most < 4);
}

TEST_CASE("species: all of the library derive and draw, about as high as their scale", "[species]") {
    int count = 0;
    for (const auto& file : std::filesystem::directory_iterator(source_path("models/species"))) {
        if (file.path().extension() != ".species") continue;
        INFO(file.path());
        LonePlant plant("models/species/" + file.path().filename().string(),
                        {{"ScaleV", "0"}, {"QUALITY", "0.1"}, {"LEVELS", "2"}});
        plant.grow(static_cast<int>(plant.derivation.length()));
        const PlantGeometry& geometry = plant.interpretation.geometry;
        CHECK(geometry.internodes.size() > 100);
        CHECK(geometry.bounds.upper.y > 5);
        CHECK(geometry.bounds.upper.y < 40);
        ++count;
    }
    CHECK(count >= 8);
}

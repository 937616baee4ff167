// Trees made of ratios and angles: Honda, Aono & Kunii, the figures of ABOP chapter 2, tropism.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <map>

using namespace espalier;

namespace {

// Apices by how often the first and the second ratio made their length.
void check_honda_lengths(const LonePlant& tree, int steps, double r1, double r2) {
    std::vector<double> lengths = values_of(tree.string, tree.model->alphabet, "B");
    const std::vector<double> trunk = values_of(tree.string, tree.model->alphabet, "T");
    lengths.insert(lengths.end(), trunk.begin(), trunk.end());
    REQUIRE(lengths.size() == std::size_t(1) << steps);
    std::sort(lengths.begin(), lengths.end());
    std::vector<double> expected;
    double binomial = 1;
    for (int i = 0; i <= steps; ++i) {
        const double length = std::pow(r1, i) * std::pow(r2, steps - i);
        expected.insert(expected.end(), static_cast<std::size_t>(std::lround(binomial)), length);
        binomial = binomial * (steps - i) / (i + 1);
    }
    std::sort(expected.begin(), expected.end());
    for (std::size_t i = 0; i < lengths.size(); ++i) CHECK(lengths[i] == Approx(expected[i]).epsilon(1e-12));
}

Tropism tropism_towards(const glm::dvec3& direction) {
    Tropism tropism;
    tropism.direction = glm::normalize(direction);
    return tropism;
}

std::vector<std::vector<Internode>> axes_of(const PlantGeometry& geometry) {
    std::map<std::uint32_t, std::vector<Internode>> axes;
    for (const Internode& internode : geometry.internodes) axes[internode.axis].push_back(internode);
    std::vector<std::vector<Internode>> result;
    for (auto& [axis, internodes] : axes) result.push_back(std::move(internodes));
    return result;
}

}  // namespace

TEST_CASE("honda: 2^n apices with lengths R1^i R2^(n-i) in binomial numbers", "[trees]") {
    LonePlant tree("models/trees/honda.l");
    tree.grow(8);
    check_honda_lengths(tree, 8, 0.9, 0.7);
    const double r = 0.9 + 0.7;
    CHECK(total_length(tree.interpretation.geometry) == Approx((std::pow(r, 8) - 1) / (r - 1)).epsilon(1e-12));
}

TEST_CASE("honda: a branch and its two children lie in one plane, turned by A1 and A2; trunk forks by the divergence",
          "[trees]") {
    LonePlant tree("models/trees/honda.l");
    tree.grow(7);
    const PlantGeometry& geometry = tree.interpretation.geometry;
    const auto children = children_of(geometry);
    int forks = 0;
    std::vector<glm::dvec3> laterals;
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (children[i].empty()) continue;
        REQUIRE(children[i].size() == 2);
        const glm::dvec3 parent = direction_of(geometry.internodes[i]);
        const glm::dvec3 lateral = direction_of(geometry.internodes[children[i][0]]);
        const glm::dvec3 straight = direction_of(geometry.internodes[children[i][1]]);
        CHECK(degrees_between(parent, lateral) == Approx(60));
        if (geometry.internodes[i].order == 0) {
            laterals.push_back({lateral.x, 0, lateral.z});
            CHECK(degrees_between(parent, straight) < 1e-9);
            continue;
        }
        ++forks;
        CHECK(degrees_between(parent, straight) == Approx(10));
        CHECK(std::abs(glm::dot(glm::cross(parent, lateral), straight)) < 1e-9);
        // Across the parent, the plane is horizontal.
        const glm::dvec3 across = lateral - glm::dot(lateral, parent) * parent;
        CHECK(std::abs(across.y) < 1e-9);
    }
    CHECK(forks > 50);
    for (std::size_t i = 1; i < laterals.size(); ++i) {
        CHECK(degrees_between(laterals[i - 1], laterals[i]) == Approx(137.5));
    }
}

TEST_CASE("monopodial: axes are straight in every figure; widths and lengths are products of the ratios", "[trees]") {
    const double r1[] = {0.9, 0.9, 0.9, 0.9}, r2[] = {0.6, 0.9, 0.8, 0.7}, lateral_angle[] = {45, 45, 45, 30};
    for (int figure = 1; figure <= 4; ++figure) {
        LonePlant tree("models/trees/monopodial.l", {{"FIGURE", std::to_string(figure)}});
        tree.grow(8);
        const PlantGeometry& geometry = tree.interpretation.geometry;
        CHECK(geometry.internodes.size() == 255);
        const double ratio = r1[figure - 1] + r2[figure - 1];
        CHECK(total_length(geometry) == Approx((std::pow(ratio, 8) - 1) / (ratio - 1)).epsilon(1e-12));
        for (const auto& axis : axes_of(geometry)) {
            for (std::size_t i = 1; i < axis.size(); ++i) {
                CHECK(degrees_between(direction_of(axis[0]), direction_of(axis[i])) < 1e-6);
                CHECK(length_of(axis[i]) == Approx(r1[figure - 1] * length_of(axis[i - 1])));
                CHECK(axis[i].tip_radius == Approx(0.707 * axis[i - 1].tip_radius));
            }
        }
        const auto children = children_of(geometry);
        for (std::size_t i = 0; i < children.size(); ++i) {
            for (std::size_t child : children[i]) {
                if (geometry.internodes[child].axis == geometry.internodes[i].axis) continue;
                CHECK(degrees_between(direction_of(geometry.internodes[i]), direction_of(geometry.internodes[child])) ==
                      Approx(lateral_angle[figure - 1]));
            }
        }
    }
}

TEST_CASE("sympodial: 2^n apices; every fork is flat, holds its parent and is open by A1 + A2", "[trees]") {
    const double a1[] = {5, 10, 20, 35}, a2[] = {65, 60, 50, 35};
    for (int figure = 1; figure <= 4; ++figure) {
        LonePlant tree("models/trees/sympodial.l", {{"FIGURE", std::to_string(figure)}});
        tree.grow(7);
        CHECK(tree.counts()["B"] == 128);
        const PlantGeometry& geometry = tree.interpretation.geometry;
        const auto children = children_of(geometry);
        for (std::size_t i = 0; i < children.size(); ++i) {
            if (children[i].empty()) continue;
            REQUIRE(children[i].size() == 2);
            const glm::dvec3 parent = direction_of(geometry.internodes[i]);
            const glm::dvec3 first = direction_of(geometry.internodes[children[i][0]]);
            const glm::dvec3 second = direction_of(geometry.internodes[children[i][1]]);
            CHECK(degrees_between(parent, first) == Approx(a1[figure - 1]));
            CHECK(degrees_between(parent, second) == Approx(a2[figure - 1]));
            CHECK(degrees_between(first, second) == Approx(a1[figure - 1] + a2[figure - 1]));
        }
    }
}

TEST_CASE("aono-kunii: both presets have exact angles and one ratio; (0, -70) has straight axes", "[trees]") {
    for (auto [h1, h2] : {std::pair{35.0, 35.0}, std::pair{0.0, 70.0}}) {
        LonePlant tree("models/trees/aono-kunii.l",
                       {{"H1", std::to_string(h1)}, {"H2", std::to_string(-h2)}, {"RATIO", "0.8"}});
        tree.grow(6);
        const PlantGeometry& geometry = tree.interpretation.geometry;
        CHECK(tree.counts()["A"] == 64);
        const auto children = children_of(geometry);
        for (std::size_t i = 0; i < children.size(); ++i) {
            if (children[i].empty()) continue;
            REQUIRE(children[i].size() == 2);
            const glm::dvec3 parent = direction_of(geometry.internodes[i]);
            for (std::size_t child : children[i]) {
                const Internode& internode = geometry.internodes[child];
                const double angle = degrees_between(parent, direction_of(internode));
                CHECK(std::min(std::abs(angle - h1), std::abs(angle - h2)) < 1e-6);
                CHECK(length_of(internode) == Approx(0.8 * length_of(geometry.internodes[i])));
            }
            CHECK(degrees_between(direction_of(geometry.internodes[children[i][0]]),
                                  direction_of(geometry.internodes[children[i][1]])) == Approx(h1 + h2));
            // The plane of the fork holds the parent, and what lies across the parent in it is horizontal.
            const glm::dvec3 lateral = direction_of(geometry.internodes[children[i][0]]);
            const glm::dvec3 straight = direction_of(geometry.internodes[children[i][1]]);
            CHECK(std::abs(glm::dot(glm::cross(parent, lateral), straight)) < 1e-9);
            for (const glm::dvec3& child : {lateral, straight}) {
                CHECK(std::abs((child - glm::dot(child, parent) * parent).y) < 1e-9);
            }
        }
        if (h1 != 0) continue;
        for (const auto& axis : axes_of(geometry)) {
            CHECK(degrees_between(direction_of(axis.front()), direction_of(axis.back())) < 1e-6);
        }
    }
}

TEST_CASE("aono-kunii: forks across a horizontal line or in the vertical plane through the parent", "[trees]") {
    LonePlant steep("models/trees/aono-kunii.l"), flat("models/trees/aono-kunii.l", {{"ROLL", "90"}});
    steep.grow(6);
    flat.grow(6);
    CHECK(steep.interpretation.geometry.bounds.upper.z > 0.3);
    CHECK(steep.interpretation.geometry.bounds.upper.x > 0.3);
    const Box& box = flat.interpretation.geometry.bounds;
    CHECK(std::min(box.upper.x - box.lower.x, box.upper.z - box.lower.z) < 0.11);  // the width of the trunk
}

TEST_CASE("ternary: 3^n apices, and a segment grows by LR at every step of its life", "[trees]") {
    const double lr[] = {1.109, 1.109, 1.790, 1.070};
    for (int figure = 1; figure <= 4; ++figure) {
        LonePlant tree("models/trees/ternary.l", {{"FIGURE", std::to_string(figure)}});
        tree.grow(5);
        CHECK(tree.counts()["A"] == 243);
        std::map<double, int> lengths;
        for (double length : values_of(tree.string, tree.model->alphabet, "F")) ++lengths[length];
        for (int age = 0; age < 5; ++age) {
            const double length = 50 * std::pow(lr[figure - 1], age);
            // 3^k segments are made at the tips of step k, and one more below each fork.
            int found = 0;
            for (auto [each, number] : lengths) found += std::abs(each - length) < 1e-9 * length ? number : 0;
            CHECK(found == static_cast<int>(std::pow(3, 5 - age) + std::pow(3, 4 - age)));
        }
    }
}

TEST_CASE("ternary: gravity opens the crown; without elasticity the branches leave at their angle", "[trees]") {
    LonePlant bent("models/trees/ternary.l"), stiff("models/trees/ternary.l", {{"ELASTICITY", "0"}});
    for (LonePlant* tree : {&bent, &stiff}) {
        tree->turtle.tropisms = {tropism_towards({0, -1, 0})};
        tree->grow(6);
    }
    CHECK(bent.text().substr(12) != stiff.text());
    CHECK(bent.counts() == stiff.counts());
    const auto width = [](const LonePlant& tree) { return tree.interpretation.geometry.bounds.upper.x; };
    CHECK(width(bent) > 1.2 * width(stiff));
}

TEST_CASE("weeping: at each segment the angle to the tropism shrinks by e times its sine, until it is parallel",
          "[trees]") {
    const double e = 0.15;
    const Defines limp{{"E", "0.15"}, {"ANGLE", "80"}, {"SEGMENTS", "80"}, {"BRANCHES", "12"}},
        firm{{"E", "0"}, {"SEGMENTS", "80"}, {"BRANCHES", "12"}};
    LonePlant tree("models/trees/weeping.l", limp), stiff("models/trees/weeping.l", firm);
    for (LonePlant* each : {&tree, &stiff}) {
        each->turtle.tropisms = {tropism_towards({0, -1, 0})};
        each->grow(60);
    }
    CHECK(tree.counts() == stiff.counts());
    for (const auto& axis : axes_of(tree.interpretation.geometry)) {
        if (axis.front().order == 0) continue;
        double angle = (180 - 80) * std::numbers::pi / 180;
        for (const Internode& internode : axis) {
            angle -= e * std::sin(angle);
            CHECK(degrees_between(direction_of(internode), {0, -1, 0}) == Approx(angle * 180 / std::numbers::pi));
        }
        CHECK(angle < 0.01);
    }
    for (const auto& axis : axes_of(stiff.interpretation.geometry)) {
        CHECK(degrees_between(direction_of(axis.front()), direction_of(axis.back())) < 1e-6);
    }
}

TEST_CASE("twisted-stem: the k-th branch is turned by k times the twist, and the stem tapers as asked", "[trees]") {
    for (double taper : {0.0, 0.9}) {
        LonePlant stem("models/trees/twisted-stem.l", {{"TAPER", std::to_string(taper)}, {"TWIST", "25"}});
        stem.grow(40);
        std::vector<double> radii;
        std::vector<glm::dvec3> branches;
        for (const Internode& internode : stem.interpretation.geometry.internodes) {
            if (internode.order == 0) radii.push_back(internode.tip_radius);
            if (internode.order == 1) branches.push_back({direction_of(internode).x, 0, direction_of(internode).z});
        }
        REQUIRE(radii.size() == 40);
        REQUIRE(branches.size() == 40);
        for (std::size_t k = 1; k < 40; ++k) {
            const double turned = std::fmod(25.0 * static_cast<double>(k), 360);
            CHECK(degrees_between(branches[0], branches[k]) == Approx(std::min(turned, 360 - turned)).margin(1e-9));
            if (taper > 0) {
                CHECK(radii[k] == Approx(0.9 * radii[k - 1]));
            } else {
                CHECK(radii[k] == Approx(0.1 * (1 - static_cast<double>(k) / 40)));
            }
        }
    }
}

TEST_CASE("growth-kinds: laterals grow in the season of their birth only if growth is sylleptic", "[trees]") {
    const auto laterals = [](const char* sylleptic, int steps) {
        LonePlant tree("models/trees/growth-kinds.l", {{"SYLLEPTIC", sylleptic}});
        tree.grow(steps);
        const auto& internodes = tree.interpretation.geometry.internodes;
        return std::count_if(internodes.begin(), internodes.end(), [](const Internode& one) { return one.order == 1; });
    };
    CHECK(laterals("1", 4) == 3 + 2 + 1);
    CHECK(laterals("0", 4) == 0);
    CHECK(laterals("0", 5) == 4);
}

TEST_CASE("growth-kinds: one apex follows each of a monochasium, two equal ones each of a dichasium", "[trees]") {
    for (const int successors : {1, 2}) {
        LonePlant tree("models/trees/growth-kinds.l", {{"KIND", std::to_string(successors + 1)}});
        int apices = 1, flowers = 0;
        for (int season = 0; season < 5; ++season) {
            tree.grow(4);
            flowers += apices;
            apices *= successors;
            CHECK(tree.counts()["K"] == flowers);
            CHECK(tree.counts()["A"] == apices);
            const std::vector<double> orders = values_of(tree.string, tree.model->alphabet, "A");
            CHECK(std::all_of(orders.begin(), orders.end(), [&](double order) { return order == season + 1; }));
        }
    }
}

TEST_CASE("tropisms: axes come to the angle of their tropism with the stimulus", "[trees]") {
    LonePlant plant("models/trees/tropisms.l", {{"PLAGIO", "70"}});
    plant.grow(50);
    std::vector<double> angles;
    for (const auto& axis : axes_of(plant.interpretation.geometry)) {
        angles.push_back(degrees_between(direction_of(axis.back()), {0, 1, 0}));
    }
    REQUIRE(angles.size() == 4);
    const double expected[] = {0, 70, 90, 180};
    for (std::size_t i = 0; i < 4; ++i) CHECK(angles[i] == Approx(expected[i]).margin(0.01));
}

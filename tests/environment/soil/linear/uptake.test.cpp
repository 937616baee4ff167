// What tips obtain, sense and avoid.
#include "catch.h"
#include "environment/soil/linear/soil.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace espalier::test {
namespace {

const std::string plane = "domain = { lower = [-1, -1, 0], upper = [1, 1, 0] }\nvoxel = 0.1\n";
const std::string space = "domain = { lower = [-1, -1, -1], upper = [1, 1, 1] }\nvoxel = 0.1\n";

double turn_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * 180 / M_PI;
}

glm::dvec3 heading_of(const std::vector<double>& answer) {
    return {answer[4], answer[5], answer[6]};
}

}  // namespace

TEST_CASE("a tip obtains its wish while there is water, and it is gone from the soil", "[environment][water]") {
    Soil soil(plane + "initial = 0.3");
    soil.advance();
    CHECK(soil.obtain({{0.12, 0.07, 0}, {0.2}}) == Approx(0.2).epsilon(1e-12));
    CHECK(soil.quantity("total") == Approx(0.3 * 400 - 0.2).epsilon(1e-12));
    CHECK(soil.quantity("uptake") == Approx(0.2));
    CHECK(soil.quantity("wish") == Approx(0.2));
    CHECK(soil.obtain({{0.05, 0.05, 0}, {0.3}}) == Approx(0.3 - 0.2 * 0.3 * 0.8));
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
}

TEST_CASE("a tip at a voxel's centre drinks from that voxel alone, one between two from both", "[environment][water]") {
    Soil soil(plane + "initial = 0.3");
    soil.advance();
    CHECK(soil.obtain({{0.05, 0.05, 0}, {1}}) == Approx(0.3));
    CHECK(soil.ask({{{0.05, 0.05, 0}, {0, 0}}})[0][1] == Approx(0).margin(1e-12));
    CHECK(soil.ask({{{0.15, 0.05, 0}, {0, 0}}})[0][1] == Approx(0.3));
    CHECK(soil.obtain({{0.5, 0.55, 0}, {0.4}}) == Approx(0.4));
    CHECK(soil.ask({{{0.45, 0.55, 0}, {0, 0}}})[0][1] == Approx(0.1));
    CHECK(soil.ask({{{0.55, 0.55, 0}, {0, 0}}})[0][1] == Approx(0.1));
}

TEST_CASE("tips that want more than there is share it in proportion to their wishes", "[environment][water]") {
    Soil soil(plane + "initial = 0.3");
    soil.advance();
    const glm::dvec3 place{0.05, 0.05, 0};
    const auto answers = soil.ask({{place, {0.1}}, {place, {0.3}}, {place, {0.5}}});
    CHECK(answers[0][0] == Approx(0.3 / 9).epsilon(1e-12));
    CHECK(answers[1][0] == Approx(0.3 * 3 / 9).epsilon(1e-12));
    CHECK(answers[2][0] == Approx(0.3 * 5 / 9).epsilon(1e-12));
    CHECK(soil.quantity("minimum") == 0);
}

TEST_CASE("neither answers nor soil depend on the order in which tips ask", "[environment][water]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-0.2, 0.2), wish(0, 0.3);
    std::vector<Tip> tips;
    for (int i = 0; i < 200; ++i) tips.push_back({{place(random), place(random), place(random)}, {wish(random)}});
    std::vector<std::size_t> order(tips.size());
    std::iota(order.begin(), order.end(), std::size_t{0});

    Soil first(space + "initial = 0.2");
    first.advance();
    const auto expected = first.ask(tips);
    for (int shuffle = 0; shuffle < 5; ++shuffle) {
        std::shuffle(order.begin(), order.end(), random);
        std::vector<Tip> shuffled;
        for (const std::size_t i : order) shuffled.push_back(tips[i]);
        Soil soil(space + "initial = 0.2");
        soil.advance();
        const auto answers = soil.ask(shuffled);
        bool same = true;
        for (std::size_t i = 0; i < order.size(); ++i) same = same && answers[i] == expected[order[i]];
        CHECK(same);
        CHECK(soil.quantity("total") == first.quantity("total"));
    }
}

TEST_CASE("what all tips obtain is what the soil loses, and no voxel falls below nothing", "[environment][water]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.3, 0.3);
    Soil soil(space + "initial = 0.25\ndiffusion = 0.001");
    double drunk = 0;
    for (int step = 0; step < 20; ++step) {
        std::vector<Tip> tips;
        for (int i = 0; i < 100; ++i) tips.push_back({{place(random), place(random), place(random)}, {1.5}});
        for (const auto& answer : soil.step(tips)) {
            CHECK(answer[0] >= 0);
            drunk += answer[0];
        }
        REQUIRE(soil.quantity("minimum") >= 0);
    }
    CHECK(soil.quantity("drunk") == Approx(drunk).epsilon(1e-12));
    CHECK(soil.quantity("total") == Approx(0.25 * 8000 - drunk).epsilon(1e-12));
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
}

TEST_CASE("mirrored tips obtain and sense mirrored answers to the last bit", "[environment][water]") {
    Soil soil(plane + R"(
initial = 0.1
diffusion = 0.01
regions = [{ shape = "sphere", center = [0, -0.2, 0], radius = 0.3, value = 0.4, edge = 0.2 }]
obstacles = [{ shape = "sphere", center = [0, 0.5, 0], radius = 0.2 }]
)");
    for (int step = 0; step < 10; ++step) {
        std::vector<Tip> tips;
        for (const double x : {0.013, 0.21, 0.3, 0.61}) {
            tips.push_back({{x, 0.3 - x, 0}, {0.2, 1, 2, 0.3, 0, 0, 0, 0}, {0, 1, 0}});
            tips.push_back({{-x, 0.3 - x, 0}, {0.2, 1, 2, 0.3, 0, 0, 0, 0}, {0, 1, 0}});
        }
        const auto answers = soil.step(tips);
        for (std::size_t i = 0; i < tips.size(); i += 2) {
            CHECK(answers[i][0] == answers[i + 1][0]);
            CHECK(answers[i][1] == -answers[i + 1][1]);
            CHECK(answers[i][2] == answers[i + 1][2]);
            CHECK(answers[i][4] == Approx(-answers[i + 1][4]).margin(1e-15));
            CHECK(answers[i][5] == Approx(answers[i + 1][5]).margin(1e-15));
        }
    }
}

TEST_CASE("without depletion every tip is answered as if alone and the soil stays as it is", "[environment][water]") {
    Soil soil(plane + "initial = 0.3\ndepletion = false");
    const std::string before = soil.saved();
    soil.advance();
    const glm::dvec3 place{0.05, 0.05, 0};
    const auto answers = soil.ask({{place, {0.2}}, {place, {0.25}}, {place, {9}}});
    CHECK(answers[0][0] == Approx(0.2));
    CHECK(answers[1][0] == Approx(0.25));
    CHECK(answers[2][0] == Approx(0.3));
    CHECK(soil.quantity("total") == Approx(0.3 * 400));
    CHECK(soil.saved().substr(0, soil.saved().size() - 16) == before.substr(0, before.size() - 16));
}

TEST_CASE("amounts are contents of a voxel, or cubic metres if asked", "[environment][water]") {
    Soil soil(plane + "initial = 0.3\namount = \"volume\"");
    soil.advance();
    CHECK(soil.obtain({{0.05, 0.05, 0}, {1}}) == Approx(0.3 * 1e-3));
    CHECK(soil.quantity("total") == Approx(0.3 * 399 * 1e-3));
}

TEST_CASE("outside the domain there is no water, and negative wishes take none", "[environment][water]") {
    Soil soil(plane + "initial = 0.3");
    soil.advance();
    const auto answers = soil.ask({{{2, 0, 0}, {0.1, 1, 1, 0}}, {{0, 0, 0}, {-0.1}}, {{0, 1, 0}, {0.1}}});
    CHECK(answers[0] == std::vector<double>{0, 0, -1, 0});
    CHECK(answers[1][0] == 0);
    CHECK(answers[2][0] == Approx(0.1));
    CHECK(soil.quantity("total") == Approx(0.3 * 400 - 0.1));
    CHECK_THROWS_AS(soil.ask({{{0, 0, 0}, {std::nan("")}}}), RunError);
}

TEST_CASE("the gradient of a linear content is exact everywhere, beside obstacles too", "[environment][water]") {
    // Closed above and below, fixed left and right: content falls linearly from 0.4 to 0 along x.
    Soil soil(R"(
domain = { lower = [0, 0, 0], upper = [2, 1, 0] }
voxel = 0.1
diffusion = 0.05
boundaries = { left = { fixed = 0.4 }, right = "open" }
obstacles = [{ shape = "box", lower = [-1, 0.4, -1], upper = [3, 0.6, 1] }]
)");
    soil.step({}, 1500);
    for (const glm::dvec3 p : {glm::dvec3(0.02, 0.02, 0), glm::dvec3(0.77, 0.35, 0), glm::dvec3(1.3, 0.38, 0),
                               glm::dvec3(1.95, 0.63, 0), glm::dvec3(1.11, 0.98, 0)}) {
        const auto answer = soil.ask({{p, {0, 0, 3, 0}}})[0];
        CHECK(answer[1] == Approx(-3 * 0.2 * 0.1).epsilon(1e-7));
        CHECK(answer[2] == Approx(0).margin(1e-9));
    }
}

TEST_CASE("gradients are weighed over gradient_length and range", "[environment][water]") {
    Soil soil(R"(
domain = { lower = [0, 0, 0], upper = [2, 1, 0] }
voxel = 0.1
diffusion = 0.05
range = 0.4
gradient_length = 0.5
boundaries = { left = { fixed = 0.4 }, right = "open" }
)");
    soil.step({}, 1500);
    CHECK(soil.ask({{{1, 0.5, 0}, {0, 0, 1, 0}}})[0][1] == Approx(-0.2 * 0.5 / 0.4).epsilon(1e-7));
}

TEST_CASE("a layer's gravity is turned by its angle, once", "[environment][water]") {
    Soil soil(plane + "layers = [{ bottom = -1, top = 0, gravity_angle = 30 }, { bottom = 0, gravity_angle = 90 }]");
    soil.advance();
    const auto answers = soil.ask({{{0, -0.5, 0}, {0, 2, 0, 0}}, {{0, 0.5, 0}, {0, 1, 0, 0}}});
    CHECK(answers[0][1] == Approx(2 * 0.5));
    CHECK(answers[0][2] == Approx(-2 * std::sqrt(0.75)));
    CHECK(answers[1][1] == Approx(1));
    CHECK(answers[1][2] == Approx(0).margin(1e-15));
}

TEST_CASE("an unhindered heading is the turtle's own, bent by the direction", "[environment][water]") {
    Soil soil(space);
    soil.advance();
    const auto answer = soil.ask({{{0, 0, 0}, {0, 1, 0, 0.3, 0, 0, 0, 0, 7}, {1, 0, 0}}})[0];
    CHECK(heading_of(answer).x == Approx(std::sqrt(0.5)));
    CHECK(heading_of(answer).y == Approx(-std::sqrt(0.5)));
    CHECK(answer[7] == 1);
    CHECK(answer[8] == 0);
}

TEST_CASE("a heading turns just past an obstacle", "[environment][water]") {
    const std::string stone = "obstacles = [{ shape = \"sphere\", center = [0, -0.5, 0], radius = 0.3 }]";
    // The tangent from the tip to the stone is 36.87 degrees off the way down; 38 is the first even angle past it.
    for (const std::string& domain : {plane, space}) {
        Soil soil(domain + stone);
        soil.advance();
        const auto answer = soil.ask({{{0, 0, 0}, {0, 0, 0, 0.6, 0, 0, 0, 0}}})[0];
        CHECK(answer[7] == 1);
        CHECK(turn_between(heading_of(answer), {0, -1, 0}) == Approx(38).epsilon(1e-6));
    }
}

TEST_CASE("headings never hit an obstacle nor leave the domain", "[environment][water]") {
    const bool flat = GENERATE(true, false);
    Soil soil((flat ? plane : space) + R"(
obstacles = [{ shape = "sphere", center = [0.3, 0, 0], radius = 0.25 },
             { shape = "box", lower = [-0.7, -0.4, -1], upper = [-0.6, 0.4, 1] },
             { shape = "sphere", center = [0, -0.6, 0.2], radius = 0.3 }]
)");
    soil.advance();
    Settings settings = Settings::parse_toml("shape = \"sphere\"\ncenter = [0.3, 0, 0]\nradius = 0.25", "a");
    Settings box = Settings::parse_toml("shape = \"box\"\nlower = [-0.7, -0.4, -1]\nupper = [-0.6, 0.4, 1]", "b");
    Settings other = Settings::parse_toml("shape = \"sphere\"\ncenter = [0, -0.6, 0.2]\nradius = 0.3", "c");
    const auto stones = {read_shape(settings), read_shape(box), read_shape(other)};
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-1, 1);
    int turned = 0, stuck = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 p{place(random), place(random), flat ? 0 : place(random)};
        glm::dvec3 h{place(random), place(random), flat ? 0 : place(random)};
        h = glm::normalize(h);
        const double length = 0.45;
        const auto answer = soil.ask({{p, {0, 0.3, 0, length, 0, 0, 0, 0}, h}})[0];
        const bool inside = std::any_of(stones.begin(), stones.end(), [&](const auto& s) { return s->inside(p); });
        if (answer[7] == 0) {
            CHECK(inside);
            CHECK(heading_of(answer) == glm::dvec3(0));
            ++stuck;
            continue;
        }
        CHECK(glm::length(heading_of(answer)) == Approx(1));
        if (turn_between(heading_of(answer), glm::normalize(h + glm::dvec3(0, -0.3, 0))) > 1) ++turned;
        bool hit = false;
        for (int k = 0; k <= 300; ++k) {
            const glm::dvec3 at = p + heading_of(answer) * (length * k / 300);
            hit = hit || std::abs(at.x) > 1 + 1e-9 || std::abs(at.y) > 1 + 1e-9 || std::abs(at.z) > 1 + 1e-9;
            // Following distances by steps of a sixteenth of a voxel may graze a corner by less than that.
            for (const auto& stone : stones) hit = hit || stone->distance(at) < -0.1 / 16;
        }
        CHECK_FALSE(hit);
    }
    CHECK(turned > 50);
    CHECK(stuck > 0);
}

TEST_CASE("a tip walled in gets no heading", "[environment][water]") {
    Soil soil(plane + R"(
obstacles = [{ shape = "box", lower = [-0.5, 0.2, -1], upper = [0.5, 0.5, 1] },
             { shape = "box", lower = [-0.5, -0.5, -1], upper = [0.5, -0.2, 1] },
             { shape = "box", lower = [-0.5, -0.5, -1], upper = [-0.2, 0.5, 1] },
             { shape = "box", lower = [0.2, -0.5, -1], upper = [0.5, 0.5, 1] }]
)");
    soil.advance();
    const auto answers = soil.ask({{{0, 0, 0}, {0, 0, 0, 0.4, 9, 9, 9, 9}}, {{0, 0, 0}, {0, 0, 0, 0.1, 9, 9, 9, 9}}});
    CHECK(answers[0] == std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0});
    CHECK(answers[1][7] == 1);
}

TEST_CASE("a seed above the soil grows into it but not away from it", "[environment][water]") {
    Soil soil(plane + "initial = 0.3");
    soil.advance();
    const std::vector<double> sown = {0.1, 0, 0, 0.2, 0, 0, 0, 0};
    const auto answers = soil.ask({{{0, 1.05, 0}, sown, {0, -1, 0}}, {{0, 1.05, 0}, sown, {0, 1, 0}}});
    CHECK(answers[0][0] == 0);
    CHECK(heading_of(answers[0]) == glm::dvec3(0, -1, 0));
    CHECK(answers[1][7] == 1);
    CHECK(heading_of(answers[1]).y < -0.25 + 1e-9);
}

}  // namespace espalier::test

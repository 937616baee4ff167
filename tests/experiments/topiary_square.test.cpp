// A plant pruned to a square and one pruned to an ellipse (Prusinkiewicz, James & Mech 1994).
#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <vector>

using namespace espalier;

namespace {

constexpr double kHalfWidth = 2.6, kHeight = 5.2;

/// How far outside the square a point is; 0 inside.
double outside_square(const glm::dvec3& point) {
    return std::max({0.0, std::abs(point.x) - kHalfWidth, -point.y, point.y - kHeight});
}

/// What happens to the plant in one step, told from its strings.
struct Step {
    int apices = 0, signals = 0, buds = 0, branches = 0, cuts = 0;
    bool apex_outside = false;
    int signal_order = -1;  ///< depth of branching the signal is at
};

int depth_of(const std::string& text, char symbol) {
    int depth = 0;
    for (char c : text) {
        if (c == symbol) return depth;
        if (c == '[') ++depth;
        if (c == ']') --depth;
    }
    return -1;
}

Step look_at(const LonePlant& plant) {
    auto counts = plant.counts();
    Step step{counts["A"], counts["S"], counts["K"], counts["["], counts["%"]};
    step.signal_order = depth_of(plant.text(), 'S');
    step.apex_outside = step.apices == 1 && outside_square(plant.interpretation.answers.front().position) > 0;
    return step;
}

std::vector<Step> history(int steps) {
    LonePlant plant("models/topiary/square.l");
    std::vector<Step> history{look_at(plant)};
    for (int step = 1; step <= steps; ++step) {
        plant.grow(1);
        history.push_back(look_at(plant));
    }
    return history;
}

/// The string without its queries, which differ in name and answers.
std::string structure(const std::string& text) {
    static const std::regex query(R"(\?[PE]\([^)]*\))");
    return std::regex_replace(text, query, "");
}

double on_ellipse(const glm::dvec3& point) {
    return 4 * point.x * point.x + (point.y - 10) * (point.y - 10);  // 100 on the ellipse
}

}  // namespace

TEST_CASE("square: every step of the published figure shows an event", "[topiary]") {
    const std::vector<Step> at = history(94);
    const auto cut_at = [&](int step) { return at[step].cuts == 1 && at[step].signals == 1 && at[step].apices == 0; };
    const auto wakes_at = [&](int step) { return at[step].branches == at[step - 1].branches + 1; };

    CHECK(at[0].buds == 0);
    CHECK(at[1].buds == 1);  // none at the ground: the first segment is bare
    // an apex is seen outside
    for (int step : {5, 11, 19, 93}) CHECK(at[step].apex_outside);
    for (int step : {0, 1, 2, 3, 4, 10, 17, 18, 92}) CHECK(!at[step].apex_outside);
    // cut: a signal is born, on the main axis or in a branch
    for (int step : {6, 8, 12, 14, 20, 94}) CHECK(cut_at(step));
    // the signal has met a bud
    for (int step : {7, 10, 13, 17, 40, 75}) CHECK(wakes_at(step));
    // and come down to the main axis for it
    for (int step : {10, 17, 40, 75}) {
        CHECK(at[step - 1].signal_order == 0);
        CHECK(at[step - 2].signal_order > 0);
    }
}

TEST_CASE("square: there is one apex or one signal, never both", "[topiary]") {
    for (const Step& step : history(200)) CHECK(step.apices + step.signals == 1);
}

TEST_CASE("square: a segment that ends outside is cut in the following step; even stubs stay inside", "[topiary]") {
    LonePlant plant("models/topiary/square.l");
    std::set<Identity> outside;
    int cuts = 0;
    for (int step = 0; step <= 200; ++step) {
        std::set<Identity> outside_now;
        for (const Internode& internode : plant.interpretation.geometry.internodes) {
            if (outside_square(internode.tip) == 0) continue;
            CHECK(glm::distance(internode.base, internode.tip) == Approx(1));
            outside_now.insert(plant.string.identity(internode.module));
        }
        CHECK(outside_now.size() <= 1);
        for (Identity identity : outside_now) CHECK(!outside.contains(identity));
        cuts += static_cast<int>(outside_now.size());
        outside = outside_now;
        plant.grow(1);
    }
    CHECK(cuts > 40);
}

TEST_CASE("square: buds wake as often as a signal meets one", "[topiary]") {
    LonePlant plant("models/topiary/square.l");
    int met = 0, awake = 0;
    for (int step = 0; step < 200; ++step) {
        met += structure(plant.text()).find("KS") != std::string::npos ? 1 : 0;
        const int before = plant.counts()["["];
        plant.grow(1);
        awake += plant.counts()["["] - before;
    }
    CHECK(awake > 40);
    CHECK(awake == met);
}

TEST_CASE("square: the box of the environment and the box in the model give the same plant step by step", "[topiary]") {
    World turtle_only(read_scene(source_path("environments/topiary-square.toml")));
    World with_shape(read_scene(source_path("environments/topiary-square-shape.toml")));
    CHECK(turtle_only.environment().size() == 0);
    CHECK(with_shape.environment().size() == 1);
    turtle_only.start();
    with_shape.start();
    for (int step = 0; step <= 200; ++step) {
        const std::string one = structure(to_text(turtle_only.string(0), turtle_only.model(0).alphabet));
        const std::string other = structure(to_text(with_shape.string(0), with_shape.model(0).alphabet));
        REQUIRE(one == other);
        turtle_only.step();
        with_shape.step();
    }
}

TEST_CASE("ellipse: every axis is cut where it leaves the ellipse, and forks by twice its height", "[topiary]") {
    const std::string angle = GENERATE("60", "90");
    LonePlant plant("models/topiary/ellipse.l", {{"ANGLE", angle}});
    plant.grow(40);
    const PlantGeometry& geometry = plant.interpretation.geometry;

    // Prongs are the only internodes that begin beyond the ellipse; each turns away from what it stands on.
    int prongs = 0;
    for (const Internode& prong : geometry.internodes) {
        if (on_ellipse(prong.base) <= 100) continue;
        const auto stands_on = std::find_if(geometry.internodes.begin(), geometry.internodes.end(),
                                            [&](auto& below) { return glm::distance(below.tip, prong.base) < 1e-9; });
        REQUIRE(stands_on != geometry.internodes.end());
        CHECK(on_ellipse(stands_on->base) <= 100);  // the segment below crosses it: cut within one segment
        const double cosine = glm::dot(stands_on->tip - stands_on->base, prong.tip - prong.base);
        CHECK(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI == Approx(2 * prong.base.y).margin(1e-6));
        ++prongs;
    }
    auto counts = plant.counts();
    CHECK(counts["A"] + counts["B"] == 0);  // all growth has been stopped
    CHECK(prongs == 2 * (1 + 2 * 21));      // the main axis, and a pair of lateral ones at the heights 0 to 20
}

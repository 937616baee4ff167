// models/language: each construct does what the model's first lines say.
#include "catch.h"
#include "experiments/growth.h"
#include "models/paths.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

using namespace espalier;

namespace {

std::string file(const std::string& name) {
    return "models/language/" + name + ".l";
}

/// The parameters of all modules of a name, in string order.
std::vector<std::vector<double>> parameters_of(const LonePlant& plant, const std::string& name) {
    std::vector<std::vector<double>> result;
    const auto offsets = parameter_offsets(plant.string, plant.model->alphabet);
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        if (plant.model->alphabet.name(plant.string.letters[i]) != name) continue;
        const double* values = plant.string.parameters.data();
        result.emplace_back(values + offsets[i], values + offsets[i + 1]);
    }
    return result;
}

}  // namespace

TEST_CASE("Conditions: the printed strings; a module with another number of parameters is another module",
          "[language]") {
    LonePlant string(file("conditions"));
    for (const char* expected :
         {"B(2)A(4,4)A(1)", "B(1)B(4)A(1,0)A(1)", "B(0)B(3)A(2,1)A(1)", "CB(2)A(4,3)A(1)", "CB(1)A(8,7)A(1)"}) {
        CHECK(string.text() == expected);
        string.grow(1);
    }
}

TEST_CASE("Parametric turtle: F(2.5) moves by 2.5, and +(90)+(-90) is nothing", "[language]") {
    const LonePlant turtle(file("parametric-turtle"));
    const auto& segments = turtle.interpretation.geometry.internodes;
    REQUIRE(segments.size() == 6);
    const auto is = [](const glm::dvec3& point, double x, double y, double z) {
        return glm::length(point - glm::dvec3(x, y, z)) < 1e-12;
    };
    CHECK(is(segments[0].tip, 0, 2.5, 0));
    CHECK(is(segments[1].tip, 0, 3.5, 0));
    const double x = -std::sin(std::numbers::pi / 6), y = std::cos(std::numbers::pi / 6);
    CHECK(is(segments[2].base, x, 3.5 + y, 0));  // f(1) leaves a gap
    CHECK(is(segments[2].tip, 1.5 * x, 3.5 + 1.5 * y, 0));
    CHECK(is(segments[3].tip, 0, 3.5, -2));  // & turns the heading towards up
    CHECK(is(segments[4].tip, 0, 3.5, -2));  // / turns left towards up
    CHECK(is(segments[5].tip, 1, 4.5, 0));
}

TEST_CASE("Statements: 25 primes below 100, and all numbers of prime factors", "[language]") {
    LonePlant sieve(file("statements"));
    sieve.grow(1);
    const auto numbers = parameters_of(sieve, "Number");
    REQUIRE(numbers.size() == 98);
    int primes = 0;
    for (const auto& number : numbers) {
        int rest = static_cast<int>(number[0]), factors = 0;
        for (int d = 2; rest > 1; ++d) {
            for (; rest % d == 0; rest /= d) ++factors;
        }
        CHECK(number[1] == factors);
        primes += factors == 1;
    }
    CHECK(primes == 25);
}

TEST_CASE("Blocks: Start once, StartEach and EndEach every step, and growth that watches itself", "[language]") {
    LonePlant plant(file("blocks"));
    plant.derivation.set_length(12);
    int before = 0;
    for (int step = 1; step <= 12; ++step) {
        plant.grow(1);
        const int segments = plant.counts()["F"];
        const auto report = parameters_of(plant, "Report").at(0);
        CHECK(report == std::vector<double>{1, double(step), double(step - 1), 0, double(step == 12), double(before)});
        CHECK((before >= 40) == (segments == before));
        before = segments;
    }
    CHECK(before == 62);
}

TEST_CASE("Decomposition: metamers fall apart within the step", "[language]") {
    LonePlant shoot(file("decomposition"));
    for (int n = 1; n <= 8; ++n) {
        shoot.grow(1);
        auto counts = shoot.counts();
        CHECK(counts["Internode"] == n);
        CHECK(counts["Leaf"] == 5 * n);
        CHECK(counts["Metamer"] + counts["Whorl"] == 0);
    }
}

TEST_CASE("Homomorphism: pictures of pictures, as deep as allowed, and nothing of them in the string", "[language]") {
    const LonePlant deep(file("homomorphism"));
    CHECK(deep.counts()["Flower"] == 3);
    CHECK(deep.counts()["Petal"] + deep.counts()["@"] == 0);
    CHECK(deep.interpretation.geometry.polygons.size() == 3 * 6 * 2);
    CHECK(deep.interpretation.geometry.organs.size() == 3);
    // Flower, Corolla, Petal and Half are four levels; each petal of a whorl begins one level deeper.
    const LonePlant shallow(file("homomorphism"), {{"DEPTH", "2"}});
    CHECK(shallow.interpretation.geometry.polygons.empty());
    const LonePlant half(file("homomorphism"), {{"DEPTH", "4"}});
    CHECK(half.interpretation.geometry.polygons.size() == 3 * 1 * 2);
}

TEST_CASE("Contexts: a named branch holds what is named, with = at least that", "[language]") {
    LonePlant string(file("contexts"));
    string.grow(1);
    CHECK(string.text() == "1[C]F2[C[D]E]F3[C[D]E]FCD45AF");
}

TEST_CASE("Cut: a branch is whole until it is shed, and then gone", "[language]") {
    LonePlant shoot(file("cut"));
    for (int step = 1; step <= 20; ++step) {
        shoot.grow(1);
        CHECK(shoot.counts()["I"] == step);
        CHECK(shoot.counts()["B"] <= 7);
        CHECK(shoot.counts()["%"] <= 1);
        // Branches of ages 1 to 6 and the one that carries its cut have 2^age - 1 apices made so far.
        const int living = std::min(step - 1, 7);
        int apices = 0;
        for (int age = 1; age <= living; ++age) {
            for (int bud = 0; bud < std::min(age, 6); ++bud) apices += 1 << (age - 1 - bud);
        }
        CHECK(shoot.counts()["X"] == apices);
    }
}

TEST_CASE("Named modules are matched whole; constants are what they say", "[language]") {
    LonePlant string(file("named-modules"));
    CHECK(string.text() == "Root(137.508,6.28319)R(1)Ro(2)芽");
    string.grow(2);
    CHECK(string.text() == "Root(137.508,6.28319)R(100)Ro(4)/(137.508)葉/(137.508)葉芽");
}

TEST_CASE("Binary counter: once the carries have settled the digits are the number", "[language]") {
    LonePlant counter(file("binary-counter"));
    for (int step = 1; step <= 80; ++step) {
        counter.grow(1);
        if (counter.counts()["Carry"] > 0) continue;
        unsigned value = 0;
        for (const auto& digit : parameters_of(counter, "Digit")) value = 2 * value + static_cast<unsigned>(digit[0]);
        CHECK(value == static_cast<unsigned>(step) / 2);
    }
    unsigned carried = 0;  // carries under way count as much as the digit they have come to
    counter.grow(64);
    const auto digits = parameters_of(counter, "Digit");
    for (const auto& digit : digits) carried = 2 * carried + static_cast<unsigned>(digit[0]);
    CHECK(carried <= 72);
    CHECK(digits.size() == static_cast<std::size_t>(std::bit_width(72u)));
}

TEST_CASE("Stopping: the ball comes to rest, and the derivation with it", "[language]") {
    LonePlant ball(file("stopping"));
    int steps = 0;
    for (; steps < 10'000 && !ball.derivation.stopped(); ++steps) ball.grow(1);
    CHECK(ball.derivation.stopped());
    CHECK(steps < 300);
    CHECK(parameters_of(ball, "Ball").at(0)[2] == 0);
    double highest = 0, bounce_before = 1e9;
    for (const auto& track : parameters_of(ball, "Track")) {
        highest = std::max(highest, track[1]);
        if (track[1] == 0) {
            CHECK(highest < bounce_before);
            bounce_before = highest;
            highest = 0;
        }
    }
}

TEST_CASE("Queries: every answer is the pose of a turtle of one's own", "[language]") {
    LonePlant tendril(file("queries"));
    double lowest = 0;
    bool stopped = false;
    for (int step = 1; step <= 60; ++step) {
        tendril.grow(1);
        glm::dvec3 position(0), heading(0, 1, 0), left(-1, 0, 0), up(0, 0, -1);
        const auto turn = [](glm::dvec3& a, glm::dvec3& b, double degrees) {
            const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
            const glm::dvec3 turned = a * c + b * s;
            b = b * c - a * s;
            a = turned;
        };
        const auto offsets = parameter_offsets(tendril.string, tendril.model->alphabet);
        int answers = 0;
        for (std::size_t i = 0; i < tendril.string.size(); ++i) {
            const std::string& name = tendril.model->alphabet.name(tendril.string.letters[i]);
            const double* p = tendril.string.parameters.data() + offsets[i];
            if (name == "F") position += p[0] * heading;
            if (name == "&") turn(heading, up, p[0]);
            if (name == "^") turn(heading, up, -p[0]);
            if (name == "/") turn(left, up, p[0]);
            if (name != "P" && name != "H") continue;
            const glm::dvec3 expected = name == "P" ? position : heading;
            CHECK(glm::length(glm::dvec3(p[0], p[1], p[2]) - expected) < 1e-9);
            ++answers;
        }
        stopped = tendril.counts()["A"] == 0;
        CHECK(answers == (stopped ? 0 : 2));
        lowest = std::min(lowest, position.y);
        if (stopped) CHECK(position.y > 3);
    }
    CHECK(stopped);
    CHECK(lowest > -4);
    CHECK(lowest < -2);
}

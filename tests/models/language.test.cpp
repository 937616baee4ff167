// models/language: each construct does what the model's first lines say.
#include "app/program.h"
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"
#include "models/paths.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace espalier;

namespace {

std::string file_of_language(const std::string& name) {
    return "models/language/" + name + ".l";
}

}  // namespace

TEST_CASE("Conditions: the printed strings; a module with another number of parameters is another module",
          "[language]") {
    LonePlant string(file_of_language("conditions"));
    for (const char* expected :
         {"B(2)A(4,4)A(1)", "B(1)B(4)A(1,0)A(1)", "B(0)B(3)A(2,1)A(1)", "CB(2)A(4,3)A(1)", "CB(1)A(8,7)A(1)"}) {
        CHECK(string.text() == expected);
        string.grow(1);
    }
}

TEST_CASE("Parametric turtle: F(2.5) moves by 2.5, and +(90)+(-90) is nothing", "[language]") {
    const LonePlant turtle(file_of_language("parametric-turtle"));
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
    LonePlant sieve(file_of_language("statements"));
    sieve.grow(1);
    const auto numbers = parameters_of(sieve.string, sieve.model->alphabet, "Number");
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
    LonePlant plant(file_of_language("blocks"));
    plant.derivation.set_length(12);
    int before = 0;
    for (int step = 1; step <= 12; ++step) {
        plant.grow(1);
        const int segments = plant.counts()["F"];
        const auto report = parameters_of(plant.string, plant.model->alphabet, "Report").at(0);
        CHECK(report == std::vector<double>{1, double(step), double(step - 1), 0, double(step == 12), double(before)});
        CHECK((before >= 40) == (segments == before));
        before = segments;
    }
    CHECK(before == 62);
}

TEST_CASE("Decomposition: metamers fall apart within the step", "[language]") {
    LonePlant shoot(file_of_language("decomposition"));
    for (int n = 1; n <= 8; ++n) {
        shoot.grow(1);
        auto counts = shoot.counts();
        CHECK(counts["Internode"] == n);
        CHECK(counts["Leaf"] == 5 * n);
        CHECK(counts["Metamer"] + counts["Whorl"] == 0);
    }
}

TEST_CASE("Homomorphism: pictures of pictures, as deep as allowed, and nothing of them in the string", "[language]") {
    const LonePlant deep(file_of_language("homomorphism"));
    CHECK(deep.counts()["Flower"] == 3);
    CHECK(deep.counts()["Petal"] + deep.counts()["@"] == 0);
    CHECK(deep.interpretation.geometry.polygons.size() == 3 * 6 * 2);
    CHECK(deep.interpretation.geometry.organs.size() == 3);
    // Flower, Corolla, Petal and Half are four levels; each petal of a whorl begins one level deeper.
    const LonePlant shallow(file_of_language("homomorphism"), {{"DEPTH", "2"}});
    CHECK(shallow.interpretation.geometry.polygons.empty());
    const LonePlant half(file_of_language("homomorphism"), {{"DEPTH", "4"}});
    CHECK(half.interpretation.geometry.polygons.size() == 3 * 1 * 2);
}

TEST_CASE("Contexts: a named branch holds what is named, with = at least that", "[language]") {
    LonePlant string(file_of_language("contexts"));
    string.grow(1);
    CHECK(string.text() == "1[C]F2[C[D]E]F3[C[D]E]FCD45AF");
}

TEST_CASE("Cut: a branch is whole until it is shed, and then gone", "[language]") {
    LonePlant shoot(file_of_language("cut"));
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
    LonePlant string(file_of_language("named-modules"));
    CHECK(string.text() == "Root(137.508,6.28319)R(1)Ro(2)芽");
    string.grow(2);
    CHECK(string.text() == "Root(137.508,6.28319)R(100)Ro(4)/(137.508)葉/(137.508)葉芽");
}

TEST_CASE("Binary counter: once the carries have settled the digits are the number", "[language]") {
    LonePlant counter(file_of_language("binary-counter"));
    for (int step = 1; step <= 80; ++step) {
        counter.grow(1);
        if (counter.counts()["Carry"] > 0) continue;
        unsigned value = 0;
        for (const auto& digit : parameters_of(counter.string, counter.model->alphabet, "Digit"))
            value = 2 * value + static_cast<unsigned>(digit[0]);
        CHECK(value == static_cast<unsigned>(step) / 2);
    }
    unsigned carried = 0;  // carries under way count as much as the digit they have come to
    counter.grow(64);
    const auto digits = parameters_of(counter.string, counter.model->alphabet, "Digit");
    for (const auto& digit : digits) carried = 2 * carried + static_cast<unsigned>(digit[0]);
    CHECK(carried <= 72);
    CHECK(digits.size() == static_cast<std::size_t>(std::bit_width(72u)));
}

TEST_CASE("Stopping: the ball comes to rest, and the derivation with it", "[language]") {
    LonePlant ball(file_of_language("stopping"));
    int steps = 0;
    for (; steps < 10'000 && !ball.derivation.stopped(); ++steps) ball.grow(1);
    CHECK(ball.derivation.stopped());
    CHECK(steps < 300);
    CHECK(parameters_of(ball.string, ball.model->alphabet, "Ball").at(0)[2] == 0);
    double highest = 0, bounce_before = 1e9;
    for (const auto& track : parameters_of(ball.string, ball.model->alphabet, "Track")) {
        highest = std::max(highest, track[1]);
        if (track[1] == 0) {
            CHECK(highest < bounce_before);
            bounce_before = highest;
            highest = 0;
        }
    }
}

TEST_CASE("Queries: every answer is the pose of a turtle of one's own", "[language]") {
    LonePlant tendril(file_of_language("queries"));
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

TEST_CASE("Table: internodes are as long as the file says, and as many", "[language]") {
    LonePlant shoot(file_of_language("table/growth"));
    shoot.grow(14);
    const std::vector<double> expected{0.45, 0.62, 0.88, 1.10, 1.26, 1.21, 1.02, 0.81, 0.66, 0.41, 0.30, 0.18};
    const auto& segments = shoot.interpretation.geometry.internodes;
    REQUIRE(segments.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(glm::length(segments[i].tip - segments[i].base) == Approx(expected[i]));
    }
}

TEST_CASE("Labels: one for each internode, with the values it was given", "[language]") {
    LonePlant shoot(file_of_language("labels"));
    shoot.grow(5);
    const auto& labels = shoot.interpretation.geometry.labels;
    REQUIRE(labels.size() == 5);
    CHECK(labels[0].text == "0: 0.5");
    CHECK(labels[4].text == "4: 1.3");
    CHECK(labels[0].position.x == Approx(0.2));
    CHECK(labels[0].position.y == Approx(0.5));
}

TEST_CASE("Preprocessor: an included leaf, opposite or alternate, wide or narrow", "[language]") {
    const auto width_of_oldest = [](const LonePlant& twig) {
        const auto& polygon = twig.interpretation.geometry.polygons.front();
        const auto first = twig.interpretation.geometry.vertices.begin() + polygon.first;
        return glm::length(first[1] - first[3]);
    };
    LonePlant alternate(file_of_language("shared/twig"));
    LonePlant opposite(file_of_language("shared/twig"), {{"OPPOSITE", "1"}, {"SHAPE", "2"}});
    alternate.grow(8);
    opposite.grow(8);
    CHECK(alternate.counts()["L"] == 8);
    CHECK(opposite.counts()["L"] == 16);
    CHECK(width_of_oldest(alternate) == Approx(2 * 0.15 * 7 * std::sin(35 * std::numbers::pi / 180)));
    CHECK(width_of_oldest(opposite) == Approx(2 * 0.15 * 7 * std::sin(15 * std::numbers::pi / 180)));
}

namespace {

/// The n-th L-system of a model's file on its own, grown by so many steps, as text.
std::string alone(const std::string& name, int system, int steps) {
    std::ifstream in(source_path(file_of_language(name)));
    std::string text(std::istreambuf_iterator<char>(in), {});
    std::size_t begin = text.find("lsystem: " + std::to_string(system));
    text = text.substr(begin, text.find("endlsystem", begin) - begin) + "endlsystem\n";
    text = std::regex_replace(text, std::regex("define: .*external (.*); .*"), "Start: { $1 = 0; }");
    const auto model = read_model_text(text, name);
    Derivation derivation(compile(model));
    ModuleString string, next;
    derivation.start(string);
    for (int step = 0; step < steps; ++step) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    return to_text(string, model->alphabet);
}

/// What stands between the signs of the sub-L-systems, in string order.
std::vector<std::string> parts(const std::string& text) {
    std::vector<std::string> result;
    for (std::size_t at = text.find('?'); at != std::string::npos; at = text.find('?', at + 1)) {
        const std::size_t begin = text.find(')', at) + 1;
        result.push_back(text.substr(begin, text.find('$', at) - begin));
    }
    return result;
}

double height_between(const PlantGeometry& geometry, double left, double right) {
    double height = 0;
    for (const Internode& internode : geometry.internodes) {
        if (internode.tip.x > left && internode.tip.x < right) height = std::max(height, internode.tip.y);
    }
    return height;
}

}  // namespace

TEST_CASE("Species: each is what its own L-system makes alone, drawn at its scale", "[language]") {
    LonePlant grove(file_of_language("species/grove"));
    for (int step = 1; step <= 7; ++step) {
        grove.grow(1);
        const auto species = parts(grove.text());
        REQUIRE(species.size() == 3);
        CHECK(species[0] == alone("species/grove", 1, step));
        CHECK(species[1] == alone("species/grove", 2, step));
        CHECK(species[2] == species[0]);
    }
    const PlantGeometry& geometry = grove.interpretation.geometry;
    CHECK(height_between(geometry, -6.001, -5.999) == Approx(7));
    CHECK(height_between(geometry, 4.999, 5.001) == Approx(3.5));
}

TEST_CASE("Compound leaf: a leaf made k steps ago is its own L-system after k steps; all turn at once", "[language]") {
    LonePlant plant(file_of_language("species/compound-leaf"));
    for (int step = 1; step <= 16; ++step) {
        plant.grow(1);
        const auto leaves = parts(plant.text());
        REQUIRE(leaves.size() == static_cast<std::size_t>(std::min(step, 8)));
        for (std::size_t node = 0; node < leaves.size(); ++node) {
            const std::string& leaf = leaves[node];
            const auto green = std::count(leaf.begin(), leaf.end(), 'G');
            const auto brown = std::count(leaf.begin(), leaf.end(), 'H');
            if (step < 14) {
                CHECK(brown == 0);
                CHECK(leaf == alone("species/compound-leaf", 1, step - 1 - static_cast<int>(node)));
            } else {
                // Every G of the step before has turned; those made in this step have not yet.
                CHECK((brown > 0) == (step - 1 - static_cast<int>(node) > 1));
                const int before = step - 2 - static_cast<int>(node);
                const std::string old = before >= 0 ? alone("species/compound-leaf", 1, before) : "";
                CHECK(green == 2 * std::count(old.begin(), old.end(), 'A'));
            }
        }
    }
}

TEST_CASE("Shoot: lengths and angles are the values of the function set", "[language]") {
    const View view = read_view_file(source_path("models/language/shoot/shoot.v"));
    CHECK(view.function_names == Defines{{"INTERNODE", "1"}, {"BRANCH", "2"}, {"ANGLE", "3"}});
    LonePlant shoot(view, file_of_language("shoot/shoot"));
    shoot.grow(30);
    REQUIRE(view.resources);
    const auto& functions = view.resources->functions;
    REQUIRE(functions.size() == 3);
    const auto internodes = parameters_of(shoot.string, shoot.model->alphabet, "I"),
               branches = parameters_of(shoot.string, shoot.model->alphabet, "B");
    const auto angles = parameters_of(shoot.string, shoot.model->alphabet, "&");
    REQUIRE(internodes.size() == 30);
    REQUIRE(branches.size() == 30);
    for (std::size_t n = 0; n < 30; ++n) {
        const double place = static_cast<double>(n) / 30;
        CHECK(internodes[n][0] == Approx(0.4 + 0.5 * functions[0](place)));
        CHECK(branches[n][0] == Approx(functions[1](place)));
        CHECK(angles[n][0] == Approx(functions[2](place)));
    }
    // A function's value is found within 0.001 of the abscissa.
    CHECK(functions[0](0) == Approx(1).margin(0.002));
    CHECK(functions[1](1) == Approx(0.05).margin(0.002));
    CHECK(functions[2](0) == Approx(95).margin(0.1));
    CHECK(shoot.interpretation.geometry.internodes.front().colour == 16);
}

TEST_CASE("Shoot: the frames of the object are those its animation file asks for", "[language]") {
    const Workplace workplace;
    const std::string object = source_path("models/language/shoot").string();
    REQUIRE(workplace.run("run '" + object + "' --output out --quiet").code == 0);
    std::set<std::string> frames;
    for (const auto& entry : std::filesystem::directory_iterator(workplace.path() / "out" / "plants")) {
        frames.insert(entry.path().filename());
    }
    CHECK(frames == std::set<std::string>{"0005.vtp", "0010.vtp", "0015.vtp", "0020.vtp", "0025.vtp", "0030.vtp"});
}

TEST_CASE("Scale: of every order, lengths and widths alike, and back again", "[language]") {
    for (const double ratio : {0.5, 0.6}) {
        LonePlant plant(file_of_language("scale"), {{"RATIO", std::to_string(ratio)}});
        plant.grow(4);
        const auto& segments = plant.interpretation.geometry.internodes;
        REQUIRE(segments.size() == 2 * (1 + 4 + 16 + 64) + 1);
        for (const Internode& segment : segments) {
            const double scale = std::pow(ratio, segment.order);
            CHECK(glm::length(segment.tip - segment.base) == Approx(scale));
            CHECK(segment.tip_radius == Approx(0.05 * scale));
        }
        CHECK(segments.back().order == 0);
    }
}

TEST_CASE("Protocol: the file a model writes lies in the run's folder, with a line for every step", "[language]") {
    const Workplace workplace;
    const std::string model = source_path(file_of_language("protocol")).string();
    REQUIRE(workplace.run("run '" + model + "' --output out --quiet").code == 0);
    std::ifstream in(workplace.path() / "out" / "files" / "buds.txt");
    const std::string text(std::istreambuf_iterator<char>(in), {});
    CHECK(text == "step,buds\n1,2\n2,4\n3,8\n4,16\n5,32\n6,64\n");
}

TEST_CASE("Liana: nodes on the curve, a segment apart, as long together as the curve", "[language]") {
    const View view = read_view_file(source_path("models/language/spiral/liana.v"));
    REQUIRE(view.resources);
    REQUIRE(view.resources->curves.size() == 1);
    const SpaceCurve& curve = view.resources->curves[0];
    LonePlant liana(view, file_of_language("spiral/liana"));
    liana.grow(40);
    const auto& segments = liana.interpretation.geometry.internodes;
    REQUIRE(segments.size() == 40);
    for (std::size_t i = 0; i < 40; ++i) {
        CHECK(glm::length(segments[i].tip - curve(static_cast<double>(i + 1) / 40)) < 1e-9);
        CHECK(glm::length(segments[i].tip - segments[i].base) == Approx(curve.length() / 40).epsilon(0.02));
    }
    CHECK(glm::length(segments.front().base - glm::dvec3(1, 0, 0)) < 1e-9);
    const double sum = total_length(liana.interpretation.geometry);
    CHECK(sum < curve.length());
    CHECK(sum == Approx(curve.length()).epsilon(0.01));
}

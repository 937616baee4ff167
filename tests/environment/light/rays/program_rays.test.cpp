// ray-light with parameter files of QuasiMC and MonteCarlo, beside what these programs print (vlab 9bf820d) and closed
// forms.
#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// One query, and the module behind it as a turtle stands at both.
struct AskedShape {
    glm::dvec3 place;
    std::string symbol;
    std::vector<double> sizes;
    glm::dvec3 heading{0, 0, -1}, up{0, -1, 0};  ///< level, as after &(90) from upright: the side of up is below
    double first = 0;                            ///< parameter of the query
};

class Program {
public:
    explicit Program(const std::string& parameters, const std::string& name = "QuasiMC",
                     const std::string& scene = "") {
        folder_.write("q.spec", parameters);
        table_ = Settings::parse_toml(
            "[E]\nprocess = \"ray-light\"\nprogram = \"" + name + "\"\nparameters = \"q.spec\"\n" + scene, "scene.toml",
            folder_.path());
    }

    /// `count` answers of each shape.
    std::vector<double> answers(const std::vector<AskedShape>& shapes, std::size_t count = 1, int step = 1) {
        EnvironmentContext context;
        context.plants = 1;
        context.warnings = &warnings;
        Environment environment({{"E", table_.table("E")}}, context);
        AskingPlants plants({"E"});
        std::vector<Asked> asked;
        for (const AskedShape& shape : shapes) {
            std::vector<double> parameters(count, 0);
            parameters[0] = shape.first;
            asked.push_back({shape.place, parameters, "E"});
        }
        plants.add(asked);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            Query& query = plants.interpretation(0).queries[i];
            query.following =
                plants.model().alphabet.letter(shapes[i].symbol, static_cast<int>(shapes[i].sizes.size()));
            query.following_parameters = shapes[i].sizes;
            query.pose.heading = shapes[i].heading;
            query.pose.up = shapes[i].up;
            query.pose.left = glm::cross(shapes[i].heading, shapes[i].up);
        }
        plants.exchange(environment, step);
        return plants.parameters();
    }
    std::string refusal() {
        return message_of([&] { answers({}); });
    }

    std::vector<Diagnostic> warnings;

private:
    TemporaryFolder folder_;
    Settings table_;
};

const std::string common =
    "verbose: 0\nMaximum depth: 5\nnumber of runs: 1\nnumber of rays: 262144\nsampling method: sobol\n"
    "local light model: Lambertian\n// a comment\ngrid size: 1x1x1\n";
const std::string green = "leaf material (top): 0.1 0 0.2 0 1\n";

/// Two level rhombi of half a square metre, a metre apart.
std::vector<AskedShape> two_rhombi() {
    return {{{0, 2, 0}, "P", {0.5, 1}}, {{0, 1, 0}, "P", {0.5, 1}}};
}

}  // namespace

TEST_CASE("two level rhombi absorb what QuasiMC prints", "[ray-light][cpfg]") {
    Program density(common + green + "light source: 0 -1 0 1\nreturn type: D\n");
    const auto per_area = density.answers(two_rhombi());
    CHECK(density.warnings.empty());
    CHECK(per_area[0] == Approx(0.700706).epsilon(0.01));
    CHECK(per_area[1] == Approx(0.0169152).epsilon(0.03));
    // The rhombi are facing squares of side .7071, whose view factor is .121431.
    CHECK(per_area[0] == Approx(0.7 + 0.2 * 0.1 * 0.121431 * 0.121431 * 0.7).epsilon(0.005));
    CHECK(per_area[1] == Approx(0.2 * 0.121431 * 0.7).epsilon(0.02));

    const auto flux = Program(common + green + "light source: 0 -1 0 1\n").answers(two_rhombi());
    CHECK(flux[0] == Approx(0.350353).epsilon(0.01));
    CHECK(flux[1] == Approx(0.00845758).epsilon(0.03));

    // Up points down, so the side of U sees nothing but what the lower rhombus sends back.
    const auto upper = Program(common + green + "light source: 0 -1 0 1\nreturn type: U\n").answers(two_rhombi());
    CHECK(upper[0] > 0);
    CHECK(upper[1] == 0);
    const auto lower = Program(common + green + "light source: 0 -1 0 1\nreturn type: L\n").answers(two_rhombi());
    CHECK(lower[0] == Approx(1).epsilon(0.01));
}

TEST_CASE("two level rhombi absorb what MonteCarlo prints, whose light source is where the light comes from",
          "[ray-light][cpfg]") {
    Program program(
        "domain size: 4 4 4\nposition: -2 -1 -2\ngrid size: 4x4x4\nray density: 60000\nseed: 1\n"
        "maximum depth: 5\nleaf material (top): 0.1 0 0.2 0 1\nlight source: 0 1 0 7\n",
        "MonteCarlo");
    const auto flux = program.answers(two_rhombi());
    CHECK(program.warnings.empty());
    CHECK(flux[0] == Approx(0.343769).epsilon(0.03));
    CHECK(flux[1] == Approx(0.00848499).epsilon(0.03));
    auto shapes = two_rhombi();
    shapes.push_back({{0, 9, 0}, "P", {0.5, 1}});
    const auto with_lost = program.answers(shapes);  // one outside of the domain, where it takes no light either
    CHECK(with_lost[2] == 0);
    CHECK(with_lost[0] == Approx(flux[0]).epsilon(0.02));
    CHECK(program.warnings.size() == 1);
}

TEST_CASE("under QuasiMC's skies rhombi absorb what it prints", "[ray-light][cpfg]") {
    const std::string black = "leaf material (top): 0 0 0 0 1\nlocation: 50 0\nreturn type: D\n";
    const auto overcast = Program(common + black + "weather: 0 2.45\n").answers(two_rhombi());
    CHECK(overcast[0] == Approx(0.799752).epsilon(0.03));
    CHECK(overcast[1] == Approx(0.487329).epsilon(0.03));
    const auto clear = Program(common + black + "weather: 1 2.45\n").answers(two_rhombi());
    CHECK(clear[0] == Approx(0.448603).epsilon(0.03));
    CHECK(clear[1] == Approx(0.361361).epsilon(0.03));
    const auto bands =
        Program(common +
                "spectrum samples: 2\nsource spectrum: 660 1 730 .5\nleaf material (top): .1 0 .2 0 1\n"
                ": .4 0 .4 0 1\nlocation: 50 0\njulian day: 172\ngrowth period: 6 18\nreturn type: D D\n")
            .answers(two_rhombi(), 3);
    CHECK(bands[0] == Approx(0.35484).epsilon(0.03));
    CHECK(bands[1] == Approx(0.0522951).epsilon(0.03));
    CHECK(bands[2] == 0);  // further parameters stay
    CHECK(bands[3] == Approx(0.285102).epsilon(0.03));
    CHECK(bands[4] == Approx(0.0420969).epsilon(0.03));
}

TEST_CASE("shapes have their areas, and sides their own materials", "[ray-light][cpfg]") {
    const std::string sides =
        "leaf material (top): 0 0 0 0 1\nleaf material (bottom): .5 0 0 0 1\nmaterial: .2 0 .2 0 1\nlight source: 0 -1 "
        "0\n";
    const auto absorbed = [&](const std::string& symbol, const std::vector<double>& sizes, const glm::dvec3& up) {
        return Program(common + sides).answers({{{0, 1, 0}, symbol, sizes, {0, 0, -1}, up}})[0];
    };
    const glm::dvec3 above(0, 1, 0), below(0, -1, 0);
    CHECK(absorbed("T", {0.3, 0.8}, above) == Approx(0.24).epsilon(0.01));
    CHECK(absorbed("T", {0.3, 0.8}, below) == Approx(0.12).epsilon(0.01));
    CHECK(absorbed("P", {0.3, 0.8}, above) == Approx(0.24).epsilon(0.01));
    CHECK(absorbed("P", {0.3, 0.8, 2}, above) == Approx(0.24 * 0.6).epsilon(0.01));
    CHECK(absorbed("P", {0.3, 0.8, 2, 1}, below) == Approx(0.24 * 0.5).epsilon(0.01));
    CHECK(absorbed("U", {0.3, 0.2, 0.8, 90}, above) == Approx(0.5 * 0.5 * 0.8).epsilon(0.01));
    CHECK(absorbed("U", {0.3, 0.2, 0.8, 30}, above) == Approx(0.5 * 0.5 * 0.8 * 0.5).epsilon(0.01));
    CHECK(absorbed("U", {0.3, 0.2, 0.8, 0}, above) == 0);
    CHECK(absorbed("U", {0.3, 0.2, 0, 90}, above) == 0);
    // Four sides of a prism of the width .2 and the length .5, two of which see the light at 45 degrees: black outside.
    CHECK(absorbed("I", {0.2, 0.5}, above) == Approx(0.2 * 0.5).epsilon(0.02));
    CHECK(absorbed("T", {0.5, 1}, glm::dvec3(1, 0, 0)) == 0);  // edge-on
    CHECK(lacks(message_of([&] { absorbed("P", {0.3, 0.8, 3}, above); }), {"materials 3 and 3", "0 to 2"}) == "");
}

TEST_CASE("a first parameter below 0 shades without an answer; scattered light alone may count", "[ray-light][cpfg]") {
    auto shapes = two_rhombi();
    shapes[0].first = -3;
    const auto shaded = Program(common + "leaf material (top): 0 0 0 0 1\nlight source: 0 -1 0 1\n").answers(shapes);
    CHECK(shaded[0] == -3);
    CHECK(shaded[1] == 0);
    const auto scattered =
        Program(common + green + "light source: 0 -1 0 1\nreturn type: D\nignore direct light: yes\n")
            .answers(two_rhombi());
    CHECK(scattered[0] > 0);
    CHECK(scattered[1] == Approx(0.2 * 0.121431 * 0.7).epsilon(0.02));
    const auto once = Program(common + "maximum depth: 1\n" + green + "light source: 0 -1 0 1\n").answers(two_rhombi());
    CHECK(once[0] == Approx(0.35).epsilon(0.01));
    CHECK(once[1] == 0);
}

TEST_CASE("what comes back to a rhombus has been scattered twice, as the kernel of radiosity says",
          "[ray-light][cpfg]") {
    // Facing squares of half a square metre: patches of one see those of the other.
    constexpr int edge = 24, count = edge * edge;
    constexpr double apart = 0.3, patch = 0.5 / count, transmitted = 0.5, reflected = 0.4;
    const auto seen = [&](const std::vector<double>& leaving) {
        std::vector<double> met(count, 0);
        for (int i = 0; i < count; ++i) {
            for (int k = 0; k < count; ++k) {
                const double x = i % edge - k % edge, z = i / edge - k / edge;
                const double square = apart * apart + (x * x + z * z) * patch;
                met[std::size_t(i)] +=
                    leaving[std::size_t(k)] * patch * apart * apart / (square * square * std::numbers::pi);
            }
        }
        return met;
    };
    const auto mean = [](const std::vector<double>& all) {
        return std::accumulate(all.begin(), all.end(), 0.0) / count;
    };
    const auto scaled = [](std::vector<double> all, double share) {
        for (double& value : all) value *= share;
        return all;
    };
    const std::vector<double> below = seen(std::vector<double>(count, transmitted));
    const double back = mean(seen(scaled(below, reflected)));
    const std::vector<AskedShape> near = {{{0, 1 + apart, 0}, "P", {0.5, 1}}, {{0, 1, 0}, "P", {0.5, 1}}};
    const std::string twice =
        "Maximum depth: 3\nnumber of rays: 1048576\nleaf material (top): 0.4 0 0.5 0 1\n"
        "light source: 0 -1 0 1\n";
    // Up points down: U is the side that faces the other rhombus.
    const auto facing = Program(common + twice + "return type: U\n").answers(near);
    CHECK(facing[0] == Approx(back).epsilon(0.015));
    const auto scattered = Program(common + twice + "return type: D\nignore direct light: yes\n").answers(near);
    CHECK(scattered[0] == Approx((1 - transmitted - reflected) * back).epsilon(0.015));
    CHECK(scattered[1] == Approx((1 - transmitted - reflected) * mean(below)).epsilon(0.01));
}

TEST_CASE("several lights share their weight, and a periodic canopy is a stand without an edge", "[ray-light][cpfg]") {
    const auto shared =
        Program(common + "leaf material (top): 0 0 0 0 1\nlight source: 0 -1 0 3\nlight source: -1 -1 0 1\n")
            .answers({{{0, 1, 0}, "P", {0.5, 1}}});
    CHECK(shared[0] == Approx(0.5 * (0.75 + 0.25 * std::sqrt(0.5))).epsilon(0.01));
    const auto stand = Program(
                           "domain size: 1 2 1\nposition: 0 0 0\nperiodic canopy: on\nray density: 100000\n"
                           "leaf material (top): 0 0 0 0 1\nlight source: 1 1 0 1\n",
                           "MonteCarlo")
                           .answers({{{0.5, 1.9, 0.9}, "P", {0.5, 1}}, {{0.5, 0.4, 0.9}, "P", {0.5, 1}}});
    // Each covers half of the ground; the light reaches the lower one 1.5 m to the side, where the upper one's images
    // are.
    CHECK(stand[0] == Approx(0.5 * std::sqrt(0.5)).epsilon(0.01));
    CHECK(stand[1] < 0.5 * std::sqrt(0.5));
    CHECK(stand[0] + stand[1] <= std::sqrt(0.5) * 1.001);
}

TEST_CASE("what a parameter file says and has no effect is named, and what would change answers is refused",
          "[ray-light][cpfg]") {
    Program odd(common + green +
                "local light model: Phong\nreturn variance: yes table.txt\nreturn type: H\nnonsense: 1\n");
    odd.answers({});
    CHECK(odd.warnings.size() == 4);
    const auto refusal = [](const std::string& line, const char* name = "QuasiMC") {
        return Program(green + line + "\n", name).refusal();
    };
    CHECK(lacks(refusal("rays from objects: yes"), {"q.spec:2", "rays from objects", "sensors"}) == "");
    CHECK(lacks(refusal("remove objects: no"), {"q.spec:2", "remove objects"}) == "");
    CHECK(lacks(refusal("sky file: sky.txt"), {"q.spec:2", "sky file", "light source"}) == "");
    CHECK(lacks(refusal("light source file: a.txt"), {"light source file"}) == "");
    CHECK(lacks(refusal("light source: 0 0 0"), {"direction that is not 0"}) == "");
    CHECK(lacks(refusal("spectrum samples: 20"), {"spectrum samples", "at most 8"}) == "");
    CHECK(lacks(refusal("leaf material (bottom): .1 0"), {"needs 5 numbers"}) == "");
    CHECK(lacks(refusal("obstacles: wall.dat", "MonteCarlo"), {"obstacles"}) == "");
    CHECK(lacks(refusal("periodic canopy: on\nlight source: 1 0 0 1", "MonteCarlo"), {"from above"}) == "");
}

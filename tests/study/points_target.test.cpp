// Clouds of points as measurements: distances that are known, and parameters found again from a plant's own scan.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/random.h"

#include "catch.h"
#include "study/fit/fit.h"
#include "study/fit/unknowns.h"
#include "study/scan/point_files.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::study;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

const char* const sapling =
    "#define RATIO 0.7\n#define ANGLE 40\nlsystem: 1\nderivation length: 6\naxiom: A(1, 0.1)\n"
    "A(l, w) --> !(w)F(l)[+(ANGLE)!(w*0.7)F(l*0.6)/(90)!(w*0.5)F(l*0.4)]/(137)A(l*RATIO, w*0.7)\nendlsystem\n";

std::optional<Grown> grown(const fs::path& model, double ratio, double angle) {
    const Growth growth(Subject{model});
    return growth.grow(growth.scene(std::vector<std::pair<std::string, double>>{{"RATIO", ratio}, {"ANGLE", angle}}), 0,
                       {true, false});
}

/// What three scanners see of it, with noise of 3 mm.
std::vector<ScanPoint> scanned(const ScannedPlants& plants) {
    std::vector<Beam> beams;
    for (const glm::dvec3& place : {glm::dvec3(5, 1, 5), glm::dvec3(-5, 1, 4), glm::dvec3(0, 1, -6)}) {
        TripodScanner scanner;
        scanner.place = place;
        scanner.step = 0.4;
        scanner.lowest = -20, scanner.highest = 40;
        const std::vector<Beam> some = scanner.beams();
        beams.insert(beams.end(), some.begin(), some.end());
    }
    ScanOptions options;
    options.distance_noise = 0.003;
    return scan(plants, beams, options);
}

fs::path written(const std::vector<ScanPoint>& points, const ScannedPlants& plants, const fs::path& file) {
    write_points(points, plants, {{"plant"}, {}, 0}, {{"x", "y", "z"}, 'y'}, file);
    return file;
}

FitResult fitted(const fs::path& model, const fs::path& points) {
    FitTask task{Growth(Subject{model}), {}, {read_target(points)}};
    for (const char* range : {"RATIO=0.5:0.95", "ANGLE=10:90"}) {
        task.unknowns.push_back(unknown_of(range, task.growth.subject()));
    }
    return fit_least_squares(task, {}, [](const FitState&) {});
}

}  // namespace

TEST_CASE("points: parameters are found again from a plant's own scan, also among stray points", "[fit][points]") {
    const TemporaryFolder folder;
    const fs::path model = folder.write("sapling.l", sapling);
    for (const auto& [ratio, angle] : {std::pair(0.78, 62.0), std::pair(0.88, 33.0)}) {
        const auto plant = grown(model, ratio, angle);
        const ScannedPlants plants(*plant->geometry, 12, std::nullopt);
        std::vector<ScanPoint> points = scanned(plants);
        REQUIRE(points.size() > 400);
        const FitResult clean = fitted(model, written(points, plants, folder.path() / "points.ply"));
        CHECK(clean.parameters[0].value == Approx(ratio).margin(0.01));
        CHECK(clean.parameters[1].value == Approx(angle).margin(1.5));
        // One in twenty points is of something else: birds, other plants.
        RandomSamples random(RandomKey(3, 0, Stream::process), 0, 0);
        const std::size_t strays = points.size() / 20;
        for (std::size_t i = 0; i < strays; ++i) {
            ScanPoint& stray = points.emplace_back();
            stray.place = {4 * random.uniform() - 2, 4 * random.uniform(), 4 * random.uniform() - 2};
        }
        const FitResult among = fitted(model, written(points, plants, folder.path() / "among.ply"));
        CHECK(among.parameters[0].value == Approx(ratio).margin(0.03));
        CHECK(among.parameters[1].value == Approx(angle).margin(4));
    }
}

TEST_CASE("points: distances are those of a level leaf, at most the bound", "[fit][points]") {
    const TemporaryFolder folder;
    const fs::path model = folder.write(
        "leaf.l",
        "lsystem: 1\nderivation length: 0\naxiom: [@M(-0.5,1,0.5)&(90){.f(1).+(90)f(1).+(90)f(1).}]\nendlsystem\n");
    const Growth growth(Subject{model});
    const auto leaf = growth.grow(growth.scene({}), 0, {true, false});
    for (const double above : {0.02, 0.05, 0.3}) {
        glm::dvec3 low(1e9), high(-1e9);  // wherever the turtle put it
        for (const glm::vec3& point : leaf->geometry->points) {
            low = glm::min(low, glm::dvec3(point)), high = glm::max(high, glm::dvec3(point));
        }
        std::string csv = "x,y,z\n";
        for (int i = 0; i < 40; ++i) {
            for (int k = 0; k < 40; ++k) {
                csv += fmt::format("{},{},{}\n", std::lerp(low.x, high.x, 0.1 + 0.02 * i), 1 + above,
                                   std::lerp(low.z, high.z, 0.1 + 0.02 * k));
            }
        }
        folder.write("cloud.csv", csv);
        folder.write("cloud.toml", "file = \"cloud.csv\"\nup = \"y\"\nbound = 0.1\n");
        const auto target = read_target(folder.path() / "cloud.toml");
        const std::vector<double> values = target->of({&*leaf, 1});
        REQUIRE(target->statistics().size() == 4);  // one layer of height
        CHECK(target->statistics()[0].name == "points_to_plant.0");
        CHECK(values[0] == Approx(std::min(above, 0.1)).margin(1e-6));
        CHECK(values[1] >= std::min(above, 0.1) - 1e-9);
        CHECK(values[1] <= 0.1 + 1e-9);
        CHECK(target->statistics()[2].value == Approx(1 + above));
        CHECK(values[2] == Approx(1).margin(1e-6));
    }
}

TEST_CASE("points: units, axes and the foot are those that the table says", "[fit][points]") {
    const TemporaryFolder folder;
    const fs::path model = folder.write("sapling.l", sapling);
    const auto plant = grown(model, 0.8, 50);
    const ScannedPlants plants(*plant->geometry, 12, std::nullopt);
    std::string metres = "x,y,z\n", millimetres = "x,y,z\n";
    for (const ScanPoint& point : scanned(plants)) {
        const glm::dvec3& at = point.place;
        metres += fmt::format("{},{},{}\n", at.x, at.y, at.z);
        const glm::dvec3 moved = at + glm::dvec3(2, 0.5, -1);
        millimetres += fmt::format("{},{},{}\n", 1000 * moved.x, -1000 * moved.z, 1000 * moved.y);  // z upwards
    }
    millimetres += "0,0,-3000\n";  // of the ground
    folder.write("metres.csv", metres);
    folder.write("millimetres.csv", millimetres);
    folder.write("cloud.toml",
                 "file = \"millimetres.csv\"\nunit = \"mm\"\nup = \"z\"\nfoot = [2, 0.5, -1]\nabove = -1\n");
    const auto other = grown(model, 0.75, 55);
    const auto expected = read_target(folder.path() / "metres.csv")->of({&*other, 1});
    const auto found = read_target(folder.path() / "cloud.toml")->of({&*other, 1});
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).epsilon(0.02).margin(1e-3));
}

TEST_CASE("points: what is no cloud of a plant is refused", "[fit][points]") {
    const TemporaryFolder folder;
    folder.write("few.csv", "x,y,z\n0,0,0\n0,1,0\n");
    CHECK_THROWS_WITH(read_target(folder.path() / "few.csv"), Contains("100 at least"));
    folder.write("words.toml", "file = \"few.csv\"\nscale = 3\n");
    CHECK_THROWS_WITH(read_target(folder.path() / "words.toml"), Contains("scale"));
    folder.write("none.toml", "up = \"z\"\n");
    CHECK_THROWS_AS(read_target(folder.path() / "none.toml"), UserError);
}

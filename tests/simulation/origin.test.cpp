// Scenes of which files have places on a map, far from 0.
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>

using namespace espalier;

namespace {

namespace fs = std::filesystem;

/// Places of the map's UTM zone: east, north and the height.
constexpr double east = 592783, north = 5432100;

std::string tree_at(double x, double y) {
    std::string text =
        "# unit: m\n# up: z\nCODE:\tFORM-A\nCLASSES:\n$\t0\nP\t1\nS\t2\nMTG:\nENTITY-CODE\t\tXX\tYY\tZZ\t"
        "diameter\n";
    text += fmt::format("/P1/S1\t\t{}\t{}\t0\t0.05\n", x + 0.125, y + 0.25);
    text += fmt::format("^<S2\t\t{}\t{}\t0.7\t0.05\n", x + 0.15, y + 0.3);
    text += fmt::format("\t+S3\t{}\t{}\t0.9\t0.02\n", x + 0.4175, y + 0.3333);
    return text + fmt::format("^<S4\t\t{}\t{}\t1.3\t0.04\n", x + 0.151, y + 0.3);
}

/// Of one metre, with y upwards.
std::string cube_at(double x, double z) {
    std::string text;
    for (int k = 0; k < 8; ++k) text += fmt::format("v {} {} {}\n", x + (k & 1), (k >> 1) & 1, z + (k >> 2));
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

const char* const creeper = R"(environment pot;
lsystem: 1
derivation length: 4
axiom: ?pot(0)A
?pot(inside) < A : inside --> F(0.25)?pot(0)A
?pot(inside) < A --> f(0.25)?pot(0)A
endlsystem
)";

const std::string plants_and_pot = R"(
[[plant]]
model = 'tree.mtg'
[[plant]]
model = 'creeper.l'
position = [0.3, 0.2, 0.4]
[environment.pot]
process = 'shape'
shape = 'mesh'
file = 'cube.obj'
voxel = 0.05
[timeline]
fields = ['all']
)";

class MapPlace {
public:
    MapPlace(const std::string& scene, double x, double y) : scene_(scene) {
        folder_.write("tree.mtg", tree_at(x, y));
        folder_.write("cube.obj", cube_at(x, -y));
        folder_.write("creeper.l", creeper);
    }

    Scene scene() const { return read_scene_text(scene_, "scene.toml", folder_.path()); }

    fs::path grown() const {
        const fs::path output = folder_.path() / "run";
        run(scene(), {.output = output});
        return output;
    }

private:
    TemporaryFolder folder_;
    std::string scene_;
};

/// Without those that tell the times.
std::map<std::string, std::string> recorded(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file() || name == "run.json" || name == "timings.csv") continue;
        files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
    }
    return files;
}

}  // namespace

TEST_CASE("a tree and an obstacle on a map grow the bytes of the same scene at 0", "[origin]") {
    const MapPlace here(plants_and_pot, 0, 0);
    const MapPlace there("[simulation]\norigin = [592783, 0, -5432100]\n" + plants_and_pot, east, north);
    const auto expected = recorded(here.grown()), on_map = recorded(there.grown());
    REQUIRE(expected.size() > 5);
    for (const auto& [name, bytes] : expected) {
        INFO(name);
        REQUIRE(on_map.contains(name));
        CHECK((on_map.at(name) == bytes));
    }
    CHECK(on_map.size() == expected.size());
}

TEST_CASE("without an origin the first file of a map decides it, and the run keeps it", "[origin]") {
    const MapPlace place(plants_and_pot, east, north);
    const Scene scene = place.scene();
    REQUIRE(scene.origin->value());
    CHECK(*scene.origin->value() == glm::dvec3(592800, 0, -5432100));
    const glm::dvec3 at = scene.plants[0].turtle.pose.position;
    CHECK(at.x == Approx(592783.125 - 592800).epsilon(1e-12));
    CHECK(at.z == Approx(-0.25).epsilon(1e-12));
    REQUIRE(!scene.notes.diagnostics.empty());
    CHECK_THAT(scene.notes.diagnostics.front().message, Catch::Contains("is taken as the origin of the scene"));
    const auto record = nlohmann::json::parse(text_of(place.grown() / "run.json"));
    CHECK(record.at("origin").get<std::vector<double>>() == std::vector<double>{592800, 0, -5432100});
}

TEST_CASE("a scene without files of a map has no origin", "[origin]") {
    const MapPlace place(plants_and_pot, 0, 0);
    CHECK_FALSE(nlohmann::json::parse(text_of(place.grown() / "run.json")).contains("origin"));
}

TEST_CASE("a plant that a scene itself puts far away is told", "[origin]") {
    const MapPlace place(
        "[[plant]]\nmodel = 'creeper.l'\nposition = [592783, 0, 0]\n[environment.pot]\nprocess = 'shape'\n"
        "shape = 'sphere'\nradius = 1\n",
        0, 0);
    const Scene scene = place.scene();
    REQUIRE(scene.notes.diagnostics.size() == 1);
    CHECK_THAT(scene.notes.diagnostics[0].message, Catch::Contains("plant 'creeper' stands 592783 m from the origin"));
}

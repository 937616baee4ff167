// `espalier export` from outside.
#include "base/csv_file.h"
#include "catch.h"
#include "program.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

using Catch::Contains;

namespace {

/// A folder with a run of five steps in it.
struct RunPlace : Workplace {
    RunPlace() {
        write("bush.l", models::bush);
        REQUIRE(run("run bush.l --output run --quiet").code == 0);
    }
};

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

bool exists(const Workplace& place, const std::string& file) {
    return std::filesystem::exists(place.path() / file);
}

}  // namespace

TEST_CASE("export writes the last frame beside the run unless told otherwise", "[export]") {
    const RunPlace place;
    const Outcome outcome = place.run("export --format obj,mtg run");
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("triangles") != std::string::npos);
    CHECK(exists(place, "run/export/bush-0005.obj"));
    CHECK(exists(place, "run/export/bush-0005.mtl"));
    CHECK(exists(place, "run/export/bush-0005.mtg"));
}

TEST_CASE("export takes chosen steps into a folder, and says what it wrote as JSON", "[export]") {
    const RunPlace place;
    const Outcome outcome = place.run("export run --format stl --step 1:5:2 --output meshes --sides 5 --json");
    REQUIRE(outcome.code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    REQUIRE(json["files"].size() == 3);
    CHECK(json["files"][2]["path"] == "meshes/bush-0005.stl");
    for (const auto& file : json["files"]) {
        // Binary STL: 84 bytes, and 50 for each triangle.
        const auto size = std::filesystem::file_size(place.path() / file["path"].get<std::string>());
        CHECK(size == 84 + 50 * file["triangles"].get<std::size_t>());
    }
    CHECK(!exists(place, "run/export"));
}

TEST_CASE("the table numbers modules in the order of their births, alike in all frames", "[export]") {
    const RunPlace place;
    REQUIRE(place.run("export run --format csv --step 0: --output table.csv --quiet").code == 0);
    std::istringstream lines(text_of(place.path() / "table.csv"));
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> header = cells_of(line);
    const auto at = [&](const std::string& name) {
        return std::size_t(std::find(header.begin(), header.end(), name) - header.begin());
    };
    std::map<std::string, std::string> identities;
    std::map<int, int> births;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = cells_of(line);
        const std::string& identity = cells.at(at("identity"));
        CHECK(identities.emplace(cells.at(at("organ")), identity).first->second == identity);
        births[std::stoi(cells.at(at("organ")))] = std::stoi(cells.at(at("birth")));
    }
    CHECK(births.size() > 10);
    int before = 0;
    for (const auto& [organ, birth] : births) {
        CHECK(birth >= before);
        before = birth;
    }
}

TEST_CASE("export writes the file it is told, in the format of its name", "[export]") {
    const RunPlace place;
    CHECK(place.run("export run --output bush.glb").out.find("bush.glb: ") == 0);
    CHECK(std::filesystem::is_regular_file(place.path() / "bush.glb"));
    CHECK(place.run("export run --format usd --step all --output made/growth.usda").code == 0);
    CHECK(exists(place, "made/growth.usda"));
    CHECK(place.run("export run --step 1:2 --output two.ply --quiet").code == 0);
    CHECK(exists(place, "two-0001.ply"));
    CHECK(exists(place, "two-0002.ply"));
    CHECK(place.run("export run --format csv --output of.ply --quiet").code == 0);  // a folder as good as any
    CHECK(exists(place, "of.ply/bush.csv"));
    const Outcome vague = place.run("export run --output meshes");
    CHECK(vague.code == 1);
    CHECK(vague.err.find("no format given: use --format csv, gltf, ") != std::string::npos);
}

TEST_CASE("export says how many vertices and triangles it wrote", "[export]") {
    const RunPlace place;
    CHECK(place.run("export run --format usd").out.find(" vertices, 0 triangles, 1 time samples") != std::string::npos);
    CHECK(place.run("export run --format usd").out.find(": 0 vertices") == std::string::npos);
    CHECK(place.run("export run --format csv").out.find("vertices") == std::string::npos);
}

TEST_CASE("export makes a mesh coarser, splits it, and names files so that none is lost", "[export]") {
    const RunPlace place;
    const auto files = [&](const std::string& options) {
        const Outcome outcome = place.run("export run --json --output " + options);
        REQUIRE(outcome.code == 0);
        return nlohmann::json::parse(outcome.out)["files"];
    };
    const auto triangles = files("bush.obj")[0]["triangles"].get<int>();
    const auto fewer = files(fmt::format("bush.obj --keep --counts --triangles {}", triangles / 2))[0];
    CHECK(fewer["triangles"].get<int>() == Approx(triangles / 2).epsilon(0.1));
    CHECK(exists(place, fmt::format("bush-{}-{}.mtl", fewer["vertices"].get<int>(), fewer["triangles"].get<int>())));
    CHECK(files("bush.obj --keep")[0]["path"] == "bush-2.obj");
    CHECK(files("bush.ply --split 100").size() > 1);
    CHECK(exists(place, "bush-2.ply"));
    const Outcome few = place.run("export run --output bush.stl --triangles 1000000");
    CHECK(few.code == 0);
    CHECK(few.err.find(fmt::format("no more than {} triangles", triangles)) != std::string::npos);
}

TEST_CASE("materials of an OBJ have the colours of the colour map", "[export]") {
    const Workplace place;
    std::string map(768, '\0');  // red, green and blue of 256 colours
    const auto set = [&](std::size_t colour, const char* rgb) { map.replace(3 * colour, 3, rgb, 3); };
    set(2, "\x66\x33\x00");
    set(3, "\x00\x99\x33");
    place.write("colours.map", map);
    place.write("twig.l",
                "lsystem: 1\nderivation length: 0\n"
                "axiom: !(0.1) ;(2) F(1) ;(3) { . +(30) f(1) . -(120) f(1) . }\nendlsystem\n");
    REQUIRE(place.run("run twig.l --colour-map colours.map --output run --quiet").code == 0);
    REQUIRE(place.run("export run --output twig.obj").code == 0);
    const std::string mtl = text_of(place.path() / "twig.mtl");
    CHECK(mtl.find("newmtl rgb_663300\nKa 0 0 0\nKd 0.400000 0.200000 0.000000\n") != std::string::npos);
    CHECK(mtl.find("newmtl rgb_009933\nKa 0 0 0\nKd 0.000000 0.600000 0.200000\n") != std::string::npos);
}

TEST_CASE("materials that glow or are transparent do so in the files of other programs", "[export]") {
    const Workplace place;
    // Index, transparency, ambient, diffuse, emission, specular, shininess.
    const std::string glowing(
        "\x02\x00"
        "\0\0\0"
        "\x33\x66\x00"
        "\xcc\x00\x33"
        "\0\0\0"
        "\0",
        15);
    const std::string glass(
        "\x03\x99"
        "\0\0\0"
        "\x00\x99\x33"
        "\0\0\0"
        "\0\0\0"
        "\0",
        15);
    place.write("lamp.mat", glowing + glass);
    place.write("lamp.l",
                "lsystem: 1\nderivation length: 0\n"
                "axiom: !(0.1) ;(2) F(1) ;(3) { . +(30) f(1) . -(120) f(1) . }\nendlsystem\n");
    REQUIRE(place.run("run lamp.l --materials lamp.mat --output run --quiet").code == 0);
    REQUIRE(place.run("export run --format obj,gltf,usd --mesh-axes").code == 0);
    const auto written = [&](const std::string& extension) {
        for (const auto& entry : std::filesystem::directory_iterator(place.path() / "run/export")) {
            if (entry.path().extension() == extension) return text_of(entry.path());
        }
        return std::string();
    };
    const auto says = [](const std::string& text, const std::string& words) {
        INFO(words);
        CHECK(text.find(words) != std::string::npos);
    };
    const std::string mtl = written(".mtl"), glb = written(".glb"), usd = written(".usda");
    says(mtl,
         "newmtl rgb_ff6633\nKa 0 0 0\nKd 0.200000 0.400000 0.000000\nKs 0 0 0\nd 1\nillum 1\n"
         "Ke 0.800000 0.000000 0.200000\n");
    says(mtl, "newmtl rgb_009933\nKa 0 0 0\nKd 0.000000 0.600000 0.200000\nKs 0 0 0\nd 0.4\n");
    says(glb, "\"emissiveFactor\":[0.6038");
    says(glb, "\"alphaMode\":\"BLEND\"");
    says(usd, "color3f inputs:emissiveColor = (0.6038");
    says(usd, "float inputs:opacity = 0.4\n");
}

TEST_CASE("leaf-texture draws a picture, and explains what it cannot draw", "[export]") {
    const Workplace place;
    const Outcome outcome = place.run("leaf-texture --blobs 9 --size 128 --output made/leaves.png");
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "made/leaves.png: 9 leaves, 0 of them over others\n");
    CHECK(exists(place, "made/leaves.png"));
    CHECK(place.run("leaf-texture --form twig --size 64 --output twig.png").out.find("13 leaves") != std::string::npos);
    CHECK(place.run("leaf-texture --form bush --output a.png").err.find("expected blobs or twig") != std::string::npos);
    CHECK(place.run("leaf-texture --output a.jpg").err.find("a .png file") != std::string::npos);
    CHECK(place.run("leaf-texture --output a.png --colour green").err.find("such as #4a7a2a") != std::string::npos);
    CHECK(place.run("leaf-texture --output a.png --blobs 9999 --size 16").err.find("too many") != std::string::npos);
}

TEST_CASE("export explains what it cannot do", "[export]") {
    const RunPlace place;
    const auto refused = [&](const std::string& arguments, const std::string& words) {
        const Outcome outcome = place.run("export " + arguments);
        INFO(outcome.err);
        CHECK(outcome.code == 1);
        CHECK(outcome.err.find(words) != std::string::npos);
    };
    refused("run --format glft", "did you mean 'gltf'");
    refused("run --format obj --step 9", "no frame of step 9");
    refused("run --format obj --plant rose", "has no plant 'rose'");
    refused("run --format obj --sides 2", "--sides");
    refused("run --format obj --triangles 0", "--triangles");
    refused("run --format obj --split 2", "--split");
    refused("run --format obj,usd --triangles 100", "--mesh-axes makes them triangles");
    refused("run --format obj --displace", "add --skin smooth");
    refused("nowhere --format obj", "holds no run");
    CHECK(!exists(place, "run/export"));
    refused("run --format vdb", "no fields");
}

TEST_CASE("plants that are exported as RSML or MTG and read back have the same internodes on every day", "[export]") {
    const Workplace place;
    const std::string model = (std::filesystem::path(ESPALIER_SOURCE_DIR) / "models/roots/lupine.l").string();
    REQUIRE(place.run("run " + model + " --steps 16 --quiet --output lupine").code == 0);
    REQUIRE(place.run("export lupine --format rsml,mtg --up z --output out").code == 0);
    REQUIRE(place.run("export lupine --format mtg --output upright").code == 0);
    const auto rows = [&](const std::string& run) {
        std::istringstream text(text_of(place.path() / run / "statistics.csv"));
        std::vector<std::vector<std::string>> cells;
        for (std::string line; std::getline(text, line);) cells.push_back(espalier::csv_cells(line));
        return cells;
    };
    const auto grown = rows("lupine");
    for (const std::string file : {"out/lupine-0016.rsml", "out/lupine-0016.mtg", "upright/lupine-0016.mtg"}) {
        INFO(file);
        REQUIRE(place.run("run " + file + " --quiet --overwrite --output back").code == 0);
        const auto back = rows("back");
        REQUIRE(grown.size() == back.size());
        for (std::size_t row = 1; row < grown.size(); ++row) {
            CHECK(grown[row][6] == back[row][6]);                                              // internodes
            CHECK(std::stod(grown[row][8]) == Approx(std::stod(back[row][8])).epsilon(1e-6));  // length
            CHECK(std::stod(grown[row][9]) ==
                  Approx(std::stod(back[row][9])).margin(1e-4));  // height: a base of MTG is estimated
        }
    }
}

TEST_CASE("the formats are listed with what each carries and loses", "[export]") {
    const Workplace place;
    const Outcome outcome = place.run("list exporters rsml");
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("Lost:") != std::string::npos);
}

namespace {

using StlPoint = std::array<float, 3>;

std::vector<std::array<StlPoint, 3>> triangles_of_stl(const std::filesystem::path& file) {
    const std::string bytes = text_of(file);
    std::vector<std::array<StlPoint, 3>> triangles((bytes.size() - 84) / 50);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        std::memcpy(&triangles[i], bytes.data() + 84 + 50 * i + 12, sizeof triangles[i]);
    }
    return triangles;
}

/// Half the extent along x of what lies between two heights.
float half_width(const std::vector<std::array<StlPoint, 3>>& triangles, float low, float high) {
    float least = 1e9f, most = -1e9f;
    for (const auto& triangle : triangles) {
        for (const StlPoint& point : triangle) {
            if (point[1] < low || point[1] > high) continue;
            least = std::min(least, point[0]);
            most = std::max(most, point[0]);
        }
    }
    return (most - least) / 2;
}

}  // namespace

TEST_CASE("the skin of the maple is closed and flares at its foot", "[export]") {
    const Workplace place;
    const std::string model = std::string(ESPALIER_SOURCE_DIR) + "/models/trees/maple.l";
    REQUIRE(place.run("run '" + model + "' --define THINNEST=0.15 --output run --quiet").code == 0);
    REQUIRE(place.run("export run --format stl --skin smooth --voxel 0.03 --output maple.stl --quiet").code == 0);
    const auto triangles = triangles_of_stl(place.path() / "maple.stl");
    REQUIRE(triangles.size() > 10000);
    std::map<std::pair<StlPoint, StlPoint>, int> edges;
    for (const auto& triangle : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const StlPoint &a = triangle[k], &b = triangle[(k + 1) % 3];
            edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    CHECK(std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; }));
    const float above = half_width(triangles, 1.3f, 1.4f);
    CHECK(above == Approx(0.315f).epsilon(0.1));
    CHECK(half_width(triangles, 0.4f, 0.5f) > 1.1f * above);
    CHECK(half_width(triangles, 0.1f, 0.2f) > 2 * above);
}

TEST_CASE("export gives axes bark that nobody drew, and refuses what is none", "[export]") {
    const RunPlace place;
    place.write("oak.bark", "stripes = 6\nsize = 32\n");
    CHECK(place.run("export run --format obj,usd --bark oak.bark --output made --quiet").code == 0);
    for (const char* file : {"made/bush-oak.png", "made/bush-oak-normal.png", "made/bush-oak-height.png"}) {
        CHECK(exists(place, file));
    }
    CHECK(text_of(place.path() / "made/bush-0005.mtl").find("map_Bump bush-oak-height.png") != std::string::npos);
    CHECK(text_of(place.path() / "made/bush-0005.usda").find("inputs:normal.connect") != std::string::npos);
    const auto complaint = [&](const std::string& options) {
        const Outcome outcome = place.run("export run --format gltf " + options);
        CHECK(outcome.code == 1);
        return outcome.err;
    };
    CHECK(complaint("--bark none.bark").find("none.bark") != std::string::npos);
    CHECK(complaint("--bark bush.l").find("ends in .bark") != std::string::npos);
    place.write("wrong.bark", "stripes = 6\nsise = 32\n");
    CHECK(complaint("--bark wrong.bark").find("wrong.bark:2") != std::string::npos);
    CHECK(complaint("--skin smooth --triangles 100").find("a larger --voxel") != std::string::npos);
    CHECK(complaint("--skin smooth --voxel 1e-7").find("the smallest voxel is") != std::string::npos);
    CHECK(complaint("--skin smooth --step all").find("export one --step") != std::string::npos);
}

TEST_CASE("export: an option that no format heeds is named", "[app][export]") {
    const Workplace place;
    REQUIRE(place.run("run " ESPALIER_SOURCE_DIR "/models/course/02-branching.l --steps 3 --output run").code == 0);
    const Outcome outcome = place.run("export run --format ply --rate 12 --instances --sides 5");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("--rate is for gltf, usd") && Contains("--instances is for gltf, usd"));
    CHECK(outcome.err.find("--sides") == std::string::npos);
    CHECK(place.run("export run --format gltf --rate 12 --instances --sides 5").err.empty());
}

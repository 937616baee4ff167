#include "formats/landscape_file.h"

#include "archive/landscape/planted.h"
#include "base/png_file.h"
#include "catch.h"
#include "formats/exporting.h"

#include <nlohmann/json.hpp>

#include <regex>
#include <set>

using namespace espalier;

namespace {

/// Four hundred small trees in rows before an eye, some of them cards.
struct SmallLandscape {
    RecordedFolder recorded_run{""};
    RecordedRun run{recorded_run.folder.path};
    PlantedLandscape landscape = planted(flat_terrain(), {small_species()}, rows(), eye, few_levels, 1);
    std::vector<std::vector<CardImage>> cards{std::vector<CardImage>(
        card_turns, {png_bytes(OpacityPicture{2, 1, {{1, 2, 3, 255}, {1, 2, 3, 0}}}), {{0, 1, 0}, {-1, -1}, {1, 1}}})};

    static constexpr glm::dvec3 eye{0, 2, 10};

    static std::vector<StandPlant> rows() {
        std::vector<StandPlant> stand;
        for (int i = 0; i < 400; ++i) stand.push_back({{i % 20 * 4.0 - 40, -1.0 * i}, small_species().radius, 1});
        return stand;
    }
    ExportedFile write(const std::string& name) const {
        return write_landscape({landscape, cards, eye, {90, 90, 60}, run}, recorded_run.folder.path / name);
    }
    std::string bytes(const std::string& name) const { return bytes_of(recorded_run.folder.path / name); }
};

/// The value of an attribute behind a place of a USD text: what stands between its brackets.
std::string value_behind(const std::string& text, const std::string& declaration, std::size_t from = 0) {
    const std::size_t at = text.find(declaration + " = [", from);
    REQUIRE(at != std::string::npos);
    const std::size_t begin = text.find('[', at + declaration.size()) + 1;
    return text.substr(begin, text.find(']', begin) - begin);
}

std::vector<double> numbers_of(const std::string& text) {
    std::vector<double> numbers;
    const std::regex number("[-+]?[0-9][0-9.e+-]*");
    for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at)
        numbers.push_back(std::stod(at->str()));
    return numbers;
}

}  // namespace

TEST_CASE("a landscape's .glb has each species and level once, in all its places", "[export][landscape]") {
    const SmallLandscape small;
    const PlantedLandscape& landscape = small.landscape;
    CHECK(small.write("landscape.glb").elements == 400);
    const std::string bytes = small.bytes("landscape.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    const auto json = nlohmann::json::parse(bytes.substr(20, length));
    CHECK(json["extensionsRequired"][0] == "EXT_mesh_gpu_instancing");
    std::size_t placed = 0, triangles = 0;
    for (const auto& node : json["nodes"]) {
        std::size_t of_mesh = 0;
        for (const auto& primitive : json["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
            of_mesh += json["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>() / 3;
        }
        if (node["name"] == "terrain") continue;
        const auto& places = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        const auto count = json["accessors"][places["TRANSLATION"].get<std::size_t>()]["count"].get<std::size_t>();
        placed += count;
        triangles += count * of_mesh;
        if (node["name"].get<std::string>().find("card") != std::string::npos) CHECK(of_mesh == 2);
    }
    CHECK(placed == 400);
    CHECK(triangles == landscape.triangles());
    bool has_cut_out = false;
    for (const auto& material : json["materials"]) has_cut_out |= material.value("alphaMode", "") == "MASK";
    CHECK(has_cut_out);
}

TEST_CASE("a landscape's .usda has each species and level once, in all its places", "[export][landscape]") {
    const SmallLandscape small;
    const ExportedFile file = small.write("landscape.usda");
    CHECK(file.elements == 400);
    const std::string text = small.bytes("landscape.usda");
    CHECK(text.starts_with("#usda 1.0\n"));
    for (const auto& [open, close] : {std::pair{'{', '}'}, {'(', ')'}, {'[', ']'}}) {
        CHECK(std::count(text.begin(), text.end(), open) == std::count(text.begin(), text.end(), close));
    }
    const std::size_t instancer = text.find("def PointInstancer \"plants\"");
    REQUIRE(instancer != std::string::npos);

    // Every prototype is a mesh below the instancer.
    const std::string listed = value_behind(text, "rel prototypes", instancer);
    const std::regex path("</world/plants/shapes/([A-Za-z0-9_]+)>");
    std::vector<std::size_t> triangles_of;
    std::size_t cards = 0;
    for (std::sregex_iterator at(listed.begin(), listed.end(), path), end; at != end; ++at) {
        const std::size_t mesh = text.find("def Mesh \"" + (*at)[1].str() + "\"");
        REQUIRE(mesh != std::string::npos);
        triangles_of.push_back(numbers_of(value_behind(text, "int[] faceVertexCounts", mesh)).size());
        const bool is_card = (*at)[1].str().find("_card_") != std::string::npos;
        cards += is_card;
        if (is_card) CHECK(triangles_of.back() == 2);
    }
    CHECK(cards == card_turns);

    const std::vector<double> shapes = numbers_of(value_behind(text, "int[] protoIndices", instancer));
    REQUIRE(shapes.size() == 400);
    std::size_t triangles = 0;
    for (const double shape : shapes) triangles += triangles_of.at(static_cast<std::size_t>(shape));
    CHECK(triangles == small.landscape.triangles());
    CHECK(std::set<double>(shapes.begin(), shapes.end()).size() == triangles_of.size());

    const std::vector<double> places = numbers_of(value_behind(text, "point3f[] positions", instancer));
    const std::vector<double> turns = numbers_of(value_behind(text, "quath[] orientations", instancer));
    CHECK(places.size() == 3 * 400);
    CHECK(numbers_of(value_behind(text, "float3[] scales", instancer)).size() == 3 * 400);
    REQUIRE(turns.size() == 4 * 400);
    std::multiset<std::pair<float, float>> expected, found;
    for (std::size_t i = 0; i < 400; ++i) {
        const glm::dvec4 turn(turns[4 * i], turns[4 * i + 1], turns[4 * i + 2], turns[4 * i + 3]);
        CHECK(glm::length(turn) == Approx(1).epsilon(1e-5));
        const glm::dvec3 position = small.landscape.plants[i].position;
        expected.insert({float(position.x), float(position.z)});
        found.insert({float(places[3 * i]), float(places[3 * i + 2])});
    }
    CHECK(found == expected);

    // Materials that are bound are there, and so are the pictures that they read.
    const std::regex binding("rel material:binding = </world/materials/([a-z0-9_]+)>"), picture("@\\./([^@]+)@");
    for (std::sregex_iterator at(text.begin(), text.end(), binding), end; at != end; ++at)
        CHECK(text.find("def Material \"" + (*at)[1].str() + "\"") != std::string::npos);
    std::size_t pictures = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), picture), end; at != end; ++at, ++pictures)
        CHECK(small.bytes((*at)[1].str()).substr(1, 3) == "PNG");
    CHECK(pictures >= cards);
    CHECK(small.bytes("landscape-tree-0.png").substr(1, 3) == "PNG");
}

TEST_CASE("usdcat reads a landscape, where it is installed", "[export][landscape]") {
    if (std::system("command -v usdcat >/dev/null 2>&1") != 0) return;
    const SmallLandscape small;
    const std::string path = small.write("landscape.usda").path.string();
    CHECK(std::system(("usdcat '" + path + "' >/dev/null").c_str()) == 0);
}

#include "formats/landscape_glb.h"

#include "archive/landscape/planted.h"
#include "base/png_file.h"
#include "catch.h"
#include "formats/exporting.h"

#include <nlohmann/json.hpp>

using namespace espalier;

TEST_CASE("a landscape's .glb has each species and level once, in all its places", "[export][landscape]") {
    const RecordedFolder recorded_run("");
    const RecordedRun run(recorded_run.folder.path);
    const LandscapeSpecies species = small_species();
    std::vector<StandPlant> stand;
    for (int i = 0; i < 400; ++i) stand.push_back({{i % 20 * 4.0 - 40, -1.0 * i}, species.radius, 1});
    const PlantedLandscape landscape = planted(flat_terrain(), {species}, stand, {0, 2, 10}, few_levels, 1);
    const OpacityPicture picture{2, 1, {{1, 2, 3, 255}, {1, 2, 3, 0}}};
    const std::vector<std::vector<CardImage>> cards{
        std::vector<CardImage>(card_turns, {png_bytes(picture), {{0, 1, 0}, {-1, -1}, {1, 1}}})};
    const auto path = recorded_run.folder.path / "landscape.glb";
    const ExportedFile file = write_landscape({landscape, cards, {0, 2, 10}, {90, 90, 60}, run}, path);
    CHECK(file.elements == 400);
    const std::string bytes = bytes_of(path);
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

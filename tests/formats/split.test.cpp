// Meshes in pieces for indices of 16 bits, and the names of files.
#include "espalier/base/error.h"

#include "base/png_file.h"
#include "catch.h"
#include "formats/exporting.h"
#include "formats/obj_file.h"
#include "formats/small_tree.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include <cstring>

using namespace espalier;
using namespace espalier::formats;
using Catch::Contains;

namespace {

constexpr std::size_t most = 700;

void in_pieces(ExportJob& job) {
    job.most_vertices = most;
}

using Triangles = std::multiset<std::array<float, 9>>;

template <class Reader>
void add_triangles(const std::filesystem::path& path, Triangles& to) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkPolyData& data = *reader->GetOutput();
    for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        data.GetCellPoints(i, count, ids);
        std::array<float, 9> corners{};
        for (std::size_t k = 0; k < 9; ++k) corners[k] = static_cast<float>(data.GetPoint(ids[k / 3])[k % 3]);
        to.insert(corners);
    }
}

nlohmann::json json_of(const std::filesystem::path& glb) {
    const std::string bytes = bytes_of(glb);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return nlohmann::json::parse(bytes.substr(20, length));
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder)) names.push_back(file.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

TEST_CASE("an OBJ is split into objects that together are the whole", "[export][split]") {
    const SmallTree tree;
    const ObjFile whole(ExportedPlant(tree.plant, "obj").files.at(0).path);
    const ExportedPlant exported(tree.plant, "obj", in_pieces);
    const ObjFile pieces(exported.files.at(0).path);
    CHECK(pieces.triangles() == whole.triangles());
    const auto objects = pieces.vertices_of_objects();
    CHECK(objects.size() >= whole.points.size() / most);
    CHECK(objects.contains("left"));
    CHECK(objects.contains("left_2"));
    for (const auto& [name, vertices] : objects) {
        INFO(name);
        CHECK(vertices.size() <= most);
        CHECK(*vertices.rbegin() - *vertices.begin() < most);
    }
}

TEST_CASE("PLY and STL are split into files that together are the whole", "[export][split]") {
    const SmallTree tree;
    for (const char* format : {"ply", "stl"}) {
        INFO(format);
        const auto add = std::string_view(format) == "ply" ? add_triangles<vtkPLYReader> : add_triangles<vtkSTLReader>;
        Triangles whole, pieces;
        const ExportedPlant one(tree.plant, format), several(tree.plant, format, in_pieces);
        add(one.files.at(0).path, whole);
        for (const ExportedFile& file : several.files) {
            CHECK(file.vertices <= most);
            add(file.path, pieces);
        }
        CHECK(pieces == whole);
        CHECK(several.files.size() > 2);
        CHECK(several.files[1].path.filename() == fmt::format("handmade-0000-2.{}", format));
    }
}

TEST_CASE("a glTF is split into meshes with indices of 16 bits", "[export][split]") {
    const SmallTree tree;
    const ExportedPlant one(tree.plant, "gltf"), several(tree.plant, "gltf", in_pieces);
    const nlohmann::json json = json_of(several.files.at(0).path);
    std::size_t corners = 0;
    for (const auto& mesh : json["meshes"]) {
        for (const auto& primitive : mesh["primitives"]) {
            CHECK(json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"] <= most);
            const auto& indices = json["accessors"][primitive["indices"].get<std::size_t>()];
            CHECK(indices["componentType"] == 5123);
            corners += indices["count"].get<std::size_t>();
        }
    }
    CHECK(corners == 3 * one.files.at(0).triangles);
    CHECK(json["nodes"].size() == json["meshes"].size());
    CHECK(json["nodes"][1]["name"] == "left_2");
    CHECK(json["scenes"][0]["nodes"].size() == json["nodes"].size());
}

TEST_CASE("one part that is larger than a piece is cut", "[export][split]") {
    const auto tiny = [](ExportJob& job) { job.most_vertices = 3; };
    const HandmadePlant plant = branched_plant();
    const ObjFile whole(ExportedPlant(plant, "obj").files.at(0).path);
    const ObjFile pieces(ExportedPlant(plant, "obj", tiny).files.at(0).path);
    CHECK(pieces.triangles() == whole.triangles());
    CHECK(pieces.vertices_of_objects().size() == whole.faces.size());
}

TEST_CASE("USD and animations are not split", "[export][split]") {
    CHECK_THROWS_WITH(Exported("usd", {}, {4}, "", in_pieces), Contains("--split 700") && Contains("32 bits"));
    CHECK_THROWS_WITH(Exported("gltf", {}, {0, 4}, "", in_pieces), Contains("--split 700"));
}

TEST_CASE("names carry the numbers of vertices and triangles if asked for", "[export][names]") {
    const HandmadePlant plant = branched_plant();
    for (const char* format : {"obj", "ply", "stl", "gltf", "usd"}) {
        const ExportedPlant exported(plant, format, [](ExportJob& job) {
            job.counts = job.mesh_axes = true;
            job.name = "oak";
        });
        const ExportedFile& file = exported.files.at(0);
        CHECK(file.path.stem() == fmt::format("oak-{}-{}", file.vertices, file.triangles));
    }
    const ExportedPlant table(plant, "csv", [](ExportJob& job) { job.counts = true; });
    CHECK(table.files.at(0).path.filename() == "handmade.csv");
}

TEST_CASE("files that are there are replaced, or kept if asked for", "[export][names]") {
    const TemporaryFolder folder;
    const HandmadePlant plant = branched_plant();
    const auto write = [&](const std::string& format, bool keep) {
        const ExportedPlant exported(plant, format, [&](ExportJob& job) {
            job.folder = folder.path() / "made";
            job.name = "oak";
            job.keep = keep;
        });
        return exported.files.at(0).path.filename().string();
    };
    CHECK(write("obj", true) == "oak.obj");
    CHECK(write("obj", false) == "oak.obj");
    CHECK(write("obj", true) == "oak-2.obj");
    CHECK(write("obj", true) == "oak-3.obj");
    CHECK(write("csv", true) == "oak.csv");
    CHECK(write("csv", true) == "oak-2.csv");
    CHECK(names_in(folder.path() / "made") == std::vector<std::string>{"oak-2.csv", "oak-2.mtl", "oak-2.obj",
                                                                       "oak-3.mtl", "oak-3.obj", "oak.csv", "oak.mtl",
                                                                       "oak.obj"});
    CHECK_THAT(bytes_of(folder.path() / "made" / "oak-2.obj"), Contains("mtllib oak-2.mtl\n"));
    // A material of somebody else's is not replaced either.
    std::filesystem::remove(folder.path() / "made" / "oak.obj");
    CHECK(write("obj", true) == "oak-4.obj");
}

TEST_CASE("a kept picture is used again if it is the same", "[export][names]") {
    const TemporaryFolder folder;
    const auto write = [&](std::uint8_t green) {
        OpacityPicture picture{1, 1, {{10, green, 30, 128}}};
        HandmadePlant plant;
        plant.interpretation.geometry.shapes = square_leaf(folder.write("leaf.png", png_bytes(picture)));
        plant.add_organ(Organ::Shape::surface, 5, 1);
        plant.interpretation.geometry.organs.back().surface = 'l';
        plant.interpretation.geometry.organs.back().look = {4, 1};
        const ExportedPlant exported(plant, "obj", [&](ExportJob& job) {
            job.folder = folder.path() / "made";
            job.keep = true;
        });
        const ObjFile mesh(exported.files.at(0).path);
        const ObjFile::Material& material = mesh.materials.begin()->second;
        CHECK(material.opacity == material.picture);
        return material.picture;
    };
    CHECK(write(20) == "handmade-leaf.png");
    CHECK(write(20) == "handmade-leaf.png");
    CHECK(write(40) == "handmade-leaf-2.png");
}

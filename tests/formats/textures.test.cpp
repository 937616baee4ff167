// Textures go with what is exported, as pictures that other programs read.
#include "catch.h"
#include "formats/exporting.h"
#include "formats/obj_file.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>
#include <vtkGLTFReader.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>

#include <cstring>

using namespace espalier;
using namespace espalier::formats;
using Catch::Contains;

namespace {

using Pixel = std::array<int, 3>;

/// 2 by 2 pixels as an SGI picture, as models written for cpfg name them: red and green below, blue and white above.
std::string sgi_picture() {
    std::string bytes(512, '\0');
    const auto put = [&](std::size_t at, int value) {
        bytes[at] = static_cast<char>(value >> 8);
        bytes[at + 1] = static_cast<char>(value & 255);
    };
    put(0, 474);
    bytes[3] = 1;
    put(4, 3);
    put(6, 2);
    put(8, 2);
    put(10, 3);
    for (const char* plane : {"\xff\x00\x00\xff", "\x00\xff\x00\xff", "\x00\x00\xff\xff"}) bytes.append(plane, 4);
    return bytes;
}

/// A leaf of two patches, or a triangle of the same identity, that wear a file; a second leaf wears nothing.
HandmadePlant leafy_plant(const std::filesystem::path& texture) {
    HandmadePlant plant;
    plant.interpretation.geometry.shapes = square_leaf(texture);
    for (const std::uint16_t worn : {1, 0}) {
        plant.add_organ(Organ::Shape::surface, 5u + worn, 1);
        Organ& organ = plant.interpretation.geometry.organs.back();
        organ.surface = 'l';
        organ.look = {4, worn};
    }
    return plant;
}

Pixel pixel(vtkImageData& image, int x, int y) {
    const auto* bytes = static_cast<const unsigned char*>(image.GetScalarPointer(x, y, 0));
    return {bytes[0], bytes[1], bytes[2]};
}

void check_picture(vtkImageData& image) {
    REQUIRE(image.GetDimensions()[0] == 2);
    REQUIRE(image.GetDimensions()[1] == 2);
    CHECK(pixel(image, 0, 0) == Pixel{255, 0, 0});
    CHECK(pixel(image, 1, 0) == Pixel{0, 255, 0});
    CHECK(pixel(image, 0, 1) == Pixel{0, 0, 255});
    CHECK(pixel(image, 1, 1) == Pixel{255, 255, 255});
}

void check_png(const std::filesystem::path& path) {
    REQUIRE(std::filesystem::exists(path));
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    check_picture(*reader->GetOutput());
}

nlohmann::json json_of_glb(const std::string& bytes) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return nlohmann::json::parse(bytes.substr(20, length));
}

}  // namespace

TEST_CASE("a glTF holds its textures as PNG, and what wears them names them", "[export]") {
    const TemporaryFolder pictures;
    const auto texture = pictures.write("leaf.rgb", sgi_picture());
    const ExportedPlant exported(leafy_plant(texture), "gltf");
    const std::string path = exported.files.at(0).path.string();
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    REQUIRE(reader->GetNumberOfTextures() == 1);

    const std::string bytes = bytes_of(path);
    const nlohmann::json json = json_of_glb(bytes);
    const auto& view = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
    std::uint32_t described = 0;
    std::memcpy(&described, bytes.data() + 12, 4);
    const std::size_t at = 20 + described + 8 + view["byteOffset"].get<std::size_t>();
    check_png(pictures.write("embedded.png", bytes.substr(at, view["byteLength"])));

    // One material with the picture, one without; and a leaf's lower left corner is the picture's: v runs down here.
    REQUIRE(json["materials"].size() == 2);
    const auto textured = [](const nlohmann::json& material) {
        return material["pbrMetallicRoughness"].contains("baseColorTexture");
    };
    CHECK(textured(json["materials"][0]) != textured(json["materials"][1]));
    // There is no colour map: the picture's colours are not multiplied by anything.
    const nlohmann::json& material = json["materials"][textured(json["materials"][0]) ? 0 : 1];
    CHECK(material["pbrMetallicRoughness"]["baseColorFactor"] == nlohmann::json({1, 1, 1, 1}));
    const auto& places = json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"].get<int>()];
    const auto& uvs = json["bufferViews"][places["bufferView"].get<std::size_t>()];
    float first[2];
    std::memcpy(first, bytes.data() + 20 + described + 8 + uvs["byteOffset"].get<std::size_t>(), sizeof first);
    CHECK(first[0] == 0);
    CHECK(first[1] == 1);
    for (const auto& accessor : json["accessors"]) {
        const auto& of = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        CHECK(of["byteOffset"].get<int>() % 4 == 0);
    }
}

TEST_CASE("a leaf whose picture is partly transparent is cut out", "[export]") {
    const TemporaryFolder pictures;
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 1);
    for (const int channels : {3, 4}) {
        image->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
        std::memset(image->GetScalarPointer(), 0, static_cast<std::size_t>(4 * channels));
        vtkNew<vtkPNGWriter> writer;
        const std::string path = (pictures.path() / "leaf.png").string();
        writer->SetFileName(path.c_str());
        writer->SetInputData(image);
        writer->Write();
        const ExportedPlant exported(leafy_plant(path), "gltf");
        CHECK((bytes_of(exported.files.at(0).path).find("\"MASK\"") != std::string::npos) == (channels == 4));
        const ObjFile obj(ExportedPlant(leafy_plant(path), "obj").files.at(0).path);
        for (const auto& [name, material] : obj.materials) {
            const std::string picture = name.ends_with("_leaf_0") ? "handmade-leaf.png" : "";
            CHECK(material.picture == picture);
            CHECK(material.opacity == (channels == 4 ? picture : ""));
        }
    }
}

TEST_CASE("USD binds faces to a material whose picture lies beside the file", "[export]") {
    const TemporaryFolder pictures;
    const ExportedPlant exported(leafy_plant(pictures.write("leaf.rgb", sgi_picture())), "usd");
    const std::filesystem::path path = exported.files.at(0).path;
    const std::string text = bytes_of(path);
    check_png(path.parent_path() / "handmade-leaf.png");
    CHECK_THAT(text, Contains("asset inputs:file = @./handmade-leaf.png@"));
    CHECK_THAT(text, Contains("def GeomSubset \"texture_0\"") &&
                         Contains("rel material:binding = </world/materials/texture_0>") &&
                         Contains("def Material \"texture_0\""));
    // Half of the faces: the other leaf wears nothing.
    const auto list = [&](const std::string& attribute) {
        const std::size_t begin = text.find(attribute + " = [") + attribute.size() + 4;
        const std::string body = text.substr(begin, text.find(']', begin) - begin);
        return static_cast<std::size_t>(std::count(body.begin(), body.end(), ',')) + 1;
    };
    CHECK(2 * list("int[] indices") == list("int[] faceVertexCounts"));
    for (const auto& [open, close] : {std::pair{'{', '}'}, {'(', ')'}, {'[', ']'}}) {
        CHECK(std::count(text.begin(), text.end(), open) == std::count(text.begin(), text.end(), close));
    }
}

TEST_CASE("an MTL names its textures as they lie beside it", "[export]") {
    const TemporaryFolder pictures;
    const ExportedPlant exported(leafy_plant(pictures.write("my leaf.rgb", sgi_picture())), "obj");
    const std::filesystem::path folder = exported.files.at(0).path.parent_path();
    CHECK_THAT(bytes_of(folder / "handmade-0000.mtl"), Contains("map_Kd handmade-my_leaf.png\n"));
    check_png(folder / "handmade-my_leaf.png");
}

TEST_CASE("what wears a file that is gone, or no picture, is exported in its own colour", "[export]") {
    const TemporaryFolder pictures;
    for (const std::filesystem::path& texture :
         {std::filesystem::path("gone.rgb"), pictures.write("text.rgb", "no picture"), pictures.write("text.png", "x"),
          pictures.write("short.rgb", sgi_picture().substr(0, 515))}) {
        INFO(texture);
        const ExportedPlant gltf(leafy_plant(texture), "gltf"), usd(leafy_plant(texture), "usd"),
            obj(leafy_plant(texture), "obj");
        CHECK_FALSE(json_of_glb(bytes_of(gltf.files.at(0).path)).contains("images"));
        CHECK_THAT(bytes_of(usd.files.at(0).path), !Contains("texture_0"));
        CHECK_THAT(bytes_of(obj.folder.path / "export" / "handmade-0000.mtl"), !Contains("map_Kd"));
        CHECK(gltf.files.at(0).triangles == usd.files.at(0).triangles);
        for (const ExportedPlant* exported : {&gltf, &usd, &obj}) {
            const std::string& hint = exported->files.at(0).hint;
            CHECK_THAT(hint, Contains(texture.filename().string()) && Contains("put the file there"));
        }
    }
}

TEST_CASE("axes wear their textures, once around and in proportion along", "[export]") {
    const TemporaryFolder pictures;
    HandmadePlant plant = branched_plant();
    plant.interpretation.geometry.shapes = square_leaf(pictures.write("bark.rgb", sgi_picture()));
    plant.interpretation.geometry.textures.assign(plant.interpretation.geometry.internodes.size(), 1);
    const ExportedPlant exported(plant, "obj");
    const std::string text = bytes_of(exported.files.at(0).path);
    CHECK_THAT(text, Contains("_bark_"));
    // The stem: 1 m tapering from 10 cm to 5, then 2 m of 5 cm.
    const double turns = 1 / (std::numbers::pi * 0.15) + 2 / (std::numbers::pi * 0.1);
    double longest = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("vt ")) longest = std::max(longest, std::stod(line.substr(line.rfind(' '))));
    }
    CHECK(longest == Approx(turns));
}

TEST_CASE("an OBJ reads back by the letter, with the colours of its settings and its leaves within the picture",
          "[export]") {
    const TemporaryFolder pictures;
    const ExportedPlant exported(leafy_plant(pictures.write("leaf.rgb", sgi_picture())), "obj");
    const ExportedFile& file = exported.files.at(0);
    const ObjFile mesh(file.path);
    CHECK(mesh.points.size() == file.vertices);
    CHECK(mesh.uvs.size() == file.vertices);
    CHECK(mesh.normals.size() == file.vertices);
    CHECK(mesh.faces.size() == file.triangles);
    for (const glm::dvec3& normal : mesh.normals) CHECK(glm::length(normal) == Approx(1).epsilon(1e-5));
    for (const glm::dvec2& uv : mesh.uvs) {
        CHECK((uv.x >= 0 && uv.x <= 1));
        CHECK((uv.y >= 0 && uv.y <= 1));
    }
    // What nobody coloured is green, and white below its picture.
    for (const auto& [name, material] : mesh.materials) {
        const glm::dvec3 colour = material.picture.empty() ? glm::dvec3(70, 130, 50) / 255.0 : glm::dvec3(1);
        CHECK(glm::distance(material.colour, colour) < 1e-6);
    }
    const ObjFile wood(ExportedPlant(branched_plant(), "obj").files.at(0).path);
    CHECK(glm::distance(wood.materials.at("rgb_7a5c3e").colour, glm::dvec3(122, 92, 62) / 255.0) < 1e-6);
}

namespace {

/// branched_plant() in bark of a file of settings.
HandmadePlant barked_plant(const TemporaryFolder& folder) {
    HandmadePlant plant = branched_plant();
    plant.interpretation.geometry.shapes = square_leaf(folder.write("oak.bark", "stripes = 4\nsize = 32\n"));
    plant.interpretation.geometry.textures.assign(plant.interpretation.geometry.internodes.size(), 1);
    return plant;
}

}  // namespace

TEST_CASE("bark goes with what is exported: its colours and its relief", "[export]") {
    const TemporaryFolder folder;
    const HandmadePlant plant = barked_plant(folder);

    const nlohmann::json json = json_of_glb(bytes_of(ExportedPlant(plant, "gltf").files.at(0).path));
    REQUIRE(json["materials"].size() == 1);
    const nlohmann::json& material = json["materials"][0];
    const int relief = material["normalTexture"]["index"];
    CHECK(relief != material["pbrMetallicRoughness"]["baseColorTexture"]["index"]);
    CHECK(json["textures"].size() == 2);
    CHECK(json["images"].size() == 2);
    // Bark is brighter and darker than wood, whose colour stays.
    CHECK(material["name"] == "rgb_7a5c3e_oak");

    const ExportedPlant obj(plant, "obj");
    const std::filesystem::path beside = obj.files.at(0).path.parent_path();
    CHECK_THAT(bytes_of(beside / "handmade-0000.mtl"),
               Contains("map_Kd handmade-oak.png\nmap_Bump handmade-oak-height.png\nnorm handmade-oak-normal.png\n"));
    for (const char* file : {"handmade-oak.png", "handmade-oak-height.png", "handmade-oak-normal.png"}) {
        vtkNew<vtkPNGReader> reader;
        reader->SetFileName((beside / file).c_str());
        reader->Update();
        CHECK(reader->GetOutput()->GetDimensions()[0] == 32);
    }

    const ExportedPlant usd(plant, "usd", [](ExportJob& job) { job.mesh_axes = true; });
    const std::string text = bytes_of(usd.files.at(0).path);
    CHECK_THAT(text, Contains("normal3f inputs:normal.connect = </world/materials/texture_0/relief.outputs:rgb>") &&
                         Contains("asset inputs:file = @./handmade-oak-normal.png@") &&
                         Contains("token inputs:sourceColorSpace = \"raw\""));
    CHECK(std::count(text.begin(), text.end(), '{') == std::count(text.begin(), text.end(), '}'));
}

TEST_CASE("axes that wear nothing can be given bark; a smooth skin has the colours and groups of tubes", "[export]") {
    const TemporaryFolder folder;
    const std::string bark = folder.write("oak.bark", "size = 32\n");
    const auto in_bark = [&](bool is_smooth) {
        return ExportedPlant(branched_plant(), "obj", [&](ExportJob& job) {
            job.bark = bark;
            job.options.skin.smooth = is_smooth;
        });
    };
    const ExportedPlant tubes_file = in_bark(false), skin_file = in_bark(true);
    const ObjFile tubes(tubes_file.files.at(0).path), skin(skin_file.files.at(0).path);
    std::set<std::string> of_tubes, of_skin;
    for (const ObjFile::Face& face : tubes.faces) of_tubes.insert(face.group + face.material);
    for (const ObjFile::Face& face : skin.faces) of_skin.insert(face.group + face.material);
    CHECK(of_tubes == of_skin);
    for (const auto& [name, material] : skin.materials) {
        const bool is_wood = name.find("_oak_") != std::string::npos;
        CHECK(material.picture == (is_wood ? "handmade-oak.png" : ""));
    }
    CHECK(skin.faces.size() > tubes.faces.size());
    for (const glm::dvec3& normal : skin.normals) CHECK(glm::length(normal) == Approx(1).epsilon(1e-5));
}

// Fewer triangles: how many, where, and what a tree of them looks like.
#include "espalier/base/error.h"

#include "catch.h"
#include "formats/exporting.h"
#include "formats/silhouette.h"
#include "formats/small_tree.h"

#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

using namespace espalier;
using namespace espalier::formats;
using Catch::Contains;

namespace {

ExportedPlant reduced(const HandmadePlant& plant, std::size_t triangles, const std::string& format = "obj") {
    return ExportedPlant(plant, format, [&](ExportJob& job) { job.options.triangles = triangles; });
}

std::size_t count_of_group(const ObjFile& mesh, const std::string& kind) {
    return static_cast<std::size_t>(std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) {
        return face.group.find(kind) != std::string::npos;
    }));
}

double area_of_cards(const ObjFile& mesh) {
    double area = 0;
    for (const ObjFile::Face& face : mesh.faces) {
        if (face.group.find("polygon") == std::string::npos) continue;
        const glm::dvec3 a = mesh.points[face.points[0]], b = mesh.points[face.points[1]],
                         c = mesh.points[face.points[2]];
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

}  // namespace

TEST_CASE("a tree is exported with the number of triangles asked for, to a tenth", "[export][reduction]") {
    const SmallTree tree;
    const std::size_t all = ExportedPlant(tree.plant, "obj").files.at(0).triangles;
    for (const double share : {0.95, 0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05}) {
        const auto wanted = static_cast<std::size_t>(share * static_cast<double>(all));
        for (const char* format : {"obj", "ply", "stl", "gltf"}) {
            const ExportedFile file = reduced(tree.plant, wanted, format).files.at(0);
            INFO(format << " " << wanted << " of " << all << ": " << file.triangles);
            CHECK(file.triangles <= wanted);
            CHECK(static_cast<double>(file.triangles) >= 0.9 * static_cast<double>(wanted));
            CHECK(file.hint.empty());
        }
    }
}

TEST_CASE("half of the triangles have the same silhouette, to a tenth", "[export][reduction]") {
    const SmallTree tree;
    const ExportedPlant whole(tree.plant, "obj");
    const ObjFile before(whole.files.at(0).path);
    const auto overlap = [&](std::size_t triangles, int right, int up) {
        const ObjFile after(reduced(tree.plant, triangles).files.at(0).path);
        const glm::dvec3 middle(0, 1, 0);
        return Silhouette(before, right, up, middle, 3).overlap(Silhouette(after, right, up, middle, 3));
    };
    for (const auto& [right, up] : {std::pair{0, 1}, {2, 1}, {0, 2}}) {
        CHECK(overlap(before.faces.size() / 2, right, up) >= 0.9);
        CHECK(overlap(before.faces.size() / 4, right, up) >= 0.75);
    }
}

TEST_CASE("reduced meshes keep normals, texture coordinates, colours and groups", "[export][reduction]") {
    const SmallTree tree;
    const ObjFile before(ExportedPlant(tree.plant, "obj").files.at(0).path);
    const ExportedPlant exported = reduced(tree.plant, before.faces.size() / 3);
    const ObjFile after(exported.files.at(0).path);
    CHECK(after.points.size() == exported.files.at(0).vertices);
    CHECK(after.faces.size() == exported.files.at(0).triangles);
    CHECK(after.normals.size() == after.points.size());
    CHECK(after.uvs.size() == after.points.size());
    for (const glm::dvec3& normal : after.normals) CHECK(glm::length(normal) == Approx(1).epsilon(1e-5));
    std::set<std::string> materials, objects;
    for (const ObjFile::Face& face : after.faces) {
        materials.insert(face.material);
        objects.insert(face.object);
        if (face.group.find("axis") != std::string::npos) CHECK(face.material == "rgb_7a5c3e");
    }
    CHECK(materials == std::set<std::string>{"rgb_7a5c3e", "rgb_468232"});
    CHECK(objects == std::set<std::string>{"left"});
}

TEST_CASE("cards go as wholes, and those that stay cover as much", "[export][reduction]") {
    const SmallTree tree;
    const ObjFile before(ExportedPlant(tree.plant, "obj").files.at(0).path);
    CHECK(count_of_group(before, "polygon") == 2 * tree.cards);
    bool some_went = false;
    for (const double share : {0.5, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02}) {
        const auto wanted = static_cast<std::size_t>(share * static_cast<double>(before.faces.size()));
        const ObjFile after(reduced(tree.plant, wanted).files.at(0).path);
        const std::size_t left = count_of_group(after, "polygon");
        CHECK(left % 2 == 0);
        if (left == 2 * tree.cards || left == 0) continue;
        some_went = true;
        const double growth = std::min(4.0, 2.0 * double(tree.cards) / double(left));
        CHECK(area_of_cards(after) == Approx(area_of_cards(before) * growth * double(left) / (2 * double(tree.cards))));
    }
    CHECK(some_went);
}

TEST_CASE("organs of many triangles become coarser before any of them goes", "[export][reduction]") {
    HandmadePlant plant = branched_plant();
    for (int i = 0; i < 20; ++i) {
        Pose pose;
        pose.position = {0.3 * i, 1, 0};
        plant.add_organ(Organ::Shape::sphere, static_cast<Identity>(500 + i), 0.1, pose);
        plant.interpretation.geometry.organs.back().sides = 16;
    }
    const ExportedPlant whole(plant, "obj");
    const ObjFile before(whole.files.at(0).path);
    const ObjFile after(reduced(plant, before.faces.size() / 3).files.at(0).path);
    const auto organs = [](const ObjFile& mesh) {
        std::set<std::string> groups;
        for (const auto& face : mesh.faces) {
            if (face.group.find("axis") == std::string::npos) groups.insert(face.group);
        }
        return groups.size();
    };
    CHECK(before.faces.size() > 2000);
    CHECK(organs(before) == 20);
    CHECK(organs(after) == 20);
    CHECK(after.faces.size() <= before.faces.size() / 3);
    CHECK(after.faces.size() >= before.faces.size() * 3 / 10);
}

TEST_CASE("reduced tubes are closed", "[export][reduction]") {
    HandmadePlant plant = branched_plant();
    for (const std::size_t wanted : {90u, 60u, 40u, 20u}) {
        const ExportedPlant exported = reduced(plant, wanted, "stl");
        vtkNew<vtkSTLReader> reader;
        reader->SetFileName(exported.files.at(0).path.c_str());
        vtkNew<vtkFeatureEdges> open;
        open->SetInputConnection(reader->GetOutputPort());
        open->FeatureEdgesOff();
        open->NonManifoldEdgesOff();  // tubes share the rings of forks
        open->Update();
        INFO(wanted << ": " << exported.files.at(0).triangles);
        CHECK(open->GetOutput()->GetNumberOfCells() == 0);
    }
}

TEST_CASE("a number of triangles that cannot be reached is spoken of", "[export][reduction]") {
    const HandmadePlant plant = branched_plant();
    const ExportedFile many = reduced(plant, 100000).files.at(0);
    CHECK(many.triangles == ExportedPlant(plant, "obj").files.at(0).triangles);
    CHECK_THAT(many.hint, Contains("there are no more than " + std::to_string(many.triangles)));
    const ExportedFile few = reduced(plant, 3).files.at(0);
    CHECK(few.triangles == 8);  // the thicker tube: three sides of two triangles, and two caps
    CHECK_THAT(few.hint, Contains("--triangles 3") && Contains("the next larger is 8"));
}

TEST_CASE("a number of triangles is refused where shapes move or are shared", "[export][reduction]") {
    const auto with = [](bool mesh_axes, bool instances) {
        return [=](ExportJob& job) {
            job.options.triangles = 100;
            job.mesh_axes = mesh_axes;
            job.instances = instances;
        };
    };
    for (const char* format : {"gltf", "usd"}) {
        CHECK_THROWS_WITH(Exported(format, {}, {0, 4}, "", with(true, false)),
                          Contains("--triangles 100") && Contains("export one --step"));
        CHECK_THROWS_WITH(Exported(format, {}, {4}, "", with(true, true)), Contains("leave out --instances"));
    }
    CHECK_THROWS_WITH(Exported("usd", {}, {4}, "", with(false, false)), Contains("--mesh-axes"));
    CHECK(Exported("usd", {}, {4}, "", with(true, false)).files.at(0).triangles <= 100);
}

TEST_CASE("a tube of three sides has four vertices a ring and six triangles a piece", "[export]") {
    HandmadePlant one, three;
    one.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 0);
    for (int i = 0; i < 3; ++i) {
        three.add_internode(static_cast<Identity>(i + 1), 0, 0, 0, 0, {0, i, 0}, {0.1 * i, i + 1, 0}, 0);
        if (i > 0) three.interpretation.geometry.internodes.back().base.x = 0.1 * (i - 1);
    }
    const auto sides_3 = [](ExportJob& job) { job.options.sides = 3; };
    const ExportedFile short_one = ExportedPlant(one, "obj", sides_3).files.at(0),
                       long_one = ExportedPlant(three, "obj", sides_3).files.at(0);
    CHECK(long_one.vertices - short_one.vertices == 2 * 4);
    CHECK(long_one.triangles - short_one.triangles == 2 * 6);
    CHECK(short_one.triangles == 6 + 2 * 3);
    CHECK(short_one.vertices == 2 * 4 + 2 * 4);
}

TEST_CASE("a card has two triangles and four vertices", "[export]") {
    const SmallTree tree;
    const ObjFile mesh(ExportedPlant(tree.plant, "obj").files.at(0).path);
    std::set<std::size_t> vertices;
    for (const ObjFile::Face& face : mesh.faces) {
        if (face.group.find("polygon") != std::string::npos) vertices.insert(face.points.begin(), face.points.end());
    }
    CHECK(count_of_group(mesh, "polygon") == 2 * tree.cards);
    CHECK(vertices.size() == 4 * tree.cards);
}

namespace {

ObjFile from_afar(const HandmadePlant& plant, double metres) {
    return ObjFile(
        ExportedPlant(plant, "obj", [&](ExportJob& job) { job.options.distance = metres; }).files.at(0).path);
}

}  // namespace

TEST_CASE("the farther a tree, the fewer its triangles, and its leaves cover as much until the last has gone",
          "[export][distance]") {
    const SmallTree tree;
    const double area = area_of_cards(from_afar(tree.plant, 0));
    std::size_t before = from_afar(tree.plant, 0).faces.size(), steps_down = 0;
    CHECK(before == ExportedPlant(tree.plant, "obj").files.at(0).triangles);
    for (double metres = 1; metres < 1e5; metres *= 1.5) {
        const ObjFile mesh = from_afar(tree.plant, metres);
        INFO(metres << " m: " << mesh.faces.size() << " triangles");
        CHECK(mesh.faces.size() <= before);
        steps_down += mesh.faces.size() < before;
        before = mesh.faces.size();
        const std::size_t left = count_of_group(mesh, "polygon");
        if (left > 0) CHECK(area_of_cards(mesh) == Approx(area));
    }
    CHECK(steps_down > 10);
    CHECK(before == 0);
}

TEST_CASE("at the distance that leaves half of the triangles a tree has the same silhouette, to a tenth",
          "[export][distance]") {
    const SmallTree tree;
    const ObjFile whole = from_afar(tree.plant, 0);
    double near = 0, far = 1e4;
    for (int i = 0; i < 40; ++i) {
        const double metres = (near + far) / 2;
        (from_afar(tree.plant, metres).faces.size() <= whole.faces.size() / 2 ? far : near) = metres;
    }
    const ObjFile coarse = from_afar(tree.plant, far);
    INFO(far << " m: " << coarse.faces.size() << " of " << whole.faces.size());
    CHECK(coarse.faces.size() <= whole.faces.size() / 2);
    const glm::dvec3 middle(0, 1, 0);
    for (const auto& [right, up] : {std::pair{0, 1}, {2, 1}, {0, 2}}) {
        CHECK(Silhouette(whole, right, up, middle, 3).overlap(Silhouette(coarse, right, up, middle, 3)) >= 0.9);
    }
}

TEST_CASE("stems no thicker than a thousandth of the distance are lines: four triangles a piece, as wide as before",
          "[export][distance]") {
    HandmadePlant plant;
    for (int i = 0; i < 3; ++i) {
        plant.add_internode(static_cast<Identity>(i + 1), 0, 0, 0, 0, {0.5 * (i % 2), i, 0},
                            {0.5 * ((i + 1) % 2), i + 1, 0}, 0);
        Internode& internode = plant.interpretation.geometry.internodes.back();
        internode.base_radius = internode.tip_radius = 0.01;
    }
    CHECK(from_afar(plant, 9.9).faces.size() > 12);
    const ObjFile line = from_afar(plant, 10.1);
    CHECK(line.faces.size() == 3 * 4);
    // Seen from all sides a round stem is 2 r wide, and a flat one of half width w 4 w / pi in the mean (Cauchy).
    const double half_width = glm::length(line.points[0] - line.points[1]) / 2;
    const double of_octagon = 8 * std::sin(std::numbers::pi / 8) / std::numbers::pi * 2 * 0.01;
    CHECK(4 * half_width / std::numbers::pi == Approx(of_octagon).epsilon(1e-3));
}

TEST_CASE("a distance is refused where shapes move or are shared", "[export][distance]") {
    const auto change = [](ExportJob& job) { job.options.distance = 100; };
    CHECK_THROWS_WITH(Exported("gltf", {}, {0, 4}, "", change), Contains("--distance 100") && Contains("one --step"));
    CHECK(Exported("gltf", {}, {4}, "", change).files.at(0).triangles < Exported("gltf").files.at(0).triangles);
}

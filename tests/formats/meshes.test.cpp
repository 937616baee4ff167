// OBJ, PLY, STL and glTF as VTK's own readers find them.
#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"
#include "catch.h"
#include "formats/exporting.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <vtkCell.h>
#include <vtkCompositeDataIterator.h>
#include <vtkFloatArray.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace {

using namespace espalier;
using namespace espalier::formats;

template <class Reader>
vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
}

glm::dvec3 point(vtkPolyData& data, vtkIdType i) {
    double p[3];
    data.GetPoint(i, p);
    return {p[0], p[1], p[2]};
}

/// By the divergence theorem.
double volume(vtkPolyData& data) {
    double six = 0;
    for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
        vtkCell& cell = *data.GetCell(i);
        six += glm::dot(point(data, cell.GetPointId(0)),
                        glm::cross(point(data, cell.GetPointId(1)), point(data, cell.GetPointId(2))));
    }
    return six / 6;
}

/// Each edge is walked as often in one direction as in the other. Tubes that share the ring of a fork share its edges.
bool is_closed(vtkPolyData& data) {
    std::map<std::pair<vtkIdType, vtkIdType>, int> balance;
    for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
        vtkCell& cell = *data.GetCell(i);
        for (int k = 0; k < 3; ++k) {
            const vtkIdType a = cell.GetPointId(k), b = cell.GetPointId((k + 1) % 3);
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

MeshOptions of_plant(std::uint32_t plant, int sides = 8) {
    MeshOptions options;
    options.plant = plant;
    options.sides = sides;
    return options;
}

}  // namespace

TEST_CASE("tubes of an STL are closed and hold what their rings hold", "[export]") {
    HandmadePlant plant = branched_plant();
    plant.interpretation.geometry.internodes[1].tip = {1, 0.5, 0};  // it turns back, so that it shares no ring
    for (const int sides : {3, 8, 64, 256}) {
        const ExportedPlant exported(plant, "stl", [&](ExportJob& job) { job.options.sides = sides; });
        const auto data = read<vtkSTLReader>(exported.files.at(0).path);
        INFO(sides);
        CHECK(is_closed(*data));
        CHECK(volume(*data) == Approx(branched_volume(sides)).epsilon(0.01));
        // Two tubes of 2 and 1 pieces: two triangles a side and piece, and two caps each.
        CHECK(data->GetNumberOfCells() == sides * (2 * 3 + 2 * 2));
        CHECK(exported.files[0].triangles == static_cast<std::size_t>(data->GetNumberOfCells()));
    }
    CHECK(ring_area(256) == Approx(std::numbers::pi).epsilon(0.001));
}

TEST_CASE("a sphere exports ever more of its volume: 99.1 % with 36 sides, 99.7 % with 64", "[export]") {
    const double ball = std::numbers::pi / 6 * 0.7 * 0.7 * 0.7;
    double before = 0;
    for (const int sides : {8, 16, 36, 64, 128}) {
        HandmadePlant plant;
        Pose pose;
        pose.position = {0.3, 1, -2};
        plant.add_organ(Organ::Shape::sphere, 1, 0.7, pose);
        plant.interpretation.geometry.organs.back().sides = sides;
        const auto data = read<vtkSTLReader>(ExportedPlant(plant, "stl").files.at(0).path);
        INFO(sides << " sides: " << volume(*data) / ball);
        CHECK(is_closed(*data));
        CHECK(volume(*data) > before);
        CHECK(volume(*data) < ball);
        if (sides >= 36) CHECK(volume(*data) > 0.99 * ball);
        if (sides >= 64) CHECK(volume(*data) > 0.997 * ball);
        before = volume(*data);
        // A frame has its facets: the sides of tubes leave it as it was drawn.
        const ExportedPlant other(plant, "stl", [](ExportJob& job) { job.options.sides = 3; });
        CHECK(volume(*read<vtkSTLReader>(other.files.at(0).path)) == before);
    }
}

TEST_CASE("where an axis ends and others begin, its tube goes on along the straightest of equals", "[export]") {
    HandmadePlant fork;
    fork.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 0);
    fork.add_internode(2, 1, 1, 1, 1, {0, 1, 0}, {-1, 1.2, 0}, 0);
    fork.add_internode(3, 1, 1, 2, 1, {0, 1, 0}, {0.2, 2, 0}, 0);
    const ExportedPlant exported(fork, "stl");
    const auto data = read<vtkSTLReader>(exported.files.at(0).path);
    CHECK(data->GetNumberOfCells() == 8 * (2 * 3 + 2 * 2));  // three pieces, two tubes
    CHECK(is_closed(*data));
    const std::string obj = bytes_of(ExportedPlant(fork, "obj").files.at(0).path);
    std::size_t groups = 0;
    for (std::size_t at = obj.find("\ng "); at != std::string::npos; at = obj.find("\ng ", at + 1)) ++groups;
    CHECK(groups == 2);
}

namespace {

constexpr std::size_t corners = 9;  // corners of a ring of eight sides, the first twice

/// A stem that forks, as a mesh of two tubes.
FrameMesh forked(const glm::dvec3& left, const glm::dvec3& right, double of_left, double of_right) {
    HandmadePlant fork;
    const glm::dvec3 top(0, 1, 0);
    fork.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, top, 0);
    fork.add_internode(2, 1, 1, 1, 1, top, top + left, 0);
    fork.add_internode(3, 1, 1, 2, 1, top, top + right, 0);
    auto& internodes = fork.interpretation.geometry.internodes;
    internodes[0].tip_radius = 0.1;
    internodes[1].base_radius = internodes[1].tip_radius = of_left;
    internodes[2].base_radius = internodes[2].tip_radius = of_right;
    const ExportedPlant exported(fork, "csv");
    const RecordedRun run(exported.folder.path);
    return mesh_of(run.geometry(run.frame(0)), {});
}

glm::dvec3 ring_normal(const FrameMesh& mesh, std::size_t ring) {
    const glm::dvec3 a = mesh.points[ring], b = mesh.points[ring + 2], c = mesh.points[ring + 4];
    return glm::normalize(glm::cross(b - a, c - a));
}

glm::dvec3 leaning(double degrees) {
    const double angle = glm::radians(degrees);
    return {std::sin(angle), std::cos(angle), 0};
}

}  // namespace

TEST_CASE("two branches as thick as each other share one ring, across their bisector", "[export]") {
    for (const auto& [left, right] : {std::pair{-40.0, 40.0}, {-20.0, 50.0}, {-35.0, 5.0}}) {
        const FrameMesh mesh = forked(leaning(left), leaning(right), 0.08, 0.08);
        REQUIRE(mesh.parts.size() == 2);
        const std::size_t of_stem = corners, of_branch = mesh.parts[1].first_vertex;
        CHECK(std::abs(glm::dot(ring_normal(mesh, of_stem), leaning((left + right) / 2))) == Approx(1));
        for (std::size_t k = 0; k < corners; ++k) {
            CHECK(glm::distance(mesh.points[of_stem + k], mesh.points[of_branch + k]) < 1e-6);
        }
        CHECK(glm::distance(mesh.points[of_stem], glm::vec3(0, 1, 0)) == Approx(0.1));
    }
}

TEST_CASE("the ring of a fork leans to the thicker branch, and a much thinner one begins with its own", "[export]") {
    double before = 0;
    for (const double thinner : {0.08, 0.06, 0.03, 1e-4}) {
        const FrameMesh mesh = forked(leaning(-40), leaning(40), 0.08, thinner);
        const double angle = glm::degrees(std::acos(std::abs(glm::dot(ring_normal(mesh, corners), leaning(-40)))));
        CHECK((before == 0 || angle < before));
        before = angle;
        const glm::dvec3 sum = 0.08 * leaning(-40) + thinner * leaning(40);
        CHECK(std::abs(glm::dot(ring_normal(mesh, corners), glm::normalize(sum))) == Approx(1));
        const float of_branch = glm::distance(mesh.points[mesh.parts[1].first_vertex], glm::vec3(0, 1, 0));
        CHECK(of_branch == Approx(thinner >= 0.05 ? 0.1 : thinner).epsilon(0.01));
    }
    CHECK(before < 0.1);
}

TEST_CASE("tubes of a fork are closed, each for itself", "[export]") {
    const FrameMesh mesh = forked(leaning(-40), leaning(40), 0.08, 0.08);
    for (const MeshPart& part : mesh.parts) {
        std::map<std::array<float, 3>, int> number;
        std::map<std::pair<int, int>, int> balance;
        for (std::size_t i = part.first_triangle; i < part.first_triangle + part.triangles; ++i) {
            std::array<int, 3> at{};
            for (int k = 0; k < 3; ++k) {
                const glm::vec3& p = mesh.points[mesh.triangles[i][k]];
                at[k] = number.try_emplace({p.x, p.y, p.z}, int(number.size())).first->second;
            }
            for (int k = 0; k < 3; ++k) {
                const auto [a, b] = std::minmax(at[k], at[(k + 1) % 3]);
                balance[{a, b}] += a == at[k] ? 1 : -1;
            }
        }
        CHECK(std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; }));
    }
}

TEST_CASE("a mesh stands on y, or on z if asked for", "[export]") {
    MeshOptions options = of_plant(0);
    double bounds[6], turned[6];
    read<vtkSTLReader>(Exported("stl", options).path())->GetBounds(bounds);
    CHECK(bounds[2] == Approx(0).margin(1e-6));
    CHECK(bounds[3] == Approx(3));
    options.up = 'z';
    const Exported upright("stl", options);
    const auto data = read<vtkSTLReader>(upright.path());
    data->GetBounds(turned);
    CHECK(turned[4] == Approx(0).margin(1e-6));
    CHECK(turned[5] == Approx(3));
    CHECK(turned[1] == Approx(bounds[1]));
    CHECK(volume(*data) > 0);  // not mirrored
}

TEST_CASE("simplification leaves out nodes in line, and no others", "[export]") {
    // branched_plant's stem narrows in its first metre only.
    MeshOptions options = of_plant(0);
    options.simplify = 0.001;
    CHECK(Exported("stl", options).files[0].triangles == 8 * (2 * 3 + 2 * 2));
    options.simplify = 0.05;
    CHECK(Exported("stl", options).files[0].triangles == 8 * (2 * 2 + 2 * 2));
}

TEST_CASE("an OBJ has normals, texture coordinates, a group per axis and organ, and materials by colour", "[export]") {
    const Exported exported("obj");
    const auto data = read<vtkOBJReader>(exported.path());
    const ExportedFile& file = exported.files[0];
    CHECK(data->GetNumberOfPoints() == static_cast<vtkIdType>(file.vertices));
    CHECK(data->GetNumberOfCells() == static_cast<vtkIdType>(file.triangles));
    REQUIRE(data->GetPointData()->GetNormals());
    REQUIRE(data->GetPointData()->GetTCoords());
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        const double* n = data->GetPointData()->GetNormals()->GetTuple3(i);
        CHECK(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] == Approx(1));
    }
    const std::string text = exported.text();
    std::set<std::string> groups, objects, used;
    std::istringstream lines(text);
    for (std::string key, value; lines >> key && std::getline(lines >> std::ws, value);) {
        if (key == "g") CHECK(groups.insert(value).second);
        if (key == "o") CHECK(objects.insert(value).second);
        if (key == "usemtl") used.insert(value);
        if (key == "mtllib") CHECK(std::filesystem::exists(exported.path().parent_path() / value));
    }
    CHECK(groups.size() == 5);  // two axes a plant and a triangle
    CHECK(objects == std::set<std::string>{"left", "right"});
    const std::string library = bytes_of(std::filesystem::path(exported.path()).replace_extension("mtl"));
    for (const std::string& material : used) CHECK(library.find("newmtl " + material + "\n") != std::string::npos);
}

TEST_CASE("a PLY has normals, colours and the same triangles", "[export]") {
    const Exported exported("ply");
    const auto data = read<vtkPLYReader>(exported.path());
    CHECK(data->GetNumberOfPoints() == static_cast<vtkIdType>(exported.files[0].vertices));
    CHECK(data->GetNumberOfCells() == static_cast<vtkIdType>(exported.files[0].triangles));
    CHECK(data->GetPointData()->GetNormals());
    REQUIRE(data->GetPointData()->GetArray("RGB"));
    double bounds[6];
    data->GetBounds(bounds);
    CHECK(bounds[1] == Approx(6).margin(0.06));
    CHECK(bounds[3] == Approx(3));
}

TEST_CASE("a glTF of one frame reads back with its plants and bounds", "[export]") {
    const Exported exported("gltf");
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName(exported.path().c_str());
    reader->Update();
    vtkIdType triangles = 0;
    double lowest = 1e9, highest = -1e9;
    const auto all = vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
    for (all->InitTraversal(); !all->IsDoneWithTraversal(); all->GoToNextItem()) {
        auto* data = vtkPolyData::SafeDownCast(all->GetCurrentDataObject());
        REQUIRE(data);
        triangles += data->GetNumberOfPolys();
        double bounds[6];
        data->GetBounds(bounds);
        lowest = std::min(lowest, bounds[2]);
        highest = std::max(highest, bounds[3]);
    }
    CHECK(triangles == static_cast<vtkIdType>(exported.files[0].triangles));
    CHECK(lowest == Approx(0).margin(1e-6));
    CHECK(highest == Approx(3));
}

TEST_CASE("equal runs give equal bytes, and no file is left half written", "[export]") {
    for (const auto& [format, type] : registered<ExporterType>()) {
        INFO(format);
        const Exported one(format, {}, {0, 4}), other(format, {}, {0, 4});
        REQUIRE(one.files.size() == other.files.size());
        for (std::size_t i = 0; i < one.files.size(); ++i) {
            CHECK(one.files[i].path.filename() == other.files[i].path.filename());
            CHECK(bytes_of(one.files[i].path) == bytes_of(other.files[i].path));
        }
        for (const auto& file : std::filesystem::directory_iterator(one.recorded.folder.path / "export")) {
            CHECK(file.path().filename().string().front() != '.');
        }
    }
}

TEST_CASE("a format that is none is refused with the nearest", "[export]") {
    CHECK_THROWS_WITH(Exported("gtlf"), Catch::Contains("did you mean 'gltf'"));
}

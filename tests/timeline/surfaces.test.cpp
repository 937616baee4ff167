// Surfaces, cylinders, labels and colours of a frame, as a reader of its file finds them.
#include "espalier/geometry/generalized_cylinder.h"

#include "catch.h"
#include "timeline/frames.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolygon.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace espalier;
using namespace espalier::timeline;

namespace {

vtkSmartPointer<vtkPolyData> recorded(const HandmadePlant& plant, const Palette* palette = nullptr) {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 1);
    const Fields fields;
    PlantFrame frame = plant.frame();
    frame.palette = palette;
    timeline.record({0, 0, {frame}, &fields});
    return read_vtp(folder.path / "plants/0000.vtp");
}

std::vector<double> values_named(vtkFieldData* data, const char* name) {
    vtkDataArray* array = data->GetArray(name);
    REQUIRE(array);
    std::vector<double> result;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
        for (int k = 0; k < array->GetNumberOfComponents(); ++k) result.push_back(array->GetComponent(i, k));
    }
    return result;
}

std::vector<std::string> texts(vtkPolyData* data, const char* name) {
    auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
    REQUIRE(array);
    std::vector<std::string> result;
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) result.push_back(array->GetValue(i));
    return result;
}

glm::dvec3 vector_at(vtkDataArray* array, vtkIdType i) {
    return {array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2)};
}

/// The smallest cosine between the normals of faces and those of their points.
double worst_normal(vtkPolyData* data) {
    double worst = 1;
    vtkDataArray* normals = data->GetPointData()->GetNormals();
    REQUIRE(normals);
    for (vtkIdType cell = data->GetNumberOfVerts() + data->GetNumberOfLines(); cell < data->GetNumberOfCells();
         ++cell) {
        double normal[3];
        vtkPolygon::ComputeNormal(data->GetCell(cell)->GetPoints(), normal);
        vtkIdList* points = data->GetCell(cell)->GetPointIds();
        for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k) {
            worst = std::min(
                worst, glm::dot(glm::dvec3(normal[0], normal[1], normal[2]), vector_at(normals, points->GetId(k))));
        }
    }
    return worst;
}

std::shared_ptr<Shapes> with_leaf() {
    auto shapes = std::make_shared<Shapes>();
    Surface leaf;
    BicubicPatch patch;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) patch.points[i][j] = {double(j) - 1.5, 2.0 * i, 0};
    }
    leaf.patches.push_back(patch);
    patch.top_colour = 9;
    patch.bottom_colour = 8;
    for (auto& row : patch.points) {
        for (glm::dvec3& point : row) point.x += 3;
    }
    leaf.patches.push_back(patch);
    leaf.precision_s = leaf.precision_t = 2;
    shapes->surfaces['l'] = leaf;
    shapes->textures = {{"bark.png"}, {"leaf.png", true}};
    return shapes;
}

HandmadePlant leafy_plant(glm::dvec3 size, std::uint16_t texture = 0) {
    HandmadePlant plant;
    plant.add_organ(Organ::Shape::surface, 5, 1);
    plant.interpretation.geometry.shapes = with_leaf();
    Organ& organ = plant.interpretation.geometry.organs.back();
    organ.surface = 'l';
    organ.size = size;
    organ.look = {4, texture};
    return plant;
}

}  // namespace

TEST_CASE("a surface is written as its patches, placed and stretched along left, heading and up", "[timeline]") {
    const auto data = recorded(leafy_plant({1, 2, 1}));
    CHECK(data->GetNumberOfPolys() == 8);
    CHECK(data->GetNumberOfPoints() == 18);
    double bounds[6];
    data->GetBounds(bounds);
    CHECK(bounds[0] == Approx(-4.5));  // left is -x, and the second patch lies beyond the first
    CHECK(bounds[1] == Approx(1.5));
    CHECK(bounds[3] == Approx(12));
    CHECK(worst_normal(data) > 0.999);
    CHECK(values_named(data->GetCellData(), "identity") == std::vector<double>(8, 5));
}

TEST_CASE("patches have their own colours, or the turtle's", "[timeline]") {
    const auto data = recorded(leafy_plant({1, 1, 1}));
    CHECK(values_named(data->GetCellData(), "colour") == std::vector<double>{3, 3, 3, 3, 9, 9, 9, 9});
    CHECK(values_named(data->GetCellData(), "back_colour") == std::vector<double>{4, 4, 4, 4, 8, 8, 8, 8});
    CHECK(values_named(data->GetPointData(), "colour")[17] == 9);
}

TEST_CASE("with materials, patches have the turtle's colour, as in cpfg", "[timeline]") {
    Palette materials;
    materials.of_materials = true;
    const auto data = recorded(leafy_plant({1, 1, 1}), &materials);
    for (const double colour : values_named(data->GetCellData(), "colour")) CHECK(colour == 3);
    for (const double colour : values_named(data->GetCellData(), "back_colour")) CHECK(colour == 4);
}

TEST_CASE("polygons have texture coordinates", "[timeline]") {
    HandmadePlant plant;
    plant.add_triangle(1);
    const std::vector<double> uvs = values_named(recorded(plant)->GetPointData(), "TCoords");
    CHECK(*std::min_element(uvs.begin(), uvs.end()) == 0);
    CHECK(*std::max_element(uvs.begin(), uvs.end()) == 1);
}

TEST_CASE("widths of lines in pixels are an array of their own", "[timeline]") {
    HandmadePlant plant = branched_plant();
    CHECK_FALSE(recorded(plant)->GetPointData()->GetArray("pixels"));
    plant.interpretation.geometry.in_pixels = true;
    for (Internode& internode : plant.interpretation.geometry.internodes) internode.pixels = 3;
    CHECK(values_named(recorded(plant)->GetPointData(), "pixels") == std::vector<double>(5, 3));
}

TEST_CASE("a surface that a negative factor mirrors still agrees with its normals", "[timeline]") {
    CHECK(worst_normal(recorded(leafy_plant({-1, 2, 1}))) > 0.999);
    CHECK(worst_normal(recorded(leafy_plant({-1, -2, 3}))) > 0.999);
}

TEST_CASE("texture coordinates run over each patch, or over the whole surface if its texture says so", "[timeline]") {
    const auto uvs = [](std::uint16_t texture) {
        const auto data = recorded(leafy_plant({1, 1, 1}, texture));
        REQUIRE(data->GetPointData()->GetTCoords());
        return values_named(data->GetPointData(), "TCoords");
    };
    const auto each = uvs(1), whole = uvs(2);
    // Point 8 is s = t = 1 of the first patch: the middle of the surface's width.
    CHECK(each[16] == 1);
    CHECK(each[17] == 1);
    CHECK(whole[16] == Approx(0.5));
    CHECK(whole[17] == 1);
    CHECK(whole[2 * 17] == 1);
}

TEST_CASE("textures are numbers into the files that the frame names", "[timeline]") {
    const auto data = recorded(leafy_plant({1, 1, 1}, 2));
    CHECK(texts(data, "texture_files") == std::vector<std::string>{"", "bark.png", "leaf.png"});
    CHECK(values_named(data->GetCellData(), "texture") == std::vector<double>(8, 2));
    CHECK(values_named(recorded(leafy_plant({1, 1, 1}, 7))->GetCellData(), "texture") == std::vector<double>(8, 0));
}

TEST_CASE("a generalized cylinder is triangles that belong to its control points", "[timeline]") {
    HandmadePlant plant;
    GeneralizedCylinder cylinder;
    for (unsigned i = 0; i < 3; ++i) {
        CylinderPoint point;
        point.module = plant.add("c", {}, 100 + i, 0, 0);
        point.pose.position = {0, double(i), 0};
        point.colour = std::uint16_t(i);
        cylinder.points.push_back(point);
    }
    draw(cylinder, plant.interpretation.geometry);
    const auto data = recorded(plant);
    CHECK(data->GetNumberOfPolys() == 2 * 16 + 2 * 8);
    const std::vector<double> identities = values_named(data->GetCellData(), "identity");
    CHECK(std::count(identities.begin(), identities.end(), 101) == 24);
    CHECK(std::count(identities.begin(), identities.end(), 102) == 24);
    CHECK(values_named(data->GetCellData(), "kind") == std::vector<double>(48, 4));
    CHECK(data->GetNumberOfPoints() == 3 * 9 + 2 * 10);
    CHECK(worst_normal(data) > 0.92);
    int across = 0;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        across += vector_at(data->GetPointData()->GetNormals(), i).y == 0 ? 1 : 0;
    }
    CHECK(across == 3 * 9);  // all but those of the caps
}

TEST_CASE("labels are points, and the frame holds their texts in order", "[timeline]") {
    HandmadePlant plant = branched_plant();
    plant.interpretation.geometry.labels.push_back({0, 0, 3, {1, 2, 3}, "first"});
    plant.interpretation.geometry.labels.push_back({2, 1, 4, {0, 1, 0}, "zweiter \xC3\xBC & <b>"});
    const auto data = recorded(plant);
    CHECK(data->GetNumberOfVerts() == 2);
    CHECK(values_named(data->GetCellData(), "kind") == std::vector<double>{6, 6, 1, 1});
    CHECK(values_named(data->GetCellData(), "identity") == std::vector<double>{1, 2, 1, 2});
    CHECK(texts(data, "label_texts") == std::vector<std::string>{"first", "zweiter \xC3\xBC & <b>"});
}

TEST_CASE("with a palette every cell and point has its author's colour", "[timeline]") {
    Palette palette;
    palette.entries[256 + 3] = {{0, 0, 0, 1}, {0.2, 0.4, 1, 1}, {0, 0, 0, 1}, {0.2, 0, 0.5, 1}, 0};
    const auto data = recorded(leafy_plant({1, 1, 1}), &palette);
    const std::vector<double> rgb = values_named(data->GetCellData(), "rgb");
    REQUIRE(rgb.size() == 3 * 8);
    CHECK(std::vector<double>(rgb.begin(), rgb.begin() + 3) == std::vector<double>{102, 102, 255});
    CHECK(values_named(data->GetPointData(), "rgb").size() == 3 * 18);
    CHECK_FALSE(recorded(leafy_plant({1, 1, 1}))->GetCellData()->GetArray("rgb"));
}

TEST_CASE("the normals of axes lie across them, so that tubes can be made of them", "[timeline]") {
    HandmadePlant plant;
    const glm::dvec3 points[] = {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 0}};
    for (unsigned i = 0; i < 5; ++i) plant.add_internode(i + 1, 0, 0, 0, 0, points[i], points[i + 1], 1);
    const auto data = recorded(plant);
    vtkDataArray* normals = data->GetPointData()->GetNormals();
    REQUIRE(data->GetNumberOfPoints() == 6);
    for (vtkIdType i = 0; i < 6; ++i) {
        const glm::dvec3 normal = vector_at(normals, i);
        CHECK(glm::length(normal) == Approx(1));
        const auto segment = std::max<vtkIdType>(i, 1);
        CHECK(glm::dot(normal, points[segment] - points[segment - 1]) == Approx(0).margin(1e-6));
    }
}

TEST_CASE("a polygon has the normal of its plane at every vertex", "[timeline]") {
    HandmadePlant plant;
    plant.add_triangle(1);
    const auto data = recorded(plant);
    CHECK(values_named(data->GetPointData(), "Normals") == std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1});
}

TEST_CASE("a polygon that bends inward is cut into triangles that cover it once, facing as it does", "[timeline]") {
    constexpr int points = 40;
    const double pi = std::acos(-1.0);
    HandmadePlant plant;
    PlantGeometry& geometry = plant.interpretation.geometry;
    plant.add_triangle(1);
    geometry.polygons.back().first = static_cast<std::uint32_t>(geometry.vertices.size());
    geometry.polygons.back().count = points;
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * pi * i / points, radius = i % 2 ? 1 : 3;
        geometry.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 2});
    }
    const auto data = recorded(plant);
    CHECK(data->GetNumberOfPoints() == points);
    REQUIRE(data->GetNumberOfPolys() == points - 2);
    double area = 0;
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell) {
        double a[3], b[3], c[3];
        data->GetPoint(data->GetCell(cell)->GetPointId(0), a);
        data->GetPoint(data->GetCell(cell)->GetPointId(1), b);
        data->GetPoint(data->GetCell(cell)->GetPointId(2), c);
        const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        CHECK(twice > 0);
        area += twice / 2;
    }
    // Every corner spans a triangle with the middle and its neighbour.
    CHECK(area == Approx(points * 0.5 * 1 * 3 * std::sin(2 * pi / points)));
}

TEST_CASE("a sphere has as many meridians as the turtle's sides, a disc at least sixteen", "[timeline]") {
    HandmadePlant plant;
    plant.add_organ(Organ::Shape::sphere, 1, 2);
    plant.interpretation.geometry.organs.back().sides = 20;
    CHECK(recorded(plant)->GetNumberOfPolys() == 20 * 15);
    CHECK(worst_normal(recorded(plant)) > 0.97);
    plant.interpretation.geometry.organs.back().shape = Organ::Shape::disc;
    CHECK(recorded(plant)->GetNumberOfPoints() == 20);
    CHECK(worst_normal(recorded(plant)) > 0.999);
}

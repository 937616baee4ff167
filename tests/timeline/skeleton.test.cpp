#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "timeline/collections.h"
#include "timeline/frames.h"

#include <tbb/global_control.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <random>

using namespace espalier;
using namespace espalier::timeline;

namespace {

vtkSmartPointer<vtkPolyData> recorded(const RunFolder& folder, const HandmadePlant& plant,
                                      const std::string& toml = "") {
    Timeline timeline(folder.path, timeline_table(toml), 3);
    record(timeline, 3, {&plant});
    return read_vtp(folder.path / "plants/0003.vtp");
}

std::vector<double> values(vtkFieldData* data, const char* name) {
    vtkDataArray* array = data->GetArray(name);
    REQUIRE(array);
    std::vector<double> result;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) result.push_back(array->GetTuple1(i));
    return result;
}

// "name:type:components" of every array: what must not change from frame to frame.
std::vector<std::string> layout(vtkPolyData* data) {
    std::vector<std::string> names;
    for (vtkFieldData* arrays : {static_cast<vtkFieldData*>(data->GetPointData()),
                                 static_cast<vtkFieldData*>(data->GetCellData()), data->GetFieldData()}) {
        for (int i = 0; i < arrays->GetNumberOfArrays(); ++i) {
            vtkAbstractArray* array = arrays->GetAbstractArray(i);
            names.push_back(std::string(array->GetName()) + ":" + array->GetDataTypeAsString() + ":" +
                            std::to_string(array->GetNumberOfComponents()));
        }
        names.emplace_back("|");
    }
    return names;
}

}  // namespace

TEST_CASE("an axis is one line, and a side axis begins at its own base", "[timeline]") {
    const RunFolder folder;
    const auto data = recorded(folder, branched_plant());
    REQUIRE(data->GetNumberOfLines() == 2);
    REQUIRE(data->GetNumberOfPoints() == 5);
    CHECK(values(data->GetCellData(), "identity") == std::vector<double>{1, 2});
    CHECK(values(data->GetCellData(), "order") == std::vector<double>{0, 1});
    CHECK(values(data->GetCellData(), "colour") == std::vector<double>{7, 8});
    CHECK(values(data->GetCellData(), "kind") == std::vector<double>{1, 1});
    CHECK(data->GetCell(0)->GetNumberOfPoints() == 3);
    CHECK(data->GetCell(1)->GetNumberOfPoints() == 2);
    CHECK(data->GetCell(1)->GetPoints()->GetPoint(0)[1] == 1);
}

TEST_CASE("a point belongs to the internode that ends there, an axis's first to the one that begins", "[timeline]") {
    const RunFolder folder;
    const auto data = recorded(folder, branched_plant());
    CHECK(values(data->GetPointData(), "identity") == std::vector<double>{1, 1, 3, 2, 2});
    CHECK(values(data->GetPointData(), "parent") == std::vector<double>{0, 0, 1, 1, 1});
    CHECK(values(data->GetPointData(), "birth") == std::vector<double>{0, 0, 2, 1, 1});
    const std::vector<double> radii = values(data->GetPointData(), "radius");
    CHECK(radii[0] == Approx(0.1));
    CHECK(radii[1] == Approx(0.05));
    CHECK(radii[3] == Approx(0.1));
}

TEST_CASE("identities keep all of their 64 bits", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant;
    const Identity identity = 0xFEDCBA9876543211u;
    plant.add_internode(identity, identity - 1, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 1);
    const auto data = recorded(folder, plant);
    const auto first = [](vtkDataArray* array) {
        REQUIRE(array->GetDataTypeSize() == 8);
        return *static_cast<const Identity*>(array->GetVoidPointer(0));
    };
    CHECK(first(data->GetCellData()->GetArray("identity")) == identity);
    CHECK(first(data->GetPointData()->GetArray("parent")) == identity - 1);
}

TEST_CASE("chosen parameters become arrays, NaN where a module has none", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant = branched_plant();
    plant.add_organ(Organ::Shape::disc, 5, 0.5);
    const auto data = recorded(folder, plant, "parameters = { vigour = 'F.2', light = '?E.1', diameter = '@o.1' }");
    const std::vector<double> vigour = values(data->GetPointData(), "vigour");
    CHECK(vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray("vigour")));
    // The asked query comes first, then the axes, then the disc.
    REQUIRE(vigour.size() == 1 + 5 + 16);
    CHECK(std::isnan(vigour[0]));
    CHECK(std::vector<double>(vigour.begin() + 1, vigour.begin() + 6) ==
          std::vector<double>{0.5, 0.5, 0.75, 0.25, 0.25});
    CHECK(std::isnan(vigour[6]));
    CHECK(values(data->GetPointData(), "diameter").back() == 0.5);
    CHECK(std::isnan(values(data->GetPointData(), "diameter")[1]));
}

TEST_CASE("a query that is asked for is a vertex with its answer", "[timeline]") {
    const RunFolder folder;
    const auto data = recorded(folder, branched_plant(), "parameters = { light = '?E.1' }");
    REQUIRE(data->GetNumberOfVerts() == 1);
    CHECK(values(data->GetCellData(), "kind") == std::vector<double>{0, 1, 1});
    CHECK(values(data->GetCellData(), "identity") == std::vector<double>{4, 1, 2});
    CHECK(data->GetPoint(0)[1] == 3);
    CHECK(values(data->GetPointData(), "light")[0] == 0.125);
}

TEST_CASE("queries that are asked for are vertices in string order, whoever answered them", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant = branched_plant();
    plant.add_place(11, {1, 2, 3}, 0.5);
    plant.add_query(12, {4, 5, 6}, 0.25);
    plant.add_place(13, {7, 8, 9}, 1);
    const auto data = recorded(folder, plant, "parameters = { light = '?E.1', height = '?P.2' }");
    REQUIRE(data->GetNumberOfVerts() == 4);
    const std::vector<double> identities = values(data->GetCellData(), "identity");
    CHECK(std::vector<double>(identities.begin(), identities.begin() + 4) == std::vector<double>{4, 11, 12, 13});
    CHECK(data->GetPoint(1)[2] == 3);
    CHECK(data->GetPoint(2)[0] == 4);
    CHECK(values(data->GetPointData(), "height")[3] == 8);
    CHECK(values(data->GetPointData(), "radius")[3] == 0.5);
    CHECK(std::isnan(values(data->GetPointData(), "light")[1]));
    const RunFolder other;
    CHECK(recorded(other, plant, "parameters = { height = '?P.2' }")->GetNumberOfVerts() == 2);
}

TEST_CASE("symbols are numbers into the names that the file carries", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant = branched_plant();
    plant.add_triangle(6);
    const auto data = recorded(folder, plant);
    auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("symbol_names"));
    REQUIRE(names);
    const std::vector<double> symbols = values(data->GetCellData(), "symbol");
    CHECK(names->GetValue(static_cast<vtkIdType>(symbols[0])) == "F");
    CHECK(names->GetValue(static_cast<vtkIdType>(symbols[2])) == "P");
}

TEST_CASE("polygons and organs are polygons, a circle is a line", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant;
    plant.add_triangle(1);
    plant.add_organ(Organ::Shape::disc, 2, 2);
    plant.add_organ(Organ::Shape::circle, 3, 2);
    const auto data = recorded(folder, plant);
    CHECK(data->GetNumberOfPolys() == 2);
    CHECK(data->GetNumberOfLines() == 1);
    CHECK(values(data->GetCellData(), "kind") == std::vector<double>{3, 2, 3});
    CHECK(values(data->GetCellData(), "identity") == std::vector<double>{3, 1, 2});
}

TEST_CASE("a sphere is a closed surface of its diameter", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant;
    Pose pose;
    pose.position = {1, 2, 3};
    plant.add_organ(Organ::Shape::sphere, 2, 3, pose);
    const auto data = recorded(folder, plant);
    CHECK(data->GetNumberOfPoints() == 42);
    CHECK(data->GetNumberOfPolys() == 48);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        const double* point = data->GetPoint(i);
        CHECK(glm::distance(pose.position, glm::dvec3(point[0], point[1], point[2])) == Approx(1.5));
    }
    // Every edge of a closed surface is walked once in each direction (which Euler's formula alone would not tell).
    std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
        vtkCell* cell = data->GetCell(i);
        for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k) {
            ++edges[{cell->GetPointId(k), cell->GetPointId((k + 1) % cell->GetNumberOfPoints())}];
        }
    }
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
    CHECK(42 - static_cast<int>(edges.size()) / 2 + 48 == 2);
}

TEST_CASE("a line breaks where the turtle moved without drawing", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 1);
    plant.add_internode(2, 0, 0, 0, 0, {0, 2, 0}, {0, 3, 0}, 1);
    const auto data = recorded(folder, plant);
    CHECK(data->GetNumberOfLines() == 2);
    CHECK(data->GetNumberOfPoints() == 4);
}

TEST_CASE("arrays are the same in every frame, whatever lives in it", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("parameters = { vigour = 'F.2', light = '?E.1' }"), 4);
    const HandmadePlant full = branched_plant();
    HandmadePlant organ, empty;
    organ.add_organ(Organ::Shape::sphere, 1, 1);
    record(timeline, 0, {&full});
    record(timeline, 1, {&empty});
    record(timeline, 2, {&organ});
    record(timeline, 3, {&full, &full});
    record(timeline, 4, {});
    const auto first = read_vtp(folder.path / "plants/0000.vtp");
    const std::vector<vtkIdType> cells{3, 0, 48, 6, 0};
    for (int step = 0; step < 5; ++step) {
        INFO("step " << step);
        const auto data = read_vtp(folder.path / ("plants/000" + std::to_string(step) + ".vtp"));
        CHECK(data->GetNumberOfCells() == cells[static_cast<std::size_t>(step)]);
        CHECK(layout(data) == layout(first));
        CHECK(values(data->GetFieldData(), "TimeValue") == std::vector<double>{0.5 * step});
    }
}

TEST_CASE("a frame has the same bytes whatever was recorded before it", "[timeline]") {
    const std::string table = "parameters = { vigour = 'F.2' }";
    std::mt19937 random(7);
    const RunFolder folder;
    Timeline timeline(folder.path / "all", timeline_table(table), 60);
    HandmadePlant plant = branched_plant(), other = branched_plant();
    for (int step = 0; step <= 60; ++step) {
        INFO("step " << step);
        // Some change, some do not; what grows may shrink again.
        PlantGeometry& geometry = plant.interpretation.geometry;
        switch (random() % 6) {
            case 0:
                geometry.internodes[random() % geometry.internodes.size()].tip.x += 1;
                break;
            case 1:
                plant.string.parameters[1] = double(random());
                break;
            case 2:
                plant.add_organ(Organ::Shape::surface, 100 + Identity(step), 0.5);
                break;
            case 3:
                other.add_internode(200 + Identity(step), 1, std::uint32_t(step), 0, 0, {0, 1, 0}, {0, 2, 0}, 0.5);
                break;
            case 4:
                other = branched_plant();
                break;
        }
        record(timeline, step, {&plant, &other});
        const std::string file = read_collection(folder.path / "all/plants.pvd").back().file;
        const int written = std::stoi(file.substr(file.find('/') + 1));
        Timeline alone(folder.path / std::to_string(step), timeline_table(table), 60);
        record(alone, written, {&plant, &other});
        const std::string name = read_collection(folder.path / std::to_string(step) / "plants.pvd").back().file;
        if (written < step) continue;  // an older file shows the same
        CHECK((bytes_of(folder.path / "all" / file) == bytes_of(folder.path / std::to_string(step) / name)));
    }
}

TEST_CASE("a large frame has the same bytes with any number of threads", "[timeline]") {
    HandmadePlant plant;
    for (std::uint32_t i = 0; i < 80000; ++i) {
        plant.add_internode(i + 1, i, i / 100, i / 7, std::uint16_t(i % 3), {0, i, 0}, {0, i + 1, 0}, 0.5 * i);
    }
    const RunFolder folder;
    std::string first;
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        Timeline timeline(folder.path, timeline_table("parameters = { vigour = 'F.2' }"), 0, true);
        timeline.remove_old();
        record(timeline, 0, {&plant});
        timeline.finish();
        const std::string bytes = bytes_of(folder.path / "plants/0000.vtp");
        if (first.empty()) first = bytes;
        CHECK((bytes == first));
    }
    const auto data = read_vtp(folder.path / "plants/0000.vtp");
    vtkPointData* points = data->GetPointData();
    REQUIRE(points->GetArray("identity")->GetNumberOfTuples() > 80000);
    for (vtkIdType i = 0; i < points->GetArray("identity")->GetNumberOfTuples(); i += 997) {
        const double identity = points->GetArray("identity")->GetTuple1(i);
        CHECK(points->GetArray("parent")->GetTuple1(i) == identity - 1);
        CHECK(points->GetArray("vigour")->GetTuple1(i) == 0.5 * (identity - 1));
        CHECK(points->GetArray("birth")->GetTuple1(i) == std::floor((identity - 1) / 100));
    }
}

TEST_CASE("plants.pvd lists a file that exists for every frame, after every frame", "[timeline]") {
    const RunFolder folder;
    const HandmadePlant plant = branched_plant();
    Timeline timeline(folder.path, timeline_table(), 2);
    for (int step = 0; step < 3; ++step) {
        record(timeline, step, {&plant});
        const std::vector<DataSetEntry> entries = read_collection(folder.path / "plants.pvd");
        REQUIRE(entries.size() == static_cast<std::size_t>(step) + 1);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            CHECK(entries[i].time == 0.5 * static_cast<double>(i));
            CHECK(std::filesystem::exists(folder.path / entries[i].file));
        }
    }
}

TEST_CASE("pieces that others write are in the index once they are there, and missing ones end the run in words",
          "[timeline]") {
    const HandmadePlant plant = branched_plant();
    const Settings table = timeline_table("statistics = false\nlifespans = false\npoints_per_file = 1\n");
    const Fields fields;
    RunFolder folder;
    Timeline timeline(folder.path, table, 3);
    CHECK(timeline.points_per_file() == 1);
    Frame part{3, 1.5, {plant.frame()}, &fields};
    part.models = {&plant.model};
    part.ends = false;
    part.piece = 0;
    timeline.record(part);
    CHECK_FALSE(std::filesystem::exists(folder.path / "plants.pvd"));
    Frame last{3, 1.5, {}, &fields};
    last.begins = false;
    last.piece = 2;
    SECTION("the other is written") {
        const auto other = recorder_of_pieces(folder.path, table, 3);
        REQUIRE(other);
        part.piece = 1;
        other->record(part);
        timeline.record(last);
        const std::string index = bytes_of(folder.path / "plants.pvd");
        CHECK_THAT(index, Catch::Contains("plants/0003.vtp") && Catch::Contains("plants/0003-1.vtp"));
    }
    SECTION("the other went to another folder") {
        CHECK_THROWS_WITH(timeline.record(last), Catch::Contains("0003-1.vtp is not there"));
        CHECK_FALSE(std::filesystem::exists(folder.path / "plants.pvd"));
    }
}

TEST_CASE("who must read all plants lets no others write pieces", "[timeline]") {
    const std::string table = GENERATE("", "lifespans = false\n", "statistics = false\n", "skeleton = false\n");
    const RunFolder folder;
    CHECK(Timeline(folder.path, timeline_table(table), 3).points_per_file() == 0);
    CHECK_FALSE(recorder_of_pieces(folder.path, timeline_table(table), 3));
}

TEST_CASE("a chosen parameter that no model has is the user's mistake, with its place", "[timeline]") {
    const HandmadePlant plant = branched_plant();
    const auto message = [&](const std::string& toml) {
        const RunFolder folder;
        Timeline timeline(folder.path, timeline_table(toml), 1);
        try {
            record(timeline, 0, {&plant});
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK(message("parameters = { vigour = 'G.1' }").find("scene.toml:1:") == 0);
    CHECK(message("parameters = { vigour = 'G.1' }").find("no model of this scene has a module 'G'") !=
          std::string::npos);
    CHECK(message("parameters = { vigour = 'F.3' }").find("has no parameter number 3") != std::string::npos);
    CHECK(message("parameters = { vigour = '~o.1' }").find("no model") != std::string::npos);
    CHECK(message("parameters = { vigour = 'F.2' }") == "no error");
}

TEST_CASE("text that names no parameter is refused before the run", "[timeline]") {
    for (const char* text : {"F", "F.", ".", ".1", "F.0", "F.x", "F.1x", "F.-1", "", "F.99999999999"}) {
        INFO(text);
        const RunFolder folder;
        const Settings table = timeline_table("parameters = { vigour = '" + std::string(text) + "' }");
        CHECK_THROWS_AS(Timeline(folder.path, table, 1), UserError);
    }
    const RunFolder folder;
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table("parameters = { identity = 'F.1' }"), 1), UserError);
}

TEST_CASE("a plant without lineage is recorded with identities of 0", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant = branched_plant();
    plant.string.births.clear();
    const auto data = recorded(folder, plant, "lifespans = false");
    CHECK(values(data->GetCellData(), "identity") == std::vector<double>{0, 0});
}

TEST_CASE("a point that the numbers of a file cannot place ends the run in words", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1e38, 0}, 1);
    Timeline timeline(folder.path, timeline_table(), 2);
    CHECK_NOTHROW(record(timeline, 0, {&plant}));
    plant.add_internode(2, 1, 1, 0, 0, {0, 1e38, 0}, {0, 1e39, 0}, 1);
    CHECK_THROWS_WITH(record(timeline, 1, {&plant}), Catch::Contains("farther than 3.4e+38"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "plants/0001.vtp"));
}

TEST_CASE("compression = \"zlib\" packs every file of VTK so; another word is refused", "[timeline]") {
    const RunFolder folder;
    const HandmadePlant plant = branched_plant();
    Timeline timeline(folder.path, timeline_table("compression = 'zlib'"), 3);
    record(timeline, 3, {&plant});
    timeline.finish();
    for (const char* file : {"plants/0003.vtp", "lifespans.vtp"}) {
        CHECK(read_text(folder.path / file).find("vtkZLibDataCompressor") != std::string::npos);
    }
    CHECK(values(read_vtp(folder.path / "plants/0003.vtp")->GetCellData(), "identity") == std::vector<double>{1, 2});
    CHECK_THROWS_WITH(Timeline(folder.path / "other", timeline_table("compression = 'zip'"), 3),
                      Catch::Contains("zlib"));
}

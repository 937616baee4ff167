#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "geometry/grids/grid_file.h"
#include "timeline/collections.h"
#include "timeline/files/vti_file.h"
#include "timeline/frames.h"

#include <openvdb/io/File.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>

#include <random>

using namespace espalier;
using namespace espalier::timeline;

namespace {

Field make_field(const std::string& name, float value, bool changes = true) {
    initialize_openvdb();
    auto made = std::make_shared<FieldGrid>();
    made->grid = openvdb::FloatGrid::create(1.0f);
    made->grid->setTransform(cell_centred_transform(0.25, {-1, 0, 2}));
    auto accessor = made->grid->getAccessor();
    accessor.setValue({0, 0, 0}, value);
    accessor.setValue({3, 2, 1}, 2 * value);
    made->box = {{0, 0, 0}, {4, 3, 2}};
    return {name, "1", "relative light", made, changes};
}

vtkSmartPointer<vtkImageData> read_vti(const std::filesystem::path& path) {
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

openvdb::FloatGrid::Ptr read_vdb(const std::filesystem::path& path, const std::string& name) {
    openvdb::io::File file(path.string());
    file.open(/*delayLoad=*/false);
    return openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(name));
}

void record_fields(Timeline& timeline, int step, const std::vector<Field>& all) {
    Fields fields;
    for (const Field& field : all) fields.provide(field);
    record(timeline, step, {}, fields);
}

}  // namespace

TEST_CASE("a .vti holds the field's values at the voxels' centres", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("fields = ['light']"), 0);
    record_fields(timeline, 0, {make_field("light", 0.375f)});
    const auto image = read_vti(folder.path / "fields/light/0000.vti");
    int dimensions[3];
    image->GetDimensions(dimensions);
    CHECK(std::vector<int>(dimensions, dimensions + 3) == std::vector<int>{5, 4, 3});
    const double* origin = image->GetOrigin();
    CHECK(origin[0] == Approx(-0.875));
    CHECK(origin[1] == Approx(0.125));
    CHECK(origin[2] == Approx(2.125));
    CHECK(image->GetSpacing()[1] == Approx(0.25));
    vtkDataArray* values = image->GetPointData()->GetArray("light");
    REQUIRE(values);
    CHECK(values->GetDataType() == VTK_FLOAT);
    CHECK(values->GetTuple1(0) == 0.375);
    CHECK(values->GetTuple1(3 + 5 * (2 + 4 * 1)) == 0.75);
    CHECK(values->GetTuple1(1) == 1);
    auto* unit = vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray("unit"));
    REQUIRE(unit);
    CHECK(unit->GetValue(0) == "1");
}

TEST_CASE("a .vdb holds the field's grid, transform, name and meaning", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("fields = ['light']"), 0);
    const Field field = make_field("light", 0.375f);
    record_fields(timeline, 0, {field});
    const auto grid = read_vdb(folder.path / "fields/light/0000.vdb", "light");
    REQUIRE(grid);
    CHECK(grid->activeVoxelCount() == 2);
    CHECK(grid->background() == 1.0f);
    CHECK(grid->getConstAccessor().getValue({3, 2, 1}) == 0.75f);
    CHECK(grid->transform() == field.grid->grid->transform());
    CHECK(grid->metaValue<std::string>("meaning") == "relative light");
    // The process's own grid is left as it was.
    CHECK(field.grid->grid->getName().empty());
}

TEST_CASE("files of nothing but leaves have the bytes that OpenVDB makes of any tree", "[timeline]") {
    const RunFolder folder;
    const auto text = [&](Field field, bool only_leaves) {
        auto grid = std::make_shared<FieldGrid>(*field.grid);
        grid->only_leaves = only_leaves;
        field.grid = grid;
        write_vdb(folder.path / "a.vdb", field);
        return bytes_of(folder.path / "a.vdb");
    };
    std::mt19937 random(6);
    // Less and more than is worth compressing; leaves in several nodes of every level.
    for (const int leaves : {0, 1, 20, 700}) {
        INFO(leaves << " leaves");
        const Field field = make_field("light", 0.375f);
        auto accessor = field.grid->grid->getAccessor();
        for (int leaf = 0; leaf < leaves; ++leaf) {
            const auto place = [&](int most) { return static_cast<int>(random() % unsigned(2 * most)) - most; };
            const openvdb::Coord at(place(200), place(200), place(10000));
            for (int voxel = 0; voxel < 20; ++voxel) accessor.setValue(at.offsetBy(voxel % 8, voxel / 8, 0), 0.125f);
            accessor.setValueOff(at, 3);
        }
        std::filesystem::create_directories(folder.path);
        const std::string fast = text(field, true);
        CHECK((fast == text(field, false)));
        const auto image = [&](bool only_leaves) {
            Field cut = field;
            auto grid = std::make_shared<FieldGrid>(*field.grid);
            grid->only_leaves = only_leaves;
            grid->box = {{-30, -5, -100}, {40, 9, 3000}};
            cut.grid = grid;
            write_vti(folder.path / "a.vti", cut, 0, 0);
            return bytes_of(folder.path / "a.vti");
        };
        CHECK((image(true) == image(false)));
        CHECK(read_vdb(folder.path / "a.vdb", "light")->tree().hasSameTopology(field.grid->grid->tree()));
    }
}

TEST_CASE("a field without an active voxel gives files that open", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("fields = ['light']"), 0);
    Field field = make_field("light", 1);
    auto nothing = std::make_shared<FieldGrid>();
    initialize_openvdb();
    nothing->grid = openvdb::FloatGrid::create(0.5f);
    field.grid = nothing;
    record_fields(timeline, 0, {field});
    const auto image = read_vti(folder.path / "fields/light/0000.vti");
    REQUIRE(image->GetNumberOfPoints() == 1);
    CHECK(image->GetPointData()->GetArray("light")->GetTuple1(0) == 0.5);
    CHECK(read_vdb(folder.path / "fields/light/0000.vdb", "light")->empty());
}

TEST_CASE("fields.pvd lists every field at every time; what does not change is written once", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("fields = ['all']\nfield_files = ['vti']"), 2);
    for (int step = 0; step < 3; ++step) {
        const auto changing = float(step + 1);
        record_fields(timeline, step, {make_field("light", changing), make_field("pot.distance", changing, false)});
        const std::vector<DataSetEntry> entries = read_collection(folder.path / "fields.pvd");
        REQUIRE(entries.size() == 2 * (static_cast<std::size_t>(step) + 1));
        for (const DataSetEntry& entry : entries) CHECK(std::filesystem::exists(folder.path / entry.file));
        CHECK(entries.back().name == "pot.distance");
        CHECK(entries.back().part == 1);
        CHECK(entries.back().time == 0.5 * step);
        CHECK(entries.back().file == "fields/pot.distance/0000.vti");
    }
    CHECK(std::filesystem::exists(folder.path / "fields/light/0002.vti"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "fields/light/0002.vdb"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "fields/pot.distance/0001.vti"));
}

TEST_CASE("a timeline that goes on twice before its next frame knows which fields are written", "[timeline]") {
    const RunFolder folder;
    const auto table = [] { return timeline_table("every = 2\nfields = ['light', 'pot.distance']"); };
    const auto saved = [](const Timeline& timeline) {
        std::ostringstream out;
        timeline.save(out);
        return std::move(out).str();
    };
    const std::vector<Field> fields{make_field("light", 0.5f), make_field("pot.distance", 1, false)};
    std::string checkpoint;
    {
        Timeline timeline(folder.path, table(), 4);
        record_fields(timeline, 0, fields);
        checkpoint = saved(timeline);
    }
    for (int again = 0; again < 2; ++again) checkpoint = saved(Timeline(folder.path, table(), 4, checkpoint));
    Timeline timeline(folder.path, table(), 4, checkpoint);
    record_fields(timeline, 2, fields);
    const std::vector<DataSetEntry> entries = read_collection(folder.path / "fields.pvd");
    REQUIRE(entries.size() == 4);
    CHECK(entries[2].file == "fields/light/0000.vti");
    CHECK(entries[3].file == "fields/pot.distance/0000.vti");
    for (const char* field : {"light", "pot.distance"}) {
        CHECK_FALSE(std::filesystem::exists(folder.path / "fields" / field / "0002.vti"));
        CHECK_FALSE(std::filesystem::exists(folder.path / "fields" / field / "0002.vdb"));
    }
}

TEST_CASE("equal fields give equal bytes", "[timeline]") {
    const RunFolder folder;
    {
        Timeline timeline(folder.path / "a", timeline_table("fields = ['light']"), 0);
        record_fields(timeline, 0, {make_field("light", 0.375f)});
    }
    Timeline timeline(folder.path / "b", timeline_table("fields = ['light']"), 0);
    record_fields(timeline, 0, {make_field("light", 0.375f)});
    for (const char* file : {"fields/light/0000.vdb", "fields/light/0000.vti", "fields.pvd"}) {
        INFO(file);
        REQUIRE(!bytes_of(folder.path / "a" / file).empty());
        CHECK(bytes_of(folder.path / "a" / file) == bytes_of(folder.path / "b" / file));
    }
}

TEST_CASE("a field nobody provides is the user's mistake, and the fields there are get named", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("every = 1\nfields = ['ligth']"), 0);
    try {
        record_fields(timeline, 0, {make_field("light", 1)});
        FAIL("no error");
    } catch (const UserError& error) {
        const std::string message = error.what();
        CHECK(message.find("scene.toml:2:") == 0);
        CHECK(message.find("did you mean 'light'?") != std::string::npos);
    }
}

TEST_CASE("a field too large for a .vti is refused before it takes the memory", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("fields = ['light']"), 0);
    Field field = make_field("light", 1);
    auto huge = std::make_shared<FieldGrid>(*field.grid);
    huge->box = {{0, 0, 0}, {9999, 9999, 9999}};
    field.grid = huge;
    CHECK_THROWS_AS(record_fields(timeline, 0, {field}), RunError);
    huge->box = {{-2000000000, -2000000000, 0}, {2000000000, 2000000000, 0}};
    CHECK_THROWS_AS(record_fields(timeline, 0, {field}), RunError);
    CHECK_FALSE(std::filesystem::exists(folder.path / "fields.pvd"));
}

TEST_CASE("a format that is not one is refused", "[timeline]") {
    const RunFolder folder;
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table("field_files = ['vtk']"), 0), UserError);
}

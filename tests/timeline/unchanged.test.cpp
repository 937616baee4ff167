// What does not change is written once and named by the index at every time.
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "timeline/collections.h"
#include "timeline/frames.h"

#include <functional>
#include <sstream>

using namespace espalier;
using namespace espalier::timeline;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> files_named(const fs::path& index) {
    std::vector<std::string> files;
    for (const DataSetEntry& entry : read_collection(index)) files.push_back(entry.file);
    return files;
}

std::size_t count_files(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

Field field_of(std::shared_ptr<const FieldGrid> grid) {
    return {"light", "1", "light", std::move(grid), true};
}

std::shared_ptr<FieldGrid> grid_with(float value, float background = 0) {
    initialize_openvdb();
    auto made = std::make_shared<FieldGrid>();
    made->grid = openvdb::FloatGrid::create(background);
    auto accessor = made->grid->getAccessor();
    accessor.setValue({0, 0, 0}, 1);
    accessor.setValue({30, 2, 1}, value);
    made->box = {{0, 0, 0}, {31, 3, 2}};
    return made;
}

void record_grid(Timeline& timeline, int step, const std::shared_ptr<const FieldGrid>& grid) {
    Fields fields;
    fields.provide(field_of(grid));
    record(timeline, step, {}, fields);
}

}  // namespace

TEST_CASE("a static forest of a thousand steps is stored once", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("parameters = { light = '?E.1' }"), 999);
    const HandmadePlant plant = branched_plant();
    for (int step = 0; step < 1000; ++step) record(timeline, step, {&plant, &plant});
    timeline.finish();
    CHECK(count_files(folder.path / "plants") == 1);
    const std::vector<DataSetEntry> entries = read_collection(folder.path / "plants.pvd");
    REQUIRE(entries.size() == 1000);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        CHECK(entries[i].file == "plants/0000.vtp");
        CHECK(entries[i].time == 0.5 * double(i));
    }
}

TEST_CASE("any change of what a frame shows gives it a file of its own", "[timeline]") {
    const std::vector<std::pair<const char*, std::function<void(HandmadePlant&)>>> changes{
        {"a place", [](HandmadePlant& p) { p.interpretation.geometry.internodes[0].base.x += 1; }},
        {"a radius", [](HandmadePlant& p) { p.interpretation.geometry.internodes[1].tip_radius *= 2; }},
        {"a colour", [](HandmadePlant& p) { p.interpretation.geometry.internodes[1].colour = 99; }},
        {"an axis", [](HandmadePlant& p) { p.interpretation.geometry.internodes[2].axis = 7; }},
        {"a chosen parameter", [](HandmadePlant& p) { p.string.parameters[1] = 77; }},
        {"an answer", [](HandmadePlant& p) { p.string.parameters.back() = 77; }},
        {"a queried place", [](HandmadePlant& p) { p.interpretation.queries[0].pose.position.x += 1; }},
        {"an identity",
         [](HandmadePlant& p) { test::set_lineage(p.string, 0, 77, p.string.parent(0), p.string.step_of_birth(0)); }},
        {"a parent",
         [](HandmadePlant& p) { test::set_lineage(p.string, 0, p.string.identity(0), 77, p.string.step_of_birth(0)); }},
        {"a birth",
         [](HandmadePlant& p) { test::set_lineage(p.string, 0, p.string.identity(0), p.string.parent(0), 77); }},
        {"a number", [](HandmadePlant& p) { p.number = 77; }},
        {"a polygon", [](HandmadePlant& p) { p.add_triangle(9); }},
    };
    for (const auto& [name, change] : changes) {
        INFO(name);
        const RunFolder folder;
        Timeline timeline(folder.path, timeline_table("parameters = { light = '?E.1', vigour = 'F.2' }"), 9);
        HandmadePlant plant = branched_plant();
        record(timeline, 0, {&plant});
        record(timeline, 1, {&plant});
        change(plant);
        record(timeline, 2, {&plant});
        record(timeline, 3, {&plant});
        const HandmadePlant as_before = branched_plant();
        record(timeline, 4, {&as_before});
        CHECK(files_named(folder.path / "plants.pvd") == std::vector<std::string>{"plants/0000.vtp", "plants/0000.vtp",
                                                                                  "plants/0002.vtp", "plants/0002.vtp",
                                                                                  "plants/0004.vtp"});
    }
}

TEST_CASE("a run that goes on from before its first frame writes what does not change once, too", "[timeline]") {
    const RunFolder folder;
    const HandmadePlant plant = branched_plant();
    std::string checkpoint;
    {
        Timeline timeline(folder.path, timeline_table("first = 2"), 9);
        record(timeline, 0, {&plant});
        std::ostringstream saved;
        timeline.save(saved);
        checkpoint = saved.str();
    }
    Timeline timeline(folder.path, timeline_table("first = 2"), 9, checkpoint);
    for (int step = 1; step <= 4; ++step) record(timeline, step, {&plant});
    CHECK(files_named(folder.path / "plants.pvd") == std::vector<std::string>(3, "plants/0002.vtp"));
}

TEST_CASE("what a file does not hold may change without a new one", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 9);
    HandmadePlant plant = branched_plant();
    record(timeline, 0, {&plant});
    plant.string.parameters[1] = 77;
    record(timeline, 1, {&plant});
    CHECK(count_files(folder.path / "plants") == 1);
}

TEST_CASE("a field that is made anew with the same values is not written anew", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("fields = ['light']"), 9);
    auto moved = grid_with(3);
    moved->grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    auto wider = grid_with(3);
    wider->box.expand(1);
    auto inactive = grid_with(3);
    inactive->grid->tree().setValueOff({30, 2, 1});
    auto tile = grid_with(3);
    tile->grid->tree().addTile(1, {0, 80, 0}, 5, true);
    auto other_tile = grid_with(3);
    other_tile->grid->tree().addTile(1, {0, 80, 0}, 6, true);
    const std::vector<std::pair<std::shared_ptr<const FieldGrid>, int>> grids{
        {grid_with(2), 0}, {grid_with(2), 0}, {grid_with(3), 2}, {grid_with(3), 2}, {grid_with(3, 9), 4},
        {moved, 5},        {wider, 6},        {inactive, 7},     {tile, 8},         {other_tile, 9},
        {other_tile, 9},   {grid_with(2), 11}};
    std::vector<std::string> expected;
    for (std::size_t step = 0; step < grids.size(); ++step) {
        record_grid(timeline, static_cast<int>(step), grids[step].first);
        const std::string number = std::to_string(grids[step].second);
        expected.push_back("fields/light/" + std::string(4 - number.size(), '0') + number + ".vti");
    }
    CHECK(files_named(folder.path / "fields.pvd") == expected);
    CHECK(count_files(folder.path / "fields/light") == 2 * 9);
}

TEST_CASE("an index of a thousand frames is read, and one of them shown, without the others", "[timeline]") {
    const RunFolder folder;
    {
        Timeline timeline(folder.path, timeline_table(), 999);
        HandmadePlant plant;
        for (int step = 0; step < 1000; ++step) {
            plant.add_internode(Identity(step + 1), Identity(step), std::uint32_t(step), 0, 0, {0, step, 0},
                                {0, step + 1, 0}, 1);
            record(timeline, step, {&plant});
        }
        timeline.finish();
    }
    for (const auto& item : fs::directory_iterator(folder.path / "plants")) {
        if (item.path().filename() != "0700.vtp") fs::remove(item.path());
    }
    const std::vector<DataSetEntry> entries = read_collection(folder.path / "plants.pvd");
    REQUIRE(entries.size() == 1000);
    CHECK(entries[700].time == 350);
    CHECK(read_vtp(folder.path / entries[700].file)->GetNumberOfPoints() == 702);
}

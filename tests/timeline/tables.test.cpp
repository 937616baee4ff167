#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/csv_file.h"
#include "catch.h"
#include "small_disk.h"
#include "timeline/frames.h"

#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

using namespace espalier;
using namespace espalier::timeline;

namespace {

// A stem that loses its tip at step 2 and grows another at step 3.
HandmadePlant stem_at(int step) {
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1.0 + step, 0}, 1);
    const double top = 1.0 + step;
    if (step == 1) plant.add_internode(2, 1, 1, 0, 0, {0, top, 0}, {0, top + 1, 0}, 1);
    if (step >= 3) plant.add_internode(3, 1, 3, 0, 0, {0, top, 0}, {0, top + 2, 0}, 1);
    return plant;
}

std::map<double, std::vector<double>> lifespans(const std::filesystem::path& file) {
    const auto data = read_vtp(file);
    std::map<double, std::vector<double>> rows;
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
        std::vector<double>& row = rows[data->GetCellData()->GetArray("identity")->GetTuple1(i)];
        for (const char* name : {"parent", "birth", "death", "alive"}) {
            row.push_back(data->GetCellData()->GetArray(name)->GetTuple1(i));
        }
    }
    return rows;
}

}  // namespace

TEST_CASE("every internode has one lifespan: born, dead or still alive", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("every = 10"), 4);
    for (int step = 0; step < 5; ++step) {
        const HandmadePlant plant = stem_at(step);
        record(timeline, step, {&plant});
    }
    timeline.finish();
    const auto rows = lifespans(folder.path / "lifespans.vtp");
    REQUIRE(rows.size() == 3);
    CHECK(rows.at(1) == std::vector<double>{0, 0, 5, 1});
    CHECK(rows.at(2) == std::vector<double>{1, 1, 2, 0});
    CHECK(rows.at(3) == std::vector<double>{1, 3, 5, 1});
}

TEST_CASE("lifespans say births and deaths in the scene's time, too, and what all is measured in", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 4);
    for (int step = 0; step < 5; ++step) {
        const HandmadePlant plant = stem_at(step);
        Frame frame{step, 0.25 * step, {plant.frame()}};
        frame.models = {&plant.model};
        frame.dt = 0.25;
        frame.time_unit = "d";
        timeline.record(frame);
        timeline.wait();
    }
    timeline.finish();
    const auto data = read_vtp(folder.path / "lifespans.vtp");
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
        const auto value = [&](const char* name) { return data->GetCellData()->GetArray(name)->GetTuple1(i); };
        CHECK(value("birth_time") == 0.25 * value("birth"));
        CHECK(value("death_time") == 0.25 * value("death"));
    }
    auto* const units = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("units"));
    REQUIRE(units);
    CHECK(units->GetNumberOfValues() == 6);
    CHECK(units->LookupValue("birth: step") >= 0);
    CHECK(units->LookupValue("birth_time: d") >= 0);
    CHECK(units->LookupValue("radius: m") >= 0);
}

TEST_CASE("a lifespan keeps the shape an internode had when last seen", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 2);
    for (int step = 0; step < 3; ++step) {
        const HandmadePlant plant = stem_at(step);
        record(timeline, step, {&plant});
    }
    timeline.finish();
    const auto data = read_vtp(folder.path / "lifespans.vtp");
    REQUIRE(data->GetNumberOfCells() == 2);
    CHECK(data->GetPoint(1)[1] == 3);
    CHECK(data->GetPoint(2)[1] == 2);
    CHECK(data->GetPoint(3)[1] == 3);
    CHECK(data->GetPointData()->GetArray("radius")->GetTuple1(1) == Approx(0.05));
}

TEST_CASE("a plant that dies leaves its internodes with their death, in a file that opens", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 2);
    const HandmadePlant living = branched_plant(), dead;
    record(timeline, 0, {&living});
    record(timeline, 1, {&dead});
    record(timeline, 2, {&dead});
    timeline.finish();
    const auto rows = lifespans(folder.path / "lifespans.vtp");
    REQUIRE(rows.size() == 3);
    for (const auto& [identity, row] : rows) {
        CHECK(row[2] == 1);
        CHECK(row[3] == 0);
    }
    CHECK(read_vtp(folder.path / "plants/0001.vtp")->GetNumberOfPoints() == 0);
}

TEST_CASE("a module that draws several internodes has as many lifespans", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 1);
    HandmadePlant plant = stem_at(0);
    Internode second = plant.interpretation.geometry.internodes.back();
    second.base = second.tip;
    second.tip.y += 1;
    plant.interpretation.geometry.internodes.push_back(second);
    record(timeline, 0, {&plant});
    record(timeline, 1, {&plant});
    timeline.finish();
    CHECK(read_vtp(folder.path / "lifespans.vtp")->GetNumberOfCells() == 2);
}

TEST_CASE("lifespans agree with a count by hand, whatever dies, hides and returns", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("skeleton = false"), 19);
    constexpr int count = 400, steps = 20;
    // Internode i is born at step i % 7; some die early, some are not drawn at every step.
    const auto birth = [](int i) { return i % 7; };
    const auto is_drawn = [&](int i, int step) {
        const bool dead = i % 3 == 0 && step >= 8 + i % 5;
        const bool hidden = i % 4 == 1 && step % 3 == 0;
        return step >= birth(i) && !dead && !hidden;
    };
    for (int step = 0; step < steps; ++step) {
        HandmadePlant plant;
        for (int i = 0; i < count; ++i) {
            if (!is_drawn(i, step)) continue;
            plant.add_internode(Identity(i + 1), 0, std::uint32_t(birth(i)), 0, 0, {0, i, 0}, {0, i + 1, 0}, 1);
        }
        record(timeline, step, {&plant});
    }
    timeline.finish();
    const auto rows = lifespans(folder.path / "lifespans.vtp");
    REQUIRE(rows.size() == count);
    for (int i = 0; i < count; ++i) {
        int last = steps - 1;
        while (!is_drawn(i, last)) --last;
        CHECK(rows.at(i + 1) == std::vector<double>{0, double(birth(i)), double(last + 1), double(last == steps - 1)});
    }
}

TEST_CASE("a run without any internode leaves lifespans that open", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 0);
    timeline.finish();
    const auto data = read_vtp(folder.path / "lifespans.vtp");
    CHECK(data->GetNumberOfCells() == 0);
    CHECK(data->GetCellData()->GetArray("death"));
}

TEST_CASE("statistics.csv has one row per step and plant, whatever every says", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("every = 2"), 3);
    HandmadePlant other;
    other.number = 1;
    other.quantities = {{"light.mean", 0.5}, {"a,b.x", 2}};
    other.add_query(1, {0, 0, 0}, 1);
    other.add_place(2, {0, 0, 0}, 1);
    for (int step = 0; step < 4; ++step) {
        HandmadePlant stem = stem_at(step);
        stem.quantities = {{"light.mean", 0.1 + step}, {"a,b.x", 1}};
        record(timeline, step, {&stem, &other});
    }
    CHECK(bytes_of(folder.path / "statistics.csv") ==
          "step,time,plant,name,modules,queries,internodes,organs,length,height,volume,born,died,light.mean,\"a,b.x\"\n"
          "0,0,0,plant,1,0,1,0,1,1,0.01832595714594046,1,0,0.1,1\n"
          "0,0,1,plant,4,2,0,0,0,0,0,4,0,0.5,2\n"
          "1,0.5,0,plant,2,0,2,0,3,3,0.05497787143782139,1,0,1.1,1\n"
          "1,0.5,1,plant,4,2,0,0,0,0,0,0,0,0.5,2\n"
          "2,1,0,plant,1,0,1,0,3,3,0.05497787143782139,0,1,2.1,1\n"
          "2,1,1,plant,4,2,0,0,0,0,0,0,0,0.5,2\n"
          "3,1.5,0,plant,2,0,2,0,6,6,0.10995574287564278,1,0,3.1,1\n"
          "3,1.5,1,plant,4,2,0,0,0,0,0,0,0,0.5,2\n");
    CHECK_FALSE(std::filesystem::exists(folder.path / "plants/0001.vtp"));
    CHECK(std::filesystem::exists(folder.path / "plants/0003.vtp"));
}

TEST_CASE("modules now are modules before, plus born, minus died", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 2);
    HandmadePlant before, after;
    for (Identity i = 1; i <= 10; ++i) before.add("A", {}, i, 0, 0);
    for (Identity i = 4; i <= 10; ++i) after.add("A", {}, i, 0, 0);
    for (Identity i = 11; i <= 15; ++i) after.add("A", {}, i, 4, 1);
    record(timeline, 0, {&before});
    record(timeline, 1, {&after});
    CHECK(bytes_of(folder.path / "statistics.csv").find("\n0,0,0,plant,10,0,0,0,0,0,0,10,0\n") != std::string::npos);
    CHECK(bytes_of(folder.path / "statistics.csv").find("\n1,0.5,0,plant,12,0,0,0,0,0,0,5,3\n") != std::string::npos);
}

TEST_CASE("height is measured from the base of the first internode", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 0);
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {0, 10, 0}, {0, 12, 0}, 1);
    plant.add_internode(2, 0, 0, 1, 1, {0, 10, 0}, {0, 7, 0}, 1);
    record(timeline, 0, {&plant});
    CHECK(bytes_of(folder.path / "statistics.csv").find("\n0,0,0,plant,2,0,2,0,5,2,") != std::string::npos);
}

TEST_CASE("a quantity that a plant has not is an empty cell", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 0);
    HandmadePlant plant;
    plant.quantities = {{"light.mean", std::numeric_limits<double>::quiet_NaN()}, {"light.queries", 0}};
    record(timeline, 0, {&plant});
    const std::string table = bytes_of(folder.path / "statistics.csv");
    CHECK(table.ends_with("light.mean,light.queries\n0,0,0,plant,0,0,0,0,0,0,0,0,0,,0\n"));
}

TEST_CASE("quantities that change their names are refused, not written under the wrong ones", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 1);
    HandmadePlant plant;
    plant.quantities = {{"light.mean", 1}};
    record(timeline, 0, {&plant});
    plant.quantities = {{"light.sum", 1}};
    CHECK_THROWS_AS(record(timeline, 1, {&plant}), RunError);
}

TEST_CASE("a table on a full disk keeps whole lines", "[timeline]") {
    const RunFolder folder;
    std::filesystem::create_directories(folder.path);
    CsvFile file(folder.path / "table.csv", "a,b");
    file.append("1,2\n3,4\n");
    {
        const SmallDisk disk(15);
        CHECK_THROWS_AS(file.append("5,6\n7,8\n"), RunError);
    }
    CHECK(bytes_of(folder.path / "table.csv") == "a,b\n1,2\n3,4\n");
    file.append("9,9\n");
    CHECK(bytes_of(folder.path / "table.csv") == "a,b\n1,2\n3,4\n9,9\n");
}

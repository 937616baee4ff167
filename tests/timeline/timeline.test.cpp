#include "espalier/timeline/timeline.h"

#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "small_disk.h"
#include "timeline/collections.h"
#include "timeline/frames.h"

#include <cstdlib>
#include <random>
#include <set>
#include <sys/wait.h>
#include <thread>

using namespace espalier;
using namespace espalier::timeline;
namespace fs = std::filesystem;

namespace {

std::string error_text(const std::function<void()>& action) {
    try {
        action();
    } catch (const RunError& error) {
        return error.what();
    }
    return "";
}

void write_file_at(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
}

}  // namespace

TEST_CASE("every file in recorders/ is registered, and explains itself", "[timeline]") {
    std::set<std::string> files, names;
    for (const auto& item : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / "src/timeline/recorders")) {
        files.insert(item.path().stem().string());
    }
    for (const auto& [name, type] : registered<RecorderType>()) {
        names.insert(name);
        CHECK(!type->summary.empty());
        CHECK(!type->help.empty());
    }
    CHECK(files == names);
}

TEST_CASE("plants need no lineage for recorders that do not read them", "[timeline]") {
    const RunFolder folder;
    Settings table = timeline_table("statistics = false\nskeleton = false\nlifespans = false\nfields = [\"all\"]\n");
    CHECK_FALSE(Timeline(folder.path / "none", std::move(table), 1).reads_plants());
    CHECK(Timeline(folder.path / "some", timeline_table("skeleton = false\nlifespans = false\n"), 1).reads_plants());
}

TEST_CASE("plants are read at steps that become frames, and where the run may end", "[timeline]") {
    const RunFolder folder;
    const Timeline some(folder.path / "some", timeline_table("every = 4\nstatistics = false\nlifespans = false\n"), 9);
    CHECK(some.reads_plants_at(0, false));
    CHECK(some.reads_plants_at(9, false));
    const Timeline later(folder.path / "later",
                         timeline_table("first = 4\nevery = 4\nstatistics = false\nlifespans = false\n"), 9);
    CHECK_FALSE(later.reads_plants_at(3, false));
    CHECK(later.reads_plants_at(3, true));
    CHECK(later.reads_plants_at(4, false));
    CHECK(Timeline(folder.path / "all", timeline_table("first = 4\nlifespans = false\n"), 9).reads_plants_at(3, false));
}

TEST_CASE("two timelines into one folder are refused", "[timeline]") {
    const RunFolder folder;
    const Timeline first(folder.path, timeline_table(), 1);
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table(), 1), UserError);
}

TEST_CASE("a folder that holds a timeline is refused unless it may be overwritten", "[timeline]") {
    const RunFolder folder;
    const HandmadePlant plant = branched_plant();
    {
        Timeline timeline(folder.path, timeline_table(), 5);
        for (int step = 0; step < 6; ++step) record(timeline, step, {&plant});
        timeline.finish();
        timeline.write_run("{}");
        write_complete(folder.path);
    }
    CHECK(missing_of_complete(folder.path).empty());
    write_file_at(folder.path / "plants/notes.txt", "mine");
    write_file_at(folder.path / ".film.avi.part", "mine");
    // What killed runs were writing.
    const std::vector<std::string> halves{".checkpoint.4711.part", ".plants.4711.part.pvd", "plants/.0003.12.part.vtp"};
    for (const std::string& name : halves) write_file_at(folder.path / name, "half");
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table(), 1), UserError);
    CHECK(read_collection(folder.path / "plants.pvd").size() == 6);
    {
        Timeline timeline(folder.path, timeline_table(), 1, /*overwrite=*/true);
        CHECK(read_collection(folder.path / "plants.pvd").size() == 6);
        timeline.remove_old();
        CHECK(fs::exists(folder.path / "run.json"));  // until the new run writes its own
        record(timeline, 0, {&plant});
    }
    CHECK(read_collection(folder.path / "plants.pvd").size() == 1);
    CHECK_FALSE(fs::exists(folder.path / "plants/0005.vtp"));
    CHECK_FALSE(fs::exists(folder.path / "lifespans.vtp"));
    CHECK_FALSE(fs::exists(folder.path / "complete"));
    CHECK(fs::exists(folder.path / "plants/notes.txt"));
    CHECK(fs::exists(folder.path / ".film.avi.part"));
    for (const std::string& name : halves) CHECK_FALSE(fs::exists(folder.path / name));
}

TEST_CASE("a timeline that is replaced or goes on follows no link, neither to delete nor to write", "[timeline]") {
    const RunFolder folder, elsewhere;
    const HandmadePlant plant = branched_plant();
    const fs::path run = folder.path / "run", theirs = elsewhere.path / "theirs";
    std::ostringstream saved;
    {
        Timeline timeline(run, timeline_table(), 5);
        record(timeline, 0, {&plant});
        timeline.save(saved);
    }
    fs::create_directories(theirs);
    fs::copy_file(run / "statistics.csv", theirs / "statistics.csv");
    write_file_at(theirs / "0001.vtp", "theirs");
    const std::string table_of_others = bytes_of(theirs / "statistics.csv") + "theirs\n";
    write_file_at(theirs / "statistics.csv", table_of_others);
    fs::remove_all(run / "plants");
    fs::create_directory_symlink(theirs, run / "plants");
    {
        Timeline timeline(run, timeline_table(), 5, saved.str());
        HandmadePlant grown = branched_plant();
        grown.add_internode(Identity(4711), 0, 1, 7, 0, {0, 1, 0}, {0, 2, 0}, 1);
        CHECK(error_text([&] { record(timeline, 1, {&grown}); }).find("plants is a link") != std::string::npos);
    }
    fs::remove(run / "statistics.csv");
    fs::create_symlink(theirs / "statistics.csv", run / "statistics.csv");
    const auto go_on = [&] { Timeline(run, timeline_table(), 5, saved.str()); };
    CHECK(error_text(go_on).find("statistics.csv: it is a link, which is not followed") != std::string::npos);
    Timeline(run, timeline_table(), 5, /*overwrite=*/true).remove_old();
    CHECK(bytes_of(theirs / "0001.vtp") == "theirs");
    CHECK(bytes_of(theirs / "statistics.csv") == table_of_others);
}

TEST_CASE("a run.json of whomever is not replaced unasked", "[timeline]") {
    const RunFolder folder;
    write_file_at(folder.path / "run.json", "mine");
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table(), 1), UserError);
    CHECK(bytes_of(folder.path / "run.json") == "mine");
}

TEST_CASE("overwriting with settings that mean nothing leaves the old timeline alone", "[timeline]") {
    const RunFolder folder;
    const HandmadePlant plant = branched_plant();
    {
        Timeline timeline(folder.path, timeline_table(), 0);
        record(timeline, 0, {&plant});
    }
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table("skeletons = true"), 1, true), UserError);
    CHECK(read_collection(folder.path / "plants.pvd").size() == 1);
}

TEST_CASE("a setting that means nothing is offered the nearest name", "[timeline]") {
    const RunFolder folder;
    try {
        Timeline(folder.path, timeline_table("skeletn = true"), 1);
        FAIL("no error");
    } catch (const UserError& error) {
        CHECK(std::string(error.what()).find("skeleton") != std::string::npos);
    }
    CHECK_THROWS_AS(Timeline(folder.path, timeline_table("every = 0"), 1), UserError);
}

TEST_CASE("what is not asked for is not written", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("skeleton = false\nstatistics = false\nlifespans = false"), 0);
    const HandmadePlant plant = branched_plant();
    record(timeline, 0, {&plant});
    timeline.finish();
    for (const auto& item : fs::directory_iterator(folder.path)) CHECK(item.path().filename() == ".lock");
}

TEST_CASE("the same frames give the same bytes", "[timeline]") {
    const RunFolder folder;
    HandmadePlant plant = branched_plant();
    plant.add_triangle(8);
    plant.add_organ(Organ::Shape::sphere, 9, 0.5);
    for (const char* name : {"a", "b"}) {
        Timeline timeline(folder.path / name, timeline_table("parameters = { light = '?E.1' }"), 1);
        record(timeline, 0, {&plant});
        record(timeline, 1, {&plant, &plant});
        timeline.finish();
    }
    for (const char* file : {"plants/0000.vtp", "plants/0001.vtp", "plants.pvd", "lifespans.vtp", "statistics.csv"}) {
        INFO(file);
        REQUIRE(!bytes_of(folder.path / "a" / file).empty());
        CHECK(bytes_of(folder.path / "a" / file) == bytes_of(folder.path / "b" / file));
    }
}

TEST_CASE("on a full disk the timeline ends with a clear message and stays whole up to then", "[timeline]") {
    const RunFolder folder;
    HandmadePlant large;
    for (int i = 0; i < 2000; ++i) {
        large.add_internode(Identity(7919 * i), 0, 1, std::uint32_t(i), 0, {i * 0.37, 0, 0}, {0, i * 0.11, 0}, i);
    }
    const HandmadePlant small = branched_plant();
    Timeline timeline(folder.path, timeline_table(), 2);
    record(timeline, 0, {&small});
    const std::string statistics = bytes_of(folder.path / "statistics.csv");
    {
        const SmallDisk disk(8000);
        const std::string message = error_text([&] { record(timeline, 1, {&large}); });
        CHECK(message.find("cannot write") == 0);
        CHECK(message.find("0001.vtp") != std::string::npos);
    }
    CHECK(read_collection(folder.path / "plants.pvd").size() == 1);
    CHECK(read_vtp(folder.path / "plants/0000.vtp")->GetNumberOfLines() == 2);
    CHECK(std::distance(fs::directory_iterator(folder.path / "plants"), fs::directory_iterator()) == 1);
    CHECK(bytes_of(folder.path / "statistics.csv") == statistics);
}

TEST_CASE("a field that does not fit on the disk leaves no half file", "[timeline]") {
    const RunFolder folder;
    initialize_openvdb();
    auto made = std::make_shared<FieldGrid>();
    made->grid = openvdb::FloatGrid::create(0);
    auto accessor = made->grid->getAccessor();
    for (int i = 0; i < 5000; ++i) accessor.setValue({i % 17, i / 17 % 17, i / 289}, std::sin(float(i)));
    made->box = made->grid->evalActiveVoxelBoundingBox();
    Fields fields;
    fields.provide({"light", "1", "light", made, true});
    for (const char* format : {"vti", "vdb"}) {
        Timeline timeline(
            folder.path / format,
            timeline_table("skeleton = false\nfields = ['light']\nfield_files = ['" + std::string(format) + "']"), 0);
        const SmallDisk disk(4000);
        CHECK(error_text([&] { record(timeline, 0, {}, fields); }).find("cannot write") == 0);
        CHECK(fs::is_empty(folder.path / format / "fields/light"));
        CHECK_FALSE(fs::exists(folder.path / format / "fields.pvd"));
    }
}

TEST_CASE("a folder that cannot be made or written is a failure with the reason", "[timeline]") {
    const RunFolder folder;
    write_file_at(folder.path / "file", "");
    CHECK_THROWS_AS(Timeline(folder.path / "file" / "run", timeline_table(), 0), RunError);
    Timeline timeline(folder.path / "run", timeline_table(), 0);
    write_file_at(folder.path / "run/plants", "a file where a folder should be");
    const HandmadePlant plant = branched_plant();
    CHECK(error_text([&] { record(timeline, 0, {&plant}); }).find("cannot make the folder") == 0);
}

TEST_CASE("every recorder finishes although another fails", "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 0);
    const HandmadePlant plant = branched_plant();
    record(timeline, 0, {&plant});
    fs::create_directories(folder.path / "lifespans.vtp/in the way");
    CHECK(error_text([&] { timeline.finish(); }).find("lifespans.vtp") != std::string::npos);
    CHECK(read_collection(folder.path / "plants.pvd").size() == 1);
}

TEST_CASE("frames are written beside the run, each as the plant was at its step", "[timeline]") {
    const RunFolder folder;
    {
        Timeline timeline(folder.path, timeline_table("every = 2"), 99);
        HandmadePlant plant = branched_plant();
        const Fields fields;
        for (int step = 0; step < 100; ++step) {
            timeline.record({step, double(step), {plant.frame()}, &fields});
            plant.add_triangle(Identity(100 + step));
        }
    }
    const std::vector<DataSetEntry> entries = read_collection(folder.path / "plants.pvd");
    REQUIRE(entries.size() == 51);
    for (const DataSetEntry& entry : entries) {
        CHECK(read_vtp(folder.path / entry.file)->GetNumberOfPolys() == static_cast<vtkIdType>(entry.time));
    }
    const std::string rows = bytes_of(folder.path / "statistics.csv");
    CHECK(std::count(rows.begin(), rows.end(), '\n') == 101);
}

TEST_CASE("a folder that disappears in the middle ends the run with the reason, and finish says it again",
          "[timeline]") {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("lifespans = false"), 1000000);
    HandmadePlant plant = branched_plant();
    const Fields fields;
    int step = 0;
    const auto record_one = [&] {
        plant.add_triangle(Identity(100 + step));
        timeline.record({step, double(step), {plant.frame()}, &fields});
        ++step;
    };
    while (step < 5) record_one();
    timeline.wait();
    fs::rename(folder.path / "plants", folder.path / "elsewhere");
    write_file_at(folder.path / "plants", "a file where a folder should be");
    const std::string message = error_text([&] {
        while (step < 100) record_one();
    });
    CHECK(message.find("cannot make the folder") == 0);
    CHECK(step < 100);
    CHECK(error_text([&] { timeline.finish(); }) == message);
    CHECK(read_collection(folder.path / "plants.pvd").size() == 5);
    CHECK(read_vtp(folder.path / "elsewhere/0004.vtp")->GetNumberOfPolys() == 5);
}

// Run by the next test in a process of its own.
TEST_CASE("record until killed", "[.killed]") {
    const char* folder = std::getenv("ESPALIER_TEST_FOLDER");
    REQUIRE(folder);
    initialize_openvdb();
    Timeline timeline(folder, timeline_table("fields = ['light']"), 1000000);
    HandmadePlant plant = branched_plant();
    for (int step = 0;; ++step) {
        plant.add_triangle(Identity(100 + step));
        auto made = std::make_shared<FieldGrid>();
        made->grid = openvdb::FloatGrid::create(0);
        made->grid->getAccessor().setValue({step % 50, 1, 2}, 1);
        Fields fields;
        fields.provide({"light", "1", "light", made, true});
        const std::vector<PlantFrame> plants{plant.frame(), plant.frame()};
        timeline.record({step, double(step), plants, &fields});
    }
}

TEST_CASE("a run that is killed leaves a timeline that is whole", "[timeline]") {
    std::mt19937 random(7);
    for (int run = 0; run < 10; ++run) {
        const RunFolder folder;
        setenv("ESPALIER_TEST_FOLDER", folder.path.c_str(), 1);
        const pid_t child = fork();
        if (child == 0) {
            execl("/proc/self/exe", "test_timeline", "record until killed", static_cast<char*>(nullptr));
            _exit(1);
        }
        while (!fs::exists(folder.path / "statistics.csv")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 60000));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);

        const std::vector<DataSetEntry> entries = read_collection(folder.path / "plants.pvd");
        REQUIRE(!entries.empty());
        for (std::size_t i = 0; i < entries.size(); ++i) {
            CHECK(entries[i].time == double(i));
            CHECK(read_vtp(folder.path / entries[i].file)->GetNumberOfPolys() == 2 * (static_cast<int>(i) + 1));
        }
        const std::vector<DataSetEntry> fields = read_collection(folder.path / "fields.pvd");
        CHECK(fields.size() >= entries.size());
        for (const DataSetEntry& entry : fields) {
            const std::string text = bytes_of(folder.path / entry.file);
            CHECK(text.find("</VTKFile>") != std::string::npos);
        }
        const std::string rows = bytes_of(folder.path / "statistics.csv");
        CHECK(rows.back() == '\n');
        CHECK(std::count(rows.begin(), rows.end(), '\n') % 2 == 1);
    }
}

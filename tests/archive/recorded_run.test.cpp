// A run read back: what the recorders wrote, found again; damage named, never trusted.
#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/meshes/tubes.h"
#include "archive/recorded_folder.h"
#include "catch.h"

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

using namespace espalier;
using namespace espalier::archive;

TEST_CASE("a run read back has its frames, plants and settings", "[reading]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    CHECK(run.scene() == "handmade");
    CHECK(run.exit() == "done");
    CHECK(run.time_unit() == "day");
    REQUIRE(run.frames().size() == 2);
    CHECK(run.frames()[0].step == 0);
    CHECK(run.frames()[1].step == 4);
    CHECK(run.frames()[1].time == 2);
    CHECK(run.frame(4).plants == recorded.folder.path / "plants/0004.vtp");
    CHECK(run.plants().size() == 2);
    CHECK(run.plant("right") == 1);
    CHECK(run.field_names() == std::vector<std::string>{"light"});
    CHECK_THROWS_WITH(run.frame(3), Catch::Contains("no frame of step 3") && Catch::Contains("0 and 4"));
    CHECK_THROWS_WITH(run.plant("rigth"), Catch::Contains("did you mean 'right'"));
}

TEST_CASE("the geometry read back is what was recorded", "[reading]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    const FrameGeometry geometry = run.geometry(run.frame(4));
    CHECK(geometry.vertices.size() == 2);
    CHECK(geometry.lines.size() == 4);
    REQUIRE(geometry.polygons.size() == 1);
    CHECK(geometry.polygons[0].size() == 3);
    CHECK(geometry.of_cells.size() == 7);
    CHECK(geometry.of_cells.kinds[geometry.polygons.first] == Kind::polygon);
    CHECK(geometry.of_cells.identities[geometry.polygons.first] == 50);
    CHECK(geometry.of_cells.colours[geometry.polygons.first] == 5);
    CHECK(geometry.symbol_names[geometry.of_cells.symbols[geometry.polygons.first]] == "P");
    CHECK(geometry.parameters.at("light")[0] == 0.125);
    CHECK(std::isnan(geometry.parameters.at("vigour")[0]));
}

TEST_CASE("internodes know module, radii and the internode they stand on", "[reading]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    const FrameGeometry geometry = run.geometry(run.frame(4));
    const std::vector<FrameInternode> internodes = internodes_of(geometry);
    REQUIRE(internodes.size() == 6);
    const FrameInternode& branch = internodes[2];
    CHECK(branch.identity == 2);
    CHECK(branch.parent == 1);
    CHECK(branch.order == 1);
    CHECK(branch.birth == 1);
    CHECK(branch.base == glm::vec3(0, 1, 0));
    CHECK(branch.tip == glm::vec3(1, 1.5, 0));
    CHECK(branch.base_radius == 0.1f);
    CHECK(branch.tip_radius == 0.05f);
    CHECK(geometry.parameters.at("vigour")[branch.tip_point.row()] == 0.25);
    // Both plants: stem, stem's second internode on it, and the branch on the first.
    CHECK(internodes[0].bearer.is_none());
    CHECK(internodes[1].bearer == InternodeIndex(0));
    CHECK(branch.bearer == InternodeIndex(0));
    CHECK(internodes[3].bearer.is_none());
    CHECK(internodes[3].plant == 1);
    CHECK(internodes[5].bearer == InternodeIndex(3));
}

TEST_CASE("a field reads back the same from .vti and from .vdb", "[reading]") {
    for (const std::string files : {"", "field_files = [\"vdb\"]\n"}) {
        INFO(files);
        const RecordedFolder recorded(files);
        const RecordedRun run(recorded.folder.path);
        const RecordedField field = run.field(run.frame(4), "light");
        CHECK(field.unit == "1");
        CHECK(field.meaning == "share of light");
        CHECK(field.size == glm::ivec3(2, 3, 1));
        CHECK(field.voxel == glm::dvec3(0.5));
        CHECK(field.origin == glm::dvec3(1.25, 2.25, 3.25));
        CHECK(field.at(0, 0, 0) == 4.5f);
        CHECK(field.at(1, 2, 0) == 9);
        CHECK(field.at(1, 0, 0) == 0.25f);
        CHECK_THROWS_WITH(run.field(run.frame(4), "ligth"), Catch::Contains("did you mean 'light'"));
    }
}

TEST_CASE("statistics and life spans read back", "[reading]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    const RecordedTable statistics = run.statistics();
    REQUIRE(statistics.rows.size() == 4);
    CHECK(statistics.rows[3][statistics.column("step")] == 4);
    CHECK(statistics.rows[3][statistics.column("plant")] == 1);
    CHECK(statistics.rows[0][statistics.column("internodes")] == 1);
    CHECK(statistics.rows[2][statistics.column("internodes")] == 3);
    CHECK_THROWS_WITH(statistics.column("hight"), Catch::Contains("did you mean 'height'"));
    const RecordedLives lives = run.lifespans();
    REQUIRE(lives.lives.size() == 6);
    for (const RecordedLife& life : lives.lives) {
        CHECK(life.alive);
        CHECK(life.death == 5);
        CHECK(lives.symbol_names[life.symbol] == "F");
    }
}

TEST_CASE("an index is read while it gets longer", "[reading]") {
    GoingRun going;
    std::atomic<bool> done{false};
    std::thread writer([&] {
        for (int step = 1; step <= 300; ++step) going.grow(step);
        done = true;
    });
    std::size_t before = 1, readings = 0;
    while (!done) {
        const std::size_t frames = RecordedRun(going.folder.path).frames().size();
        CHECK(frames >= before);
        before = frames;
        ++readings;
    }
    writer.join();
    CHECK(readings > 1);
    CHECK(RecordedRun(going.folder.path).frames().size() == 301);
}

TEST_CASE("a step of which only a part is written is no frame yet", "[reading]") {
    const RecordedFolder recorded;
    for (const std::string file : {"plants.pvd", "fields.pvd"}) {
        const std::filesystem::path path = recorded.folder.path / file;
        const std::string whole = read_text(path);
        const std::size_t last = whole.rfind("<DataSet");
        write_text(path, whole.substr(0, last) + whole.substr(whole.find("/>", last) + 2));
        const RecordedRun run(recorded.folder.path);
        CHECK(run.frames().size() == 1);
        CHECK(run.frames().back().step == 0);
        write_text(path, whole);
        CHECK(RecordedRun(recorded.folder.path).frames().size() == 2);
    }
}

TEST_CASE("what is missing is named", "[reading]") {
    const RecordedFolder recorded;
    const auto& folder = recorded.folder.path;
    CHECK_THROWS_WITH(RecordedRun(folder / "elsewhere"), Catch::Contains("holds no run"));
    std::filesystem::remove(folder / "plants/0004.vtp");
    const RecordedRun run(folder);
    CHECK_THROWS_WITH(run.geometry(run.frame(4)), Catch::Contains("0004.vtp"));
    std::filesystem::remove(folder / "statistics.csv");
    CHECK_THROWS_WITH(run.statistics(), Catch::Contains("statistics.csv"));
    std::filesystem::remove(folder / "plants.pvd");
    const RecordedRun without_plants(folder);
    CHECK(without_plants.frames().size() == 2);  // frames of the fields
    CHECK_THROWS_WITH(without_plants.geometry(without_plants.frame(4)), Catch::Contains("no plants"));
    std::ofstream(folder / "run.json") << "{}";
    CHECK_THROWS_WITH(RecordedRun(folder), Catch::Contains("run.json"));
}

TEST_CASE("files damaged anywhere are refused by name or read as something sound", "[reading]") {
    const RecordedFolder recorded;
    const auto& folder = recorded.folder.path;
    std::mt19937 random(5);
    const auto pick = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    int refused = 0;
    for (const char* name :
         {"plants/0004.vtp", "lifespans.vtp", "fields/light/0004.vti", "plants.pvd", "statistics.csv", "run.json"}) {
        const std::string whole = bytes_of(folder / name);
        for (int round = 0; round < 200; ++round) {
            std::string text = whole;
            const std::string_view letters = "A/+=<>\"09-x &\n";
            for (std::size_t i = 0; i <= pick(3); ++i) text[pick(text.size())] = letters[pick(letters.size())];
            if (round % 10 == 0) text.resize(pick(text.size()));
            std::ofstream(folder / name, std::ios::binary) << text;
            try {
                const RecordedRun run(folder);
                const FrameGeometry geometry = run.geometry(run.frame(4));
                for (const FrameInternode& internode : internodes_of(geometry)) CHECK(internode.axis < LineIndex(1000));
                run.field(run.frame(4), "light");
                run.lifespans();
                run.statistics();
            } catch (const UserError& error) {
                ++refused;
                CHECK(std::string(error.what()).find(folder.string()) != std::string::npos);
            }
        }
        std::ofstream(folder / name, std::ios::binary) << whole;
    }
    CHECK(refused > 500);
}

TEST_CASE("a file of a run stands for the run", "[reading]") {
    const RecordedFolder recorded;
    const std::filesystem::path run = recorded.folder.path;
    for (const char* file : {"run.json", "plants.pvd", "plants/0004.vtp", "statistics.csv", "fields/light/0000.vti"}) {
        INFO(file);
        CHECK(std::filesystem::equivalent(folder_of_run(run / file), run));
        CHECK(RecordedRun(run / file).frames().size() == 2);
    }
    CHECK(folder_of_run(run) == run);
    CHECK(folder_of_run("models/course/01-curve.l") == "models/course/01-curve.l");
    CHECK(folder_of_run("no/such/plants.pvd") == "no/such/plants.pvd");
}

TEST_CASE("how an author looked at a plant is read back", "[reading]") {
    const GoingRun going;
    CHECK_FALSE(RecordedRun(going.folder.path).view());
    std::string json = run_json;
    json.insert(1, R"("view": {"towards_eye": [1, 0, 0], "twist": 90.0, "perspective": true, "angle": 30.0,
                               "towards_light": [0, 2, 0], "background": [0, 0.2, 1]}, )");
    write_text(going.folder.path / "run.json", json);
    const auto view = RecordedRun(going.folder.path).view();
    REQUIRE(view);
    CHECK(view->towards_eye == glm::dvec3(1, 0, 0));
    CHECK(view->twist == 90);
    CHECK(view->perspective);
    CHECK(view->towards_light == glm::dvec3(0, 2, 0));
    CHECK(view->background == std::array<std::uint8_t, 3>{0, 51, 255});
}

TEST_CASE("lines in pixels are as thick as the picture says", "[reading]") {
    FrameGeometry geometry;
    geometry.points = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    geometry.radii = {0, 0, 0.5f};
    geometry.pixels = {3, 3, 0};
    const std::vector<PointIndex> points{PointIndex(0), PointIndex(1), PointIndex(2)};
    const TubeLine line = tube_line(geometry, points, 0, 0.01f);
    REQUIRE(line.nodes.size() == 3);
    CHECK(line.nodes[0].radius == Approx(0.03f));
    CHECK(line.nodes[2].radius == 0.5f);
    geometry.pixels.clear();
    geometry.radii = {0, 0, 0};
    CHECK(tube_line(geometry, points, 0, 0.01f).nodes[0].radius == 0.01f);
}

TEST_CASE("what stands around the plants reads back", "[reading]") {
    const GoingRun going;
    CHECK_FALSE(RecordedRun(going.folder.path).background());
    Background background;
    background.vertices = {{{0, 0, 0}, {0, 0, 1}, {}}, {{1, 0, 0}, {0, 0, 1}, {}}, {{0, 1, 0}, {0, 0, 1}, {}}};
    background.triangles = {0, 1, 2};
    Material red;
    red.diffuse = {1, 0, 0, 0.5};
    background.pieces = {{red, 0, 3}};
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 0);
    const HandmadePlant plant = seedling();
    PlantFrame frame = plant.frame();
    frame.background = &background;
    const Fields fields;
    timeline.record({0, 0, {frame}, &fields});
    timeline.finish();
    timeline.write_run(run_json);
    const auto recorded = RecordedRun(folder.path).background();
    REQUIRE(recorded);
    CHECK(recorded->triangles.size() == 1);
    CHECK(recorded->points[1] == glm::vec3(1, 0, 0));
    CHECK(recorded->rgb[0] == std::array<std::uint8_t, 3>{255, 0, 0});
    CHECK(recorded->opacities[0] == 0.5f);
}

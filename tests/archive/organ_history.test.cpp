// What a run tells of one organ, against plants whose organs are known.
#include "espalier/archive/organ_history.h"

#include "archive/recorded_folder.h"
#include "catch.h"

#include <cmath>

using namespace espalier;
using namespace espalier::archive;

namespace {

/// A stem (1) that grows by a metre a step, a side internode (2) alive at the steps 2 to 5, and from step 4 a triangle
/// (50); frames at the steps given.
struct GrowingFolder {
    RunFolder folder;

    explicit GrowingFolder(const std::vector<int>& steps) {
        Timeline timeline(folder.path, timeline_table("parameters = { vigour = \"F.2\" }\n"), 4);
        for (const int step : steps) {
            HandmadePlant plant;
            const double height = 1 + step;
            plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, height, 0}, 0.5 * step);
            if (step >= 2 && step <= 5) plant.add_internode(2, 1, 2, 1, 1, {0, height, 0}, {3, height + 4, 0}, 0.25);
            if (step >= 4) {
                plant.add_triangle(50);
                test::set_lineage(plant.string, plant.string.size() - 1, 50, 0, 4);
            }
            record(timeline, step, {&plant});
        }
        timeline.finish();
        timeline.write_run(run_json);
    }
};

std::string value_of(const OrganHistory& history, const RecordedRun& run, int step, const std::string& name) {
    for (const auto& [key, value] : described(history, run, step)) {
        if (key == name) return value;
    }
    return "";
}

}  // namespace

TEST_CASE("an internode's history has a moment for every frame that has it", "[reading]") {
    const GrowingFolder recorded({0, 1, 2, 3, 4, 5, 6, 7});
    const RecordedRun run(recorded.folder.path);
    OrganReader reader;
    const auto stem = reader.history(run, {0, 1});
    REQUIRE(stem);
    CHECK(stem->symbol == "F");
    CHECK(stem->kind == Kind::axis);
    CHECK(stem->birth == 0);
    CHECK_FALSE(stem->gone);
    REQUIRE(stem->moments.size() == 8);
    for (int step = 0; step < 8; ++step) {
        const OrganMoment& moment = stem->moments[static_cast<std::size_t>(step)];
        CHECK(moment.step == step);
        CHECK(moment.time == 0.5 * step);
        CHECK(moment.length == 1 + step);
        CHECK(moment.tip == glm::vec3(0, 1 + step, 0));
        CHECK(moment.base_radius == Approx(0.1));
        CHECK(moment.tip_radius == Approx(0.05));
        REQUIRE(stem->parameters == std::vector<std::string>{"vigour"});
        CHECK(moment.parameters.at(0) == 0.5 * step);
    }
}

TEST_CASE("birth, death, parent and order of an organ that was shed are told", "[reading]") {
    const GrowingFolder recorded({0, 1, 2, 3, 4, 5, 6, 7});
    const RecordedRun run(recorded.folder.path);
    OrganReader reader;
    const auto branch = reader.history(run, {0, 2}, 3);
    REQUIRE(branch);
    CHECK(branch->parent == 1);
    CHECK(branch->order == 1);
    CHECK(branch->birth == 2);
    CHECK(branch->death() == 6);
    REQUIRE(branch->moments.size() == 4);
    CHECK(branch->moments.front().step == 2);
    CHECK(branch->moments.back().step == 5);
    CHECK(branch->moments[0].length == 5);
    CHECK(value_of(*branch, run, 7, "died") == "step 6");
    CHECK(value_of(*branch, run, 7, "last seen") == "5");
    CHECK(value_of(*branch, run, 3, "at step") == "3");
    CHECK(value_of(*branch, run, 3, "length") == "5 m");
    CHECK(value_of(*branch, run, 3, "radius") == "0.1 m to 50 mm");
    CHECK(value_of(*branch, run, 3, "plant") == "left");
    CHECK(value_of(*branch, run, 1, "at step") == "1, not there yet");
    CHECK(value_of(*branch, run, 1, "length").empty());
}

TEST_CASE("frames with steps between them tell when an organ died as well as they can", "[reading]") {
    const GrowingFolder recorded({0, 3, 6});
    const RecordedRun run(recorded.folder.path);
    OrganReader reader;
    const auto branch = reader.history(run, {0, 2});
    REQUIRE(branch);
    CHECK(branch->gone == std::pair(3, 6));
    CHECK_FALSE(branch->death());
    CHECK(value_of(*branch, run, 6, "died") == "step 4 to 6");
}

TEST_CASE("organs that are not internodes have a history of their surface", "[reading]") {
    const GrowingFolder recorded({0, 3, 4, 5});
    const RecordedRun run(recorded.folder.path);
    OrganReader reader;
    const auto triangle = reader.history(run, {0, 50});
    REQUIRE(triangle);
    CHECK(triangle->symbol == "P");
    CHECK(triangle->kind == Kind::polygon);
    CHECK(triangle->birth == 4);
    REQUIRE(triangle->moments.size() == 2);
    CHECK(triangle->moments[0].area == Approx(0.5));
    CHECK(triangle->moments[0].length == Approx(1));
    CHECK(std::isnan(triangle->moments[0].parameters.at(0)));
    CHECK(value_of(*triangle, run, 5, "area") == "0.5 m2");
    CHECK(value_of(*triangle, run, 5, "vigour").empty());
}

TEST_CASE("what a module draws in several pieces is one organ", "[reading]") {
    HandmadePlant plant;
    RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 4);
    plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 0);
    PlantGeometry& geometry = plant.interpretation.geometry;
    Internode second = geometry.internodes.back();
    second.base = {0, 1, 0};
    second.tip = {2, 1, 0};
    geometry.internodes.push_back(second);
    record(timeline, 0, {&plant});
    timeline.finish();
    timeline.write_run(run_json);
    OrganReader reader;
    const auto organ = reader.history(RecordedRun(folder.path), {0, 1});
    REQUIRE(organ);
    CHECK(organ->moments.at(0).length == 3);
    CHECK(organ->moments.at(0).base == glm::vec3(0));
    CHECK(organ->moments.at(0).tip == glm::vec3(2, 1, 0));
}

TEST_CASE("a history is told while it is read, and stops when asked to", "[reading]") {
    const GrowingFolder recorded({0, 1, 2, 3, 4, 5, 6, 7});
    const RecordedRun run(recorded.folder.path);
    OrganReader reader;
    std::vector<std::size_t> seen;
    const auto branch =
        reader.history(run, {0, 2}, 2, [&](const OrganHistory& so_far, std::size_t done, std::size_t of) {
            CHECK(of == 6);  // what came before its birth is not read
            CHECK(done == seen.size() + 1);
            seen.push_back(so_far.moments.size());
            return done < 3;
        });
    CHECK(seen == std::vector<std::size_t>{1, 2, 3});
    REQUIRE(branch);
    CHECK(branch->moments.size() == 3);
}

TEST_CASE("an organ that no frame has has no history, and a little memory is enough for all", "[reading]") {
    const GrowingFolder recorded({0, 1, 2, 3, 4, 5, 6, 7});
    const RecordedRun run(recorded.folder.path);
    OrganReader reader(1);
    CHECK_FALSE(reader.history(run, {0, 3}));
    CHECK_FALSE(reader.history(run, {1, 1}));
    for (int i = 0; i < 2; ++i) CHECK(reader.history(run, {0, 1})->moments.size() == 8);
}

TEST_CASE("a frame that was written anew is read anew", "[reading]") {
    const GrowingFolder recorded({0, 1}), other({0, 1, 2});
    OrganReader reader;
    CHECK(reader.history(RecordedRun(recorded.folder.path), {0, 1})->moments.at(1).length == 2);
    std::filesystem::copy_file(other.folder.path / "plants/0002.vtp", recorded.folder.path / "plants/0001.vtp",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::last_write_time(
        recorded.folder.path / "plants/0001.vtp",
        std::filesystem::last_write_time(other.folder.path / "plants/0002.vtp") + std::chrono::seconds(1));
    CHECK(reader.history(RecordedRun(recorded.folder.path), {0, 1})->moments.at(1).length == 3);
}

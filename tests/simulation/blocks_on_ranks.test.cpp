// Ranks whose plants wait on disk: the bytes of one process that holds all plants in memory.
#include "espalier/simulation/simulation.h"
#include "espalier/turtle/interpretation.h"

#include "catch.h"
#include "simulation/shading_stand.h"
#include "simulation/spread/plants_on_disk.h"
#include "temporary_folder.h"
#include "thread_ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// How a world is divided: among ranks, and the plants of each into blocks; 0: all are in memory.
struct Division {
    std::size_t ranks, blocks, resident = 1;
};

class Divided : public TemporaryFolder {
public:
    Divided() { write("plant.l", shading); }

    Scene scene(const std::string& rest) const {
        return read_scene_text(
            "[simulation]\nseed = 11\n"
            "[[plant]]\nmodel = 'plant.l'\ngrid = { columns = 4, rows = 3, spacing = 2, jitter = 1 }\n" +
                rest,
            "scene.toml", path());
    }

    /// Returns what went wrong on each rank.
    std::vector<std::string> run_divided(const Scene& scene, const std::string& folder, const Division& division,
                                         const std::function<void(RunOptions&)>& change = {}) const {
        return on_ranks(division.ranks, [&](Ranks& ranks) {
            RunOptions options;
            options.output = path() / folder;
            options.ranks = &ranks;
            options.blocks = division.blocks;
            options.resident = division.resident;
            if (change) change(options);
            run(scene, options);
        });
    }

    void run_alone(const Scene& scene) const {
        RunOptions options;
        options.output = path() / "alone";
        run(scene, options);
    }

    void check_same(const std::string& folder) const { check_same_files(path() / "alone", path() / folder); }
};

void check_silent(const std::vector<std::string>& errors) {
    for (const std::string& error : errors) CHECK(error == "");
}

const std::string in_pieces = "[timeline]\nstatistics = false\nlifespans = false\npoints_per_file = 400\n";

}  // namespace

TEST_CASE_METHOD(Divided, "plants of ranks may wait on disk, and no byte changes", "[simulation][ranks][store]") {
    const std::string rest =
        GENERATE(std::string(light), std::string(light) + "[timeline]\nfields = ['light']\n",
                 std::string(light) + in_pieces, std::string("[environment.light]\nprocess = 'density'\n"),
                 std::string("[[plant.stage]]\nstage = 'pipe-radii'\n[[plant.stage]]\nstage = 'leaves'\n") + light);
    INFO(rest);
    const Scene described = scene(rest);
    run_alone(described);
    for (const Division& division : {Division{2, 1}, Division{2, 3}, Division{3, 4, 2}, Division{5, 100}}) {
        const std::string folder = fmt::format("on-{}-in-{}", division.ranks, division.blocks);
        INFO(folder);
        check_silent(run_divided(described, folder, division));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Divided, "a run goes on wherever its plants were and are", "[simulation][ranks][store]") {
    const std::string rest = GENERATE(std::string(light), std::string(light) + in_pieces);
    const Scene described = scene(rest);
    run_alone(described);
    const auto fail_at_the_fifth_step = [](RunOptions& options) {
        options.checkpoint_every = 2;
        options.progress = [](const Progress& progress) {
            if (progress.step == 5) throw RunError("the machine is gone");
        };
    };
    const std::pair<Division, Division> changes[] = {{{3, 4}, {2, 0}}, {{2, 0}, {3, 2}}, {{1, 3}, {3, 5}},
                                                     {{3, 2}, {1, 4}}, {{2, 3}, {1, 0}}, {{1, 0}, {2, 3}}};
    int number = 0;
    for (const auto& [before, after] : changes) {
        INFO(before.ranks << " ranks, " << before.blocks << " blocks, then " << after.ranks << ", " << after.blocks);
        const std::string folder = fmt::format("again-{}", ++number);
        for (const std::string& error : run_divided(described, folder, before, fail_at_the_fifth_step)) {
            CHECK_THAT(error, Contains("the machine is gone"));
        }
        check_silent(run_divided(described, folder, after, [](RunOptions& options) { options.resume = true; }));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Divided, "plants that wait move to ranks that have less to do", "[simulation][ranks][store]") {
    // The plants in the last row become a hundred times as large as the others, and ask, too.
    write("large.l",
          "environment light;\nlsystem: 1\nderivation length: 9\naxiom: A\nA --> F(1)?light(1)[+A][-A]A\nendlsystem\n");
    const Scene described = read_scene_text(
        "[[plant]]\nmodel = 'plant.l'\ngrid = { columns = 4, rows = 3, spacing = 2 }\n"
        "[[plant]]\nmodel = 'large.l'\ngrid = { columns = 4, rows = 1, spacing = 2 }\nposition = [0, 0, 9]\n" +
            std::string(light),
        "scene.toml", path());
    run_alone(described);
    check_silent(run_divided(described, "moved", {2, 3}, [](RunOptions& options) { options.checkpoint_every = 1; }));
    check_same("moved");
}

TEST_CASE_METHOD(Divided, "each rank divides its own plants, so that all have as much to do in each part",
                 "[simulation][ranks][store]") {
    const Scene described = scene("");
    const auto symbols = symbol_table(source_of(*described.plants.front().model));
    std::vector<GrowingPlant> plants;
    for (const Plant& plant : described.plants) {
        plants.emplace_back(static_cast<std::uint32_t>(plants.size()), plant, symbols, DerivationSettings{});
    }
    MemoryBudget memory(std::size_t{1} << 30);
    PlantsOnDisk on_disk(std::move(plants), path(), /*blocks=*/4, /*resident=*/1, memory,
                         /*holds_queries=*/true);
    const auto local_of_parts = [&] {
        std::vector<std::ptrdiff_t> counts;
        std::uint32_t next = 0;
        for (const PlantSet::Part& part : on_disk.parts()) {
            counts.push_back(
                std::count_if(part.begin(), part.end(), [](const GrowingPlant& plant) { return plant.is_local; }));
            for (const GrowingPlant& plant : part) CHECK(plant.number == next++);
        }
        CHECK(next == on_disk.all().size());
        return counts;
    };
    CHECK(local_of_parts() == std::vector<std::ptrdiff_t>{3, 3, 3, 3});
    for (std::size_t i = 0; i < 8; ++i) on_disk.all()[i].is_local = false;
    CHECK(local_of_parts() == std::vector<std::ptrdiff_t>{1, 1, 1, 1});
    for (std::size_t i = 3; i < 8; ++i) on_disk.all()[i].is_local = true;
    CHECK(local_of_parts() == std::vector<std::ptrdiff_t>{3, 3, 3});
    for (GrowingPlant& plant : on_disk.all()) plant.is_local = false;
    CHECK(local_of_parts() == std::vector<std::ptrdiff_t>{0});
}

TEST_CASE_METHOD(Divided, "less memory suffices for ranks whose plants wait on disk", "[simulation][ranks][store]") {
    write("doubling.l", doubling);
    const Scene described = read_scene_text(doubling_stand, "scene.toml", path());
    const auto with_little = [](RunOptions& options) { options.memory = std::size_t{70} << 20; };
    for (const std::string& error : run_divided(described, "whole", {2, 0}, with_little)) {
        CHECK_THAT(error, Contains("--memory"));
    }
    check_silent(run_divided(described, "stored", {2, 8}, with_little));
    CHECK(recorded_files(path() / "stored").contains("plants/0015.vtp"));
}

TEST_CASE_METHOD(Divided, "a run that needed all memory goes on with less, as its plants wait from then on",
                 "[simulation][ranks][store]") {
    write("doubling.l", doubling);
    const Scene described = read_scene_text(doubling_stand, "scene.toml", path());
    const auto stop_before_the_end = [](RunOptions& options) {
        options.checkpoint_every = 1;
        options.progress = [](const Progress& progress) {
            if (progress.step == 14) throw RunError("the machine is gone");
        };
    };
    const auto go_on_with_little = [](RunOptions& options) {
        options.memory = std::size_t{70} << 20;
        options.resume = true;
    };
    const std::size_t ranks = GENERATE(1, 2);
    CHECK_THAT(run_divided(described, "again", {1, 0}, stop_before_the_end)[0], Contains("the machine is gone"));
    fs::copy(path() / "again", path() / "whole", fs::copy_options::recursive);
    CHECK_THAT(run_divided(described, "whole", {ranks, 0}, go_on_with_little)[0], Contains("--memory"));
    check_silent(run_divided(described, "again", {ranks, 16}, go_on_with_little));
    CHECK(recorded_files(path() / "again").contains("plants/0015.vtp"));
}

TEST_CASE_METHOD(Divided, "what fails while plants wait ends all ranks, and leaves no file of them",
                 "[simulation][ranks][store]") {
    write("falling.l", "lsystem: 1\nderivation length: 9\naxiom: A(4)\nA(x) --> F(1/x)A(x-1)\nendlsystem\n");
    const Scene described = read_scene_text(
        "[[plant]]\nmodel = 'plant.l'\ngrid = { columns = 3, rows = 1, spacing = 9 }\n"
        "[[plant]]\nmodel = 'falling.l'\nname = 'weak'\nposition = [30, 0, 0]\n" +
            std::string(light),
        "scene.toml", path());
    for (const std::string& error : run_divided(described, "failed", {2, 2})) CHECK_THAT(error, Contains("weak"));
    for (const auto& item : fs::directory_iterator(path() / "failed")) {
        CHECK_THAT(item.path().filename().string(), !Contains("waiting"));
    }
}

TEST_CASE_METHOD(Divided, "all ranks refuse a process that reads whole plants", "[simulation][ranks][store]") {
    const Scene described = scene("[environment.light]\nprocess = 'ray-light'\n");
    for (const std::string& error : run_divided(described, "refused", {2, 2})) {
        CHECK_THAT(error, Contains("'light' reads whole plants"));
    }
    CHECK_FALSE(fs::exists(path() / "refused"));
}

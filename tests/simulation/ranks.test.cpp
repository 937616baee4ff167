// Worlds that several ranks grow together: the bytes of one that grows alone.
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/world_checkpoint.h"

#include "catch.h"
#include "simulation/run/allowed_memory.h"
#include "simulation/shading_stand.h"
#include "simulation/spread/blocks.h"
#include "temporary_folder.h"
#include "thread_ranks.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

class Spread : public TemporaryFolder {
public:
    Spread() { write("plant.l", shading); }

    Scene scene(const std::string& rest, const std::string& simulation = "") const {
        return read_scene_text(
            "[simulation]\nseed = 11\n" + simulation +
                "[[plant]]\nmodel = 'plant.l'\ngrid = { columns = 4, rows = 3, spacing = 2, jitter = 1 }\n" + rest,
            "scene.toml", path());
    }

    /// Runs the scene on so many ranks; returns what went wrong on each.
    std::vector<std::string> run_on(std::size_t count, const Scene& scene, const std::string& folder,
                                    const std::function<void(RunOptions&, Ranks&)>& change = {}) const {
        return on_ranks(count, [&](Ranks& ranks) {
            RunOptions options;
            options.output = path() / folder;
            options.ranks = &ranks;
            if (change) change(options, ranks);
            run(scene, options);
        });
    }

    void run_alone(const Scene& scene) const {
        RunOptions options;
        options.output = path() / "alone";
        options.overwrite = true;
        run(scene, options);
    }

    void check_same(const std::string& folder) const { check_same_files(path() / "alone", path() / folder); }
};

// Nothing but the skeleton reads plants, so that all ranks write files of large frames.
const std::string in_pieces = "[timeline]\nstatistics = false\nlifespans = false\npoints_per_file = 400\n";

// Plants with symbols of their own.
const char* const other =
    "lsystem: 1\nderivation length: 9\naxiom: Z\nZ --> U(2)F(1)[-Z][+Z]\nF(x) --> F(x*1.1)\nendlsystem\n";
const std::string others =
    "[[plant]]\nmodel = 'other.l'\ngrid = { columns = 3, rows = 2, spacing = 2 }\nposition = [1, 0, 1]\n";

bool all_are_silent(const std::vector<std::string>& errors) {
    return std::all_of(errors.begin(), errors.end(), [](const std::string& error) { return error.empty(); });
}

}  // namespace

TEST_CASE_METHOD(Spread, "a world has the same bytes on any number of ranks", "[simulation][ranks]") {
    const std::string process = GENERATE(
        std::string(light), std::string(light) + "[timeline]\nfields = ['light']\n",
        std::string(
            "[environment.light]\nprocess = 'voxel-shade'\ndomain = { lower = [-2, -1, -2], upper = [8, 9, 6] }\n"
            "voxel = 0.5\nperiodic = true\n"),
        std::string("[environment.light]\nprocess = 'density'\n"),
        std::string("[environment.light]\nprocess = 'shadowpyramid'\ngrid_size = 81\ngrid_span = 20\n"),
        std::string("[environment.light]\nprocess = 'canopy-light'\nvoxel = 2\nscattering = { rings = 1, around = 3 "
                    "}\nsky = { par = 500, rings = 2 }\n"),
        std::string("[[plant.stage]]\nstage = 'pipe-radii'\n[[plant.stage]]\nstage = 'leaves'\n") + light);
    const Scene described = scene(process);
    run_alone(described);
    for (const std::size_t count : {2u, 3u, 5u}) {
        const std::string folder = fmt::format("on-{}", count);
        INFO(process << count);
        REQUIRE(all_are_silent(run_on(count, described, folder)));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Spread, "two roots on two ranks drink from one soil, whose balance is exact", "[simulation][ranks]") {
    Scene described = read_scene(ESPALIER_SOURCE_DIR "/environments/two-roots.toml");
    described.steps = 40;
    run_alone(described);
    REQUIRE(all_are_silent(run_on(2, described, "shared")));
    check_same("shared");

    std::array<double, 2> drunk_by{}, drunk{}, missing{}, balance{};  // of a rank's plant; of the soil that it knows
    const auto errors = on_ranks(2, [&](Ranks& ranks) {
        World world(described, {.ranks = &ranks});
        const auto rank = static_cast<std::size_t>(ranks.rank());
        world.start();
        const std::uint32_t own = world.modules(0) > 0 ? 0 : 1;
        const auto statistic = [&](const std::string& name) {
            for (const Quantity& quantity : world.environment().statistics(own)) {
                if (quantity.name == name) return quantity.value;
            }
            throw std::runtime_error("no statistic " + name);
        };
        const double filled = statistic("water.total") + statistic("water.drunk");
        for (int step = 0; step < described.steps; ++step) {
            drunk_by[rank] += statistic("water.uptake");
            world.step();
        }
        drunk_by[rank] += statistic("water.uptake");
        drunk[rank] = statistic("water.drunk");
        missing[rank] = filled - statistic("water.total");
        balance[rank] = statistic("water.balance");
    });
    REQUIRE(all_are_silent(errors));
    CHECK(drunk[0] == drunk[1]);
    CHECK(std::min(drunk_by[0], drunk_by[1]) > 0.3 * drunk[0]);
    CHECK(drunk_by[0] + drunk_by[1] == Approx(drunk[0]).epsilon(1e-9));
    CHECK(missing[0] == Approx(drunk[0]).epsilon(1e-9));
    CHECK(std::max(balance[0], balance[1]) < 1e-12);
}

TEST_CASE_METHOD(Spread, "ranks on one machine share its memory", "[simulation][ranks]") {
    std::array<std::size_t, 5> sharing{};
    on_ranks(5, [&](Ranks& ranks) { sharing[static_cast<std::size_t>(ranks.rank())] = ranks_on_node(&ranks); });
    CHECK(sharing == std::array<std::size_t, 5>{2, 2, 2, 2, 1});
    CHECK(ranks_on_node(nullptr) == 1);
    CHECK(default_memory(2) == default_memory() / 2);
    CHECK(simulation::allowed_memory(0, path(), 2) == default_memory(2));
    CHECK(simulation::allowed_memory(4711, path(), 2) == 4711);
    REQUIRE(all_are_silent(run_on(2, scene(light), "shared")));
    CHECK(nlohmann::json::parse(text_of(path() / "shared/run.json"))["memory"] == default_memory(2));
}

TEST_CASE_METHOD(Spread, "a world has the same bytes whatever its blocks are", "[simulation][ranks]") {
    run_alone(scene(light));
    for (const char* blocks : {"blocks = [1, 3]\n", "blocks = [3, 1]\n", "blocks = [7, 5]\n"}) {
        const std::string folder = fmt::format("blocks-{}", blocks[10]);
        REQUIRE(all_are_silent(run_on(3, scene(light, blocks), folder)));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Spread, "only queries that change answers elsewhere are sent", "[simulation][ranks]") {
    const std::string process =
        GENERATE(std::string(light),
                 std::string("[environment.light]\nprocess = 'shadowpyramid'\ngrid_size = 4001\ngrid_span = 2000\n"),
                 std::string("[environment.light]\nprocess = 'honda81'\nradius = 3\n"));
    // Two rows of plants that nothing connects.
    const auto sent = [&](double apart) {
        const Scene described = read_scene_text(
            fmt::format("[[plant]]\nmodel = 'plant.l'\npositions = [[0, 0, 0], [{}, 0, 0]]\n{}", apart, process),
            "scene.toml", path());
        std::array<std::uint64_t, 2> bytes{};
        on_ranks(2, [&](Ranks& ranks) {
            World world(described, {.ranks = &ranks});
            world.start();
            for (int step = 0; step < 8; ++step) world.step();
            bytes[static_cast<std::size_t>(ranks.rank())] = world.times().bytes;
        });
        return bytes[0] + bytes[1];
    };
    CHECK(sent(1) > 10 * sent(1000));
}

TEST_CASE_METHOD(Spread, "the first rank gets the plants of others part by part, and only for frames that show them",
                 "[simulation][ranks]") {
    class EveryThird : public Recorder {
    public:
        bool reads_plants_at(int step, bool) const override { return step % 3 == 0; }
        void record(const Frame& frame) override {
            const auto is_there = [](const PlantFrame& plant) { return !plant.string->empty(); };
            const auto there = std::count_if(frame.plants.begin(), frame.plants.end(), is_there);
            parts.push_back({frame.plants.size(), static_cast<std::size_t>(there)});
        }
        void finish() override {}

        std::vector<std::pair<std::size_t, std::size_t>> parts;  ///< plants, and of how many the string is there
    };
    write("silent.l", "lsystem: 1\nderivation length: 9\naxiom: A\nA --> F[+A]A\nendlsystem\n");
    const Scene described = read_scene_text(
        "[[plant]]\nmodel = 'silent.l'\ngrid = { columns = 4, rows = 3, spacing = 2 }\n", "scene.toml", path());
    EveryThird recorder;
    std::array<std::vector<std::uint64_t>, 3> sent;
    const auto errors = on_ranks(3, [&](Ranks& ranks) {
        World world(described, {.ranks = &ranks});
        if (ranks.rank() == 0) world.attach(recorder);
        world.start();
        for (int step = 1; step <= 8; ++step) {
            world.step();
            sent[static_cast<std::size_t>(ranks.rank())].push_back(world.times().bytes);
        }
    });
    REQUIRE(all_are_silent(errors));
    using Parts = std::vector<std::pair<std::size_t, std::size_t>>;
    const auto parts = [&](std::size_t begin, std::size_t count) {
        const auto first = recorder.parts.begin() + static_cast<std::ptrdiff_t>(begin);
        return Parts(first, first + static_cast<std::ptrdiff_t>(count));
    };
    CHECK(parts(0, 3) == Parts{{4, 4}, {4, 4}, {4, 4}});  // step 0, as steps 3 and 6
    CHECK(parts(3, 2) == Parts{{12, 4}, {12, 4}});        // steps 1 and 2: the plants of this rank
    CHECK(parts(5, 3) == Parts{{4, 4}, {4, 4}, {4, 4}});
    CHECK(recorder.parts.size() == 3 * 3 + 6);
    CHECK(sent[1][5] > 100 * sent[1][4]);  // step 6 against step 5
    CHECK(sent[1][5] > 100 * sent[1][6]);
}

TEST_CASE_METHOD(Spread, "the first rank frees what it has recorded of the plants of others", "[simulation][ranks]") {
    class Recorded : public Recorder {
    public:
        bool reads_plants_at(int, bool) const override { return true; }
        void record(const Frame& frame) override {
            for (const PlantFrame& plant : frame.plants) modules += plant.string->size();
        }
        void finish() override {}

        std::size_t modules = 0;
    };
    const Scene described = scene(light);
    Recorded recorder;
    std::size_t modules = 0, held = 0, plants_held = 0;
    const auto errors = on_ranks(3, [&](Ranks& ranks) {
        World world(described, {.ranks = &ranks});
        if (ranks.rank() == 0) world.attach(recorder);
        world.start();
        for (int step = 1; step <= 6; ++step) {
            if (ranks.rank() == 0) recorder.modules = 0;
            world.step();
        }
        if (ranks.rank() != 0) return;
        modules = world.modules();
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            if (world.string(plant).empty())
                held += world.string(plant).bytes() + world.interpretation(plant).geometry.internodes.capacity();
            else
                ++plants_held;
        }
    });
    REQUIRE(all_are_silent(errors));
    CHECK(recorder.modules == modules);
    CHECK(plants_held == 4);
    CHECK(held == 0);
}

TEST_CASE_METHOD(Spread, "ranks write the pieces of large frames together, with the bytes of one process",
                 "[simulation][ranks]") {
    write("other.l", other);
    write("leaf.ppm", "P6 1 1 255\nabc");
    const std::string rest = GENERATE_COPY(
        light + in_pieces, light + in_pieces + "keyframes = [9]\n",
        others + light + in_pieces + "keyframes = [4, 9]\nparameters = { length = 'U.1' }\n",
        light + in_pieces + "every = 2\nfields = ['light']\n",
        "[[plant.stage]]\nstage = 'pipe-radii'\n[[plant.stage]]\nstage = 'leaves'\n" + (light + in_pieces),
        "[[plant.stage]]\nstage = 'leaves'\ntexture = 'leaf.ppm'\n" + (light + in_pieces),
        "[environment.light]\nprocess = 'canopy-light'\nvoxel = 2\nscattering = { rings = 1, around = 3 }\nsky = { par "
        "= 500, rings = 2 }\n" +
            in_pieces + "organs = ['light.absorbed']\n");
    INFO(rest);
    const Scene described = scene(rest);
    run_alone(described);
    REQUIRE(fs::exists(path() / "alone/plants/0009-6.vtp"));
    for (const std::size_t count : {2u, 3u, 5u}) {
        INFO(count << " ranks");
        const std::string folder = fmt::format("on-{}", count);
        REQUIRE(all_are_silent(run_on(count, described, folder)));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Spread, "pieces have what a process knows of organs, also of those that another rank holds",
                 "[simulation][ranks]") {
    const Scene described = scene("[environment.light]\nprocess = 'canopy-light'\nvoxel = 2\n" + in_pieces +
                                      "organs = ['light.absorbed']\nkeyframes = [6]\n",
                                  "steps = 6\n");
    run_alone(described);
    REQUIRE(fs::exists(path() / "alone/plants/0006-2.vtp"));
    REQUIRE(all_are_silent(run_on(3, described, "on-3")));
    CHECK(recorded_files(path() / "on-3") == recorded_files(path() / "alone"));
}

TEST_CASE_METHOD(Spread, "each rank gets only the pieces that it writes", "[simulation][ranks]") {
    class Listening final : public Ranks {
    public:
        explicit Listening(Ranks& ranks) : ranks_(ranks) {}

        int rank() const override { return ranks_.rank(); }
        int count() const override { return ranks_.count(); }
        std::string name() const override { return ranks_.name(); }
        std::vector<std::string> trade(std::vector<std::string> to_each) override {
            std::vector<std::string> received = ranks_.trade(std::move(to_each));
            std::size_t bytes = 0;
            for (std::size_t from = 0; from < received.size(); ++from) {
                if (static_cast<int>(from) != rank()) bytes += received[from].size();
            }
            most = std::max(most, bytes);
            sum += bytes;
            return received;
        }

        std::size_t most = 0, sum = 0;  ///< bytes that came at once, and in all

    private:
        Ranks& ranks_;
    };
    write("silent.l", "lsystem: 1\nderivation length: 9\naxiom: A\nA --> F[+A]A\nendlsystem\n");
    using Received = std::array<std::size_t, 3>;
    const auto received = [&](const std::string& folder, int points_per_file) {
        const Scene described = read_scene_text(
            "[[plant]]\nmodel = 'silent.l'\ngrid = { columns = 6, rows = 6, spacing = 2 }\n[timeline]\n"
            "statistics = false\nlifespans = false\nkeyframes = [9]\npoints_per_file = " +
                std::to_string(points_per_file),
            "scene.toml", path());
        Received most{}, sum{};
        const auto errors = on_ranks(3, [&](Ranks& ranks) {
            Listening listening(ranks);
            RunOptions options;
            options.output = path() / folder;
            options.ranks = &listening;
            run(described, options);
            most[static_cast<std::size_t>(ranks.rank())] = listening.most;
            sum[static_cast<std::size_t>(ranks.rank())] = listening.sum;
        });
        REQUIRE(all_are_silent(errors));
        return std::pair(most, sum);
    };
    // 1,022 points a plant.
    const auto [most_of_one, one_file] = received("one", 1 << 20);
    const auto [most, twelve_files] = received("twelve", 3 * 1022);
    REQUIRE(fs::exists(path() / "twelve/plants/0009-11.vtp"));
    REQUIRE_FALSE(fs::exists(path() / "twelve/plants/0009-12.vtp"));
    CHECK(one_file[0] > 20 * one_file[1]);
    CHECK(twelve_files[0] < one_file[0] / 2);
    CHECK(most[0] < most_of_one[0] / 2);
    for (const std::size_t rank : {1u, 2u}) CHECK(twelve_files[rank] > twelve_files[0] / 2);
}

TEST_CASE_METHOD(Spread, "a run whose frames are pieces goes on with another number of ranks", "[simulation][ranks]") {
    write("other.l", other);
    const Scene described = scene(others + light + in_pieces);
    run_alone(described);
    const auto fail_at_the_sixth_step = [](RunOptions& options, Ranks&) {
        options.checkpoint_every = 2;
        options.progress = [](const Progress& progress) {
            if (progress.step == 8) throw RunError("the machine is gone");
        };
    };
    for (const auto& [before, after] : {std::pair(3u, 2u), std::pair(2u, 1u), std::pair(1u, 4u)}) {
        INFO(before << " ranks, then " << after);
        const std::string folder = fmt::format("again-{}", before);
        for (const std::string& error : run_on(before, described, folder, fail_at_the_sixth_step)) {
            CHECK_THAT(error, Contains("the machine is gone"));
        }
        REQUIRE(fs::exists(path() / folder / "plants/0008-2.vtp"));
        const auto go_on = [](RunOptions& options, Ranks&) { options.resume = true; };
        REQUIRE(all_are_silent(run_on(after, described, folder, go_on)));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Spread, "a rank that cannot write its piece ends all, and no index names the frame",
                 "[simulation][ranks]") {
    const Scene described = scene(light + in_pieces + "keyframes = [3, 9]\n");
    fs::create_directories(path() / "full/plants/0009-4.vtp/in the way");
    const std::vector<std::string> errors = run_on(3, described, "full");
    CHECK_THAT(errors[0], Contains("rank 1: cannot write") && Contains("0009-4.vtp"));
    CHECK(errors[2] == errors[0]);
    CHECK_THAT(errors[1], Contains("cannot write") && Contains("0009-4.vtp"));
    const std::string index = text_of(path() / "full/plants.pvd");
    CHECK_THAT(index, Contains("plants/0003.vtp") && !Contains("plants/0009"));
    CHECK_THAT(text_of(path() / "full/run.json"), Contains("0009-4.vtp"));
}

TEST_CASE_METHOD(Spread, "what other ranks send must fit into the memory", "[simulation][ranks]") {
    write("doubling.l", doubling);
    const Scene described = read_scene_text(doubling_stand + std::string("statistics = false\n"), "scene.toml", path());
    const auto with = [](std::size_t bytes) {
        return [bytes](RunOptions& options, Ranks&) { options.memory = bytes; };
    };
    CHECK(all_are_silent(run_on(2, described, "enough", with(std::size_t{600} << 20))));
    for (const std::string& error : run_on(2, described, "little", with(std::size_t{160} << 20))) {
        CHECK_THAT(error, Contains("step 15: what other ranks send of their plants takes"));
    }
}

TEST_CASE_METHOD(Spread, "a rank needs memory for the plants of one file at a time", "[simulation][ranks]") {
    write("doubling.l", doubling);
    const auto errors = [&](const std::string& folder, const std::string& timeline) {
        const Scene described =
            read_scene_text(doubling_stand + std::string("statistics = false\n") + timeline, "scene.toml", path());
        return run_on(2, described, folder,
                      [](RunOptions& options, Ranks&) { options.memory = std::size_t{175} << 20; });
    };
    CHECK_THAT(errors("whole", "")[0], Contains("what other ranks send of their plants takes"));
    CHECK(errors("pieces", "points_per_file = 200000\n") == std::vector<std::string>(2));
}

TEST_CASE_METHOD(Spread, "a run goes on from its checkpoint with another number of ranks", "[simulation][ranks]") {
    const Scene described = scene(light);
    run_alone(described);
    const auto fail_at_the_sixth_step = [](RunOptions& options, Ranks&) {
        options.checkpoint_every = 2;
        options.progress = [](const Progress& progress) {
            if (progress.step == 5) throw RunError("the machine is gone");
        };
    };
    const std::vector<std::string> errors = run_on(3, described, "again", fail_at_the_sixth_step);
    for (const std::string& error : errors) CHECK_THAT(error, Contains("the machine is gone"));
    REQUIRE(all_are_silent(run_on(2, described, "again", [](RunOptions& options, Ranks&) { options.resume = true; })));
    check_same("again");
}

TEST_CASE_METHOD(Spread, "plants move to ranks that have less to do, and no byte changes", "[simulation][ranks]") {
    // The plants in the last row become a hundred times as large as the others.
    write("large.l", "lsystem: 1\nderivation length: 9\naxiom: A\nA --> F[+A][-A]A\nendlsystem\n");
    write("small.l", "lsystem: 1\nderivation length: 9\naxiom: A\nA --> FA\nendlsystem\n");
    const std::string plants =
        "[[plant]]\nmodel = 'small.l'\ngrid = { columns = 4, rows = 3, spacing = 2 }\n"
        "[[plant]]\nmodel = 'large.l'\ngrid = { columns = 4, rows = 1, spacing = 2 }\nposition = [0, 0, 9]\n";
    const Scene described = read_scene_text(plants, "scene.toml", path());
    run_alone(described);
    REQUIRE(all_are_silent(
        run_on(2, described, "moved", [](RunOptions& options, Ranks&) { options.checkpoint_every = 1; })));
    check_same("moved");

    std::array<std::size_t, 2> modules{};
    const std::vector<std::string> errors = on_ranks(2, [&](Ranks& ranks) {
        World world(described, {.ranks = &ranks});
        world.start();
        for (int step = 0; step < 9; ++step) {
            world.step();
            WorldCheckpoint(world).prepare(path());
        }
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            modules[static_cast<std::size_t>(ranks.rank())] += world.string(plant).size();
        }
    });
    for (const std::string& error : errors) CHECK(error == "");
    // All four large plants began on one rank. How many move depends on measured times, but each rank gets one.
    CHECK(std::min(modules[0], modules[1]) > (modules[0] + modules[1]) / 5);
}

TEST_CASE_METHOD(Spread, "what fails on one rank ends all with its message", "[simulation][ranks]") {
    write("falling.l", "lsystem: 1\nderivation length: 9\naxiom: A(4)\nA(x) --> F(1/x)A(x-1)\nendlsystem\n");
    const Scene described = read_scene_text(
        "[[plant]]\nmodel = 'plant.l'\nposition = [9, 0, 0]\n[[plant]]\nmodel = 'falling.l'\nname = 'weak'\n" +
            std::string(light),
        "scene.toml", path());
    const std::vector<std::string> errors = run_on(2, described, "failed");
    for (const std::string& error : errors) CHECK_THAT(error, Contains("weak"));
    CHECK_FALSE(recorded_files(path() / "failed").empty());  // the frames before are kept
}

TEST_CASE_METHOD(Spread, "a process that says nothing of ranks is refused by all", "[simulation][ranks]") {
    const Scene described = scene("[environment.light]\nprocess = 'external'\ncommand = ['cat']\n");
    for (const std::string& error : run_on(2, described, "refused"))
        CHECK_THAT(error, Contains("cannot be spread over ranks"));
}

TEST_CASE_METHOD(Spread, "ranks without a block are refused by all", "[simulation][ranks]") {
    for (const std::string& error : run_on(3, scene(light, "blocks = [2, 1]\n"), "refused")) {
        CHECK_THAT(error, Contains("there are 3 ranks but only 2 blocks with plants"));
    }
}

TEST_CASE_METHOD(Spread, "ranks hold blocks that follow each other, of about the same weight", "[simulation][ranks]") {
    const auto blocks_and_ranks = GENERATE(std::pair(7, 2), std::pair(40, 3), std::pair(40, 39), std::pair(64, 8));
    const auto [count, ranks] = blocks_and_ranks;
    for (const int heavy : {1, 5, 30}) {
        std::vector<std::size_t> blocks(static_cast<std::size_t>(count));
        std::iota(blocks.begin(), blocks.end(), 0);
        std::vector<double> weights(blocks.size(), 1);
        weights[2] = heavy;
        const std::vector<int> rank = ranks_of(blocks, weights, ranks);
        INFO(count << " blocks, " << ranks << " ranks, one of weight " << heavy);
        CHECK(std::is_sorted(rank.begin(), rank.end()));
        CHECK(std::set<int>(rank.begin(), rank.end()).size() == static_cast<std::size_t>(ranks));
        std::map<int, double> held;
        for (std::size_t i = 0; i < rank.size(); ++i) held[rank[i]] += weights[i];
        const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / ranks;
        for (const auto& one : held) CHECK(one.second <= mean + heavy + 1);
    }
}

// One command line that is right after every end of a run: --continue.
#include "catch.h"
#include "program.h"
#include "recorded_files.h"

#include <nlohmann/json.hpp>

#include <filesystem>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

// Writes a file of its own, too, by adding to it: what an earlier try left would show.
const char* const growing =
    "environment light;\nlsystem: 1\nseed: 2\nderivation length: 40\nstart: { f = fopen(\"log.txt\", \"a\"); }\n"
    "endeach: { fprintf(f, \"a step\\n\"); }\naxiom: A(1)\n"
    "A(x) --> F(x)[+A(x*0.9)?light(1)] : 1\nA(x) --> F(x)A(x*0.99) : 2\nF(x) : x < 4 --> F(x*1.01)\nendlsystem\n";

const char* const lit =
    "[[plant]]\nmodel = \"growing.l\"\npositions = [[0, 0, 0], [1, 0, 0]]\n"
    "[environment.light]\nprocess = \"voxel-shade\"\n[timeline]\nfields = [\"light\"]\n";

const std::string line = "run lit.toml --output out --continue ";

class Continued : public Workplace {
public:
    Continued() {
        write("growing.l", growing);
        write("lit.toml", lit);
        REQUIRE(run("run lit.toml --quiet --output whole").code == 0);
    }

    void check_whole() const {
        const auto expected = recorded_files(path() / "whole"), found = recorded_files(path() / "out");
        CHECK(found.size() == expected.size());
        for (const auto& [name, bytes] : expected) {
            INFO(name);
            REQUIRE(found.contains(name));
            CHECK((found.at(name) == bytes));
        }
    }
    json record() const { return json::parse(text_of(path() / "out/run.json")); }
    void tell_record(const std::string& key, const json& value) const {
        json changed = record();
        changed[key] = value;
        write("out/run.json", changed.dump());
    }
    /// Leaves a run that was killed when it had a checkpoint.
    void leave_checkpoint() const {
        run_until(
            {"run", "lit.toml", "--quiet", "--output", "out", "--checkpoint-every", "3"},
            [&] { return fs::exists(path() / "out/checkpoint"); }, [](pid_t process) { kill(process, SIGKILL); });
        REQUIRE(fs::exists(path() / "out/checkpoint"));
    }
};

}  // namespace

TEST_CASE_METHOD(Continued, "a run that is killed at any moment ends by the same line, with the same bytes", "[app]") {
    for (int wait = 0; wait < 12; ++wait) {
        run_until(
            {"run", "lit.toml", "--quiet", "--output", "out", "--continue", "--checkpoint-every", "4"},
            [] { return true; },
            [&](pid_t process) {
                usleep(static_cast<unsigned>(2'000 + 7'000 * wait));
                kill(process, SIGKILL);
            });
    }
    CHECK(run(line + "--quiet --threads 1").code == 0);
    check_whole();
    CHECK_FALSE(fs::exists(path() / "out/checkpoint"));
    const Outcome again = run(line);
    CHECK(again.code == 0);
    CHECK_THAT(again.out, Contains("out: complete, 40 of 40 steps"));
    CHECK(json::parse(run(line + "--json").out)["exit"] == "done");
    CHECK(run(line + "--quiet").out == "");
    check_whole();
}

TEST_CASE_METHOD(Continued, "a run goes on from its checkpoint, and one that has none begins", "[app]") {
    leave_checkpoint();
    const Outcome resumed = run(line);
    CHECK(resumed.code == 0);
    CHECK_THAT(resumed.err, Contains("out: continued from the checkpoint of step "));
    check_whole();

    tell_record("exit", "running");  // killed before its first checkpoint
    const Outcome begun = run(line);
    CHECK(begun.code == 0);
    CHECK_THAT(begun.err, Contains("out: begun again: the run here ended before its first checkpoint"));
    check_whole();

    fs::remove(path() / "out/run.json");
    CHECK(run(line + "--quiet").code == 0);
    CHECK(text_of(path() / "out/statistics.csv") == text_of(path() / "whole/statistics.csv"));
}

TEST_CASE_METHOD(Continued, "another run in the folder is refused, or replaced if the user says so", "[app]") {
    REQUIRE(run(line + "--quiet --steps 3").code == 0);
    const Outcome longer = run(line);
    CHECK(longer.code == 1);
    CHECK_THAT(longer.err, Contains("out holds another run: it was started as `espalier run lit.toml --steps 3`") &&
                               Contains("--overwrite"));
    CHECK(record()["steps_done"] == 3);
    CHECK(run(line + "--quiet --overwrite").code == 0);
    check_whole();

    write("lit.toml", std::string(lit) + "\n");
    CHECK_THAT(run(line).err, Contains("lit.toml has changed since it began"));
    CHECK(run(line + "--overwrite --quiet").code == 0);
    fs::create_directory(path() / "elsewhere");
    for (const char* file : {"lit.toml", "growing.l"}) fs::copy_file(path() / file, path() / "elsewhere" / file);
    CHECK_THAT(run("run lit.toml --output ../out --continue", "cd elsewhere;").err, Contains("it was started in "));
    write("out/run.json", "{");
    CHECK(run(line).code == 1);
    CHECK(text_of(path() / "out/run.json") == "{");
    CHECK_THAT(run("run lit.toml --continue").err, Contains("--continue requires --output"));
}

TEST_CASE_METHOD(Continued, "only a run that ended by itself has the file that says so, and it is the last", "[app]") {
    CHECK(text_of(path() / "whole/complete") == "plants.pvd\nfields.pvd\nlifespans.vtp\nstatistics.csv\n");
    leave_checkpoint();
    CHECK_FALSE(fs::exists(path() / "out/complete"));
    CHECK(run(line + "--quiet").code == 0);
    for (const auto& file : fs::recursive_directory_iterator(path() / "out")) {
        INFO(file.path());
        if (file.is_regular_file()) CHECK(file.last_write_time() <= fs::last_write_time(path() / "out/complete"));
    }
    // make compares its time, Snakemake removes it before it starts the line again.
    fs::last_write_time(path() / "out/complete", fs::file_time_type::clock::now() - std::chrono::hours(24));
    fs::last_write_time(path() / "lit.toml", fs::file_time_type::clock::now() - std::chrono::hours(1));
    CHECK(run(line + "--quiet").code == 0);
    CHECK(fs::last_write_time(path() / "out/complete") > fs::last_write_time(path() / "lit.toml"));
    fs::remove(path() / "out/complete");
    CHECK(run(line + "--quiet").code == 0);
    check_whole();
    // A run that is replaced is not complete any more, whatever becomes of the other.
    REQUIRE(run("run lit.toml --quiet --output out --overwrite --disk 1K --checkpoint-every 2").code == 2);
    CHECK_FALSE(fs::exists(path() / "out/complete"));
}

TEST_CASE_METHOD(Continued, "a table that was removed comes back when the run goes on", "[app]") {
    for (const std::string way : {"run lit.toml --output out --continue --quiet", "resume out --quiet"}) {
        CAPTURE(way);
        fs::remove_all(path() / "out");
        leave_checkpoint();
        fs::remove(path() / "out/statistics.csv");
        fs::remove(path() / "out/timings.csv");
        CHECK(run(way).code == 0);
        check_whole();
        CHECK_FALSE(fs::exists(path() / "out/.statistics.csv.kept"));
    }
    // Of a complete run, it can only be made again.
    fs::remove(path() / "out/statistics.csv");
    const Outcome again = run(line);
    CHECK(again.code == 0);
    CHECK_THAT(again.err, Contains("begun again: out/statistics.csv is gone"));
    check_whole();
}

// A folder where a file is to be removed stands for a kill in between.
TEST_CASE_METHOD(Continued, "a run that was replaced in part never looks complete, and leaves no files of models",
                 "[app]") {
    REQUIRE(run(line + "--quiet").code == 0);
    write("out/files/0/log.txt", text_of(path() / "out/files/0/log.txt") + "of the run before\n");
    fs::remove(path() / "out/lifespans.vtp");
    fs::create_directories(path() / "out/lifespans.vtp/mine");
    const Outcome outcome = run("run lit.toml --quiet --output out --overwrite");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("cannot remove the old timeline in out"));
    CHECK_FALSE(fs::exists(path() / "out/complete"));
    CHECK(record()["exit"] != "done");
    fs::remove_all(path() / "out/lifespans.vtp");
    CHECK(run(line + "--quiet").code == 0);
    check_whole();
}

TEST_CASE_METHOD(Continued, "resume says of a complete run that it is, and keeps what was asked of others", "[app]") {
    const Outcome whole = run("resume whole");
    CHECK(whole.code == 0);
    CHECK_THAT(whole.out, Contains("whole: complete, 40 of 40 steps; there is nothing left to do"));
    REQUIRE(run("run lit.toml --quiet --output out --disk 1K --memory 900M --timeout 77 --checkpoint-every 2").code ==
            2);
    const Outcome as_before = run("resume out --quiet");
    CHECK(as_before.code == 2);
    CHECK_THAT(as_before.err, Contains("--disk allows 1 KiB"));
    CHECK(record()["memory"] == 900 << 20);
    CHECK(record()["asked"] == json{{"memory", 900 << 20}, {"disk", 1024}, {"timeout", 77}});
    CHECK(run("resume out --quiet --disk 1G --memory 800M").code == 0);
    CHECK(record()["memory"] == 800 << 20);
    check_whole();
}

TEST_CASE_METHOD(Continued, "info knows how far a killed run came, and from where it goes on", "[app]") {
    leave_checkpoint();
    const std::string timings = text_of(path() / "out/timings.csv");
    const auto rows = std::count(timings.begin(), timings.end(), '\n') - 1;
    const json info = json::parse(run("info out --json").out);
    CHECK(info["exit"] == "killed");
    CHECK(info["steps_done"] == rows - 1);
    CHECK(info["seconds"].is_null());  // nobody noted them
    CHECK(info["checkpoint"].get<int>() % 3 == 0);
    CHECK(info["checkpoint"] <= info["steps_done"]);
    CHECK_THAT(run("info out").out, Contains("ended: killed; " + std::to_string(rows - 1) + " of 40 steps on ") &&
                                        Contains("checkpoint: of step ") && Contains("`espalier resume out`"));
}

TEST_CASE_METHOD(Workplace, "a run that another process writes is not taken over", "[app]") {
    write("patient.l", models::patient);
    run_until(
        {"run", "patient.l", "--quiet", "--output", "out"}, [&] { return fs::exists(path() / "out/plants/0002.vtp"); },
        [&](pid_t process) {
            const Outcome other = run("run patient.l --quiet --output out --continue");
            CHECK(other.code == 1);
            CHECK_THAT(other.err, Contains("another run is writing into out"));
            kill(process, SIGKILL);
        });
}

// Signals to whole process groups, and what becomes of runs whose starter is gone.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// A place with a model that would go on for hours.
class Patience : public Workplace {
public:
    Patience() { write("patient.l", models::patient); }

    bool has_frames(const std::string& folder) const {
        return fs::exists(path() / folder / "plants" / "0002.vtp") && fs::exists(path() / folder / "run.json");
    }
    std::string exit_of(const std::string& folder) const {
        return json::parse(text_of(path() / folder / "run.json"))["exit"];
    }

    /// Processes that work in this place.
    std::vector<pid_t> processes() const {
        std::vector<pid_t> found;
        for (const auto& entry : fs::directory_iterator("/proc")) {
            std::error_code gone;
            const fs::path folder = fs::read_symlink(entry.path() / "cwd", gone);
            const std::string name = entry.path().filename().string();
            if (!gone && folder == path() && std::all_of(name.begin(), name.end(), ::isdigit)) {
                found.push_back(std::stoi(name));
            }
        }
        return found;
    }
    bool all_have_ended() const {
        for (int i = 0; i < 1000 && !processes().empty(); ++i) usleep(10'000);
        return processes().empty();
    }
};

const std::vector<std::string> sweep{"sweep",  "patient.l", "--vary",  "simulation.seed=1..3",
                                     "--jobs", "2",         "--quiet", "--threads",
                                     "1",      "--output",  "s"};

}  // namespace

TEST_CASE_METHOD(Patience, "Ctrl-C to the process group of a sweep ends all its runs after their step", "[app]") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
        fs::remove_all(path() / "s");
        const Outcome outcome = run_until(
            sweep, [&] { return has_frames("s/seed=1") && has_frames("s/seed=2"); },
            [&](pid_t process) { kill(-process, signal); }, Group::own);
        CHECK(outcome.code == 130);
        CHECK(all_have_ended());
        for (const std::string folder : {"s/seed=1", "s/seed=2"}) {
            CHECK(exit_of(folder) == "interrupted");
            CHECK(fs::exists(path() / folder / "checkpoint"));
        }
        CHECK_FALSE(fs::exists(path() / "s/seed=3"));
    }
}

TEST_CASE_METHOD(Patience, "a terminal that is closed ends a run after its step", "[app]") {
    const Outcome outcome = run_until(
        {"run", "patient.l", "--output", "out"}, [&] { return has_frames("out"); },
        [&](pid_t process) {
            kill(-process, SIGHUP);  // the system's, and the shell's
            kill(-process, SIGHUP);
        },
        Group::own);
    CHECK(outcome.code == 130);
    CHECK(exit_of("out") == "interrupted");
    CHECK(fs::exists(path() / "out/checkpoint"));
}

TEST_CASE_METHOD(Patience, "the signals of batch systems end a run after its step, however often they come", "[app]") {
    const std::pair<int, std::string> signals[] = {
        {SIGXCPU, "SIGXCPU"}, {SIGUSR1, "SIGUSR1"}, {SIGUSR2, "SIGUSR2"}, {SIGTERM, "SIGTERM"}};
    for (const auto& [signal, name] : signals) {
        INFO(name);
        fs::remove_all(path() / "out");
        const int times = signal == SIGTERM ? 1 : 3;
        const Outcome outcome = run_until(
            {"run", "patient.l", "--output", "out"}, [&] { return has_frames("out"); },
            [&](pid_t process) {
                for (int i = 0; i < times; ++i) kill(process, signal);
            });
        CHECK(outcome.code == 130);
        CHECK(exit_of("out") == "interrupted");
        CHECK(fs::exists(path() / "out/checkpoint"));
        CHECK_THAT(outcome.err, Contains(name + ": finishing this step"));
        CHECK_THAT(outcome.err, Contains("`espalier resume out` continues it"));
    }
}

TEST_CASE_METHOD(Patience, "a signal that the starter of a run had made ignored stays ignored", "[app]") {
    run("run patient.l --quiet --steps 400 --output out & run=$!; sleep 0.2; kill -USR1 $run; kill -USR2 $run; wait "
        "$run",
        "trap '' USR1 USR2;");
    CHECK(exit_of("out") == "done");
}

TEST_CASE_METHOD(Patience, "nohup keeps a run going", "[app]") {
    run("run patient.l --quiet --steps 400 --output out & run=$!; sleep 0.2; kill -HUP $run; wait $run",
        "trap '' HUP;");
    CHECK(exit_of("out") == "done");
}

TEST_CASE_METHOD(Patience, "the runs of a sweep that is killed end with it, and it can begin anew at once", "[app]") {
    const Outcome killed = run_until(
        sweep, [&] { return has_frames("s/seed=1") && has_frames("s/seed=2"); },
        [&](pid_t process) { kill(process, SIGKILL); }, Group::own);
    CHECK(killed.code == -SIGKILL);
    CHECK(all_have_ended());
    CHECK(exit_of("s/seed=1") == "running");
    CHECK(run("sweep patient.l --vary simulation.seed=1,2 --steps 3 --quiet --output s").code == 0);
}

TEST_CASE_METHOD(Patience, "a rerun that is killed or interrupted takes its run with it", "[app]") {
    REQUIRE(run("run patient.l --quiet --steps 2000 --output first").code == 0);
    for (const int signal : {SIGKILL, SIGINT}) {
        fs::remove_all(path() / "second");
        const auto begun = [&] { return fs::exists(path() / "second/plants/0001.vtp"); };
        const Outcome outcome = run_until(
            {"rerun", "first", "--quiet", "--output", "second"}, begun,
            [&](pid_t process) { kill(signal == SIGKILL ? process : -process, signal); }, Group::own);
        CHECK(outcome.code == (signal == SIGKILL ? -SIGKILL : 130));
        CHECK(all_have_ended());
        // Its lock is free.
        CHECK(run("run patient.l --quiet --steps 1 --overwrite --output second").code == 0);
    }
}

// A process that never answers ends a run with its name, and a slow step of many quick answers does not.
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "temporary_folder.h"

#include <atomic>
#include <chrono>
#include <thread>

using namespace espalier;
using Catch::Contains;

namespace {

std::atomic<bool> answers{true};

/// Answers after a while, or as soon as it may.
class Waiting final : public EnvironmentProcess {
public:
    Waiting(Settings& settings, const EnvironmentContext&, Fields&) : seconds_(settings.number_or("seconds", 0)) {}

    void answer(const WorldView&, Queries, std::span<Answer>, Fields&) override {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds_));
        while (!answers) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::pair<int, int> query_arity() const override { return {1, 1}; }

private:
    double seconds_;
};

const Registered<ProcessType> waiting{{"test-waiting", "lets one wait", "seconds (0)", construct<Waiting>}};

struct Watched {
    TemporaryFolder folder;
    std::string why;

    RunResult run(const std::string& seconds, int steps, double patience) {
        folder.write("plant.l", "environment light;\nlsystem: 1\nderivation length: 1\naxiom: ?light(1)\nendlsystem\n");
        const Scene scene = read_scene_text(
            "[[plant]]\nmodel = 'plant.l'\n[environment.light]\nprocess = 'test-waiting'\nseconds = " + seconds + "\n",
            "scene.toml", folder.path(), {{}, steps, {}});
        RunOptions options;
        options.output = folder.path() / "out";
        options.patience = patience;
        options.expired = [this](const std::string& message) {
            why = message;
            answers = true;
        };
        return espalier::run(scene, options);
    }
};

}  // namespace

TEST_CASE("a run that waits for an answer for too long says for which", "[simulation]") {
    answers = false;
    Watched watched;
    watched.run("0", 1, 0.05);
    CHECK_THAT(watched.why, Contains("process 'light' has not answered") && Contains("for 0.05 s"));
}

TEST_CASE("many quick answers are not one that takes long", "[simulation]") {
    Watched watched;
    CHECK(watched.run("0.04", 10, 0.3).steps == 10);
    CHECK(watched.why.empty());
}

// A slider of the studio is moved: from the request until the packet of the new picture is sent, beside deriving and
// interpreting the same model alone; for a slider of looks, too, which grows nothing. Then the same for a text that was
// edited, beside reading the model as well.
#include "espalier/simulation/world.h"

#include "growing.h"
#include "studio/listening_page.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <string>

namespace espalier::bench {
namespace {

using studio_test::Json;

/// Ten thousand organs: 8,191 internodes and 2,048 leaves.
const std::string tree = R"(#define LENGTH 1
#define ANGLE 30
lsystem: 1
derivation length: 13
axiom: A(1)
A(n) : n < 12 --> F(LENGTH / n) [ +(ANGLE) /(90) A(n+1) ] [ -(ANGLE) /(90) A(n+1) ]
A(n) : n == 12 --> F(LENGTH / n) @c(0.1) [ +(ANGLE) A(n+1) ] [ -(ANGLE) A(n+1) ]
A(n) --> F(LENGTH / n)
endlsystem
)";

std::string with_length(int number) {
    std::string text = tree;
    return text.replace(text.find("LENGTH 1") + 7, 1, fmt::format("{}", 1 + 0.001 * number));
}

using Clock = std::chrono::steady_clock;

/// Notes when it was sent what one waits for.
class Screen final : public studio::Page {
public:
    void send_text(std::string text) override {
        if (text.find(R"("state":"done")") != std::string::npos) has_grown_ = true;
    }
    void send_bytes(std::string) override { sent_ = Clock::now(); }
    bool is_behind() const override { return false; }

    bool has_grown() const { return has_grown_; }
    /// When the last packet was sent; none: not since forget().
    std::optional<Clock::time_point> sent() const { return sent_; }
    void forget() { sent_.reset(); }

private:
    bool has_grown_ = false;
    std::optional<Clock::time_point> sent_;
};

/// A studio with one page, which waits for each change.
class Changes {
public:
    explicit Changes(benchmark::State& state) : state_(state) {
        options_.folder = folder_.path();
        options_.scratch = scratch_.path();
        options_.read = studio_test::read_as_run;
        options_.opened.path = file_ = folder_.write("tree.l", tree);
        session_ = std::make_unique<studio::Session>(
            options_, [this](std::function<void()> work) { mailbox_.post(std::move(work)); });
        session_->join(screen_);
        ask({{"do", "hello"}, {"id", 1}});
        while (!screen_.has_grown()) work();
    }

    void slide(const char* name, double value) { change("settings", {{name, fmt::format("{}", value)}}); }
    void type(int number) { change("texts", {{file_.string(), with_length(number)}}); }

private:
    void change(const char* what, const Json& values) {
        screen_.forget();
        const auto begin = Clock::now();
        ask({{"do", "change"}, {"id", 1}, {"transient", true}, {what, values}});
        while (!screen_.sent()) work();
        state_.SetIterationTime(std::chrono::duration<double>(*screen_.sent() - begin).count());
    }
    void ask(const Json& request) { session_->receive(screen_, request.dump()); }
    void work() { mailbox_.work_once(std::chrono::seconds(10)); }

    benchmark::State& state_;
    TemporaryFolder folder_, scratch_;
    std::filesystem::path file_;
    StudioOptions options_;
    studio_test::Mailbox mailbox_;
    Screen screen_;
    std::unique_ptr<studio::Session> session_;
};

void studio_slider(benchmark::State& state) {
    Changes changes(state);
    int number = 0;
    for (auto _ : state) changes.slide("LENGTH", 1 + 0.001 * ++number);
}
BENCHMARK(studio_slider)->UseManualTime();

void studio_slider_of_looks(benchmark::State& state) {
    Changes changes(state);
    int number = 0;
    for (auto _ : state) changes.slide("ANGLE", 30 + 0.001 * ++number);
}
BENCHMARK(studio_slider_of_looks)->UseManualTime();

void studio_text(benchmark::State& state) {
    Changes changes(state);
    int number = 0;
    for (auto _ : state) changes.type(++number);
}
BENCHMARK(studio_text)->UseManualTime();

void grow_to_end(const Scene& scene) {
    World world(scene);
    world.start();
    while (!world.at_end()) world.step();
    benchmark::DoNotOptimize(world.modules());
}

void studio_model_alone(benchmark::State& state) {
    Scene scene;
    scene.plants.push_back(plant_of_text(tree));
    for (auto _ : state) grow_to_end(scene);
}
BENCHMARK(studio_model_alone)->UseRealTime();

void studio_text_alone(benchmark::State& state) {
    int number = 0;
    for (auto _ : state) {
        Scene scene;
        scene.plants.push_back(plant_of_text(with_length(++number)));
        grow_to_end(scene);
    }
}
BENCHMARK(studio_text_alone)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;

const Row slider{"studio: slider moved to packet sent, 10,000 organs, against the model alone",
                 "studio_slider/manual_time",
                 "studio_model_alone/real_time",
                 Measure::time,
                 Goal::at_most,
                 1.5};
const Row looks{"studio: slider of an angle moved to packet sent, 10,000 organs, against the model alone",
                "studio_slider_of_looks/manual_time",
                "studio_model_alone/real_time",
                Measure::time,
                Goal::at_most,
                1.2};
const Row text{"studio: text edited to packet sent, 10,000 organs, against reading and growing alone",
               "studio_text/manual_time",
               "studio_text_alone/real_time",
               Measure::time,
               Goal::at_most,
               1.5};

}  // namespace
}  // namespace espalier::bench

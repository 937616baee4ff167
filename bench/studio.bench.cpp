// A slider of the studio is moved: from the request to the packet of the new picture, beside deriving and interpreting
// the same model alone; for a slider of looks, too, which grows nothing. Then the same for a text that was edited,
// beside reading the model as well.
#include "espalier/simulation/world.h"

#include "growing.h"
#include "studio/listening_page.h"
#include "temporary_folder.h"

#include <fmt/format.h>

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

/// A studio with one page, until each change has grown.
class Changes {
public:
    Changes() {
        options_.folder = folder_.path();
        options_.scratch = scratch_.path();
        options_.read = studio_test::read_as_run;
        options_.opened.path = file_ = folder_.write("tree.l", tree);
        session_ = std::make_unique<studio::Session>(
            options_, [this](std::function<void()> work) { mailbox_.post(std::move(work)); });
        session_->join(page_);
        ask({{"do", "hello"}, {"id", 1}});
        wait();
    }

    void slide(const char* name, double value) {
        ask({{"do", "change"}, {"id", 1}, {"transient", true}, {"settings", {{name, fmt::format("{}", value)}}}});
        wait();
    }
    void type(int number) {
        ask({{"do", "change"}, {"id", 1}, {"transient", true}, {"texts", {{file_.string(), with_length(number)}}}});
        wait();
    }

private:
    void ask(const Json& request) {
        page_.texts.clear();
        page_.packets.clear();
        session_->receive(page_, request.dump());
    }
    void wait() {
        while (page_.packets.empty()) mailbox_.work_once(std::chrono::seconds(10));
    }

    TemporaryFolder folder_, scratch_;
    std::filesystem::path file_;
    StudioOptions options_;
    studio_test::Mailbox mailbox_;
    studio_test::ListeningPage page_;
    std::unique_ptr<studio::Session> session_;
};

void studio_slider(benchmark::State& state) {
    Changes changes;
    int number = 0;
    for (auto _ : state) changes.slide("LENGTH", 1 + 0.001 * ++number);
}
BENCHMARK(studio_slider)->UseRealTime();

void studio_slider_of_looks(benchmark::State& state) {
    Changes changes;
    int number = 0;
    for (auto _ : state) changes.slide("ANGLE", 30 + 0.001 * ++number);
}
BENCHMARK(studio_slider_of_looks)->UseRealTime();

void studio_text(benchmark::State& state) {
    Changes changes;
    int number = 0;
    for (auto _ : state) changes.type(++number);
}
BENCHMARK(studio_text)->UseRealTime();

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
                 "studio_slider/real_time",
                 "studio_model_alone/real_time",
                 Measure::time,
                 Goal::at_most,
                 1.5};
const Row looks{"studio: slider of an angle moved to packet sent, 10,000 organs, against the model alone",
                "studio_slider_of_looks/real_time",
                "studio_model_alone/real_time",
                Measure::time,
                Goal::at_most,
                1.2};
const Row text{"studio: text edited to packet sent, 10,000 organs, against reading and growing alone",
               "studio_text/real_time",
               "studio_text_alone/real_time",
               Measure::time,
               Goal::at_most,
               1.5};

}  // namespace
}  // namespace espalier::bench

// The exchange and the fields behind it: a question's round trip, shade rebuilt and changed, water diffusing.
#include "environment/exchange/exchange_plants.h"
#include "environment/light/shade/field.h"
#include "environment/soil/linear/soil.h"
#include "table.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstring>
#include <vector>

namespace espalier::bench {
namespace {

/// Answers what it was asked.
class Echo : public EnvironmentProcess {
public:
    Echo(Settings&, const EnvironmentContext&, Fields&) {}
    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i][0] = queries[i].parameters[0];
    }
    std::vector<Quantity> statistics(std::uint32_t) const override { return {}; }
    std::pair<int, int> query_arity() const override { return {1, 1}; }
};
const Registered<ProcessType> echo{{"bench-echo", "answers what it was asked", "", construct<Echo>}};

constexpr int edge = 256;

/// Questions all over a box of this many voxels.
std::vector<Asked> crown(int count, double strength) {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(samples.uniform(), samples.uniform(), samples.uniform());
        questions.push_back({place * double(edge - 1), {strength}});
    }
    return questions;
}

void echo_round_trip(benchmark::State& state) {
    constexpr int count = 100'000;
    Environment environment = environment_of("[light]\nprocess = \"bench-echo\"");
    AskingPlants plants;
    plants.add(crown(count, 1));
    double seconds = 0;
    for (auto _ : state) {
        const auto begin = std::chrono::steady_clock::now();
        plants.exchange(environment);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    state.counters["value"] = seconds / double(state.iterations()) / count * 1e9;
}
BENCHMARK(echo_round_trip)->UseRealTime();

/// 100,000 questions to a process of their own: the exchange around it is what the echo measures.
class ShadedCrown {
public:
    ShadedCrown() {
        Settings settings = Settings::parse_toml(R"(process = "voxel-shade"
voxel = 1
strength = 1
dissipation = 1.5
depth = 8
)",
                                                 "scene.toml");
        EnvironmentContext context;
        context.name = "light";
        process_ = registered<ProcessType>().at("voxel-shade")->make(settings, context, fields_);
        parameters_.resize(count);
        answers_.resize(count);
        for (const Asked& asked : crown(count, 1)) {
            Query query;
            query.parameters = {&parameters_[queries_.size()], 1};
            query.pose.position = asked.position;
            queries_.push_back(query);
        }
    }

    void ask_with(double strength) { std::fill(parameters_.begin(), parameters_.end(), strength); }
    void advance() {
        process_->advance({}, queries_, fields_);
        benchmark::DoNotOptimize(fields_.need("light").grid.get());
    }
    void answer() {
        for (std::size_t i = 0; i < count; ++i) answer_spans_[i] = {&answers_[i], 1};
        process_->answer({}, queries_, answer_spans_, fields_);
        benchmark::DoNotOptimize(answers_.data());
    }

    static constexpr std::size_t count = 100'000;

private:
    Fields fields_;
    std::unique_ptr<EnvironmentProcess> process_;
    std::vector<double> parameters_, answers_;
    std::vector<Query> queries_;
    std::vector<Answer> answer_spans_ = std::vector<Answer>(count);
};

/// From the questions to the published grid of light, in a step in which every caster differs from the step before.
void shade_of_a_crown(benchmark::State& state) {
    ShadedCrown shaded;
    double strength = 1;
    const auto ask = [&] { shaded.ask_with(strength = 1.9 - strength); };
    for (int i = 0; i < 2; ++i) {  // the first steps take fresh memory, the others have it
        ask();
        shaded.advance();
    }
    for (auto _ : state) {
        state.PauseTiming();
        ask();
        state.ResumeTiming();
        shaded.advance();
    }
}
BENCHMARK(shade_of_a_crown)->UseRealTime();

/// Each between the eight voxels around it, all over 134 MB of sums; nanoseconds for one of them.
void answers_from_the_shade(benchmark::State& state) {
    ShadedCrown shaded;
    shaded.ask_with(1);
    shaded.advance();
    double best = 1e9;
    for (auto _ : state) {
        const auto begin = std::chrono::steady_clock::now();
        shaded.answer();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    state.counters["value"] = best / double(ShadedCrown::count) * 1e9;
}
BENCHMARK(answers_from_the_shade)->UseRealTime();

void copy_of_a_float_field(benchmark::State& state) {
    const std::vector<float> from(std::size_t(edge) * edge * edge, 1.0f);
    std::vector<float> to(from.size());
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), from.size() * sizeof(float));
        benchmark::DoNotOptimize(to.data());
    }
}
BENCHMARK(copy_of_a_float_field)->UseRealTime();

/// Casters of a crown move, one after the other and far apart, each followed at once: microseconds for one of them.
void one_changed_organ(benchmark::State& state) {
    ShadeRule rule;
    rule.depth = 8;
    ShadeCasts casts(rule, {glm::ivec3(-1000), glm::ivec3(1000)});
    ShadeField field(std::size_t(1) << 32);
    casts.begin_step();
    for (const Asked& asked : crown(100'000, 1)) casts.add(glm::ivec3(asked.position), 1);
    field.show(casts);
    constexpr std::size_t moves = 1000;
    std::vector<ShadeChanges> there(moves), back(moves);
    for (std::size_t i = 0; i < moves; ++i) {
        ShadeCast cast = casts.casts()[i * 97];
        back[i].come = there[i].gone = {cast};
        cast.apex[static_cast<int>(i % 3)] += 1;  // sideways, upwards, sideways
        there[i].come = back[i].gone = {cast};
    }
    double best = 1e9;
    for (auto _ : state) {
        for (const auto* changes : {&there, &back}) {
            field.bricks().forget_changes();
            const auto begin = std::chrono::steady_clock::now();
            for (const ShadeChanges& change : *changes) field.update(casts, change);
            best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
    }
    state.counters["value"] = best / moves * 1e6;
}
BENCHMARK(one_changed_organ)->UseRealTime();

void diffusion_sweep(benchmark::State& state) {
    test::Stock soil(R"(process = "soil-water"
voxel = 1
domain = { lower = [0, 0, 0], upper = [256, 256, 256] }
diffusion = 0.1
initial = 0.3
)");
    WaterBrick from = soil.stock.contents(), to = from;
    for (auto _ : state) {
        soil.diffusion.sweep(soil.stock.faces(), from, to, 0.5);
        std::swap(from, to);
        benchmark::DoNotOptimize(from.data());
    }
}
BENCHMARK(diffusion_sweep)->UseRealTime();

void copy_of_a_double_field(benchmark::State& state) {
    const std::vector<double> from(std::size_t(edge) * edge * edge, 1.0);
    std::vector<double> to(from.size());
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), from.size() * sizeof(double));
        benchmark::DoNotOptimize(to.data());
    }
}
BENCHMARK(copy_of_a_double_field)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row trip{
    "a question's round trip through an echo, ns", "echo_round_trip/real_time", "", Measure::value, Goal::at_most, 50};
const Row rebuilt{"shade of 100,000 casters in 256^3: casts, sums, grid of light; against copying the field",
                  "shade_of_a_crown/real_time",
                  "copy_of_a_float_field/real_time",
                  Measure::time,
                  Goal::at_most,
                  4};
const Row answered{"a scattered question answered from that shade, without the exchange, ns",
                   "answers_from_the_shade/real_time",
                   "",
                   Measure::value,
                   Goal::at_most,
                   150};
const Row changed{
    "one changed organ in the shade, us", "one_changed_organ/real_time", "", Measure::value, Goal::at_most, 3};
const Row sweep{"diffusion sweep in 256^3, against copying the field",
                "diffusion_sweep/real_time",
                "copy_of_a_double_field/real_time",
                Measure::time,
                Goal::at_most,
                3};

}  // namespace
}  // namespace espalier::bench

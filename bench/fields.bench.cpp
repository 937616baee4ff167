// The exchange and the fields behind it: a question's round trip, shade rebuilt and changed, water diffusing.
#include "environment/exchange_plants.h"
#include "environment/soil_water_soil.h"
#include "table.h"

#include <benchmark/benchmark.h>
#include <cstring>
#include <vector>

namespace espalier::bench {
namespace {

/// Answers what it was asked.
class Echo : public EnvironmentProcess {
public:
    Echo(Settings&, const EnvironmentContext&, Fields&) {}
    void advance(const WorldView&, std::span<const Query>, Fields&) override {}
    void answer(const WorldView&, std::span<const Query> queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i][0] = queries[i].parameters[0];
    }
    std::vector<Quantity> statistics(std::uint32_t) const override { return {}; }
    std::pair<int, int> query_arity() const override { return {1, 1}; }
    void save(std::ostream&) const override {}
    void restore(std::istream&) override {}
};
const RegisteredProcess<Echo> echo{{"bench-echo", "answers what it was asked", ""}};

constexpr int edge = 256;

/// Questions all over a box of this many voxels.
std::vector<Asked> crown(int count, double strength) {
    RandomDraws draws({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(draws.uniform(), draws.uniform(), draws.uniform());
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

const std::string shade = R"([light]
process = "voxel-shade"
voxel = 1
strength = 1
dissipation = 1.5
depth = 8
)";

void shade_of_a_crown(benchmark::State& state) {
    Environment environment = environment_of(shade);
    AskingPlants one, other;
    one.add(crown(100'000, 1));
    other.add(crown(100'000, 0.9));  // every caster differs from step to step
    bool turn = false;
    for (auto _ : state) {
        (turn ? one : other).exchange(environment);
        turn = !turn;
    }
}
BENCHMARK(shade_of_a_crown)->UseRealTime();

void copy_of_a_float_field(benchmark::State& state) {
    const std::vector<float> from(std::size_t(edge) * edge * edge, 1.0f);
    std::vector<float> to(from.size());
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), from.size() * sizeof(float));
        benchmark::DoNotOptimize(to.data());
    }
}
BENCHMARK(copy_of_a_float_field)->UseRealTime();

/// One caster of a crown moves: the step's time beyond that of a step in which nothing does, in microseconds, each the
/// best of all repetitions.
void one_changed_organ(benchmark::State& state) {
    Environment environment = environment_of(shade);
    std::vector<Asked> still = crown(100'000, 1), moved = still;
    moved.front().position += glm::dvec3(1, 0, 0);
    AskingPlants before, after;
    before.add(still);
    after.add(moved);
    const auto timed = [&](AskingPlants& plants) {
        const auto begin = std::chrono::steady_clock::now();
        plants.exchange(environment);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    double changed = 1e9, unchanged = 1e9;
    for (auto _ : state) {
        timed(before);
        unchanged = std::min(unchanged, timed(before));
        changed = std::min(changed, timed(after));
    }
    state.counters["value"] = (changed - unchanged) * 1e6;
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
const Row rebuilt{"shade of 100,000 casters in 256^3, against copying the field",
                  "shade_of_a_crown/real_time",
                  "copy_of_a_float_field/real_time",
                  Measure::time,
                  Goal::at_most,
                  4};
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

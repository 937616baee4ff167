// Processes that search: collisions, cells, and light between balls of leaves.
#include "espalier/simulation/world.h"

#include "environment/exchange/exchange_plants.h"
#include "environment/space/markers/colonization.h"
#include "table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace espalier::bench {
namespace {

/// One process with its batch of queries, all at random places, without the exchange around it.
class Searching {
public:
    Searching(const std::string& lines, std::size_t count, glm::dvec3 box, double parameter) {
        Settings settings = Settings::parse_toml(lines, "scene.toml");
        process_ = registered<ProcessType>().at(settings.text("process"))->make(settings, {}, fields_);
        RandomSamples samples({1, 2, Stream::process}, 3, 4);
        parameters_.assign(count, parameter);
        answers_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            Query& query = queries_.emplace_back();
            query.parameters = {&parameters_[i], 1};
            query.pose.position = box * glm::dvec3(samples.uniform(), samples.uniform(), samples.uniform());
            spans_.push_back({&answers_[i], 1});
        }
    }

    void answer() {
        process_->answer({}, queries_, spans_, fields_);
        benchmark::DoNotOptimize(answers_.data());
    }

    std::vector<glm::dvec3> places() const {
        std::vector<glm::dvec3> places;
        for (const Query& query : queries_) places.push_back(query.pose.position);
        return places;
    }

private:
    Fields fields_;
    std::unique_ptr<EnvironmentProcess> process_;
    std::vector<double> parameters_, answers_;
    std::vector<Query> queries_;
    std::vector<Answer> spans_;
};

/// One in three meets another.
Searching collisions() {
    return {"process = \"honda81\"\nradius = 0.5\n", 13'000, {160, 0, 160}, 1};
}

void collisions(benchmark::State& state) {
    Searching searching = collisions();
    for (auto _ : state) searching.answer();
}
BENCHMARK(collisions)->UseRealTime();

void sorted_places(benchmark::State& state) {
    const std::vector<glm::dvec3> places = collisions().places();
    std::vector<glm::dvec3> sorted;
    for (auto _ : state) {
        sorted = places;
        std::sort(sorted.begin(), sorted.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        benchmark::DoNotOptimize(sorted.data());
    }
}
BENCHMARK(sorted_places)->UseRealTime();

constexpr std::size_t ball_count = 5'000;

Searching balls(const std::string& mode) {
    return {"process = \"chiba\"\ntransmittance = 0.25\n" + mode, ball_count, {10, 10, 10}, 0.4};
}

void light_by_chords(benchmark::State& state) {
    Searching searching = balls("");
    for (auto _ : state) searching.answer();
}
BENCHMARK(light_by_chords)->UseRealTime();

void light_by_areas(benchmark::State& state) {
    Searching searching = balls("estimate_intersection_area = true");
    for (auto _ : state) searching.answer();
}
BENCHMARK(light_by_areas)->UseRealTime();

/// Which balls are in front of which, for one direction of 128: every pair.
void pairs_of_one_direction(benchmark::State& state) {
    const std::vector<glm::dvec3> places = balls("").places();
    const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 2, 3));
    for (auto _ : state) {
        std::size_t hits = 0;
        for (const glm::dvec3& one : places) {
            for (const glm::dvec3& other : places) {
                const glm::dvec3 between = other - one;
                const double ahead = glm::dot(between, towards);
                hits += ahead > 0 && glm::dot(between, between) - ahead * ahead < 0.16;
            }
        }
        benchmark::DoNotOptimize(hits);
    }
}
BENCHMARK(pairs_of_one_direction)->UseRealTime();

/// Seconds of a scene's exchanges, and of derivation and interpretation beside them.
std::pair<double, double> grow(const Scene& scene) {
    double exchange = 0, rest = 0;
    World world(scene);
    world.start();
    while (!world.at_end()) {
        world.step();
        exchange += world.times().exchange;
        rest += world.times().derive + world.times().interpret;
    }
    return {exchange, rest};
}

Scene ulam_scene(const std::vector<std::pair<std::string, std::string>>& overrides) {
    SceneOptions options;
    options.overrides = overrides;
    options.steps = 80;
    return read_scene(ESPALIER_SOURCE_DIR "/environments/ulam.toml", options);
}

void ulam(benchmark::State& state) {
    const Scene scene = ulam_scene({});
    std::pair<double, double> seconds;
    for (auto _ : state) seconds = grow(scene);
    state.counters["work"] = seconds.first;
    state.counters["yardstick"] = seconds.second;
}
BENCHMARK(ulam)->UseRealTime();

/// With the questions and answers of an environment file: numbers as text carries them.
void ulam_in_digits(benchmark::State& state) {
    const Scene scene = ulam_scene({});
    const Scene in_digits = ulam_scene({{"environment.collisions.digits", "6"},
                                        {"environment.collisions.following_module", "false"},
                                        {"environment.collisions.turtle", "{ position = 'P: %f %f %f' }"}});
    double exact = 0, rounded = 0;
    for (auto _ : state) {
        exact = grow(scene).first;
        rounded = grow(in_digits).first;
    }
    state.counters["work"] = rounded;
    state.counters["yardstick"] = exact;
}
BENCHMARK(ulam_in_digits)->UseRealTime();

/// A tree of 25,000 points and 40 iterations: what the process does in all steps, beside asking every node for every
/// point. Every step's nodes are those of the colony.
class Colony {
public:
    explicit Colony(std::size_t points) {
        RandomSamples samples({1, 2, Stream::process}, 3, 4);
        side_ = std::cbrt(static_cast<double>(points) / 25'000);
        while (points_.size() < points) {
            const double x = samples.uniform() - 0.5, y = samples.uniform(), z = samples.uniform() - 0.5;
            points_.push_back(10 * side_ * glm::dvec3(x, y, z));
        }
    }

    template <class Step>
    void grow(Step&& step) const {
        std::vector<environment::ColonizingNode> nodes{{0, {0, 0, 0}}};
        for (int i = 0; i < 40; ++i) {
            const std::vector<environment::Colonization::Won> won = step(nodes);
            const std::size_t count = nodes.size();
            for (std::size_t k = 0; k < count; ++k) {
                if (won[k].count == 0 || glm::length(won[k].sum) < 1e-9) continue;
                const glm::dvec3 direction = glm::normalize(won[k].sum);
                nodes.push_back({nodes.size(), nodes[k].position + length() * direction, direction});
            }
        }
    }

    const std::vector<glm::dvec3>& points() const { return points_; }
    double length() const { return 0.25 * side_; }
    static constexpr double influence = 1.5, kill = 0.5;

private:
    double side_ = 1;
    std::vector<glm::dvec3> points_;
};

void colonize(benchmark::State& state) {
    const Colony colony(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        environment::Colonization points(colony.points(), {Colony::influence});
        colony.grow([&](const std::vector<environment::ColonizingNode>& nodes) {
            points.set_nodes(nodes);
            points.remove_within(Colony::kill);
            return points.won();
        });
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(colonize)->Arg(25'000)->Arg(100'000)->Arg(1'000'000)->UseRealTime();

void ask_every_node(benchmark::State& state) {
    const Colony colony(25'000);
    for (auto _ : state) {
        std::vector<glm::dvec3> points = colony.points();
        colony.grow([&](const std::vector<environment::ColonizingNode>& nodes) {
            std::vector<environment::Colonization::Won> won(nodes.size());
            std::vector<glm::dvec3> left;
            for (const glm::dvec3& point : points) {
                std::size_t nearest = 0;
                double least = INFINITY;
                for (std::size_t k = 0; k < nodes.size(); ++k) {
                    const glm::dvec3 towards = point - nodes[k].position;
                    const double square = glm::dot(towards, towards);
                    if (square >= least) continue;
                    least = square;
                    nearest = k;
                }
                if (least <= Colony::kill * Colony::kill) continue;
                left.push_back(point);
                if (least > Colony::influence * Colony::influence) continue;
                ++won[nearest].count;
                won[nearest].sum += (point - nodes[nearest].position) / std::sqrt(least);
            }
            points = std::move(left);
            return won;
        });
    }
}
BENCHMARK(ask_every_node)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row collided{"13,000 collisions, against sorting their places",
                   "collisions/real_time",
                   "sorted_places/real_time",
                   Measure::time,
                   Goal::at_most,
                   4};
const Row cells{"Ulam's cells for 80 steps: their exchanges, against derivation and interpretation",
                "ulam/real_time",
                "",
                Measure::counters,
                Goal::at_most,
                0.6};
const Row digits{"Ulam's cells: exchanges with the numbers of an environment file, against those of a scene",
                 "ulam_in_digits/real_time",
                 "",
                 Measure::counters,
                 Goal::at_most,
                 2};
const Row chords{"light of 5,000 balls from 128 directions by chords, against all pairs for one direction",
                 "light_by_chords/real_time",
                 "pairs_of_one_direction/real_time",
                 Measure::time,
                 Goal::at_most,
                 3};
const Row areas{"the same by areas",
                "light_by_areas/real_time",
                "pairs_of_one_direction/real_time",
                Measure::time,
                Goal::at_most,
                8};

const Row colonized{"space colonization of 25,000 points in 40 iterations, against asking every node for every point",
                    "colonize/25000/real_time",
                    "ask_every_node/real_time",
                    Measure::time,
                    Goal::at_most,
                    0.1};
const Row linear{"a point of a million, against one of 25,000",
                 "colonize/1000000/real_time",
                 "colonize/25000/real_time",
                 Measure::time_per_item,
                 Goal::at_most,
                 1.5};

}  // namespace
}  // namespace espalier::bench

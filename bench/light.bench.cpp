// Light: rays of ray-light beside a bare loop over Embree, what changed plants cost, voxels of canopy-light, and the
// paths of pictures.
#include "bare_embree.h"
#include "base/sobol.h"
#include "environment/light/canopy/scattering.h"
#include "environment/light/lit_leaves.h"
#include "environment/light/rays/light_paths.h"
#include "geometry/vectors.h"
#include "picture/light/path_tracer.h"
#include "seconds_of.h"
#include "table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <numeric>
#include <vector>

namespace espalier::bench {
namespace {

using namespace environment;

constexpr std::uint32_t path_count = 1 << 17;
constexpr double area_index = 3;

Settings settings(const char* text) {
    return Settings::parse_toml(text, "scene.toml");
}

Daylight sun_and_sky() {
    return DaylightSeries(settings("par = 1000\ndiffuse = 0.3\nsun = [1, 2, 0]\n"), least_rise).over(0, 1);
}

/// Square leaves, each of a module of its own, over 2 x 2 m of ground.
PlantGeometry leaves_at_random(std::size_t count, std::uint64_t seed) {
    PlantGeometry geometry;
    draw_at_random(geometry, 0, static_cast<int>(count), std::sqrt(4 * area_index / static_cast<double>(count)), seed);
    for (std::size_t i = 0; i < count; ++i) geometry.polygons[i].module = static_cast<std::uint32_t>(i);
    return geometry;
}

/// A plant of so many triangles.
struct LitPlant {
    Optics optics{settings("bands.par = { leaf = [0, 0], soil = 0 }\n")};
    LitTriangles triangles;
    std::size_t leaves;

    explicit LitPlant(std::size_t count) : leaves(count / 2) {
        triangles.add(leaves_at_random(leaves, 7), 0, 0, optics);
    }
};

void rays_of_ray_light(benchmark::State& state) {
    const LitPlant plant(static_cast<std::size_t>(state.range(0)));
    LightPaths paths(plant.optics, {}, {});
    paths.set(plant.triangles, plant.leaves, sun_and_sky(), {}, 0, std::array{1.0});
    for (auto _ : state) paths.trace(path_count, 5);
    state.SetItemsProcessed(state.iterations() * path_count);
}
BENCHMARK(rays_of_ray_light)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->UseRealTime();

/// The light of each leaf in a step, and in another one with other numbers.
using LightOfLeaves = std::array<std::vector<double>, 2>;

LightOfLeaves light_of_leaves(LightPaths& paths, std::size_t leaves, std::uint32_t count, bool from_organs) {
    constexpr std::uint32_t trials = 8;
    LightOfLeaves light;
    for (std::uint32_t step = 0; step < light.size(); ++step) {
        light[step].assign(leaves, 0);
        for (std::uint32_t trial = 0; trial < trials; ++trial) {
            paths.trace(count / trials, trials * step + trial);
            if (from_organs) paths.trace_from_organs(trial, 1000 + step);
            for (std::size_t i = 0; i < leaves; ++i) light[step][i] += paths.absorbed(i, 0) / trials;
        }
    }
    return light;
}

/// Of the differences between two steps, over the mean: twice the squared error of a leaf.
double squared_error(const LightOfLeaves& light) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < light[0].size(); ++i) {
        squares += std::pow(light[0][i] - light[1][i], 2);
        sum += (light[0][i] + light[1][i]) / 2;
    }
    return squares * static_cast<double>(light[0].size()) / (sum * sum);
}

/// Errors of leaves at equal time, with light that is looked for from the organs and with paths from the sources alone:
/// the square of an error falls as time grows.
void errors_of_organs(benchmark::State& state) {
    const auto leaves = static_cast<std::size_t>(state.range(0));
    const Optics optics(settings("bands.par = { leaf = [0.1, 0.1], soil = 0.1 }\n"));
    LitTriangles triangles;
    triangles.add(leaves_at_random(leaves, 7), 0, 0, optics);
    const Box period{{0, 0, 0}, {2, 3, 2}};
    const auto error_at_equal_time = [&](bool from_organs) {
        LightPaths paths(optics, {},
                         {.period = period, .residual = from_organs ? 0.25 : 0.001, .from_organs = from_organs});
        paths.set(triangles, leaves, sun_and_sky(), {}, 0, std::array{1.0});
        LightOfLeaves light;
        const double seconds = seconds_of([&] { light = light_of_leaves(paths, leaves, 1 << 16, from_organs); });
        return std::sqrt(squared_error(light) * seconds);
    };
    double organs = INFINITY, alone = INFINITY;
    for (auto _ : state) {
        organs = std::min(organs, error_at_equal_time(true));
        alone = std::min(alone, error_at_equal_time(false));
    }
    state.counters["work"] = organs;
    state.counters["yardstick"] = alone;
}
BENCHMARK(errors_of_organs)->Arg(10'000)->Arg(100'000)->UseRealTime();

/// As the paths of `ray-light` begin.
std::vector<Ray> rays_towards(const Box& box) {
    const Daylight light = sun_and_sky();
    std::vector<double> powers;
    for (const LightBeam& beam : light.beams) powers.push_back(beam.photons);
    std::partial_sum(powers.begin(), powers.end(), powers.begin());
    const glm::dvec3 centre = (box.lower + box.upper) / 2.0;
    const double radius = glm::length(box.upper - box.lower) / 2;
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < path_count; ++i) {
        const auto [source, u, v, spare] = scrambled_sobol(i, 9);
        const auto beam = std::upper_bound(powers.begin(), powers.end() - 1, source * powers.back()) - powers.begin();
        const glm::dvec3 towards = light.beams[static_cast<std::size_t>(beam)].towards;
        const glm::dvec3 x = any_across(towards), y = glm::cross(towards, x);
        const glm::dvec3 origin = centre + radius * (towards + (2 * u - 1) * x + (2 * v - 1) * y);
        rays.push_back(Ray{glm::vec3(origin), glm::vec3(-towards)});
    }
    return rays;
}

void bare_rays(benchmark::State& state, const char* options) {
    const LitPlant plant(static_cast<std::size_t>(state.range(0)));
    const BareEmbree scene(options, plant.triangles.parts({}).front().corners);
    const std::vector<Ray> rays = rays_towards(plant.triangles.bounds());
    for (auto _ : state) benchmark::DoNotOptimize(scene.hits(rays));
    state.SetItemsProcessed(state.iterations() * path_count);
}
void rays_of_bare_embree(benchmark::State& state) {
    bare_rays(state, "isa=sse2");
}
void rays_of_widest_embree(benchmark::State& state) {
    bare_rays(state, "");
}
BENCHMARK(rays_of_bare_embree)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->UseRealTime();
BENCHMARK(rays_of_widest_embree)->Arg(10'000)->UseRealTime();

/// 100 plants of 5,000 triangles in a stand 20 m wide: the scene when one of them has changed, and when all have.
void changed_plants(benchmark::State& state) {
    const Optics optics(settings("bands.par = { leaf = [0, 0], soil = 0 }\n"));
    constexpr std::uint32_t leaves = 2500;
    std::vector<PlantGeometry> plants;
    for (std::uint32_t k = 0; k < 100; ++k) {
        PlantGeometry& plant = plants.emplace_back(leaves_at_random(leaves, k + 1));
        for (glm::dvec3& corner : plant.vertices) corner += glm::dvec3(2 * (k % 10), 0, 2 * (k / 10));
    }
    LitTriangles triangles;
    LightPaths paths(optics, {}, {});
    const auto seconds_with_changed = [&](std::size_t changed) {
        for (std::size_t k = 0; k < changed; ++k) plants[k].vertices.front().y += 1e-4;
        triangles.clear();
        for (std::uint32_t k = 0; k < plants.size(); ++k) triangles.add(plants[k], k * leaves, k, optics);
        return seconds_of([&] { paths.set(triangles, plants.size() * leaves, sun_and_sky(), {}, 0, std::array{1.0}); });
    };
    seconds_with_changed(plants.size());
    double one = INFINITY, all = INFINITY;
    for (auto _ : state) {
        one = std::min(one, seconds_with_changed(1));
        all = std::min(all, seconds_with_changed(plants.size()));
    }
    state.counters["work"] = one;
    state.counters["yardstick"] = all;
}
BENCHMARK(changed_plants)->UseRealTime();

/// 1,000,000 black leaves in 256^3 voxels, from 24 directions.
void voxels_in_light(benchmark::State& state) {
    constexpr int edge = 256;
    constexpr double voxel = 3.0 / edge;
    const Optics optics(settings("bands.par = { leaf = [0, 0], soil = 0 }\n"));
    const LeafAngles angles("spherical");
    CanopyLeaves leaves;
    leaves.add(0, leaves_at_random(1'000'000, 3), voxel, optics, true);
    const CanopyVoxels voxels{{-0.5, 0, -0.5}, {edge, edge, edge}, voxel, false};
    leaves.sort_into(voxels);
    std::vector<LightBeam> beams;
    for (const SkyPart& part : sky_parts(4, 6)) beams.push_back({part.towards, 1});
    const CanopyScattering light(voxels, leaves.pieces(), optics, angles, {}, {});
    for (auto _ : state) benchmark::DoNotOptimize(light.first(beams).ground.data());
}
BENCHMARK(voxels_in_light)->UseRealTime();

/// A generation of what 100,000 leaves scatter in 64^3 voxels, to 36 directions, and as many copies of these.
void scattered_in_voxels(benchmark::State& state) {
    constexpr int edge = 64, directions = 36;
    constexpr double voxel = 3.0 / edge;
    const Optics optics(settings("bands.par = { leaf = [0.1, 0.1], soil = 0.1 }\n"));
    const LeafAngles angles("spherical");
    CanopyLeaves leaves;
    leaves.add(0, leaves_at_random(100'000, 3), voxel, optics, true);
    const CanopyVoxels voxels{{-0.5, 0, -0.5}, {edge, edge, edge}, voxel, false};
    leaves.sort_into(voxels);
    const CanopyScattering light(voxels, leaves.pieces(), optics, angles, {}, {});
    CanopyScattering::Emission emission;
    emission.front.assign(leaves.pieces().size(), 1);
    emission.back = emission.front;
    emission.ground.assign(voxels.ground_count(), 1);
    const std::vector<double> values(voxels.count(), 1);
    std::vector<double> copy(values.size());
    double scattered = INFINITY, copied = INFINITY;
    for (auto _ : state) {
        scattered = std::min(scattered, seconds_of([&] { benchmark::DoNotOptimize(light.spread(emission).entered); }));
        copied = std::min(copied, seconds_of([&] {
                              for (int k = 0; k < directions; ++k) {
                                  std::copy(values.begin(), values.end(), copy.begin());
                                  benchmark::DoNotOptimize(copy.data());
                              }
                          }));
    }
    state.counters["work"] = scattered;
    state.counters["yardstick"] = copied;
}
BENCHMARK(scattered_in_voxels)->UseRealTime();

/// One copy for each of four beams of each direction.
void copied_voxels(benchmark::State& state) {
    std::vector<double> voxels(256 * 256 * 256, 1.0), copy(voxels.size());
    for (auto _ : state) {
        for (int beam = 0; beam < 24 * 4; ++beam) {
            std::copy(voxels.begin(), voxels.end(), copy.begin());
            benchmark::DoNotOptimize(copy.data());
        }
    }
}
BENCHMARK(copied_voxels)->UseRealTime();

/// A plant of 100,000 triangles as `render --light` sees it: so many paths from the eye, with all their bounces.
void paths_of_a_picture(benchmark::State& state) {
    const LitPlant plant(100'000);
    picture::LitPart part;
    const auto parts = plant.triangles.parts({});
    const std::span<const glm::vec3> corners = parts.front().corners;
    std::vector<glm::vec3> normals(corners.size(), glm::vec3(0));
    std::vector<std::int32_t> numbers(corners.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    part.points = corners;
    part.normals = normals;
    part.corners = numbers;
    part.colours.assign(corners.size(), {90, 140, 60});
    part.is_thin = true;
    const picture::LitScene scene({std::move(part)}, picture::LitGround{{1, 0, 1}, 3, picture::open_ground});
    const picture::SkyLight light({}, glm::normalize(glm::vec3(1, 2, 0)));
    const picture::PathTracer tracer(scene, light, picture::open_ground);
    const std::vector<Ray> rays = rays_towards(plant.triangles.bounds());
    for (auto _ : state) {
        for_in_parallel(std::size_t{0}, rays.size(), [&](std::size_t i) {
            picture::PathNumbers numbers_of_path(i, 0);
            benchmark::DoNotOptimize(tracer.seen(rays[i].origin, rays[i].direction, true, numbers_of_path).radiance.x);
        });
    }
    state.SetItemsProcessed(state.iterations() * path_count);
}
BENCHMARK(paths_of_a_picture)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row few{"rays of ray-light, 10,000 triangles, against a bare loop over Embree with the same instructions",
              "rays_of_ray_light/10000/real_time",
              "rays_of_bare_embree/10000/real_time",
              Measure::rate,
              Goal::at_least,
              0.5};
const Row more{"the same, 100,000 triangles",
               "rays_of_ray_light/100000/real_time",
               "rays_of_bare_embree/100000/real_time",
               Measure::rate,
               Goal::at_least,
               0.5};
const Row many{"the same, 1,000,000 triangles",
               "rays_of_ray_light/1000000/real_time",
               "rays_of_bare_embree/1000000/real_time",
               Measure::rate,
               Goal::at_least,
               0.5};
const Row widest{"the same, 10,000 triangles, against Embree with the widest instructions of the machine",
                 "rays_of_ray_light/10000/real_time",
                 "rays_of_widest_embree/10000/real_time",
                 Measure::rate,
                 Goal::at_least,
                 0.3};
const Row changed{"scene of ray-light when 1 of 100 plants has changed, against all",
                  "changed_plants/real_time",
                  "",
                  Measure::counters,
                  Goal::at_most,
                  0.1};
const Row few_organs{"error of 10,000 leaves in ray-light, against paths from the sources alone in the same time",
                     "errors_of_organs/10000/real_time",
                     "",
                     Measure::counters,
                     Goal::at_most,
                     0.2};
const Row many_organs{
    "the same, 100,000 leaves", "errors_of_organs/100000/real_time", "", Measure::counters, Goal::at_most, 0.2};
const Row voxels{
    "canopy-light, 10^6 leaves in 256^3 voxels, 4 beams from each of 24 directions, against a copy for each beam",
    "voxels_in_light/real_time",
    "copied_voxels/real_time",
    Measure::time,
    Goal::at_most,
    40};
const Row scattered{
    "a generation of scattered light, 100,000 leaves in 64^3 voxels, against a copy for each of 36 directions",
    "scattered_in_voxels/real_time",
    "",
    Measure::counters,
    Goal::at_most,
    40};
const Row pictures{"paths of render --light, 100,000 triangles, against rays of a bare loop over Embree",
                   "paths_of_a_picture/real_time",
                   "rays_of_bare_embree/100000/real_time",
                   Measure::rate,
                   Goal::at_least,
                   0.1};

}  // namespace
}  // namespace espalier::bench

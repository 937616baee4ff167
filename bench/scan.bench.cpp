// Beams of a virtual scanner beside a bare loop over Embree.
#include "study/scan/scan.h"

#include "espalier/base/file.h"
#include "espalier/base/random.h"

#include "bare_embree.h"
#include "study/fit/growth.h"
#include "table.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <benchmark/benchmark.h>
#include <string>
#include <vector>

namespace espalier::bench {
namespace {

constexpr int leaf_count = 5000;  // of two triangles

FrameGeometry leaves_at_random() {
    std::string axiom;
    RandomSamples samples(RandomKey(9, 0, Stream::process), 0, 0);
    for (int i = 0; i < leaf_count; ++i) {
        axiom += fmt::format("[@M({},{},{})/({}){{.f(.05).+(90)f(.05).+(90)f(.05).}}]", 2 * samples.uniform(),
                             2 * samples.uniform(), 2 * samples.uniform(), 360 * samples.uniform());
    }
    const TemporaryFolder folder;
    folder.write("leaves.l", "lsystem: 1\nderivation length: 0\naxiom: " + axiom + "\nendlsystem\n");
    const study::Growth growth(study::Subject{folder.path() / "leaves.l"});
    return *growth.grow(growth.scene({}), 0, {true, false})->geometry;
}

const study::ScannedPlants& plants() {
    static const study::ScannedPlants all(leaves_at_random(), 8, std::nullopt);
    return all;
}

std::vector<study::Beam> beams() {
    study::TripodScanner scanner;
    scanner.place = {6, 1, 1};
    scanner.step = 0.1;
    scanner.lowest = -15, scanner.highest = 15;
    scanner.first_azimuth = -105, scanner.last_azimuth = -75;
    return scanner.beams();
}

void scanned_beams(benchmark::State& state) {
    const std::vector<study::Beam> all = beams();
    for (auto _ : state) benchmark::DoNotOptimize(study::scan(plants(), all, {}));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(scanned_beams)->UseRealTime();

void bare_beams(benchmark::State& state) {
    const BareEmbree scene("isa=sse2", plants().corners());
    std::vector<Ray> rays;
    for (const study::Beam& beam : beams()) rays.push_back({glm::vec3(beam.origin), glm::vec3(beam.direction)});
    for (auto _ : state) benchmark::DoNotOptimize(scene.hits(rays));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}
BENCHMARK(bare_beams)->UseRealTime();

const Row row{"beams of a scan, 10,000 triangles, against a bare loop over Embree with the same instructions",
              "scanned_beams/real_time",
              "bare_beams/real_time",
              Row::Measure::rate,
              Row::Goal::at_least,
              0.5};

}  // namespace
}  // namespace espalier::bench

// A data set of labelled plants beside plants that are only grown and drawn.
#include "study/dataset/dataset.h"

#include "espalier/base/file.h"

#include "study/dataset/measured_sample.h"
#include "table.h"
#include "temporary_folder.h"

#include <benchmark/benchmark.h>
#include <string>

namespace espalier::bench {
namespace {

/// That of docs/datasets.md, 1,000 of which are made in one command.
const char* const trees = ESPALIER_SOURCE_DIR "/docs/examples/trees.toml";
constexpr std::size_t samples = 16;

void labelled_plants(benchmark::State& state) {
    for (auto _ : state) {
        const TemporaryFolder folder;
        const study::Dataset set(study::read_dataset(trees, {samples, std::nullopt}), folder.path() / "set");
        set.make({}, [](std::size_t, std::size_t) {});
        set.write_card();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * samples));
}
BENCHMARK(labelled_plants)->UseRealTime();

/// The same plants and pictures, without masks and scans.
void drawn_plants(benchmark::State& state) {
    study::DatasetPlan plan = study::read_dataset(trees, {samples, std::nullopt});
    plan.scan.reset();
    plan.pictures->masks = false;
    for (auto _ : state) {
        const TemporaryFolder folder;
        for (const study::DatasetSample& sample : study::samples_of(plan)) {
            const study::GrownSample grown = study::grown_sample(plan, sample);
            study::measure(plan, sample, grown, folder.path());
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * samples));
}
BENCHMARK(drawn_plants)->UseRealTime();

const Row row{"a data set of labelled trees, against growing and drawing the same trees",
              "labelled_plants/real_time",
              "drawn_plants/real_time",
              Row::Measure::time,
              Row::Goal::at_most,
              1.5};

}  // namespace
}  // namespace espalier::bench

// What the page of a sweep holds: means and deviations of known numbers, and cells of a known map.
#include "picture/charts/sweep_charts.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "picture/files/off_screen.h"
#include "temporary_folder.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <set>

using namespace espalier;
using namespace espalier::picture;
using Catch::Contains;

namespace {

/// A run of two plants that end with `organs` together, and so high.
SweptRun run(std::vector<std::string> values, double organs, double height) {
    return {std::move(values),
            {{"step", "plant", "organs", "height"},
             {{0, 0, 1, 9}, {0, 1, 1, 9}, {5, 0, organs / 4, height}, {5, 1, 3 * organs / 4, height / 2}}}};
}

std::vector<std::string> key_names(const ChartPage& page) {
    std::vector<std::string> names;
    for (const Key& key : page.keys) names.push_back(key.name);
    return names;
}

}  // namespace

TEST_CASE("a sweep of one key is a line of what the runs ended with, in the order of its numbers", "[pictures]") {
    const SweptRuns sweep{"voxels", {"light.voxel"}, {run({"1"}, 8, 2), run({"0.25"}, 4, 3), run({"10"}, 12, 1)}};
    const ChartPage page = sweep_page(sweep, {"organs", "height"}, false);
    REQUIRE(page.charts.size() == 2);
    CHECK(page.title == "voxels");
    CHECK(page.charts[0].x_title == "light.voxel");
    CHECK(page.charts[1].y_title == "height (m)");
    REQUIRE(page.charts[0].series.size() == 1);
    CHECK(page.charts[0].series[0].x == std::vector<double>{0.25, 1, 10});
    CHECK(page.charts[0].series[0].y == std::vector<double>{4, 8, 12});  // sums of the plants
    CHECK(page.charts[1].series[0].y == std::vector<double>{3, 2, 1});   // the higher one
    CHECK(page.charts[0].series[0].low.empty());
    CHECK(sweep_page(sweep, {}, false).charts.size() == 2);  // all that is not 0 throughout
}

TEST_CASE("runs that differ in their seed alone are a mean, a deviation and dots", "[pictures]") {
    SweptRuns sweep{"seeds", {"light.voxel", "simulation.seed"}, {}};
    const double organs[2][4] = {{2, 4, 4, 6}, {10, 10, 10, 10}};
    for (int voxel = 0; voxel < 2; ++voxel) {
        for (int seed = 0; seed < 4; ++seed) {
            sweep.runs.push_back(run({std::to_string(voxel), std::to_string(seed)}, organs[voxel][seed], 1));
        }
    }
    const ChartPage page = sweep_page(sweep, {"organs"}, false);
    REQUIRE(page.charts[0].series.size() == 2);
    const Series &means = page.charts[0].series[0], &dots = page.charts[0].series[1];
    CHECK(means.y == std::vector<double>{4, 10});
    const double deviation = std::sqrt(8.0 / 3);  // deviation of a sample
    CHECK(means.low[0] == Approx(4 - deviation));
    CHECK(means.high[0] == Approx(4 + deviation));
    CHECK(means.low[1] == 10);
    CHECK_FALSE(dots.joined);
    CHECK(dots.x == std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1});
    CHECK(dots.y == std::vector<double>{2, 4, 4, 6, 10, 10, 10, 10});

    // What is never negative has no band below 0.
    sweep.runs[2] = run({"0", "2"}, 100, 1);
    const Series wide = sweep_page(sweep, {"organs"}, false).charts[0].series[0];
    CHECK(wide.low[0] == 0);
    CHECK(wide.high[0] > 70);
    sweep.runs[1] = run({"0", "1"}, -4, 1);
    CHECK(sweep_page(sweep, {"organs"}, false).charts[0].series[0].low[0] < -20);

    // Alone, seeds are repetitions of one thing.
    const SweptRuns seeds{"", {"simulation.seed"}, {run({"3"}, 7, 1), run({"1"}, 5, 1)}};
    const Chart alone = sweep_page(seeds, {"organs"}, false).charts[0];
    CHECK(alone.series[0].y == std::vector<double>{6});
    CHECK(alone.series[0].high[0] == Approx(6 + std::sqrt(2)));
    CHECK(alone.series[1].y == std::vector<double>{7, 5});
    CHECK(alone.x_names == std::vector<std::string>{"2 runs"});
}

TEST_CASE("a sweep's mean of a stand is of those plants that asked, by how much they did", "[pictures]") {
    SweptRuns sweep{"", {"light.voxel"}, {}};
    sweep.runs.push_back(
        {{"1"}, {{"step", "plant", "light.mean", "light.queries"}, {{3, 0, 0.5, 30}, {3, 1, 0.2, 10}}}});
    for (int seed = 2; seed < 30; ++seed) sweep.runs[0].table.rows.push_back({3, double(seed), 0, 0});
    CHECK(sweep_page(sweep, {"light.mean"}, false).charts[0].series[0].y[0] == Approx(17.0 / 40));
}

TEST_CASE("of two keys the one with more numbers goes along, and the other makes the lines", "[pictures]") {
    SweptRuns sweep{"", {"light.mode", "light.voxel"}, {}};
    for (const std::string mode : {"add", "attenuate"}) {
        for (const std::string voxel : {"0.1", "0.2", "0.4"}) {
            sweep.runs.push_back(run({mode, voxel}, mode == "add" ? 1 : 2, std::stod(voxel)));
        }
    }
    ChartPage page = sweep_page(sweep, {"organs"}, true);
    CHECK(page.dark);
    CHECK(page.charts[0].x_title == "light.voxel");
    CHECK(key_names(page) == std::vector<std::string>{"mode=add", "mode=attenuate"});
    CHECK(page.charts[0].series[1].y == std::vector<double>{2, 2, 2});

    // Words along x keep their order and are written below.
    sweep.runs.resize(1);
    sweep.runs.push_back(run({"attenuate", "0.1"}, 3, 1));
    sweep.keys.pop_back();
    for (SweptRun& swept : sweep.runs) swept.values.pop_back();
    page = sweep_page(sweep, {"organs"}, false);
    CHECK(page.charts[0].x_names == std::vector<std::string>{"add", "attenuate"});
    CHECK(page.charts[0].series[0].y == std::vector<double>{1, 3});
}

TEST_CASE("many values of two keys are a map of means, and its cells have their colours", "[pictures]") {
    SweptRuns sweep{"", {"a", "b", "simulation.seed"}, {}};
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 9; ++b) {
            if (a == 3 && b == 4) continue;  // has not ended
            for (int seed = 0; seed < 2; ++seed) {
                sweep.runs.push_back(
                    run({std::to_string(a), std::to_string(b), std::to_string(seed)}, a + 10 * b + seed, 1));
            }
        }
    }
    const ChartPage page = sweep_page(sweep, {"organs"}, false);
    REQUIRE(page.charts[0].map);
    const HeatMap& map = *page.charts[0].map;
    CHECK(page.charts[0].x_title == "b");
    REQUIRE(map.columns.size() == 9);
    REQUIRE(map.rows.size() == 8);
    for (std::size_t a = 0; a < 8; ++a) {
        for (std::size_t b = 0; b < 9; ++b) {
            const double value = map.values[a * 9 + b];
            if (a == 3 && b == 4) {
                CHECK(std::isnan(value));
            } else {
                CHECK(value == Approx(static_cast<double>(a + 10 * b) + 0.5));
            }
        }
    }
    if (!why_no_pictures().empty()) return;
    const TemporaryFolder folder;
    write_picture(page, {900, 600}, folder.path() / "map.png");
    write_picture(page, {900, 600}, folder.path() / "map.svg");
    CHECK_THAT(text_of(folder.path() / "map.svg"), Contains("</svg>"));
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder.path() / "map.png").c_str());
    reader->Update();
    std::size_t darkest = 0, brightest = 0;  // the ends of viridis, in a cell and in the bar
    for (int y = 0; y < 600; ++y) {
        for (int x = 0; x < 900; ++x) {
            const auto* rgb = static_cast<const unsigned char*>(reader->GetOutput()->GetScalarPointer(x, y, 0));
            darkest += rgb[0] == 68 && rgb[1] == 1 && rgb[2] == 84;
            brightest += rgb[0] == 253 && rgb[1] == 231 && rgb[2] == 37;
        }
    }
    const std::size_t cell = 700 / 9 * (450 / 8);
    CHECK(darkest > cell / 2);
    CHECK(brightest > cell / 2);
}

TEST_CASE("quantities that no run of a sweep has are refused, runs without one leave a gap", "[pictures]") {
    SweptRuns sweep{"", {"a"}, {run({"1"}, 1, 1), run({"2"}, 2, 2)}};
    CHECK_THROWS_WITH(sweep_page(sweep, {"orgns"}, false), Contains("did you mean 'organs'?"));
    sweep.runs[1].table = {{"step", "plant"}, {{5, 0}}};
    CHECK(std::isnan(sweep_page(sweep, {"organs"}, false).charts[0].series[0].y[1]));
    sweep.runs[1].table = {};
    CHECK_NOTHROW(sweep_page(sweep, {"organs"}, false));
}

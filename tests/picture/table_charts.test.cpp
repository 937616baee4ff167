// What a page of charts holds, and that its picture appears.
#include "espalier/picture/table_charts.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "picture/pictures.h"
#include "temporary_folder.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace espalier;
using namespace espalier::picture;
using Catch::Contains;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Three plants of two species at steps 0 and 1.
PlottedTable table(const std::string& run) {
    PlottedTable plotted;
    plotted.run = run;
    plotted.table.columns = {"step",       "plant",     "modules",   "height",
                             "light.mean", "light.min", "light.max", "water.uptake"};
    plotted.table.rows = {{0, 0, 10, 1, 0.5, 0.1, 0.6, 0},        {0, 1, 20, 3, 0.7, 0.3, 0.9, 0},
                          {0, 2, 30, 2, not_a_number, 0.2, 1, 0}, {1, 0, 11, 4, 0.4, 0.1, 0.5, 0},
                          {1, 1, 21, 5, 0.6, 0.2, 0.9, 0},        {1, 2, 31, 6, not_a_number, 0.1, 0.8, 0}};
    plotted.plants = {{0, "left", "models/oak.l"}, {1, "right", "models/oak.l"}, {2, "front", "models/fern.l"}};
    return plotted;
}

ChartPage page(const std::vector<PlottedTable>& tables, std::vector<std::string> quantities, Lines lines) {
    PlotOptions options;
    options.quantities = std::move(quantities);
    options.lines = lines;
    return chart_page(tables, options);
}

std::vector<std::string> names(const ChartPage& page) {
    std::vector<std::string> result;
    for (const Key& key : page.keys) result.push_back(key.name);
    return result;
}

ChartPage waves() {
    ChartPage page;
    page.title = "waves";
    page.keys = {{"left", 0, 0}, {"right", 1, 1}};
    for (int i = 0; i < 5; ++i) {
        Chart chart{"step", "height (m)", {{0, {}, {}}, {1, {}, {}}}};
        for (int x = 0; x < 50; ++x) {
            for (std::size_t key = 0; key < 2; ++key) {
                chart.series[key].x.push_back(x);
                chart.series[key].y.push_back(x == 20 ? not_a_number : std::sin(x * 0.2 + static_cast<double>(key)));
            }
        }
        page.charts.push_back(std::move(chart));
    }
    return page;
}

/// How many pixels of a picture have this colour.
int pixels_of(vtkImageData& image, int red, int green, int blue) {
    const int* size = image.GetDimensions();
    int count = 0;
    for (int y = 0; y < size[1]; ++y) {
        for (int x = 0; x < size[0]; ++x) {
            const auto* pixel = static_cast<const unsigned char*>(image.GetScalarPointer(x, y, 0));
            count += pixel[0] == red && pixel[1] == green && pixel[2] == blue;
        }
    }
    return count;
}

}  // namespace

TEST_CASE("charts: a line per plant holds its column over the steps", "[charts]") {
    const ChartPage drawn = page({table("a")}, {"modules", "light.mean"}, Lines::per_plant);
    CHECK(drawn.title == "a");
    CHECK(names(drawn) == std::vector<std::string>{"left", "right", "front"});
    REQUIRE(drawn.charts.size() == 2);
    CHECK(drawn.charts[0].y_title == "modules");
    REQUIRE(drawn.charts[0].series.size() == 3);
    CHECK(drawn.charts[0].series[1].x == std::vector<double>{0, 1});
    CHECK(drawn.charts[0].series[1].y == std::vector<double>{20, 21});
    CHECK(std::isnan(drawn.charts[1].series[2].y[0]));
    CHECK(drawn.keys[0].colour != drawn.keys[1].colour);
}

TEST_CASE("charts: plants of a species, or all, are summed, averaged, or their greatest and least taken", "[charts]") {
    const ChartPage species =
        page({table("a")}, {"modules", "height", "light.mean", "light.min", "light.max"}, Lines::per_species);
    CHECK(names(species) == std::vector<std::string>{"oak", "fern"});
    CHECK(species.charts[0].series[0].y == std::vector<double>{30, 32});
    CHECK(species.charts[1].series[0].y == std::vector<double>{3, 5});
    CHECK(species.charts[2].series[0].y[0] == Approx(0.6));
    CHECK(species.charts[3].series[0].y == std::vector<double>{0.1, 0.1});
    CHECK(species.charts[4].series[0].y == std::vector<double>{0.9, 0.9});
    const ChartPage total = page({table("a")}, {"modules", "light.mean"}, Lines::total);
    REQUIRE(total.keys.size() == 1);
    CHECK(total.charts[0].series[0].y == std::vector<double>{60, 63});
    CHECK(total.charts[1].series[0].y[0] == Approx(0.6));  // the plant without light does not count
}

TEST_CASE("charts: the mean of a stand weighs its plants by what they asked", "[charts]") {
    PlottedTable stand;
    stand.table.columns = {"step", "plant", "light.mean", "light.min", "light.queries"};
    // One plant asks a hundred times, one three times; the others are seeds (the last as older versions wrote them).
    stand.table.rows = {
        {7, 0, 0.48, 0.2, 100}, {7, 1, 0.44, 0.4, 3}, {7, 2, not_a_number, not_a_number, 0}, {7, 3, 0, 0, 0}};
    stand.plants = {{0, "a", "a.l"}, {1, "b", "a.l"}, {2, "c", "a.l"}, {3, "d", "a.l"}};
    const ChartPage drawn = page({stand}, {"light.mean", "light.min"}, Lines::total);
    CHECK(drawn.charts[0].series[0].y[0] == Approx((48 + 3 * 0.44) / 103));
    CHECK(drawn.charts[1].series[0].y[0] == 0.2);
}

TEST_CASE("charts: of several runs colours tell the runs and dashes the plants; a run may lack a quantity",
          "[charts]") {
    PlottedTable other = table("b");
    other.table.columns[4] = "shade.mean";
    const ChartPage drawn = page({table("a"), other}, {"modules", "light.mean"}, Lines::per_species);
    CHECK(names(drawn) == std::vector<std::string>{"a: oak", "a: fern", "b: oak", "b: fern"});
    CHECK(drawn.keys[0].colour == drawn.keys[1].colour);
    CHECK(drawn.keys[0].colour != drawn.keys[2].colour);
    CHECK(drawn.keys[0].dash == drawn.keys[2].dash);
    CHECK(drawn.keys[0].dash != drawn.keys[1].dash);
    CHECK(drawn.charts[0].series.size() == 4);
    CHECK(drawn.charts[1].series.size() == 2);
    CHECK(drawn.title.empty());
}

TEST_CASE("charts: another column may lie along x", "[charts]") {
    PlotOptions options;
    options.quantities = {"modules"};
    options.x = "light.max";
    const ChartPage drawn = chart_page(std::vector{table("a")}, options);
    CHECK(drawn.charts[0].x_title == "light.max");
    CHECK(drawn.charts[0].series[0].x == std::vector<double>{0.5, 0.6});
    CHECK(drawn.charts[0].series[0].y == std::vector<double>{11, 10});
}

TEST_CASE("charts: what is not asked for is chosen: main quantities that are not 0, lines that can be told apart",
          "[charts]") {
    CHECK(default_quantities(std::vector{table("a")}) == std::vector<std::string>{"height", "modules", "light.mean"});
    CHECK(page({table("a")}, {}, Lines::chosen).keys.size() == 3);
    PlottedTable stand = table("a");
    for (std::uint32_t plant = 3; plant < 12; ++plant) stand.plants.push_back({plant, "", "models/oak.l"});
    CHECK(names(page({stand}, {}, Lines::chosen)) == std::vector<std::string>{"oak", "fern"});
    for (RecordedPlant& plant : stand.plants) plant.model = "models/oak.l";
    CHECK(page({stand}, {}, Lines::chosen).keys.size() == 1);
}

TEST_CASE("charts: an unknown quantity is named with the nearest", "[charts]") {
    CHECK_THROWS_WITH(page({table("a")}, {"ligth.mean"}, Lines::chosen), Contains("did you mean 'light.mean'?"));
    CHECK_THROWS_AS(page({table("a")}, {"plants"}, Lines::chosen), UserError);
}

TEST_CASE("ticks: multiples of 1, 2 or 5 that hold the range, with short labels", "[charts]") {
    const Ticks height = ticks_over(0, 11.2, 6);
    CHECK(height.places == std::vector<double>{0, 2, 4, 6, 8, 10, 12});
    CHECK(height.labels.back() == "12");
    CHECK(ticks_over(0, 24800, 5).labels == std::vector<std::string>{"0", "5000", "10k", "15k", "20k", "25k"});
    CHECK(ticks_over(0, 2.4e6, 5).labels[1] == "500k");
    CHECK(ticks_over(0, 2.4e6, 5).labels.back() == "2.5M");
    CHECK(ticks_over(1'000'000, 1'000'003, 4).labels[1] == "1.000001M");
    for (const auto& [low, high] : {std::pair(1e6, 1e6 + 3), {0.3, 0.3 + 1e-9}, {-7e9, -7e9 + 5}, {1.0, 1 + 1e-11}}) {
        std::vector<std::string> labels = ticks_over(low, high, 4).labels;
        std::sort(labels.begin(), labels.end());
        CHECK(std::adjacent_find(labels.begin(), labels.end()) == labels.end());
    }
    CHECK(ticks_over(-0.35, 0.1, 5).places.front() == Approx(-0.4));
    CHECK(ticks_over(-0.35, 0.1, 5).labels.back() == "0.1");
    CHECK(ticks_over(3, 3, 4).low == 0);
    CHECK(ticks_over(3, 3, 4).high >= 3);
    CHECK(ticks_over(INFINITY, -INFINITY, 4).places.size() >= 2);
    CHECK(ticks_over(1e-9, 3e-9, 4).labels[1] != ticks_over(1e-9, 3e-9, 4).labels[2]);
}

TEST_CASE("pictures: a PNG has the size asked for, the background in its corners and both lines' colours",
          "[pictures]") {
    if (!can_draw()) return;
    const TemporaryFolder folder;
    for (const bool dark : {false, true}) {
        ChartPage drawn = waves();
        drawn.dark = dark;
        const auto path = folder.path() / (dark ? "dark.png" : "light.png");
        write_picture(drawn, {640, 410}, path);
        vtkNew<vtkPNGReader> reader;
        reader->SetFileName(path.c_str());
        reader->Update();
        vtkImageData& image = *reader->GetOutput();
        CHECK(image.GetDimensions()[0] == 640);
        CHECK(image.GetDimensions()[1] == 410);
        const auto* corner = static_cast<const unsigned char*>(image.GetScalarPointer(639, 0, 0));
        CHECK(int(corner[0]) == (dark ? 24 : 255));
        CHECK(pixels_of(image, dark ? 86 : 0, dark ? 180 : 114, dark ? 233 : 178) > 100);
        CHECK(pixels_of(image, dark ? 230 : 213, dark ? 159 : 94, 0) > 50);
    }
}

TEST_CASE("pictures: single points between gaps, lines of nothing and pages of nothing are drawn", "[pictures]") {
    if (!can_draw()) return;
    const TemporaryFolder folder;
    ChartPage sparse;
    sparse.keys = {{"sparse", 0, 0}, {"empty", 1, 0}};
    sparse.charts.push_back({"x",
                             "y",
                             {{0, {0, 1, 2, 3, 4}, {1, not_a_number, 2, not_a_number, not_a_number}},
                              {1, {}, {}},
                              {1, {not_a_number}, {not_a_number}}}});
    CHECK_NOTHROW(write_picture(sparse, {300, 200}, folder.path() / "sparse.png"));
    CHECK_NOTHROW(write_picture({}, {300, 200}, folder.path() / "nothing.png"));
}

TEST_CASE("pictures: an SVG is one, and the same page gives the same bytes", "[pictures]") {
    if (!can_draw()) return;
    const TemporaryFolder folder;
    for (const char* kind : {"svg", "png"}) {
        const auto first = folder.path() / (std::string("first.") + kind),
                   second = folder.path() / (std::string("second.") + kind);
        write_picture(waves(), {640, 410}, first);
        write_picture(waves(), {640, 410}, second);
        CHECK((text_of(first) == text_of(second)));
        CHECK(text_of(first).size() > 2000);
    }
    CHECK_THAT(text_of(folder.path() / "first.svg"), Catch::StartsWith("<svg") && Contains("</svg>"));
}

TEST_CASE("pictures: in an SVG a line lies where its numbers are, in the picture's own pixels", "[pictures]") {
    if (!can_draw()) return;
    const TemporaryFolder folder;
    ChartPage page;
    page.keys = {{"", 0, 0}};
    page.charts = {{"x", "y", {{0, {0, 5, 10}, {0, 10, 5}}}}};
    write_picture(page, {640, 410}, folder.path() / "line.svg");
    const std::string text = text_of(folder.path() / "line.svg");
    // Viewers apply a clip and a matrix in another order than VTK, and nothing of the line would be seen.
    CHECK_THAT(text, !Contains("clip-path") && !Contains("transform=\"matrix(3"));
    const std::size_t line = text.find("<polyline stroke=\"#0072b2\"");
    REQUIRE(line != std::string::npos);
    std::istringstream points(text.substr(text.find("points=\"", line) + 8));
    double x[3], y[3];
    char comma;
    for (int i = 0; i < 3; ++i) points >> x[i] >> comma >> y[i];
    REQUIRE(points);
    CHECK(x[1] - x[0] == Approx(x[2] - x[1]).margin(1));
    CHECK((y[0] - y[2]) == Approx((y[0] - y[1]) / 2).margin(1));  // down is more
    CHECK(x[0] > 20);
    CHECK(x[2] < 640);
    CHECK(y[1] > 0);
    CHECK(y[0] < 390);
    CHECK(x[2] - x[0] > 400);
    CHECK(y[0] - y[1] > 250);
}

TEST_CASE("pictures: other kinds, absurd sizes and places that are not there leave nothing behind", "[pictures]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_picture(waves(), {640, 410}, folder.path() / "waves.jpg"), UserError);
    if (!can_draw()) return;
    CHECK_THROWS_AS(write_picture(waves(), {0, 410}, folder.path() / "waves.png"), UserError);
    CHECK_THROWS_AS(write_picture(waves(), {100000, 410}, folder.path() / "waves.png"), UserError);
    CHECK_THROWS_AS(write_picture(waves(), {64, 41}, folder.path() / "no/waves.png"), RunError);
    CHECK_THROWS_AS(write_picture(waves(), {64, 41}, folder.path() / "no/waves.svg"), RunError);
    CHECK(std::filesystem::is_empty(folder.path()));
}

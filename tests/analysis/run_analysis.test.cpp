// From what a run recorded to its measures.
#include "espalier/analysis/run_analysis.h"

#include "espalier/base/error.h"

#include "analysis/branch_tree.h"
#include "analysis/leaves.h"
#include "archive/recorded_folder.h"
#include "catch.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

using namespace espalier;
using namespace espalier::analysis;

namespace {

FrameInternode internode(glm::vec3 base, glm::vec3 tip, std::int32_t bearer, std::uint32_t plant = 0) {
    FrameInternode result{};
    result.base = base;
    result.tip = tip;
    result.base_radius = result.tip_radius = 0.5F;
    result.bearer = InternodeIndex(bearer);
    result.plant = plant;
    return result;
}

/// A facet of a module: a triangle of area 0.5 at (x, 0, 0).
void add_facet(FrameGeometry& geometry, std::uint64_t identity, float x, Kind kind = Kind::organ,
               std::uint16_t symbol = 0) {
    const auto first = static_cast<std::int32_t>(geometry.points.size());
    for (const glm::vec3& corner : {glm::vec3(x, 0, 0), glm::vec3(x + 1, 0, 0), glm::vec3(x, 0, 1)}) {
        geometry.points.push_back(corner);
    }
    for (std::int32_t i = 0; i < 3; ++i) geometry.polygons.connectivity.push_back(first + i);
    geometry.polygons.offsets.push_back(static_cast<std::int32_t>(geometry.polygons.connectivity.size()));
    geometry.of_cells.identities.push_back(identity);
    geometry.of_cells.plants.push_back(0);
    geometry.of_cells.symbols.push_back(symbol);
    geometry.of_cells.kinds.push_back(kind);
}

std::vector<std::uint32_t> numbers_of(const RecordedRun& run) {
    std::vector<std::uint32_t> numbers;
    for (const RecordedPlant& plant : run.plants()) numbers.push_back(plant.number);
    return numbers;
}

std::vector<const RecordedFrame*> frames_in(const RecordedRun& run) {
    std::vector<const RecordedFrame*> frames;
    for (const RecordedFrame& frame : run.frames()) frames.push_back(&frame);
    return frames;
}

}  // namespace

TEST_CASE("a frame in several files is measured as in one", "[analysis]") {
    const RecordedFolder whole, cut("points_per_file = 1\n");
    const RecordedRun one(whole.folder.path), several(cut.folder.path);
    REQUIRE(several.frame(4).pieces().size() == 2);
    const auto rows_of = [](const RecordedRun& run) {
        return RunAnalysis(run, frames_of(run), numbers_of(run)).table().rows;
    };
    const auto a = rows_of(one), b = rows_of(several);
    REQUIRE(a.size() == 2 * one.frames().size());
    REQUIRE(b.size() == a.size());
    for (std::size_t row = 0; row < a.size(); ++row) {
        for (std::size_t i = 0; i < a[row].size(); ++i) {
            INFO("row " << row << ", column " << i);
            CHECK((a[row][i] == b[row][i] || (std::isnan(a[row][i]) && std::isnan(b[row][i]))));
        }
    }
}

TEST_CASE("internodes without length vanish, and what they bear stands on what they stand on", "[analysis]") {
    const std::vector<FrameInternode> internodes{
        internode({0, 0, 0}, {0, 1, 0}, -1), internode({0, 1, 0}, {0, 1, 0}, 0), internode({0, 1, 0}, {0, 2, 0}, 1),
        internode({0, 1, 0}, {1, 1, 0}, 1), internode({5, 0, 0}, {5, 3, 0}, -1, 7)};
    const std::vector<std::uint32_t> plants{7, 0};
    const std::vector<BranchTree> trees = branch_trees(internodes, plants);
    REQUIRE(trees.size() == 2);
    CHECK(trees[0].size() == 1);
    CHECK(trees[0].lengths[0] == 3);
    CHECK(trees[1].parents == std::vector<std::int32_t>{-1, 0, 0});
}

TEST_CASE("an axis that begins where its bearer begins stands beside it", "[analysis]") {
    const std::vector<FrameInternode> internodes{internode({0, 0, 0}, {0, 1, 0}, -1),
                                                 internode({0, 0, 0}, {1, 0, 0}, 0), internode({0, 1, 0}, {0, 2, 0}, 0),
                                                 internode({0, 1, 0}, {1, 2, 0}, 2)};
    const std::vector<std::uint32_t> plants{0};
    const BranchTree tree = branch_trees(internodes, plants).front();
    CHECK(tree.parents == std::vector<std::int32_t>{-1, -1, 0, 0});
}

TEST_CASE("leaves: facets of one module are one leaf, cylinders are none, symbols choose", "[analysis]") {
    FrameGeometry geometry;
    geometry.symbol_names = {"L", "K"};
    add_facet(geometry, 1, 0);
    add_facet(geometry, 1, 10);
    add_facet(geometry, 2, 20, Kind::polygon, 1);
    add_facet(geometry, 3, 30, Kind::cylinder);
    add_facet(geometry, 0, 40, Kind::patch);
    add_facet(geometry, 0, 50, Kind::patch);
    const std::vector<std::uint32_t> plants{0};
    const Leaves all = leaves_of(geometry, plants).front();
    REQUIRE(all.leaves.size() == 4);
    CHECK(all.leaves[0].area == Approx(1));
    CHECK(all.leaves[0].position.x == Approx(5 + 1.0 / 3));
    CHECK(total_area(all) == Approx(2.5));
    CHECK(leaves_of(geometry, plants, {"K"}).front().leaves.size() == 1);
}

TEST_CASE("a recorded run has a row per step and plant, and its files say the same", "[analysis]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    const RunAnalysis analysis(run, frames_in(run), numbers_of(run));
    const RecordedTable table = analysis.table();
    REQUIRE(table.rows.size() == 4);
    CHECK(table.columns.size() == measure_descriptions().size() + 3);
    const RecordedTable statistics = run.statistics();
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        for (const auto& other : statistics.rows) {
            if (other[0] != table.rows[i][0] || other[2] != table.rows[i][2]) continue;
            CHECK(table.rows[i][table.column("length")] == Approx(other[statistics.column("length")]));
            CHECK(table.rows[i][table.column("internodes")] == other[statistics.column("internodes")]);
        }
    }
    const auto folder = recorded.folder.path;
    analysis.write_csv(folder);
    analysis.write_json(folder);
    for (const char* name : {"orders.csv", "ramification.csv", "layers.csv", "internodes.csv"}) {
        CHECK(std::filesystem::file_size(folder / name) > 20);
    }
    std::ifstream csv(folder / "analysis.csv");
    std::string line;
    std::size_t lines = 0;
    while (std::getline(csv, line)) {
        ++lines;
        CHECK(static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) ==
              table.columns.size());  // and the name
        CHECK(line.find("nan") == std::string::npos);
    }
    CHECK(lines == 5);
    std::ifstream text(folder / "analysis.json");
    const nlohmann::json json = nlohmann::json::parse(text);
    REQUIRE(json["frames"].size() == 2);
    CHECK(json["frames"][1]["plants"][0]["internodes"] == table.rows[2][table.column("internodes")]);
    CHECK(json["plants"][1]["name"] == "right");
    CHECK(json["frames"][1]["plants"][0]["internode_lengths"].size() == 16);
}

TEST_CASE("a leaf symbol that no frame knows is named with the nearest", "[analysis]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    CHECK_THROWS_AS(RunAnalysis(run, frames_in(run), numbers_of(run), {{"Q"}}), UserError);
}

TEST_CASE("all plants and steps have the same layers, empty ones too, so that means over them are means",
          "[analysis]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    AnalysisOptions options;
    options.low = -2;
    options.high = 1;
    options.ground = 4;
    const RunAnalysis analysis(run, frames_in(run), numbers_of(run), options);
    const RecordedTable layers = analysis.last_layers();
    const std::size_t plant = layers.column("plant"), height = layers.column("height"),
                      length = layers.column("length"), density = layers.column("ground_density");
    std::map<double, std::vector<double>> heights;
    std::map<double, double> lengths;
    const double thickness = layers.rows[1][height] - layers.rows[0][height];
    for (const std::vector<double>& row : layers.rows) {
        heights[row[plant]].push_back(row[height]);
        lengths[row[plant]] += row[length];
        CHECK(row[density] == Approx(row[length] / (4 * thickness)));
    }
    REQUIRE(heights.size() == 2);
    CHECK(heights[0] == heights[1]);
    CHECK(heights[0].front() < -2 + thickness);
    const RecordedTable table = analysis.table();
    for (const auto& row : table.rows) {
        if (row[0] == table.rows.back()[0]) CHECK(lengths[row[2]] == Approx(row[table.column("length")]));
    }
}

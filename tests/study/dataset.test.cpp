// Data sets: the same bytes however often they were interrupted, values and splits that are drawn as the file says.
#include "study/dataset/dataset.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/stop.h"

#include "base/csv_rows.h"
#include "base/json_text.h"
#include "catch.h"
#include "picture/files/off_screen.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <set>

using namespace espalier;
using namespace espalier::study;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

const char* const bush =
    "#define ANGLE 30 /* of branches; 10..80; degrees */\n#define CHANCE 1\nlsystem: 1\nseed: 1\nderivation length: 4\n"
    "axiom: A\nA --> !(0.05)F(0.2+ran(0.1))[+(ANGLE)!(0.02)F(0.2){.f(.1).+(90)f(.1).+(90)f(.1).}]/(137)A : CHANCE\n"
    "A --> * : 1 - CHANCE\nendlsystem\n";

std::string file_of(const std::string& dataset, bool has_pictures) {
    return "[dataset]\nmodel = \"bush.l\"\nseed = 5\n" + dataset +
           "\n[scan]\nat = [[2, 0.5, 2]]\nangle = 2\nelevations = [-20, 40]\ndistance_noise = 0.002\n" +
           (has_pictures ? "[pictures]\nsize = [48, 36]\nazimuths = [0, 120]\n" : "");
}

/// A folder with the model and the file of a data set.
struct Files {
    TemporaryFolder folder;

    explicit Files(const std::string& dataset, bool has_pictures = false) {
        folder.write("bush.l", bush);
        folder.write("set.toml", file_of(dataset, has_pictures));
    }
    DatasetPlan plan() const { return read_dataset(folder.path() / "set.toml"); }
};

const auto unwatched = [](std::size_t, std::size_t) {};

std::map<std::string, std::string> bytes_below(const fs::path& folder) {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) bytes[fs::relative(entry, folder).string()] = text_of(entry);
    }
    return bytes;
}

}  // namespace

TEST_CASE("dataset: one that is interrupted, or made in parts, becomes the same bytes", "[dataset]") {
    const Files files("samples = 9\n[dataset.parameters]\nANGLE = \"20:60\"\n", picture::why_no_pictures().empty());
    const Dataset whole(files.plan(), files.folder.path() / "whole");
    whole.make({}, unwatched);
    const Dataset::Summary summary = whole.write_card();
    CHECK(summary.samples == 9);
    CHECK(summary.failed == 0);
    CHECK(summary.points > 100);

    const fs::path folder = files.folder.path() / "interrupted";
    const Dataset interrupted(files.plan(), folder);
    StopRequest request;
    {
        const StopRequest::Scope scope(&request);
        CHECK_THROWS_AS(interrupted.make({},
                                         [&](std::size_t done, std::size_t) {
                                             if (done == 3) request.ask();
                                         }),
                        Stopped);
    }
    CHECK(interrupted.to_do({}).size() == 6);
    // One of them was killed in the midst of its files.
    fs::create_directories(interrupted.folder_of(interrupted.samples()[4]));
    write_text(interrupted.folder_of(interrupted.samples()[4]) / "points.ply", "ply\n");
    const Dataset again(files.plan(), folder);
    again.make({}, unwatched);
    again.write_card();
    CHECK((bytes_below(folder) == bytes_below(files.folder.path() / "whole")));

    const Dataset parts(files.plan(), files.folder.path() / "parts");
    parts.make({1, 2}, unwatched);
    CHECK(parts.to_do({}).size() == 5);
    parts.make({0, 2}, unwatched);
    parts.write_card();
    CHECK((bytes_below(files.folder.path() / "parts") == bytes_below(files.folder.path() / "whole")));
}

TEST_CASE("dataset: values fill their ranges, splits are exact, and both follow the seed", "[dataset]") {
    const Files files("samples = 1005\nsplit = { train = 0.7, test = 0.3 }\n[dataset.parameters]\nANGLE = \"20:60\"\n");
    DatasetPlan plan = files.plan();
    const std::vector<DatasetSample> samples = samples_of(plan);
    std::map<std::string, int> splits;
    std::set<std::uint64_t> seeds;
    double sum = 0, of_tests = 0;
    for (const DatasetSample& sample : samples) {
        ++splits[sample.split];
        seeds.insert(sample.seed);
        REQUIRE(sample.values[0] >= 20);
        REQUIRE(sample.values[0] <= 60);
        REQUIRE(fmt::format("{:.6g}", sample.values[0]) == fmt::format("{}", sample.values[0]));
        sum += sample.values[0];
        of_tests += sample.split == "test" ? sample.values[0] : 0;
    }
    CHECK(splits == std::map<std::string, int>{{"train", 704}, {"test", 301}});
    CHECK(seeds.size() == samples.size());
    const double error = 40 / std::sqrt(12.0 * 1005);  // of the mean of a uniform distribution
    CHECK(sum / 1005 == Approx(40).margin(3 * error));
    CHECK(of_tests / 301 == Approx(40).margin(3 * error * std::sqrt(1005.0 / 301)));
    plan.seed = 6;
    const std::vector<DatasetSample> others = samples_of(plan);
    int same = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) same += samples[i].split == others[i].split;
    CHECK(same == Approx(1005 * (0.7 * 0.7 + 0.3 * 0.3)).margin(60));
}

TEST_CASE("dataset: points and pixels name organs of their plant, and the card tells the truth", "[dataset]") {
    const bool draws = picture::why_no_pictures().empty();
    const Files files("title = \"Bushes\"\nlicence = \"CC0-1.0\"\nsamples = 3\n", draws);
    const fs::path folder = files.folder.path() / "set";
    const Dataset dataset(files.plan(), folder);
    dataset.make({}, unwatched);
    const Dataset::Summary summary = dataset.write_card();
    const CsvRows rows(folder / "dataset.csv");
    CHECK(rows.rows().size() == 4);
    CHECK_THAT(text_of(folder / "README.md"), Contains("# Bushes\n\n3 samples of `bush.l`") &&
                                                  Contains("Licence: CC0-1.0") && Contains("| `train` | 2 |") &&
                                                  Contains("| `height` | m |") &&
                                                  Contains("espalier dataset set.toml --samples 3 --seed 5"));
    const auto card = read_json<nlohmann::json>(text_of(folder / "card.json"));
    CHECK(card["points"] == summary.points);
    CHECK(card["pictures"] == (draws ? 6 : 0));
    CHECK(card["splits"]["validation"]["samples"] == 1);
    CHECK(card["splits"]["test"]["samples"] == 0);
    const fs::path sample = folder / "samples/000001";
    const CsvRows organs(sample / "organs.csv");
    const std::string points = text_of(sample / "points.ply");
    CHECK_THAT(points, Contains("property double organ\n"));
    if (!draws) return;
    // The tables of scan and picture have the same organs, but for the pixels.
    const CsvRows seen(sample / "view-1-organs.csv");
    REQUIRE(seen.rows().size() == organs.rows().size());
    double pixels = 0;
    for (std::size_t i = 0; i < seen.rows().size(); ++i) {
        std::vector<std::string> cells = seen.rows()[i].cells;
        if (i > 0) pixels += std::stod(cells.back());
        cells.pop_back();
        CHECK(cells == organs.rows()[i].cells);
    }
    CHECK(pixels > 50);
}

TEST_CASE("dataset: a plant that cannot be drawn is a sample that says why", "[dataset]") {
    if (!picture::why_no_pictures().empty()) return;
    const Files files("samples = 8\n[dataset.parameters]\nCHANCE = \"0.2:0.6\"\n", true);
    const fs::path folder = files.folder.path() / "set";
    const Dataset dataset(files.plan(), folder);
    dataset.make({}, unwatched);
    const Dataset::Summary summary = dataset.write_card();
    CHECK(summary.failed > 0);
    CHECK(summary.failed < 8);
    CHECK_THAT(text_of(folder / "dataset.csv"), Contains("nothing to draw"));
}

TEST_CASE("dataset: what a file says wrongly is named with its place", "[dataset]") {
    for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
             {"[dataset]\nsamples = 3\n", "grows one thing"},
             {"[dataset]\nmodel = \"none.l\"\n", "none.l"},
             {"[dataset]\nmodel = \"bush.l\"\nsplit = { train = 0.5, test = 0.4 }\n", "add up to 0.9"},
             {"[dataset]\nmodel = \"bush.l\"\n[dataset.parameters]\nANGEL = \"1:2\"\n", "ANGEL"},
             {"[dataset]\nmodel = \"bush.l\"\n[dataset.parameters]\nCHANCE = \"0.5\"\n", "expected a range"},
             {"[dataset]\nmodel = \"bush.l\"\nlicense = \"CC0\"\n", "license"},
             {"[dataset]\nmodel = \"bush.l\"\n[scan]\nangle = 3\n", "one instrument"},
             {"[dataset]\nmodel = \"bush.l\"\n[scan]\nat = [[1, 2, 3]]\npulses = 3\n", "pulses"},
             {"[dataset]\nmodel = \"bush.l\"\n[scan]\nat = [[1, 2, 3]]\ncolumns = [\"hue\"]\n", "no such column"},
             {"[dataset]\nmodel = \"bush.l\"\n[pictures]\nsize = [0, 3]\n", "size"}}) {
        const TemporaryFolder folder;
        folder.write("bush.l", bush);
        folder.write("set.toml", text);
        INFO(text);
        CHECK_THROWS_WITH(read_dataset(folder.path() / "set.toml"), Contains(reason) && Contains("set.toml"));
    }
    const Files files("samples = 2\n");
    const Dataset first(files.plan(), files.folder.path() / "set");
    files.folder.write("bush.l", std::string(bush) + "\n");
    CHECK_THROWS_WITH(Dataset(files.plan(), files.folder.path() / "set"), Contains("holds another data set"));
}

// dataset: one command, its parts, and a command line that grows one of its plants again.
#include "base/csv_rows.h"
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;

TEST_CASE("dataset makes labelled plants in one command, and each of them grows again from its words", "[app]") {
    const Workplace place;
    place.write("reed.l",
                "#define LENGTH 1 /* of internodes; 0.1..2; m */\nlsystem: 1\nseed: 1\nderivation length: 3\naxiom: A\n"
                "A --> F(LENGTH+ran(0.5))A\nendlsystem\n");
    place.write("reeds.toml",
                "[dataset]\nmodel = \"reed.l\"\nsamples = 50\n[dataset.parameters]\nLENGTH = \"0.5:1.5\"\n"
                "[scan]\nat = [[3, 1, 0]]\nangle = 5\nformat = \"csv\"\n");
    const Outcome outcome = place.run("dataset reeds.toml --samples 6 --seed 3 --json");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(json::parse(outcome.out)["samples"] == 6);
    CHECK_THAT(text_of(place.path() / "output/reeds/samples/000005/points.csv"), Contains("organ,identity"));
    const json sample = json::parse(text_of(place.path() / "output/reeds/samples/000002/sample.json"));
    std::string words;
    for (const auto& word : sample["arguments"]) words += word.get<std::string>() + " ";
    REQUIRE(place.run(words + "--output again").code == 0);
    const espalier::CsvRows statistics(place.path() / "again/statistics.csv");
    const auto& header = statistics.rows().front().cells;
    const auto column = static_cast<std::size_t>(std::find(header.begin(), header.end(), "length") - header.begin());
    CHECK(statistics.number(statistics.rows().back(), column) ==
          Approx(sample["plants"][0]["length"].get<double>()).epsilon(1e-6));
    // Parts of it, as a cluster makes them.
    const Outcome commands = place.run("dataset reeds.toml --samples 6 --seed 3 --output parts --list 2");
    CHECK_THAT(commands.out, Contains("--samples 6 --seed 3 --part 2/2 --quiet"));
    CHECK(place.run("dataset reeds.toml --samples 6 --seed 3 --output parts --part 2/2 --quiet").code == 0);
    CHECK_FALSE(fs::exists(place.path() / "parts/dataset.csv"));
    CHECK(place.run("dataset reeds.toml --samples 6 --seed 3 --output parts --quiet").code == 0);
    CHECK(text_of(place.path() / "parts/dataset.csv") == text_of(place.path() / "output/reeds/dataset.csv"));
    CHECK_THAT(place.run("dataset reeds.toml --samples 6 --seed 3 --part 3/2").err, Contains("expected NUMBER/OF"));
    CHECK_THAT(place.run("dataset reeds.toml --samples 7").err, Contains("holds another data set"));
    CHECK_THAT(place.run("dataset none.toml").err, Contains("none.toml"));
}

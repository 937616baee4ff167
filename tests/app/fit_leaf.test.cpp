// fit-leaf: the parameters of a leaf come back from the tables of four instruments.
#include "catch.h"
#include "environment/leaf/measured/leaf_files.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <random>

using Catch::Contains;
using nlohmann::json;

namespace {

json fitted(const Workplace& place, const std::string& text, const std::string& options = "") {
    place.write("leaf.txt", text);
    const Outcome outcome = place.run("fit-leaf leaf.txt --json " + options);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("fit-leaf recovers V, Jmax, Rd and g1 from the table of each instrument", "[app][leaf]") {
    const Workplace place;
    for (const leaf_files::TrueLeaf& leaf : {leaf_files::TrueLeaf{}, leaf_files::TrueLeaf{28, 61, 0.7, 0.005, 6.1},
                                             leaf_files::TrueLeaf{110, 190, 2.6, 0.005, 1.9}}) {
        const std::vector<leaf_files::Row> rows = leaf_files::measured(leaf);
        for (const std::string& text : {leaf_files::li6400(rows), leaf_files::li6800(rows), leaf_files::gfs3000(rows),
                                        leaf_files::ciras4(rows)}) {
            const json found = fitted(place, text);
            INFO(found.dump());
            const json& is = found["parameters"];
            CHECK(is["v"]["value"] == Approx(leaf.v).epsilon(1e-3));
            CHECK(is["jmax"]["value"] == Approx(leaf.jmax).epsilon(1e-3));
            CHECK(is["rd"]["value"] == Approx(leaf.rd).epsilon(5e-3));
            CHECK(is["g1"]["value"] == Approx(leaf.g1).epsilon(1e-3));
            CHECK(found["confused"].empty());
        }
    }
}

TEST_CASE("the standard errors of fit-leaf are the scatter of fits to noisy leaves", "[app][leaf]") {
    const Workplace place;
    const leaf_files::TrueLeaf leaf{};
    std::mt19937 random(481);
    std::normal_distribution<> noise(0, 0.4);
    const std::vector<leaf_files::Row> clean = leaf_files::measured(leaf);
    double squares = 0, told = 0;
    constexpr int trials = 24;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<leaf_files::Row> rows = clean;
        for (leaf_files::Row& row : rows) row.a += noise(random);
        const json is = fitted(place, leaf_files::ciras4(rows), "--parameter v,jmax,rd")["parameters"];
        const double miss = is["v"]["value"].get<double>() - leaf.v;
        squares += miss * miss / trials;
        told += is["v"]["error"].get<double>() / trials;
    }
    CHECK(told / std::sqrt(squares) == Approx(1).margin(0.4));
}

TEST_CASE("fit-leaf says what a table does not decide", "[app][leaf]") {
    const Workplace place;
    const leaf_files::TrueLeaf leaf{};
    std::vector<leaf_files::Row> rows = leaf_files::measured(leaf);
    rows.resize(3);  // low Ci in strong light: Rubisco alone
    for (leaf_files::Row& row : rows)
        row.ci = 150 + row.ci / 1000, row.a = leaf_files::assimilation(leaf, row.absorbed, row.ci, 26, 99.2);
    place.write("low.txt", leaf_files::ciras4(rows));
    const Outcome pair = place.run("fit-leaf low.txt --parameter v,rd");
    INFO(pair.out + pair.err);
    CHECK(pair.code == 0);
    CHECK_THAT(pair.out, Contains("v and rd cannot be told apart") && Contains("more of v with more of rd"));
    rows = leaf_files::measured(leaf);
    rows.resize(4);
    place.write("low.txt", leaf_files::ciras4(rows));
    const Outcome light = place.run("fit-leaf low.txt --parameter v,jmax,rd");
    INFO(light.out + light.err);
    CHECK_THAT(light.out, Contains("jmax: the table does not decide it, as no row is limited by light"));
}

TEST_CASE("fit-leaf draws what it fitted, and prints lines for a scene", "[app][leaf]") {
    const Workplace place;
    place.write("leaf.txt", leaf_files::li6400(leaf_files::measured({})));
    const Outcome outcome = place.run("fit-leaf leaf.txt --output fit.svg");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("LI-6400, 15 rows") && Contains("\nv    = 62"));
    CHECK_THAT(text_of(place.path() / "fit.svg"), Contains("<svg") && Contains("circle"));
}

TEST_CASE("fit-leaf explains what it cannot do", "[app][leaf]") {
    const Workplace place;
    place.write("leaf.txt", leaf_files::li6400(leaf_files::measured({})));
    const auto mistake = [&](const std::string& options) {
        const Outcome outcome = place.run("fit-leaf " + options);
        CHECK(outcome.code == 1);
        return outcome.err;
    };
    CHECK_THAT(mistake("none.txt"), Contains("none.txt"));
    CHECK_THAT(mistake("leaf.txt --parameter vmax"), Contains("'vmax' cannot be fitted") && Contains("jmax"));
    CHECK_THAT(mistake("leaf.txt --parameter vp"), Contains("'vp' cannot be fitted"));
    CHECK_THAT(mistake("leaf.txt --set g2=1"), Contains("g2"));
    CHECK_THAT(mistake("leaf.txt --output fit.jpg"), Contains("fit.jpg"));
    place.write("two.txt", leaf_files::li6400({leaf_files::measured({})[0]}));
    CHECK_THAT(mistake("two.txt"), Contains("1 measures cannot decide 3"));
}

// Soils from their texture, from measured tables, and pressure heads with units.
#include "catch.h"
#include "environment/soil/hydraulics/heads.h"
#include "environment/soil/hydraulics/saxton_rawls.h"
#include "environment/soil/hydraulics/soil_table.h"
#include "environment/soil/hydraulics/texture_library.h"
#include "environment/soil/linear/soil.h"
#include "environment/soil/richards/column.h"
#include "temporary_folder.h"

#include <cmath>
#include <fstream>
#include <map>
#include <set>

using Catch::Contains;

namespace espalier::test {
namespace {

SoilKind kind_of(const std::string& soil) {
    return SoilBlock(column_of(0.1, 0.05, "soil = " + soil + "\n")).parameters.kinds[0].soil();
}

std::string mistake_in_kind(const std::string& soil) {
    return user_error([&] { kind_of(soil); });
}

}  // namespace

TEST_CASE("Saxton & Rawls' equations give their table 3", "[soil]") {
    struct Published {
        double sand, clay, wilting, field, saturated, mm_per_hour;
    };
    const Published table[] = {{88, 5, 5, 10, 46, 108.1},  {80, 5, 5, 12, 46, 96.7},   {65, 10, 8, 18, 45, 50.3},
                               {40, 20, 14, 28, 46, 15.5}, {20, 15, 11, 31, 48, 16.1}, {10, 5, 6, 30, 48, 22.0},
                               {60, 25, 17, 27, 43, 11.3}, {30, 35, 22, 36, 48, 4.3},  {10, 35, 22, 38, 51, 5.7},
                               {10, 45, 27, 41, 52, 3.7},  {50, 40, 25, 36, 44, 1.4},  {25, 50, 30, 42, 50, 1.1}};
    for (const Published& soil : table) {
        INFO(soil.sand << " % sand, " << soil.clay << " % clay");
        const SaxtonRawls computed(soil.sand, soil.clay, 2.5);
        CHECK(100 * computed.at_1500_kpa() == Approx(soil.wilting).margin(0.51));
        CHECK(100 * computed.at_33_kpa() == Approx(soil.field).margin(0.51));
        CHECK(100 * computed.saturated() == Approx(soil.saturated).margin(0.51));
        CHECK(computed.full_conductivity() / 2.4 == Approx(soil.mm_per_hour).margin(0.051));
        // The curve goes through what it is made of.
        CHECK(computed.content(-33 / 0.0980665) == Approx(computed.at_33_kpa()).epsilon(1e-9));
        CHECK(computed.content(-1500 / 0.0980665) == Approx(computed.at_1500_kpa()).epsilon(1e-9));
        CHECK(computed.content(-0.5 * computed.air_entry() / 0.0980665) == computed.saturated());
    }
}

TEST_CASE("a texture is read as percentages, of which one may be left out", "[soil]") {
    const SoilKind all = kind_of("{ sand = 40, silt = 40, clay = 20 }");
    CHECK(all.saturated == Approx(0.459).margin(0.0005));
    CHECK(all.conductivity == Approx(2.4 * 15.5).epsilon(0.003));
    CHECK(kind_of("{ sand = 40, clay = 20 }").saturated == all.saturated);
    CHECK(kind_of("{ silt = 40, clay = 20 }").saturated == Approx(all.saturated));
    CHECK(kind_of("{ sand = 40, clay = 20, organic_matter = 5 }").saturated > all.saturated);
    CHECK(kind_of("{ sand = 40, clay = 20, transfer = \"rosetta\" }") == kind_of("\"rosetta loam\""));
    CHECK(kind_of("{ sand = 40, clay = 20, transfer = \"carsel-parrish\" }") == kind_of("\"loam\""));
    CHECK_THAT(mistake_in_kind("{ sand = 40 }"), Contains("two of 'sand', 'silt' and 'clay'"));
    CHECK_THAT(mistake_in_kind("{ sand = 40, silt = 40, clay = 30 }"), Contains("110 % together"));
    CHECK_THAT(mistake_in_kind("{ sand = 90, clay = 30 }"), Contains("120 % together"));
    CHECK_THAT(mistake_in_kind("{ sand = 10, clay = 70 }"), Contains("at most 60 % clay"));
}

TEST_CASE("every texture belongs to a class, and the middle of a class to that", "[soil]") {
    const std::map<std::string, std::pair<double, double>> middles{{"sand", {92, 3}},
                                                                   {"loamy sand", {82, 6}},
                                                                   {"sandy loam", {65, 10}},
                                                                   {"loam", {40, 20}},
                                                                   {"silt", {7, 6}},
                                                                   {"silt loam", {20, 15}},
                                                                   {"sandy clay loam", {60, 27}},
                                                                   {"clay loam", {33, 34}},
                                                                   {"silty clay loam", {10, 34}},
                                                                   {"sandy clay", {52, 42}},
                                                                   {"silty clay", {7, 47}},
                                                                   {"clay", {20, 60}}};
    std::set<std::string_view> seen, named;
    for (const NamedSoil& soil : texture_library()) named.insert(soil.name);
    for (double sand = 0; sand <= 100; ++sand) {
        for (double clay = 0; clay <= 100 - sand; ++clay) seen.insert(texture_class(sand, clay));
    }
    CHECK(seen.size() == 12);
    for (const std::string_view name : seen) {
        CHECK(named.count(name) == 1);
        CHECK(named.count("rosetta " + std::string(name)) == 1);
    }
    for (const auto& [name, middle] : middles) CHECK(texture_class(middle.first, middle.second) == name);
}

TEST_CASE("Rosetta's mean sand and clay are the published logarithms", "[soil]") {
    const SoilKind sand = kind_of("\"rosetta sand\""), clay = kind_of("\"rosetta clay\"");
    CHECK(sand.alpha == Approx(0.0352).epsilon(0.002));
    CHECK(sand.n == Approx(3.177).epsilon(0.001));
    CHECK(sand.conductivity == Approx(642.7).epsilon(0.001));
    CHECK(clay.residual == 0.098);
    CHECK(clay.n == Approx(1.253).epsilon(0.001));
}

namespace {

/// Rows of a van Genuchten soil, `in_octave` in each octave of the head.
std::vector<SoilTable::Row> rows_of(const SoilKind& soil, int in_octave) {
    std::vector<SoilTable::Row> rows{{0, soil.saturated, soil.conductivity}};
    for (int i = 0; i <= 18 * in_octave; ++i) {
        const double head = -0.1 * std::exp2(double(i) / in_octave);
        const double saturation = effective_saturation(soil, head);
        rows.push_back({head, soil.residual + saturation * (soil.saturated - soil.residual), conductivity(soil, head)});
    }
    return rows;
}

}  // namespace

TEST_CASE("a table of a soil goes through its rows, and between them nears the soil as rows are added", "[soil]") {
    const SoilKind loam = kind_of(test_loam);
    double before = 1;
    for (const int in_octave : {1, 2, 4}) {
        const auto rows = rows_of(loam, in_octave);
        const SoilTable table(rows);
        for (std::size_t i = 1; i < rows.size(); ++i) {
            CHECK(table.content(rows[i].head) == Approx(rows[i].content).epsilon(1e-12));
            CHECK(table.conductivity(rows[i].head) == Approx(rows[i].conductivity).epsilon(1e-10));
        }
        double worst = 0;
        for (double head = -0.2; head > -20000; head *= 1.07) {
            const double content = loam.residual + effective_saturation(loam, head) * (loam.saturated - loam.residual);
            worst = std::max(worst, std::abs(table.content(head) - content));
            worst = std::max(worst, std::abs(std::log(table.conductivity(head) / conductivity(loam, head))));
        }
        CHECK(worst < before);
        before = worst / 3;  // at least of the second order
    }
    CHECK(before < 2e-3);
}

TEST_CASE("a table dries to nothing at pF 6.8, and never bends back", "[soil]") {
    const SoilTable table({{-1, 0.42, 30}, {-30, 0.4, 8}, {-330, 0.25, 0.02}, {-15300, 0.12, 1e-6}});
    CHECK(table.content(-0.2) == 0.42);
    CHECK(table.conductivity(-0.2) == 30);
    CHECK(table.content(-std::pow(10, 6.8)) == Approx(0).margin(1e-12));
    CHECK(table.content(-std::pow(10, 0.5 * (6.8 + std::log10(15300)))) == Approx(0.06).epsilon(1e-9));
    double content = 1, conducts = 1e9;
    for (double head = -0.01; head > -1e8; head *= 1.1) {
        CHECK(table.content(head) <= content);
        CHECK(table.conductivity(head) <= conducts);
        content = table.content(head);
        conducts = table.conductivity(head);
    }
}

TEST_CASE("rain wets a soil of a table as it does the soil that the table was made of", "[soil]") {
    const SoilKind loam = kind_of(test_loam);
    std::string heads, contents, conductivities;
    for (const SoilTable::Row& row : rows_of(loam, 4)) {
        const char* const comma = heads.empty() ? "" : ", ";
        heads += fmt::format("{}{}", comma, row.head);
        contents += fmt::format("{}{}", comma, row.content);
        conductivities += fmt::format("{}{}", comma, row.conductivity);
    }
    const std::string rest =
        "initial = { head = -400 }\n[boundaries]\ntop = { rain = 200 }\nbottom = \"free-drainage\"\n";
    SoilBlock exact(column_of(1, 0.02, "soil = " + test_loam + "\n" + rest));
    SoilBlock table(column_of(
        1, 0.02,
        fmt::format("soil = {{ heads = [{}], theta = [{}], k = [{}] }}\n", heads, contents, conductivities) + rest));
    exact.advance(0.5);
    table.advance(0.5);
    CHECK(table.front(0.25) == Approx(exact.front(0.25)).epsilon(0.003));
    for (int y = 0; y < exact.height(); ++y) CHECK(table.content(y) == Approx(exact.content(y)).margin(0.004));
    CHECK(std::abs(table.soil.balance().relative_error()) < 1e-9);
}

TEST_CASE("a table of a soil comes from a file, in any order of rows and in hPa", "[soil]") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "loam.csv")
        << "head,theta,k\n-15000,0.1,1e-6\n-10,0.4,20\n-330,0.25,0.02\n0,0.43,50\n";
    const std::string file = (folder.path() / "loam.csv").string();
    const SoilKind soil = kind_of("{ file = \"" + file + "\", unit = \"hPa\" }");
    CHECK(soil.saturated == 0.43);
    CHECK(soil.conductivity == 50);
    CHECK(soil.curves->content(-330 * 1.019716) == Approx(0.25).epsilon(1e-6));
    CHECK(soil.curves->content(-5 * 1.019716) == Approx(0.415).epsilon(1e-5));  // straight in the head down to 0
    std::ofstream(folder.path() / "loam.csv") << "head,theta,k\n-10,0.4,20\n-330,0.45,0.02\n";
    CHECK_THAT(mistake_in_kind("{ file = \"" + file + "\" }"),
               Contains("-330 cm, theta is 0.45") && Contains("both fall"));
    CHECK_THAT(mistake_in_kind("{ heads = [-10, -1000], theta = [0.4, 0.3], k = [20, 10] }"),
               Contains("must fall faster"));
    CHECK_THAT(mistake_in_kind("{ heads = [-10], theta = [0.4], k = [20] }"), Contains("two heads below 0"));
    CHECK_THAT(mistake_in_kind("{ heads = [-10, -100], theta = [0.4], k = [20, 1] }"), Contains("as many 'heads'"));
}

TEST_CASE("a pressure head may have a unit", "[soil]") {
    const auto head = [](const std::string& value) {
        return read_head(Settings::parse_toml("h = " + value, "heads.toml"), "h", Range::between(-1e6, 1e5));
    };
    CHECK(head("-150") == -150);
    CHECK(head("\"-1 MPa\"") == Approx(-10197.162).epsilon(1e-7));
    CHECK(head("\"-1500 kPa\"") == Approx(head("\"-1.5 MPa\"")).epsilon(1e-14));
    CHECK(head("\"-330 hPa\"") == Approx(-336.5064).epsilon(1e-6));
    CHECK(head("\"-15 bar\"") == Approx(head("\"-1.5 MPa\"")).epsilon(1e-14));
    CHECK(head("\"-2.5 m\"") == Approx(-250));
    CHECK(head("\"pF 4.2\"") == Approx(-15848.93).epsilon(1e-6));
    CHECK(head("\"2 pF\"") == Approx(-100));
    const auto mistake = [&](const std::string& value) { return user_error([&] { head(value); }); };
    CHECK_THAT(mistake("\"-1.5\""), Contains("a number, a blank and a unit"));
    CHECK_THAT(mistake("\"-1.5 Mpa\""), Contains("did you mean 'MPa'?"));
    CHECK_THAT(mistake("\"-200 MPa\""), Contains("'h' is -200 MPa") && Contains("not between"));
    CHECK(read_heads(Settings::parse_toml("h = [\"-1 hPa\", \"-1.6 MPa\"]", "h.toml"), "h", Range::any())[1] ==
          Approx(-16315.459).epsilon(1e-6));
    const SoilKind soil = kind_of(
        "{ model = \"brooks-corey\", theta_r = 0.05, theta_s = 0.4, air_entry = \"-2 kPa\", "
        "lambda = 0.4, ks = 20 }");
    CHECK(1 / soil.alpha == Approx(20.39432).epsilon(1e-6));
}

}  // namespace espalier::test

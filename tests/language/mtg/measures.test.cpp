// Multiscale tree graphs as programs and people write them: abbreviations, scales, units, dates, several plants.
#include "catch.h"
#include "language/measured_file.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;

namespace {

const MeasuredText mtg_file{"mtg", "tree.mtg"};

const std::string mtg_classes =
    "CODE :\tFORM-A\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n$ \t0\tFREE\tFREE\tIMPLICIT\n"
    "P\t1\tFREE\tFREE\tEXPLICIT\nB\t2\tFREE\tFREE\tEXPLICIT\nS\t3\tFREE\tFREE\tEXPLICIT\nDESCRIPTION :\n"
    "LEFT\tRIGHT\tRELTYPE\tMAX\nS\tS\t+\t?\nFEATURES:\nNAME\tTYPE\n";

/// With two columns of entities, in metres.
std::string mtg_tree(const std::string& rows, const std::string& columns = "XX\tYY\tZZ",
                     const std::string& unit = "m") {
    const std::string comment = unit.empty() ? "" : "# unit: " + unit + "\n";
    return comment + mtg_classes +
           "Date\tDD/MM/YY\nDay\tDD/MM\nMonth\tMM/YY\nHour\tDD/MM-TIME\nMTG :\nENTITY-CODE\t\t" + columns + "\n" + rows;
}

std::size_t tips_of_mtg(const MeasuredPlants& plants) {
    return plants.axes.size();
}

double day_of_last(const std::string& text) {
    return mtg_file.read(text).axes.front().nodes.back().day;
}

}  // namespace

TEST_CASE("MTG: ^ goes on from the last entity of its column and of its own scale", "[mtg]") {
    const std::string text =
        mtg_tree("/P1/B1/S1\t\t0\t0\t1\n^<S2\t\t0\t0\t2\n^+B2\n\t/S1\t1\t0\t2\n\t^<S2\t2\t0\t2\n^<S3\t\t0\t0\t3\n");
    CHECK(mtg_file.summary(text).length == Approx(4.0));
    CHECK(tips_of_mtg(mtg_file.read(text)) == 2);
    // The same without a column for what is borne.
    const std::string in_one_column =
        mtg_tree("/P1/B1/S1\t\t0\t0\t1\n^<S2\t\t0\t0\t2\n^<S3\t\t0\t0\t3\n^+B2/S1\t\t1\t0\t3\n^<S2\t\t2\t0\t3\n");
    CHECK(mtg_file.summary(in_one_column).length == Approx(4.0));
}

TEST_CASE("MTG: an axis that bears another one goes on by its own entities", "[mtg]") {
    const std::string text =
        mtg_tree("/P1\n\t/B1/S1\t0\t0\t1\n\t^<S2\t0\t0\t2\n\t^+B2/S1\t1\t0\t2\n\t^+B3/S1\t1\t3\t2\n");
    const MeasuredPlants plants = mtg_file.read(text);
    REQUIRE(plants.axes.size() == 3);
    CHECK(plants.axes[2].order == 2);
    CHECK(summary_of(plants).length == Approx(1 + 1 + 3));
}

TEST_CASE("MTG: a row of entities shares its features, and its last one has the coordinates", "[mtg]") {
    const std::string rest = "/P1/B1/S1\t\t0\t0\t0\t0.3\n";
    const MeasuredPlants shared = mtg_file.read(mtg_tree(rest + "^<S2<<S5\t\t0\t0\t4\t0.2\n", "XX\tYY\tZZ\tdiameter"));
    REQUIRE(shared.axes[0].nodes.size() == 5);
    CHECK(shared.axes[0].nodes[1].at.y == Approx(1));
    CHECK(shared.axes[0].nodes[1].diameter == 0.2);
    for (const char* const row : {"S2<.S5", "S2<.<S5"}) {
        const auto last = mtg_file.read(mtg_tree(rest + "^<" + row + "\t\t0\t0\t4\t0.2\n", "XX\tYY\tZZ\tdiameter"));
        CHECK(last.axes[0].nodes[3].diameter == 0.3);
        CHECK(last.axes[0].nodes[4].diameter == 0.2);
    }
    const MeasuredPlants borne = mtg_file.read(mtg_tree(rest + "^+S2++S4\t\t0\t0\t3\n"));
    REQUIRE(borne.axes.size() == 2);  // S2 and S3 are nowhere
    CHECK(borne.axes[1].label == "S4");
    CHECK(summary_of(borne).length == Approx(3));
}

TEST_CASE("MTG: rows with * measure an entity again", "[mtg]") {
    const std::string text = mtg_tree(
        "/P1/B1/S1\t\t0\t0\t1\t0.1\t01/03/2007\n*\t\t\t\t\t0.2\t31/12/2007\n*\t\t\t\t\t0.3\t\n"
        "^<S2\t\t0\t0\t2\t0.1\t11/03/2007\n",
        "XX\tYY\tZZ\tdiameter\tDate");
    const MeasuredPlants plants = mtg_file.read(text);
    REQUIRE(plants.axes[0].nodes.size() == 2);
    CHECK(plants.axes[0].nodes[0].diameter == 0.3);
    CHECK(plants.axes[0].nodes[0].day == 0);
    CHECK(plants.axes[0].nodes[1].day == 10);
    CHECK(plants.has_times);
    CHECK_THAT(mtg_file.warnings(text),
               Catch::Contains("the last measures are drawn") && Catch::Contains("(2 places)"));
    CHECK_THAT(mtg_file.mistake(mtg_tree("*\t\t0\t0\t1\n")), Catch::Contains("no entity above"));
}

TEST_CASE("MTG: dates have the forms that FEATURES declares, and count from the first", "[mtg]") {
    const auto with = [](const char* column, const char* first, const char* second) {
        return mtg_tree(std::string("/P1/B1/S1\t\t0\t0\t1\t") + first + "\n^<S2\t\t0\t0\t2\t" + second + "\n",
                        std::string("XX\tYY\tZZ\t") + column);
    };
    CHECK(day_of_last(with("Date", "16/07/2007", "01/12/2008")) == 504);
    CHECK(day_of_last(with("Date", "16/07/07", "01/12/08")) == 504);
    CHECK(day_of_last(with("Day", "28/02", "02/03")) == 2);
    CHECK(day_of_last(with("Month", "12/2007", "02/2008")) == 62);
    CHECK(day_of_last(with("Hour", "28/02-06:00", "01/03-18:00")) == Approx(1.5));
    CHECK_FALSE(mtg_file.read(with("Date", "16/07/2007", "16/07/2007")).has_times);
    CHECK_THAT(mtg_file.warnings(with("Date", "16/07/2007", "31/02/2007")), Catch::Contains("holds what is no date"));
}

TEST_CASE("MTG: coordinates of an axis are where its first piece begins", "[mtg]") {
    const std::string text =
        mtg_tree("/P1\n^/B1\t\t0\t0\t-1\n^/S1\t\t0\t0\t1\n^<S2\t\t0\t0\t2\n\t+B2\t0.5\t0\t2\n\t^/S1\t2\t0\t2\n");
    const MeasuredPlants plants = mtg_file.read(text);
    const MeasuredSummary summary = summary_of(plants);
    CHECK(summary.length == Approx(2 + 1 + 1.5));
    // From the trunk's axis to where the branch begins is nobody's.
    CHECK(summary.link_length == Approx(0.5));
    CHECK(plants.axes[0].nodes.front().at == glm::dvec3(0, -1, 0));
}

TEST_CASE("MTG: a radius, and diameters at both ends", "[mtg]") {
    const auto diameter = [](const std::string& columns, const std::string& cells) {
        return mtg_file.read(mtg_tree("/P1/B1/S1\t\t0\t0\t1\t" + cells + "\n", "XX\tYY\tZZ\t" + columns))
            .axes[0]
            .nodes[0]
            .diameter;
    };
    CHECK(diameter("radius", "0.1") == 0.2);
    CHECK(diameter("TopDia", "0.1") == 0.1);
    CHECK(diameter("BotDia", "0.3") == 0.3);
    CHECK(diameter("BotDia\tTopDia", "0.3\t0.1") == Approx(0.2));
}

TEST_CASE("MTG: coordinates in cm beside diameters in mm are told by their numbers", "[mtg]") {
    const std::string rows = "/P1/B1/S1\t\t0\t0\t10\t90\n^<S2\t\t5\t0\t310\t60\n^<S3\t\t0\t0\t420\t8\n";
    const std::string text = mtg_tree(rows, "XX\tYY\tZZ\tTopDia", "");
    const MeasuredPlants plants = mtg_file.read(text);
    CHECK(plants.axes[0].nodes[2].at.y == Approx(4.2));
    CHECK(plants.axes[0].nodes[0].diameter == Approx(0.09));
    CHECK_THAT(mtg_file.warnings(text), Catch::Contains("says no unit; it is taken as cm, diameters mm"));
    // What the file says is not guessed: of a column, too.
    const std::string said = "# unit TopDia: mm\n" + mtg_tree(rows, "XX\tYY\tZZ\tTopDia", "cm");
    CHECK(mtg_file.read(said).axes[0].nodes[0].diameter == Approx(0.09));
    CHECK(mtg_file.warnings(said).empty());
    // Nor is the unit of lengths, if the user says it.
    MeasuredOptions options;
    options.unit = "cm";
    CHECK_THAT(mtg_file.warnings(text, options), Catch::Contains("the unit of diameters is taken as 1 mm"));
    CHECK(mtg_file.read(text, options).axes[0].nodes[2].at.y == Approx(4.2));
}

TEST_CASE("MTG: of units that fit alike the usual ones count, and no trunk is thicker than trees are", "[mtg]") {
    const auto unit_of = [](const std::string& rows) {
        return mtg_file.read(mtg_tree(rows, "XX\tYY\tZZ\tTopDia", "")).unit;
    };
    // 1 m high and 55 mm thick, or 5.5 mm: eighteen or 182 times as large as thick.
    CHECK(unit_of("/P1/B1/S1\t\t0\t0\t0\t55\n^<S2\t\t0\t0\t100\t45\n") == "cm, diameters mm");
    // Tenths of a millimetre still are what fits best.
    CHECK(unit_of("/P1/B1/S1\t\t0\t0\t0\t300\n^<S2\t\t0\t0\t2000\t100\n") == "mm, diameters 0.1 mm");
    CHECK(unit_of("/P1/B1/S1\t\t0\t0\t0\t20\n^<S2\t\t0\t0\t120\t10\n") == "cm, diameters mm");
    CHECK(unit_of("/P1/B1/S1\t\t0\t0\t0\t3\n^<S2\t\t0\t0\t30\t1\n") == "m");
}

TEST_CASE("MTG: a plant of more than 150 m is told", "[mtg]") {
    const std::string rows = "/P1/B1/S1\t\t0\t0\t0\t1\n^<S2\t\t0\t0\t650\t1\n";
    CHECK_THAT(mtg_file.warnings(mtg_tree(rows, "XX\tYY\tZZ\tdiameter", "m")), Catch::Contains("is 650 m large"));
    CHECK(mtg_file.warnings(mtg_tree(rows, "XX\tYY\tZZ\tdiameter", "cm")).empty());
    CHECK(mtg_file.summary(mtg_tree(rows, "XX\tYY\tZZ\tdiameter", "")).length == Approx(6.5));
}

TEST_CASE("MTG: a file that lies on its side is told", "[mtg]") {
    const std::string text = mtg_tree("/P1/B1/S1\t\t0\t1\t0\t1\n^<S2\t\t0\t9\t0\t1\n", "XX\tYY\tZZ\tdiameter");
    CHECK_THAT(mtg_file.warnings(text), Catch::Contains("z is taken, but its trunks run along y"));
    MeasuredOptions options;
    options.up = "y";
    CHECK(mtg_file.warnings(text, options).empty());
    CHECK(mtg_file.summary(text, options).extent[1].y == 9);
}

TEST_CASE("MTG: several plants, a scene, mtg_classes and columns that nothing declares", "[mtg]") {
    const std::string text = mtg_tree(
        "/Scene0\n^/P1/B1/S1\t\t0\t0\t0\tash\n^<S2\t\t0\t0\t1\n/Scene0/P2/B1/S1\t\t5\t0\t0\n^<S2\t\t5\t0\t2\n"
        "^+T1\t\t6\t0\t2\n",
        "XX\tYY\tZZ\tplant");
    const MeasuredPlants plants = mtg_file.read(text);
    REQUIRE(plants.plants.size() == 2);
    CHECK(plants.plants[0].label == "ash");
    CHECK(plants.plants[1].label == "P2");
    CHECK(plants.axes.size() == 3);
    CHECK(summary_of(plants).length == Approx(1 + 2 + 1));
    CHECK_THAT(mtg_file.warnings(text),
               Catch::Contains("CLASSES: does not list 'Scene': it is taken for one of scale 0") &&
                   Catch::Contains("'T': it is taken for one of scale 3"));
}

TEST_CASE("MTG: columns and cells that nothing reads are named once", "[mtg]") {
    const std::string text =
        mtg_tree("/P1/B1/S1\t\t0\t0\t1\t3\tbark\n^<S2\t\t0\t0\t2\t4\n^<S3\n", "XX\tYY\tZZ\tpsi\tNote");
    CHECK_THAT(mtg_file.warnings(text), Catch::Contains("column 'psi' is not used (2 places)\n") &&
                                            Catch::Contains("column 'Note' is not used\n") &&
                                            Catch::Contains("no entity has a diameter") &&
                                            Catch::Contains("at the end of an axis are left out\n"));
}

TEST_CASE("MTG: a file without coordinates says what it lacks", "[mtg]") {
    CHECK_THAT(mtg_file.mistake(mtg_tree("/P1/B1/S1\t\t3\n", "nbEl")),
               Catch::Contains("no entity of this file has numbers in the columns XX, YY and ZZ") &&
                   Catch::Contains("its columns are nbEl"));
}

TEST_CASE("MTG: malformed files end in one line", "[mtg]") {
    CHECK_THAT(mtg_file.mistake(mtg_tree("/P1/B1/S5<<S2\t\t0\t0\t1\n")), Catch::Contains("to a higher one"));
    CHECK_THAT(mtg_file.mistake(mtg_tree("/P1/B1/S1<<S900000000\t\t0\t0\t1\n")),
               Catch::Contains("over 100000 at most"));
    CHECK_THAT(mtg_file.mistake(mtg_tree("/P1/B1/S1<<T9\t\t0\t0\t1\n")), Catch::Contains("to a higher one"));
    const std::string wide = mtg_tree("/P1/B1/S1\t\t0\t0\t1\n", "XX\tYY\tZZ" + std::string(1'000'000, '\t') + "end");
    CHECK(mtg_file.mistake(wide).empty());
    CHECK_THAT(mtg_file.mistake(mtg_tree(std::string(1'000'000, '\t') + "+S1\n", "")),
               Catch::Contains("no entity above"));
}

TEST_CASE("MTG: a hundred thousand entities", "[mtg]") {
    std::string rows = "/P1/B1/S1\t\t0\t0\t0.001\t0.001\n";
    for (int i = 2; i <= 100'000; ++i) {
        const std::string height = std::to_string(i);
        rows += "^<S" + height + "\t\t0\t0\t" + height + "e-3\t0.001\n";
    }
    const MeasuredSummary summary = mtg_file.summary(mtg_tree(rows, "XX\tYY\tZZ\tdiameter"));
    CHECK(summary.nodes == 100'000);
    CHECK(summary.length == Approx(99.999));
    CHECK(summary.surface == Approx(99.999 * 0.001 * std::numbers::pi));
}

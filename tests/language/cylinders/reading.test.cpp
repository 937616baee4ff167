// Cylinder models: the tables of several programs, links to the bearer's axis, and malformed ones.
#include "catch.h"
#include "language/cylinders/dialect.h"
#include "language/measured_file.h"
#include "temporary_folder.h"

#include <numbers>
#include <string>

using namespace espalier;

namespace {

const MeasuredText cylinder_table{"cylinders", "tree.csv"};

const std::string treeqsm_head =
    "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent,extension,added,UnmodRadius,branch\n";

/// A trunk of two cylinders, and a branch that begins on its surface, halfway up the first; the second cylinder of the
/// branch begins 2 cm behind the end of its first.
const std::string treeqsm = treeqsm_head +
                            "0.1,1,0,0,0,0,0,1,0,2,0,0.12,1\n"
                            "0.08,1,0,0,1,0,0,1,1,0,0,0.08,1\n"
                            "0.02,0.5,0.1,0,0.5,2,0,0,1,4,0,0.02,2\n"
                            "0.01,0.25,0.62,0,0.5,1,0,0,3,0,0,0.01,2\n";

const std::string simple_forest =
    " ID, parentID, startX, startY, startZ, endX, endY, endZ, radius, length, growthLength, branchOrder, branchID\n"
    "0,-1,0,0,0,0,0,1,0.1,1,3.5,0,0\n1,0,0,0,1,0,0,2,0.08,1,1,0,0\n2,0,0,0,1,0.5,0,1,0.02,0.5,0.5,1,0\n";

const std::string archi =
    "startX;startY;startZ;endX;endY;endZ;cyl_ID;parent_ID;extension_ID;radius_cyl;length;volume;axis_ID;segment_ID;"
    "node_ID;branching_order\n0;0;0;0;0;1;1;0;2;0.1;1;0;1;1;1;1\n0;0;1;0;0;2;2;1;0;0.08;1;0;1;1;1;1\n"
    "0.1;0;0.5;0.6;0;0.5;3;1;0;0.02;0.5;0;2;1;1;2\n";

}  // namespace

TEST_CASE("cylinders: a branch begins on its bearer's surface, and each cylinder keeps its length", "[cylinders]") {
    const MeasuredPlants plants = cylinder_table.read(treeqsm);
    const MeasuredSummary summary = summary_of(plants);
    REQUIRE(plants.axes.size() == 2);
    CHECK(summary.axes_of_order == std::vector<std::size_t>{1, 1});
    CHECK(summary.length == Approx(2.75));
    CHECK(summary.link_length == Approx(0.1 + 0.02));
    CHECK(summary.volume == Approx(std::numbers::pi * (0.01 + 0.0064 + 0.0002 + 0.000025)));
    // The trunk is divided where the branch hangs on it.
    CHECK(plants.axes[0].nodes[plants.axes[1].on_node].at.y == Approx(0.5));
    CHECK(plants.axes[1].label == "branch 2");
    CHECK_THAT(cylinder_table.warnings(treeqsm),
               Catch::Contains("column 'UnmodRadius' is not used (4 places)") && !Catch::Contains("'radius'"));
}

TEST_CASE("cylinders: programs are told apart by their headers", "[cylinders]") {
    const auto program = [](const std::string& text) {
        return std::string(language::cylinders::header_of(text.substr(0, text.find('\n')))->dialect->program);
    };
    CHECK(program(treeqsm) == "TreeQSM");
    CHECK(program(simple_forest) == "SimpleForest");
    CHECK(program(archi) == "aRchi");
    for (const std::string& text : {simple_forest, archi}) {
        const MeasuredPlants plants = cylinder_table.read(text);
        CHECK(plants.plants.size() == 1);
        CHECK(plants.axes.size() == 2);
        CHECK(plants.axes[1].order == 1);
        CHECK(summary_of(plants).length == Approx(2.5));
    }
    CHECK(cylinder_table.summary(simple_forest).link_length == 0);
    CHECK(language::cylinders::is_cylinder_model("\n# of a scan\n" + archi));
    CHECK_FALSE(language::cylinders::is_cylinder_model("time,temperature\n0,20\n"));
}

TEST_CASE("cylinders: the tables of MATLAB, of R and of TreeQSM itself are the same tree", "[cylinders]") {
    const auto with_head = [](std::string head, char separator) {
        std::string text = head + treeqsm.substr(treeqsm_head.size() - 1);
        std::replace(text.begin(), text.end(), ',', separator);
        return text;
    };
    for (const std::string& text :
         {with_head(
              "radius,length,start_1,start_2,start_3,axis_1,axis_2,axis_3,parent,extension,added,UnmodRadius,branch",
              ','),
          with_head("\"radius\",\"length\",\"start.x\",\"start.y\",\"start.z\",\"axis.x\",\"axis.y\",\"axis.z\",parent,"
                    "extension,added,UnmodRadius,branch",
                    ';'),
          with_head("radius (m),length (m),start_point,axis_direction,parent,extension,added,UnmodRadius (m),branch",
                    '\t'),
          with_head("Rad,Len,Sta1,Sta2,Sta3,Axe1,Axe2,Axe3,CPar,CExt,Added,UnmodRadius,BoC1", ',')}) {
        CHECK(cylinder_table.summary(text).length == Approx(2.75));
        CHECK(cylinder_table.summary(text).link_length == Approx(0.12));
    }
}

TEST_CASE("cylinders: rows may stand in any order", "[cylinders]") {
    const std::size_t first = simple_forest.find('\n') + 1;
    const std::size_t last = simple_forest.rfind('\n', simple_forest.size() - 2) + 1;
    const std::string turned =
        simple_forest.substr(0, first) + simple_forest.substr(last) + simple_forest.substr(first, last - first);
    CHECK(cylinder_table.summary(turned).length == Approx(2.5));
}

TEST_CASE("cylinders: what the user says of unit and axes counts", "[cylinders]") {
    MeasuredOptions options;
    options.unit = "cm";
    options.up = "x";
    const MeasuredSummary summary = cylinder_table.summary(treeqsm, options);
    CHECK(summary.length == Approx(0.0275));
    CHECK(summary.extent[1].y == Approx(0.0087));
}

TEST_CASE("cylinders: malformed tables end in one line", "[cylinders]") {
    const auto row = [](const std::string& ends) { return "0.1,1,0,0,0,0,0,1," + ends + ",0,0.1,1\n"; };
    CHECK(cylinder_table.mistake(treeqsm_head) == "tree.csv:1:1: this file has no cylinders");
    CHECK_THAT(cylinder_table.mistake(treeqsm_head + row("7,0")),
               Catch::Contains("tree.csv:2:1: there is no number 7"));
    CHECK_THAT(cylinder_table.mistake(treeqsm_head + row("0,0") + row("3,0") + row("2,0")),
               Catch::Contains("tree.csv:3:1: the parents of 2 lead round in a ring"));
    CHECK_THAT(cylinder_table.mistake(treeqsm_head + "0.1,1,0,0,zero,0,0,1,0,0,0,0,1\n"),
               Catch::Contains("tree.csv:2:5: column start_z of a cylinder is a number, not 'zero'"));
    CHECK_THAT(cylinder_table.mistake(treeqsm_head + "0.1,1\n"), Catch::Contains("is a number, not ''"));
    CHECK_THAT(cylinder_table.mistake(treeqsm_head + "0.1,1,0,0,0,0,0,0,0,0,0,0,1\n"),
               Catch::Contains("has no direction"));
    CHECK_THAT(cylinder_table.mistake(treeqsm_head + "-0.1,1,0,0,0,0,0,1,0,0,0,0,1\n"), Catch::Contains("not below 0"));
    CHECK_THAT(cylinder_table.mistake(simple_forest + "2,0,0,0,1,0.5,0,1,0.02,0.5,0.5,1,0\n"),
               Catch::Contains("the number 2 stands on line 4, too"));
    CHECK_THAT(cylinder_table.mistake(std::string(1'000'000, ',') + "\n"),
               Catch::Contains("no header of a cylinder model"));
}

TEST_CASE("cylinders: between semicolons a comma may stand for the point", "[cylinders]") {
    std::string text = archi;
    for (std::size_t at = text.find('\n'); (at = text.find('.', at)) != std::string::npos;) text[at] = ',';
    CHECK(cylinder_table.summary(text).volume == Approx(cylinder_table.summary(archi).volume));
    CHECK(cylinder_table.summary(text).link_length == Approx(0.1));
}

TEST_CASE("points and files of other programs are told for what they are where plants are read", "[cylinders]") {
    const TemporaryFolder folder;
    const auto mistake = [&](const std::string& name, const std::string& text) {
        try {
            read_measured_plants(folder.write(name, text));
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(mistake("a.las", "LASF"), Catch::Contains("this is LAS, which is not read: write it as .xyz or .ply"));
    CHECK_THAT(mistake("a.ply", "ply\nformat ascii 1.0\n"), Catch::Contains("these are points or a mesh, not a plant"));
    CHECK_THAT(mistake("a.geom", "#PlantGL"), Catch::Contains("this is a scene of PlantGL"));
    CHECK_THAT(mistake("a.odt", "PK"), Catch::Contains("is no file of measured plants: their extensions are .csv"));
}

TEST_CASE("a MATLAB file is told how its cylinders become a table", "[cylinders]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(
        read_measured_plants(folder.write("tree.mat", "MATLAB 5.0 MAT-file, Platform: GLNXA64")),
        Catch::Contains("tree.mat: this is a MATLAB file, as TreeQSM writes: write its cylinders as a table"));
}

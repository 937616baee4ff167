// Plants of the AMAP programs: matrices, topology, scenes, and what is no such file.
#include "catch.h"
#include "language/measured_file.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <fstream>

using namespace espalier;

namespace {

const MeasuredText opf_file{"opf", "plant.opf"};

/// A tube of length 1 and diameter 1 along x, and a flat leaf.
const std::string meshes =
    "<opf version=\"2.0\"><meshBDD><mesh Id=\"0\" enableScale=\"true\"><points>0 -0.5 0 0 0.5 0 0 0 -0.5 0 0 0.5\n"
    "1 -0.5 0 1 0.5 0 1 0 -0.5 1 0 0.5</points></mesh><mesh Id=\"1\" enableScale=\"true\"><points>0 -0.5 0 1 -0.5 0 1 "
    "0.5 0 0 0.5 0</points><faces><face Id=\"0\">0 1 2</face><face Id=\"1\">0 2 "
    "3</face></faces></mesh></meshBDD><shapeBDD><shape Id=\"0\"><meshIndex>0</meshIndex></shape><shape "
    "Id=\"7\"><meshIndex>1"
    "</meshIndex></shape></shapeBDD>";

/// Upright from a height, 10 cm long and 2 cm thick.
std::string upright_piece(double height) {
    return fmt::format(
        "<geometry><shapeIndex>0</shapeIndex><mat>0 0 -1 0\n0 1 0 0\n10 0 0 {}</mat><dUp>1.5</dUp>"
        "<dDwn>2.5</dDwn></geometry>",
        height);
}

/// Along x, 20 cm long.
std::string level_piece(double x, double height) {
    return fmt::format(
        "<geometry><shapeIndex>0</shapeIndex><mat>20 0 0 {}\n0 1 0 0\n0 0 1 {}</mat><dUp>1</dUp>"
        "<dDwn>1</dDwn></geometry>",
        x, height);
}

const std::string leaf =
    "<branch class=\"Leaf\" scale=\"3\" id=\"9\"><Length>0.2</Length><geometry><shapeIndex>7"
    "</shapeIndex><mat>4 0 0 1 0 2 0 0 0 0 1 5</mat><dUp>0.5</dUp><dDwn>1.5</dDwn></geometry></branch>";

/// A stem of three internodes, of which the first bears a branch on its surface, and a leaf.
std::string plant_of(const std::string& begin, const std::string& end) {
    return meshes + begin +
           "<decomp class=\"Axis\" scale=\"2\"><decomp class=\"Internode\" scale=\"3\"><Width>0.02</Width>" +
           upright_piece(0) + leaf + "<branch class=\"Axis\" scale=\"2\"><decomp class=\"Internode\" scale=\"3\">" +
           level_piece(1, 10) + "</decomp></branch><follow class=\"Internode\" scale=\"3\">" + upright_piece(10) +
           "</follow></decomp><follow class=\"Axis\" scale=\"2\"><decomp class=\"Internode\" scale=\"3\">" +
           upright_piece(20) + "</decomp></follow></decomp>" + end + "</opf>";
}

const std::string one_plant =
    plant_of("<topology class=\"Scene\" scale=\"0\"><decomp class=\"Individual\" scale=\"1\">", "</decomp></topology>");

}  // namespace

TEST_CASE("OPF: matrices put pieces to their places, by which axes follow and are borne", "[opf]") {
    const language::MeasuredPlants plants = opf_file.read(one_plant);
    check_measures(plants, {1, 2, 0.5, {0.21, 0.3, 0.03}, 0.01});
    CHECK(plants.plants[0].label == "Individual");
    CHECK(plants.axes[0].nodes.size() == 4);
    CHECK(plants.axes[0].nodes[1].diameter == Approx(0.02));
    CHECK(plants.axes[1].order == 1);
    CHECK(warnings_of(plants) == "attribute 'Width' is not used\nattribute 'Length' is not used\n");
}

TEST_CASE("OPF: a flat leaf is one polygon at its place, as wide as its factors say", "[opf]") {
    const language::MeasuredPlants plants = opf_file.read(one_plant);
    const language::MeasuredSummary summary = language::summary_of(plants);
    CHECK(summary.organs == 1);
    // 4 cm long, and 2 cm wide times 1.5 at its base and 0.5 at its tip.
    CHECK(summary.organ_area == Approx(0.04 * 0.02));
    REQUIRE(plants.axes[0].organs.size() == 1);
    const language::MeasuredOrgan& leaf_of_stem = plants.axes[0].organs[0];
    CHECK(plants.axes[0].nodes[leaf_of_stem.on_node].at.y == Approx(0.1));  // the end of what bears it
    CHECK(plants.meshes[leaf_of_stem.mesh].faces.size() == 1);
    const std::vector<glm::dvec3> points = language::points_of(plants.meshes[leaf_of_stem.mesh], leaf_of_stem);
    REQUIRE(points.size() == 4);
    CHECK(glm::distance(points[0], glm::dvec3(0.01, 0.05, 0.015)) == Approx(0).margin(1e-12));
    CHECK(glm::distance(points[2], glm::dvec3(0.05, 0.05, -0.005)) == Approx(0).margin(1e-12));
    CHECK_THAT(language::measured_model_text(plants), Catch::Contains("{.") && Catch::Contains("}"));
}

TEST_CASE("OPF: a mesh that is not flat has a polygon for each face, and a plant may be one organ", "[opf]") {
    const auto quad = [](const std::string& height) {
        return "<opf><meshBDD><mesh Id=\"0\"><points>0 0 0 100 0 0 100 100 " + height +
               " 0 100 0</points><faces><face>0 1 2</face><face>0 2 3</face></faces></mesh></meshBDD><shapeBDD><shape "
               "Id=\"0\"><meshIndex>0</meshIndex></shape></shapeBDD><topology class=\"Plant\" scale=\"1\"><geometry>"
               "<shapeIndex>0</shapeIndex><mat>1 0 0 0 0 1 0 0 0 0 1 0</mat></geometry></topology></opf>";
    };
    CHECK(opf_file.read(quad("0")).meshes.at(0).faces.size() == 1);
    CHECK(opf_file.read(quad("50")).meshes.at(0).faces.size() == 2);
    CHECK(opf_file.summary(quad("0")).organ_area == Approx(1));
    CHECK(opf_file.summary(quad("0")).length == 0);
    std::string text = quad("0");
    text.replace(text.find("0 2 3"), 5, "0 2 4");
    CHECK_THAT(opf_file.mistake(text), Catch::Contains("a face names point 4 of 4; they count from 0"));
}

TEST_CASE("OPF: hundreds of internodes stand inside each other", "[opf]") {
    std::string begin = "<topology class=\"Plant\" scale=\"1\"><decomp class=\"Internode\" scale=\"2\">",
                end = "</decomp></topology>";
    std::string text = meshes + begin + upright_piece(0);
    for (int i = 1; i < 1000; ++i) {
        text += "<follow class=\"Internode\" scale=\"2\">" + upright_piece(10 * i);
        end = "</follow>" + end;
    }
    CHECK(opf_file.summary(text + end + "</opf>").length == Approx(100));
}

TEST_CASE("OPF: a scene puts plants of files to their places", "[opf]") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "plant.opf") << one_plant;
    const std::string rows =
        "# T xOrigin yOrigin zOrigin xSize ySize flat\nT 0 0 0 2 1 flat\n1\t1\tplant.opf\t0\t0\t0\t1\t0\t0\t0\n"
        "1\t2\tplant.opf\t5\t0\t0\t2\t0\t0\t1.5707963267948966\n";
    const MeasuredText scene{"ops", (folder.path() / "field.ops").string()};
    const language::MeasuredPlants plants = scene.read(rows);
    REQUIRE(plants.plants.size() == 2);
    REQUIRE(plants.axes.size() == 4);
    CHECK(language::summary_of(plants).length == Approx(0.5 + 1));
    // Turned about its stem, the branch of the second plant runs along the file's y: backwards.
    CHECK(plants.axes[3].nodes.back().at.x == Approx(5));
    CHECK(plants.axes[3].nodes.back().at.z == Approx(-0.42));
    CHECK_THAT(scene.mistake("1 1 oak.opf 0 0 0 1 0 0 0\n"), Catch::Contains("field.ops:1:1: there is no file"));
    CHECK_THAT(scene.mistake("1 1 plant.opf 0 0\n"), Catch::Contains("a plant of a scene is"));
}

TEST_CASE("OPF: malformed files end in one line", "[opf]") {
    CHECK_THAT(opf_file.mistake("<rsml/>"), Catch::Contains("this is no OPF file"));
    CHECK_THAT(opf_file.mistake("<opf></opf>"), Catch::Contains("no entity of this file has a mesh"));
    const std::string begin = meshes + "<topology class=\"Plant\" scale=\"1\"><geometry>",
                      end = "</geometry></topology></opf>";
    CHECK_THAT(opf_file.mistake(begin + "<shapeIndex>5</shapeIndex>" + end), Catch::Contains("there is no shape '5'"));
    CHECK_THAT(opf_file.mistake(begin + "<mat>1 0 0 0</mat>" + end), Catch::Contains("here are 4 numbers, not 12"));
    CHECK_THAT(opf_file.mistake(begin + "<dUp>wide</dUp>" + end), Catch::Contains("'wide' is no number"));
    CHECK_THAT(opf_file.mistake(begin), Catch::Contains("plant.opf:"));
}

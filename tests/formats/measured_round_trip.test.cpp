// What was imported and exported is the same plant, in the forms that can hold it.
#include "espalier/archive/recorded_run.h"
#include "espalier/formats/exporter.h"
#include "espalier/language/measured_plants.h"
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "temporary_folder.h"

#include <cmath>
#include <string>

using namespace espalier;

namespace {

/// A branch begins on the surface of the trunk, and bears another.
const char* const cylinders =
    "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent,extension,branch\n"
    "0.1,1,0,0,0,0,0,1,0,2,1\n0.08,1,0,0,1,0,0,1,1,0,1\n0.02,0.5,0.1,0,0.5,2,0,0,1,4,2\n"
    "0.01,0.25,0.6,0,0.5,1,0,0,3,0,2\n0.01,0.3,0.6,0.02,0.5,0,1,0,3,0,3\n";

/// Gaps in the trunk and in a branch; two branches begin beside the same place, and one stands behind a gap.
const char* const cylinders_with_gaps =
    "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent,extension,branch\n"
    "0.1,1,0,0,0,0,0,1,0,2,1\n0.08,1,0,0,1.5,0,0,1,1,0,1\n0.02,0.5,0.1,0,0.5,2,0,0,1,4,2\n"
    "0.01,0.25,0.7,0,0.5,1,0,0,3,0,2\n0.01,0.3,0,-0.1,0.5,0,-1,0,1,0,3\n0.01,0.3,0,0.08,1.75,0,1,0,2,0,4\n";

/// Two polylines of one root, which appear on days, and a lateral on the second.
const char* const root_with_gap =
    "<rsml><metadata><unit>cm</unit><up>z</up></metadata><scene><plant label='p'><root ID='7'><geometry><polyline>"
    "<point x='0' y='0' z='0'/><point x='0' y='0' z='-2'/></polyline><polyline><point x='0' y='0' z='-3'/>"
    "<point x='0' y='0' z='-5'/><point x='1' y='0' z='-6'/></polyline></geometry><functions>"
    "<function name='node_creation_time' domain='polyline'><sample>0</sample><sample>1</sample><sample>2</sample>"
    "<sample>3</sample><sample>4</sample></function></functions>"
    "<root><geometry><polyline><point x='0' y='0' z='-5'/><point x='2' y='0' z='-5'/></polyline></geometry>"
    "<functions><function name='node_creation_time' domain='polyline'><sample>3</sample><sample>4</sample></function>"
    "</functions></root></root></plant></scene></rsml>";

/// What is read of what is written of a scene.
MeasuredPlants read_again(const TemporaryFolder& folder, const std::string& model, const std::string& format) {
    run(read_scene_text("[[plant]]\nmodel = '" + model + "'\n", "scene.toml", folder.path()),
        {.output = folder.path() / "run", .overwrite = true});
    const RecordedRun recorded(folder.path() / "run");
    const RecordedFrame* const frames[] = {&recorded.frames().back()};
    std::filesystem::path file;
    formats::ExportJob job{
        recorded, frames, {}, folder.path(), [&](const formats::ExportedFile& each) { file = each.path; }};
    formats::export_run(job, std::vector<std::string>{format});
    return read_measured_plants(file);
}

void check_same(const MeasuredSummary& after, const MeasuredSummary& before) {
    CHECK(after.plants == before.plants);
    CHECK(after.axes_of_order == before.axes_of_order);
    CHECK(after.length == Approx(before.length).epsilon(1e-5));
    CHECK(after.link_length == Approx(before.link_length).epsilon(1e-5));
    for (int axis = 0; axis < 3; ++axis) CHECK(after.extent[1][axis] == Approx(before.extent[1][axis]).margin(1e-6));
}

}  // namespace

TEST_CASE("a cylinder model that is written as MTG and read again is the same plant", "[export]") {
    const TemporaryFolder folder;
    const MeasuredSummary before = summary_of(read_measured_plants(folder.write("tree.csv", cylinders)));
    CHECK(before.length == Approx(3.05));
    const MeasuredSummary after = summary_of(read_again(folder, "tree.csv", "mtg"));
    check_same(after, before);
    // Between pieces the turtle tapers; an MTG has the diameter in the middle of each.
    CHECK(after.volume == Approx(before.volume).epsilon(0.15));
}

TEST_CASE("gaps within axes are the same when they are written and read again", "[export]") {
    const TemporaryFolder folder;
    const MeasuredSummary tree = summary_of(read_measured_plants(folder.write("tree.csv", cylinders_with_gaps)));
    CHECK(tree.axes_of_order == std::vector<std::size_t>{1, 3});
    CHECK(tree.link_length == Approx(0.5 + 0.1 + 0.1 + 0.1 + 0.08));
    const MeasuredPlants root = read_measured_plants(folder.write("root.rsml", root_with_gap));
    CHECK(summary_of(root).link_length == Approx(0.01));
    for (const char* const format : {"rsml", "mtg"}) {
        INFO(format);
        check_same(summary_of(read_again(folder, "tree.csv", format)), tree);
        const MeasuredPlants again = read_again(folder, "root.rsml", format);
        check_same(summary_of(again), summary_of(root));
        CHECK(again.axes.at(0).nodes.back().day == 4);
        CHECK(again.axes.at(0).nodes[again.axes.at(1).on_node].at.y == Approx(-0.05));
    }
}

TEST_CASE("what hangs within a gap hangs there when it is read again from RSML", "[export]") {
    const TemporaryFolder folder;
    const std::string lateral = "0.01,0.3,0,0.09,1.2,0,1,0,2,0,5\n";
    const MeasuredSummary tree =
        summary_of(read_measured_plants(folder.write("tree.csv", cylinders_with_gaps + lateral)));
    CHECK(tree.axes_of_order == std::vector<std::size_t>{1, 4});
    check_same(summary_of(read_again(folder, "tree.csv", "rsml")), tree);
    // An MTG tells the piece that it stands on, whose end is nearest.
    const MeasuredSummary graph = summary_of(read_again(folder, "tree.csv", "mtg"));
    CHECK(graph.axes_of_order == tree.axes_of_order);
    CHECK(graph.link_length - tree.link_length == Approx(std::hypot(0.2, 0.09) - 0.09));
}

TEST_CASE("a gap in the stem of a grown plant begins no plant of its own", "[export]") {
    const TemporaryFolder folder;
    folder.write("stem.l",
                 "lsystem: 1\nderivation length: 0\naxiom: !(.1) F(1) [+F(1)] f(.5) F(1) [f(.2) F(1)]\nendlsystem\n");
    for (const char* const format : {"rsml", "mtg"}) {
        INFO(format);
        const MeasuredSummary read = summary_of(read_again(folder, "stem.l", format));
        CHECK(read.plants == 1);
        CHECK(read.axes_of_order == std::vector<std::size_t>{1, 2});
        CHECK(read.length == Approx(4));
        CHECK(read.link_length == Approx(0.7));
    }
}

TEST_CASE("RSML: a root that continues none before it is one of its own, and told", "[export]") {
    const TemporaryFolder folder;
    std::string text = root_with_gap;
    text.replace(text.find("<root ID='7'>"), 13, "<root ID='7'><properties><continues value='9'/></properties>");
    const MeasuredPlants plants = read_measured_plants(folder.write("root.rsml", text));
    CHECK(plants.axes.size() == 2);
    CHECK(plants.warnings.at(0).message == "a root continues none that stands before it: it is one of its own");
}

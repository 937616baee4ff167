// What was imported and exported is the same plant, in the forms that can hold it.
#include "espalier/archive/recorded_run.h"
#include "espalier/formats/exporter.h"
#include "espalier/language/measured_plants.h"
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "temporary_folder.h"

using namespace espalier;

namespace {

/// A branch begins on the surface of the trunk, and bears another.
const char* const cylinders =
    "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent,extension,branch\n"
    "0.1,1,0,0,0,0,0,1,0,2,1\n0.08,1,0,0,1,0,0,1,1,0,1\n0.02,0.5,0.1,0,0.5,2,0,0,1,4,2\n"
    "0.01,0.25,0.6,0,0.5,1,0,0,3,0,2\n0.01,0.3,0.6,0.02,0.5,0,1,0,3,0,3\n";

}  // namespace

TEST_CASE("a cylinder model that is written as MTG and read again is the same plant", "[export]") {
    const TemporaryFolder folder;
    const MeasuredSummary before = summary_of(read_measured_plants(folder.write("tree.csv", cylinders)));
    CHECK(before.length == Approx(3.05));
    run(read_scene_text("[[plant]]\nmodel = 'tree.csv'\n", "scene.toml", folder.path()),
        {.output = folder.path() / "run"});
    const RecordedRun recorded(folder.path() / "run");
    const RecordedFrame* const frames[] = {&recorded.frames().back()};
    std::filesystem::path file;
    formats::ExportJob job{
        recorded, frames, {}, folder.path(), [&](const formats::ExportedFile& each) { file = each.path; }};
    formats::export_run(job, std::vector<std::string>{"mtg"});
    const MeasuredSummary after = summary_of(read_measured_plants(file));
    CHECK(after.plants == before.plants);
    CHECK(after.axes_of_order == before.axes_of_order);
    CHECK(after.length == Approx(before.length).epsilon(1e-5));
    CHECK(after.link_length == Approx(before.link_length).epsilon(1e-5));
    // Between pieces the turtle tapers; an MTG has the diameter in the middle of each.
    CHECK(after.volume == Approx(before.volume).epsilon(0.15));
    for (int axis = 0; axis < 3; ++axis) CHECK(after.extent[1][axis] == Approx(before.extent[1][axis]).margin(1e-6));
}

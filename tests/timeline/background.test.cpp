// What stands around the plants, recorded once.
#include "espalier/turtle/background.h"

#include "catch.h"
#include "timeline/frames.h"

#include <vtkCellData.h>

using namespace espalier;
using namespace espalier::timeline;

namespace {

void record_with(const RunFolder& folder, const Background* background) {
    Timeline timeline(folder.path, timeline_table(), 1);
    const Fields fields;
    const HandmadePlant plant = branched_plant();
    PlantFrame frame = plant.frame();
    frame.background = background;
    timeline.record({0, 0, {frame}, &fields});
    timeline.finish();
}

}  // namespace

TEST_CASE("the background scenes of view files are triangles with their colours", "[timeline]") {
    Background background;
    std::vector<Diagnostic> diagnostics;
    read_background_text("material 0 0 0 1 1 0 0 0.5\npolygon 0 0 0 1 0 0 1 1 0 0 1 0\n", "wall", {}, background,
                         diagnostics);
    const RunFolder folder;
    record_with(folder, &background);
    const auto data = read_vtp(folder.path / "background.vtp");
    CHECK(data->GetNumberOfPolys() == 2);
    CHECK(data->GetCellData()->GetArray("opacity")->GetTuple1(0) == 0.5);
}

TEST_CASE("without a background scene there is no file", "[timeline]") {
    const RunFolder folder;
    record_with(folder, nullptr);
    CHECK_FALSE(std::filesystem::exists(folder.path / "background.vtp"));
}

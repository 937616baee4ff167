// A field over one axis: of layers of voxels whose values are known.
#include "analysis/field_profile.h"

#include "archive/recorded_folder.h"
#include "catch.h"

using namespace espalier;

namespace {

std::vector<const RecordedFrame*> frames_of(const RecordedRun& run) {
    std::vector<const RecordedFrame*> frames;
    for (const RecordedFrame& frame : run.frames()) frames.push_back(&frame);
    return frames;
}

}  // namespace

TEST_CASE("a field's profile has mean, deviation and bounds of every layer of voxels", "[analysis]") {
    const RecordedFolder recorded;  // 2 x 3 x 1 voxels of 0.25, but 4.5 in the lowest layer and 9 in the highest
    const RecordedRun run(recorded.folder.path);
    const RecordedTable heights = field_profile(run, frames_of(run), "light", "y");
    CHECK(heights.columns == std::vector<std::string>{"step", "y", "mean", "deviation", "minimum", "maximum"});
    REQUIRE(heights.rows.size() == 6);
    CHECK(heights.rows[0] == std::vector<double>{0, 2.25, 0.375, 0.125, 0.25, 0.5});
    CHECK(heights.rows[3] == std::vector<double>{4, 2.25, 2.375, 2.125, 0.25, 4.5});
    CHECK(heights.rows[4] == std::vector<double>{4, 2.75, 0.25, 0, 0.25, 0.25});
    CHECK(heights.rows[5] == std::vector<double>{4, 3.25, 4.625, 4.375, 0.25, 9});
    const RecordedTable across = field_profile(run, frames_of(run), "light", "x");
    REQUIRE(across.rows.size() == 4);
    CHECK(across.rows[2][1] == 1.25);
    CHECK(across.rows[2][2] == Approx((4.5 + 0.25 + 0.25) / 3));
    CHECK_THROWS_WITH(field_profile(run, frames_of(run), "ligth", "y"), Catch::Contains("did you mean 'light'"));
}

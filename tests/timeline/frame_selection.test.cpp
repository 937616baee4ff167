#include "espalier/timeline/frame_selection.h"

#include "catch.h"
#include "timeline/collections.h"
#include "timeline/frames.h"

#include <functional>
#include <limits>

using namespace espalier;
using namespace espalier::timeline;
using Frames = std::vector<int>;

namespace {

Frames chosen(const FrameSelection& selection, int last) {
    Frames frames;
    for (int frame = selection.first; frame <= last; frame = selection.after(frame)) frames.push_back(frame);
    return frames;
}

/// The steps of plants.pvd after steps 0 to `last`.
Frames recorded(
    const std::string& table, int last, const std::function<void(Timeline&)>& prepare = [](Timeline&) {}) {
    const HandmadePlant plant = branched_plant();
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table(table), last);
    prepare(timeline);
    const std::vector<PlantFrame> plants{plant.frame()};
    const Fields fields;
    for (int step = 0; step <= last; ++step) {
        timeline.record({step, double(step), plants, &fields, step == last});
    }
    timeline.finish();
    Frames frames;
    for (const DataSetEntry& entry : read_collection(folder.path / "plants.pvd")) {
        frames.push_back(static_cast<int>(entry.time));
    }
    return frames;
}

}  // namespace

TEST_CASE("frames follow the first at equal steps", "[timeline]") {
    CHECK(chosen({1, 1, {}}, 4) == Frames{1, 2, 3, 4});
    CHECK(chosen({0, 5, {}}, 12) == Frames{0, 5, 10});
    CHECK(chosen({3, 0, {}}, 5) == Frames{3, 4, 5});
}

TEST_CASE("an interval has its own step, and what lies between two intervals is left out", "[timeline]") {
    CHECK(chosen({2, 1, {{2, 4, 1}, {10, 16, 3}}}, 16) == Frames{2, 3, 4, 10, 13, 16});
    CHECK(chosen({1, 5, {{1, 8, 3}, {20, 21, 1}}}, 21) == Frames{1, 4, 7, 20, 21});
}

TEST_CASE("after the last interval the ordinary step counts again", "[timeline]") {
    CHECK(chosen({1, 5, {{1, 3, 1}}}, 15) == Frames{1, 2, 3, 8, 13});
}

TEST_CASE("a first frame before all intervals is followed by their beginning", "[timeline]") {
    CHECK(chosen({0, 2, {{7, 9, 1}}}, 9) == Frames{0, 7, 8, 9});
    CHECK(chosen({6, 2, {{7, 9, 1}}}, 9) == Frames{6, 8, 9});
}

TEST_CASE("an interval that stands still is one frame", "[timeline]") {
    CHECK(chosen({1, 1, {{1, 2, 1}, {3, 30, 0}, {31, 32, 1}}}, 32) == Frames{1, 2, 3, 31, 32});
}

TEST_CASE("keyframes are frames besides the regular ones, and move none of them", "[timeline]") {
    CHECK(chosen({0, 5, {}, {0, 3, 5, 11}}, 15) == Frames{0, 3, 5, 10, 11, 15});
    CHECK(chosen({3, FrameSelection::never, {}, {3, 4, 40}}, 1000) == Frames{3, 4, 40});
}

TEST_CASE("frames end where numbers do", "[timeline]") {
    const int most = std::numeric_limits<int>::max();
    CHECK(FrameSelection{0, most, {}}.after(5) == most);
}

TEST_CASE("a timeline sees exactly the frames chosen, or the last if it would see none", "[timeline]") {
    const auto recorded_by = [](const FrameSelection& selection, int last) {
        return recorded("", last, [&](Timeline& timeline) { timeline.choose(selection); });
    };
    CHECK(recorded_by({1, 2, {}}, 6) == Frames{1, 3, 5});
    CHECK(recorded_by({9, 1, {}}, 6) == Frames{6});
}

TEST_CASE("a scene's keyframes are its only frames, but for the last, unless it gives a step too", "[timeline]") {
    CHECK(recorded("keyframes = [4, 1]", 6) == Frames{1, 4, 6});
    CHECK(recorded("keyframes = [1, 4]\nevery = 3", 7) == Frames{0, 1, 3, 4, 6, 7});
    CHECK(recorded("keyframes = [1]\nfirst = 4", 6) == Frames{1, 4, 5, 6});
    for (const char* wrong : {"keyframes = [1.5]", "keyframes = [-1]", "keyframes = [1e12]"}) {
        CHECK_THROWS_WITH(recorded(wrong, 6), Catch::Contains("whole numbers from 0 on"));
    }
}

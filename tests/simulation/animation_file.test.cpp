#include "simulation/object/animation_file.h"

#include "catch.h"

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;
using Frames = std::vector<int>;

namespace {

Animation read(const std::string& text) {
    return read_animation_text(text, "plant.a");
}

/// The frames of a model of so many steps.
Frames frames_of(const std::string& text, int derivation_length = 9) {
    const Animation animation = read(text);
    Frames frames;
    const int last = animation.last.value_or(derivation_length);
    for (int frame = animation.frames.first; frame <= last; frame = animation.frames.after(frame)) {
        frames.push_back(frame);
    }
    return frames;
}

}  // namespace

TEST_CASE("an animation shows every step from the first to the last frame", "[simulation]") {
    CHECK(frames_of("double buffer: on\nfirst frame: 2\nlast frame: 5\nswap interval: 1\n") == Frames{2, 3, 4, 5});
    CHECK(frames_of("step: 4\n") == Frames{1, 5, 9});
    CHECK(frames_of("first frame: 0\nlast frame: 6\nstep: 3") == Frames{0, 3, 6});
}

TEST_CASE("a negative last frame is the derivation length, and so is none", "[simulation]") {
    CHECK_FALSE(read("last frame: -1\n").last);
    CHECK_FALSE(read("").last);
    CHECK(read("last frame: 200\n").last == 200);
}

TEST_CASE("a last frame below the first is the first, judged where it stands", "[simulation]") {
    CHECK(read("first frame: 5\nlast frame: 3\n").last == 5);
    CHECK(read("last frame: 3\nfirst frame: 5\n").last == 3);
    CHECK(read("first frame: -3\n").frames.first == 0);
    CHECK(read("step: 0\n").frames.step == 1);
}

TEST_CASE("frame intervals give the frames from their first to their last", "[simulation]") {
    CHECK(frames_of("frame intervals: 2, 5-7, 10-20 step 5\n") == Frames{2, 5, 6, 7, 10, 15, 20});
    CHECK(frames_of("step: 3\nframe intervals: 1-7 , 8-12 step 2\n") == Frames{1, 4, 7, 10, 12});
    CHECK(frames_of("frame intervals: 2-4\nfirst frame: 3\n") == Frames{3, 4});
    CHECK(frames_of("first frame: 3\nframe intervals: 2-4\n") == Frames{2, 3, 4});
}

TEST_CASE("turning and scaling between frames is left to the viewer, and a picture that only turns is one frame",
          "[simulation]") {
    const std::string text = "frame intervals: 1-2 rotate 0 10 0, 3-40 step 0 scale 1 1 .5, 41\n";
    CHECK(frames_of(text) == Frames{1, 2, 3, 41});
    CHECK(read(text).unused == std::vector<std::string>{"frame intervals: rotate", "frame intervals: scale"});
    CHECK(read(text).diagnostics.empty());
}

TEST_CASE("a blank before the minus makes a lone frame, and what follows is complained of", "[simulation]") {
    const Animation animation = read("\nframe intervals: 2 -5\n");
    CHECK(animation.frames.first == 2);
    CHECK(animation.last == 2);
    REQUIRE(animation.diagnostics.size() == 1);
    CHECK(animation.diagnostics[0].place.line == 2);
    CHECK_THAT(animation.diagnostics[0].message, Contains("'-5'"));
    CHECK(frames_of("frame intervals: 2- 4\n") == Frames{2, 3, 4});
}

TEST_CASE("keywords are exact, unknown ones are ignored, and line ends may be those of Windows", "[simulation]") {
    CHECK(frames_of("First frame: 5\n first frame: 6\nfirst frame : 7\nmin/max: 3\nnonsense\nlast frame: 2\r\n") ==
          Frames{1, 2});
    CHECK(read("first frame: 2 3 4\n").diagnostics.empty());
    CHECK(read("First frame: 5\n").unused.empty());
}

TEST_CASE("a number that is none is complained of and keeps the default", "[simulation]") {
    const Animation animation = read("first frame: two\nlast frame:\nstep: 2x\nframe intervals: ,\n");
    CHECK(animation.frames.first == 1);
    CHECK(animation.frames.step == 2);
    CHECK_FALSE(animation.last);
    CHECK(animation.diagnostics.size() == 3);
    CHECK(read("last frame: 99999999999999999999\n").last == 1000000000);
}

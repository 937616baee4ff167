// The window without a window: where its controls stand, what scripts say, how it follows and reads runs.
#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/recorded_folder.h"
#include "catch.h"
#include "view/frame_reader.h"
#include "view/history_reader.h"
#include "view/layout.h"
#include "view/run_follower.h"
#include "view/script.h"

#include <chrono>
#include <thread>

using namespace espalier;
using namespace espalier::view;
using namespace std::chrono_literals;

namespace {

bool overlap(const Rectangle& a, const Rectangle& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// What `poll` gives once it gives something; its default if that takes more than ten seconds.
template <class Poll>
auto awaited(Poll poll) {
    auto result = poll();
    for (int i = 0; i < 1000 && !result; ++i) {
        std::this_thread::sleep_for(10ms);
        result = poll();
    }
    return result;
}

}  // namespace

TEST_CASE("no two controls of the window overlap, at any size", "[view]") {
    for (const int width : {60, 200, 420, 640, 1280, 3840}) {
        for (const float scale : {1.0F, 2.0F}) {
            for (const bool panel : {false, true}) {
                INFO(width << " " << scale << " " << panel);
                const WindowLayout layout = layout_of_window(width, 600, scale, panel, true);
                for (std::size_t i = 0; i < layout.controls.size(); ++i) {
                    CHECK(layout.controls[i].at.width > 0);
                    for (std::size_t k = 0; k < i; ++k) {
                        CHECK_FALSE(overlap(layout.controls[i].at, layout.controls[k].at));
                    }
                }
                CHECK_FALSE(overlap(layout.scene, layout.bar));
                CHECK_FALSE(overlap(layout.scene, layout.panel));
            }
        }
    }
}

TEST_CASE("what is clicked is what is drawn there", "[view]") {
    const WindowLayout layout = layout_of_window(1280, 800, 1, true, false);
    for (const WindowLayout::Place& place : layout.controls) {
        const Rectangle& at = place.at;
        CHECK(layout.at(int(at.x + at.width / 2), int(at.y + at.height / 2)) == place.control);
    }
    CHECK_FALSE(layout.at(400, 400));
    CHECK(layout.at(1200, 400) == Control::inside);  // the panel
    CHECK(layout.at(1, 1) == Control::inside);       // the bar
    CHECK_FALSE(layout.find(Control::live));
    CHECK(layout_of_window(1280, 800, 1, false, true).find(Control::live));
}

TEST_CASE("the slider finds each frame where it shows it", "[view]") {
    const WindowLayout layout = layout_of_window(1280, 800, 1, false, false);
    for (std::size_t frame = 0; frame < 275; ++frame) {
        CHECK(layout.frame_at(int(std::lround(layout.slider_x(frame, 275))), 275) == frame);
    }
    CHECK(layout.frame_at(-100, 275) == 0);
    CHECK(layout.frame_at(5000, 275) == 274);
    CHECK(layout.frame_at(600, 1) == 0);
    CHECK(layout.frame_at(600, 0) == 0);
}

TEST_CASE("a script is read line by line, and a mistake is named", "[view]") {
    const auto lines =
        parse_script("# a comment\n\nkey space\ndrag 1 2 3 4 shift # turn\nclick 5 6\nscreenshot a.png\nwait\n");
    REQUIRE(lines.size() == 5);
    CHECK(lines[0].kind == ScriptLine::Kind::key);
    CHECK(lines[0].word == "space");
    CHECK(lines[1].numbers == std::array<int, 4>{1, 2, 3, 4});
    CHECK(lines[1].shift);
    CHECK(lines[2].numbers[1] == 6);
    CHECK(lines[3].word == "a.png");
    CHECK(parse_script("").empty());
    CHECK_THROWS_WITH(parse_script("key f\nclik 1 2"), Catch::Contains("script:2") && Catch::Contains("'click'"));
    CHECK_THROWS_WITH(parse_script("click 1"), Catch::Contains("click X Y"));
    CHECK_THROWS_WITH(parse_script("click 1 2 3"), Catch::Contains("click X Y"));
    CHECK_THROWS_AS(parse_script("wait shift"), UserError);
}

TEST_CASE("frames are read by a thread, counted, and found again", "[view]") {
    const RecordedFolder recorded;
    const auto run = std::make_shared<const RecordedRun>(recorded.folder.path);
    FrameReader reader;
    CHECK_FALSE(reader.find(run->frames()[1]));
    reader.want(run, run->frames());
    const auto data = awaited([&] { return reader.find(run->frames()[1]); });
    REQUIRE(data);
    CHECK(data->error.empty());
    CHECK(data->plants == 2);
    CHECK(data->internodes == 6);
    CHECK(data->organs == 1);
    CHECK(data->geometry.points.size() == run->geometry(run->frames()[1]).points.size());
    const auto first = awaited([&] { return reader.find(run->frames()[0]); });
    REQUIRE(first);
    CHECK(first->internodes == 4);
    reader.forget();
    CHECK_FALSE(reader.find(run->frames()[0]));
}

TEST_CASE("little memory for frames is enough, one after the other", "[view]") {
    const RecordedFolder recorded;
    const auto run = std::make_shared<const RecordedRun>(recorded.folder.path);
    FrameReader reader(1);
    for (int round = 0; round < 3; ++round) {
        for (const RecordedFrame& frame : run->frames()) {
            reader.want(run, {frame});
            CHECK(awaited([&] { return reader.find(frame); }));
        }
    }
}

TEST_CASE("a damaged frame is told, not shown", "[view]") {
    const RecordedFolder recorded;
    const auto run = std::make_shared<const RecordedRun>(recorded.folder.path);
    std::ofstream(run->frames()[1].plants) << "nonsense";
    FrameReader reader;
    reader.want(run, {run->frames()[1]});
    const auto data = awaited([&] { return reader.find(run->frames()[1]); });
    REQUIRE(data);
    CHECK_THAT(data->error, Catch::Contains("0004.vtp"));
}

TEST_CASE("a history is read beside the window, and the last question wins", "[view]") {
    const RecordedFolder recorded;
    const auto run = std::make_shared<const RecordedRun>(recorded.folder.path);
    HistoryReader reader;
    reader.ask(run, {0, 1}, 4);
    reader.ask(run, {1, 2}, 4);
    std::optional<HistoryReader::Answer> answer;
    for (int i = 0; i < 1000 && !(answer && answer->finished); ++i) {
        std::this_thread::sleep_for(10ms);
        if (auto news = reader.poll()) answer = news;
    }
    REQUIRE(answer);
    CHECK(answer->finished);
    CHECK(answer->history.organ == OrganKey{1, 2});
    CHECK(answer->history.moments.size() == 2);
}

TEST_CASE("a run is followed while it gets more frames", "[view]") {
    GoingRun going;
    RunFollower follower(going.folder.path);
    CHECK(follower.run()->frames().size() == 1);
    CHECK_FALSE(follower.look());
    const auto before = follower.run();
    std::this_thread::sleep_for(20ms);
    going.grow(1);
    CHECK(follower.look());
    CHECK(follower.run()->frames().size() == 2);
    CHECK_FALSE(follower.is_another());
    CHECK(before->frames().size() == 1);  // who holds the old one is not disturbed
}

TEST_CASE("a run that is killed is known by the lock that it no longer holds", "[view]") {
    GoingRun going("running");
    RunFollower follower(going.folder.path);
    CHECK(follower.run()->exit() == "running");
    CHECK_FALSE(follower.look());
    going.timeline.reset();
    CHECK(follower.look());
    CHECK(follower.run()->exit() == "killed");
    CHECK_FALSE(follower.is_another());
    const FolderLock again(going.folder.path);  // looking takes it from nobody
    CHECK(is_locked(going.folder.path));
}

TEST_CASE("another run in the same folder is noticed, and what cannot be read leaves the old one", "[view]") {
    RunFolder folder;
    const HandmadePlant plant = seedling();
    {
        Timeline timeline(folder.path, timeline_table(), 4);
        for (const int step : {0, 1, 2}) record(timeline, step, {&plant});
        timeline.finish();
        timeline.write_run(run_json);
    }
    RunFollower follower(folder.path);
    std::this_thread::sleep_for(20ms);
    std::ofstream(folder.path / "run.json") << "{";
    CHECK_FALSE(follower.look());
    CHECK_THAT(follower.error(), Catch::Contains("run.json"));
    CHECK(follower.run()->frames().size() == 3);
    std::filesystem::remove_all(folder.path);
    {
        Timeline timeline(folder.path, timeline_table(), 4);
        record(timeline, 5, {&plant});
        timeline.finish();
        timeline.write_run(run_json);
    }
    CHECK(follower.look());
    CHECK(follower.is_another());
    CHECK(follower.error().empty());
    CHECK(follower.run()->frames().size() == 1);
}

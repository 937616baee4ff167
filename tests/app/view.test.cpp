// `espalier view`: a window on a virtual display, driven by a script, and what it shows: words and pixels.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <functional>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

using Pixel = std::array<int, 3>;

class Picture {
public:
    explicit Picture(const fs::path& path) {
        reader_->SetFileName(path.c_str());
        reader_->Update();
    }

    int width() const { return reader_->GetOutput()->GetDimensions()[0]; }
    int height() const { return reader_->GetOutput()->GetDimensions()[1]; }
    /// From the upper left corner.
    Pixel at(int x, int y) const {
        const auto* rgb =
            static_cast<const unsigned char*>(reader_->GetOutput()->GetScalarPointer(x, height() - 1 - y, 0));
        return {rgb[0], rgb[1], rgb[2]};
    }
    int count(const std::function<bool(const Pixel&)>& like) const {
        int found = 0;
        for (int y = 0; y < height(); ++y) {
            for (int x = 0; x < width(); ++x) found += like(at(x, y));
        }
        return found;
    }

private:
    vtkNew<vtkPNGReader> reader_;
};

bool is_bright_red(const Pixel& p) {
    return p[0] > 230 && p[1] < 90 && p[2] < 40;
}

bool is_dark(const Pixel& p) {
    return p[0] + p[1] + p[2] < 120;
}

/// A stalk of six internodes, one more each step: the fourth was born at step 4.
const char* const stalk = "lsystem: 1\nderivation length: 6\naxiom: !(0.3)A\nA --> F(1)A\nendlsystem\n";

class Viewed : public Workplace {
public:
    Viewed() {
        write("stalk.l", stalk);
        REQUIRE(run("run stalk.l --quiet --output run").code == 0);
    }

    /// On a display of its own; none where there is no xvfb-run.
    Outcome on_display(const std::string& arguments, const std::string& script) const {
        write("script.txt", script);
        return run("view " + arguments + " --script script.txt", "xvfb-run -a");
    }
    /// With EGL, or on the display there is.
    Outcome without_display(const std::string& arguments, const std::string& script) const {
        write("script.txt", script);
        return run("view " + arguments + " --script script.txt", "env -u DISPLAY");
    }
};

bool has_virtual_display() {
    const bool has = std::system("command -v xvfb-run >/dev/null && command -v Xvfb >/dev/null") == 0;
    if (!has) WARN("skipped: there is no xvfb-run (apt-get install xvfb xauth)");
    return has;
}

/// True where pictures can be drawn; says so where they cannot.
bool drew_view(const Outcome& outcome) {
    const bool none = outcome.err.find("no picture can be drawn") != std::string::npos;
    if (none) WARN("skipped: " << outcome.err);
    return !none;
}

/// What `print` said the n-th time.
std::string printed(const Outcome& outcome, int n) {
    std::size_t from = 0;
    for (int i = 0; i < n; ++i) from = outcome.out.find("\nstalk\n", from + 1);
    REQUIRE(from != std::string::npos);
    return outcome.out.substr(from, outcome.out.find("\nstalk\n", from + 1) - from);
}

}  // namespace

TEST_CASE_METHOD(Viewed, "without a display it is said what to do, not aborted", "[app][view]") {
    for (const std::string display : {"env -u DISPLAY", "env DISPLAY=:9876"}) {
        const Outcome outcome = run("view run", display);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err,
                   Contains("no X display answers") && Contains("espalier render") && Contains("xvfb-run"));
    }
}

TEST_CASE_METHOD(Viewed, "keys, slider and buttons go through the time of a run", "[app][view]") {
    if (!has_virtual_display()) return;
    const Outcome outcome = on_display("run",
                                       "print\n"             // 0: the last frame
                                       "key Home\nprint\n"   // 1
                                       "key Right\nprint\n"  // 2
                                       "drag 300 774 1215 774\nprint\n"
                                       "click 26 774\nprint\n"  // 4: to the first
                                       "click 98 774\nprint\n"  // 5: plays to the end
                                       "key Left\nprint\n"      // 6
                                       "key h\nprint\n"         // 7
                                       "key Escape\nprint\n");  // 8
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(printed(outcome, 0),
               Contains("step 6") && Contains("1 plant, 6 internodes") && Contains("frame: 7 of 7"));
    CHECK_THAT(printed(outcome, 1), Contains("step 0") && Contains("frame: 1 of 7"));
    CHECK_THAT(printed(outcome, 2), Contains("1 internode,") && Contains("frame: 2 of 7"));
    CHECK_THAT(printed(outcome, 3), Contains("frame: 7 of 7"));
    CHECK_THAT(printed(outcome, 4), Contains("frame: 1 of 7"));
    CHECK_THAT(printed(outcome, 5), Contains("frame: 7 of 7\n"));
    CHECK_THAT(printed(outcome, 6), Contains("frame: 6 of 7"));
    CHECK_THAT(printed(outcome, 7), Contains("help:") && Contains("Space: play, pause"));
    CHECK_THAT(printed(outcome, 8), !Contains("help:"));
}

TEST_CASE_METHOD(Viewed, "a click on an organ marks it and tells its history", "[app][view]") {
    if (!has_virtual_display()) return;
    const Outcome outcome = on_display("run",
                                       "screenshot before.png\n"
                                       "click 640 318\nscreenshot picked.png\nprint\n"  // 0: the fourth from below
                                       "key Home\nprint\n"                              // 1
                                       "key End\nkey p\nprint\n"                        // 2
                                       "key Escape\nscreenshot after.png\nprint\n");    // 3
    INFO(outcome.err << outcome.out);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(printed(outcome, 0), Contains("symbol: F (internode)") && Contains("plant: stalk") &&
                                        Contains("born: step 4") && Contains("died: no") && Contains("length: 1 m") &&
                                        Contains("chart: length, m, 3 points"));
    CHECK_THAT(printed(outcome, 1), Contains("not there yet"));
    CHECK_THAT(printed(outcome, 2), Contains("no frame draws it"));
    CHECK_THAT(printed(outcome, 3), !Contains("organ:"));
    const Picture before(path() / "before.png"), picked(path() / "picked.png"), after(path() / "after.png");
    CHECK(before.width() == 1280);
    CHECK(before.height() == 800);
    CHECK(before.count(is_bright_red) == 0);
    CHECK(picked.count(is_bright_red) > 500);
    CHECK(after.count(is_bright_red) == 0);
    // The stalk stands in the middle and moves aside for the panel.
    CHECK_FALSE(before.at(640, 400) == before.at(100, 400));
    CHECK(picked.at(640, 400) == before.at(100, 400));
    CHECK_FALSE(picked.at(490, 400) == before.at(100, 400));
}

TEST_CASE_METHOD(Viewed, "colours, background and camera change by keys and mouse", "[app][view]") {
    if (!has_virtual_display()) return;
    const Outcome outcome = on_display("run --size 900x600",
                                       "screenshot natural.png\n"
                                       "key b\nscreenshot dark.png\nkey b\n"
                                       "key c\nprint\nscreenshot coloured.png\n"
                                       "key C\nprint\n"
                                       "drag 450 250 250 250\nscreenshot moved.png\n"
                                       "wheel 450 250 3\nscreenshot near.png\n"
                                       "key r\nscreenshot back.png\n"
                                       "key f\nprint\n");
    INFO(outcome.err << outcome.out);
    REQUIRE(outcome.code == 0);
    const auto picture = [&](const std::string& name) { return Picture(path() / (name + ".png")); };
    const Picture natural = picture("natural"), moved = picture("moved"), back = picture("back");
    CHECK(natural.width() == 900);
    CHECK(natural.count(is_dark) < 900 * 600 / 10);
    CHECK(picture("dark").count(is_dark) > 900 * 600 / 2);
    CHECK_THAT(printed(outcome, 0), !Contains("colour: natural"));
    CHECK_THAT(printed(outcome, 1), Contains("colour: natural"));
    CHECK_THAT(printed(outcome, 2), Contains("no fields"));
    const Pixel paper = natural.at(20, 300);
    CHECK_FALSE(natural.at(450, 300) == paper);
    CHECK_FALSE(picture("coloured").at(450, 300) == natural.at(450, 300));
    CHECK(moved.at(450, 300) == paper);
    CHECK_FALSE(moved.at(250, 300) == paper);  // a flat scene goes where the mouse goes
    const auto is_drawn = [&](const Pixel& p) { return p != paper; };
    CHECK(picture("near").count(is_drawn) > moved.count(is_drawn) + 500);
    CHECK(back.at(450, 300) == natural.at(450, 300));
}

TEST_CASE_METHOD(Viewed, "a window of any size draws what fits", "[app][view]") {
    if (!has_virtual_display()) return;
    for (const std::string size : {"120x90", "300x700"}) {
        const Outcome outcome = on_display("run --size " + size, "key h\nscreenshot a.png\nkey Escape\nclick 60 40\n");
        INFO(size << outcome.err);
        CHECK(outcome.code == 0);
        CHECK(outcome.err.empty());
        CHECK(fs::exists(path() / "a.png"));
    }
}

TEST_CASE_METHOD(Viewed, "a screenshot needs no display", "[app][view]") {
    const Outcome outcome = run("view run --step 2 --screenshot two.png --size 640x480 --dark", "env -u DISPLAY");
    if (!drew_view(outcome)) return;
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const Picture picture(path() / "two.png");
    CHECK(picture.width() == 640);
    CHECK(picture.height() == 480);
    CHECK(picture.count(is_dark) > 640 * 480 / 2);
    CHECK_FALSE(picture.at(320, 380) == picture.at(20, 380));
}

TEST_CASE_METHOD(Viewed, "a scene is shown while it grows, to its end", "[app][view]") {
    const Outcome outcome = without_display("stalk.l --steps 12 --output grown", "wait\nprint\nscreenshot end.png\n");
    if (!drew_view(outcome)) return;
    INFO(outcome.err << outcome.out);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("step 12") && Contains("frame: 13 of 13") && Contains("the run has ended"));
    CHECK_THAT(outcome.out, Contains("grown/\n"));
    CHECK(json::parse(text_of(path() / "grown/run.json"))["exit"] == "done");
    // The camera went back as the stalk grew: all of it is seen, and as large as there is room.
    const Picture end(path() / "end.png");
    const Pixel paper = end.at(100, 400);
    CHECK(end.at(640, 8) == paper);
    CHECK_FALSE(end.at(640, 80) == paper);
    CHECK_FALSE(end.at(640, 680) == paper);
    CHECK(end.at(640, 740) == paper);
}

TEST_CASE_METHOD(Viewed, "closing the window ends the run after the step at hand, and nothing is lost", "[app][view]") {
    write("patient.l", models::patient);
    const Outcome outcome = without_display("patient.l --output grown", "print\nkey q\n");
    if (!drew_view(outcome)) return;
    INFO(outcome.err << outcome.out);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("running") && Contains("live") && Contains("grown/\n"));
    CHECK(json::parse(text_of(path() / "grown/run.json"))["exit"] == "interrupted");
    CHECK(run("info grown").code == 0);
}

TEST_CASE_METHOD(Viewed, "--keep-running waits for the end of the run", "[app][view]") {
    const Outcome outcome = without_display("stalk.l --steps 40 --output grown --keep-running", "key q\n");
    if (!drew_view(outcome)) return;
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(json::parse(text_of(path() / "grown/run.json"))["exit"] == "done");
}

TEST_CASE_METHOD(Viewed, "a signal closes window and run", "[app][view]") {
    write("patient.l", models::patient);
    write("script.txt", "wait\n");
    if (!drew_view(run("view run --screenshot a.png"))) return;
    const Outcome outcome = run_until(
        {"view", "patient.l", "--output", "grown", "--script", "script.txt"},
        [&] { return fs::exists(path() / "grown/plants/0002.vtp"); }, [](pid_t process) { kill(process, SIGTERM); });
    INFO(outcome.err << outcome.out);
    CHECK(outcome.code == 130);
    CHECK(json::parse(text_of(path() / "grown/run.json"))["exit"] == "interrupted");
}

TEST_CASE_METHOD(Viewed, "mistakes in a scene and failures of its run are told", "[app][view]") {
    write("broken.l", "lsystem: 1\nderivation length: 3\naxiom: F(\nendlsystem\n");
    const Outcome broken = run("view broken.l --output grown --screenshot a.png", "env -u DISPLAY");
    CHECK(broken.code == 1);
    CHECK_THAT(broken.err, Contains("broken.l:3"));
    CHECK_FALSE(fs::exists(path() / "a.png"));
    write("zero.l", models::zero_by_zero);
    const Outcome failed = without_display("zero.l --output failed", "wait\nprint\n");
    if (!drew_view(failed)) return;
    INFO(failed.err << failed.out);
    CHECK(failed.code == 2);
    CHECK_THAT(failed.out, Contains("status: the run failed"));
    CHECK_THAT(failed.err, Contains("zero.l"));
}

TEST_CASE_METHOD(Viewed, "mistakes on the command line of view are named", "[app][view]") {
    write("script.txt", "key f\nclik 1 2\n");
    const Outcome script = run("view run --script script.txt", "env -u DISPLAY");
    CHECK(script.code == 1);
    CHECK_THAT(script.err, Contains("script:2") && Contains("'click'"));
    CHECK_THAT(run("view run --step 9 --screenshot a.png").err, Contains("no frame of step 9"));
    CHECK_THAT(run("view run --step x --screenshot a.png").err, Contains("--step x"));
    CHECK_THAT(run("view nowhere --screenshot a.png").err, Contains("nowhere"));
    const Outcome colour = run("view run --colour-by agee --screenshot a.png", "env -u DISPLAY");
    if (!drew_view(colour)) return;
    CHECK(colour.code == 1);
    CHECK_THAT(colour.err, Contains("agee") && Contains("age"));
}

// Pictures, films and sheets of a run as files.
#include "espalier/picture/render.h"

#include "espalier/base/error.h"

#include "picture/files/film.h"
#include "picture/pictures.h"
#include "picture/webm_reader.h"

#include <cstdlib>
#include <filesystem>

using namespace espalier;
using namespace espalier::picture;
using Catch::Contains;

namespace {

struct Rendered {
    RecordedFolder recorded;
    RecordedRun run{recorded.folder.path};

    RenderJob job() const { return {run, {&run.frames()[0], &run.frames()[1]}, {}, {}, 0, {}, false, {96, 72}, {}}; }
    std::filesystem::path path(const std::string& name) const { return recorded.folder.path / name; }
};

bool has_ffmpeg() {
    return std::system("ffmpeg -version >/dev/null 2>&1") == 0;
}

}  // namespace

TEST_CASE("render: a picture has its size, several are numbered by their steps", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    RenderJob job = rendered.job();
    std::vector<std::size_t> told;
    job.progress = [&](std::size_t drawn, std::size_t all) { told.insert(told.end(), {drawn, all}); };
    const auto files = render_pictures(job, rendered.path("plant.png"));
    REQUIRE(files.size() == 2);
    CHECK(files[0].filename() == "plant-0000.png");
    CHECK(files[1].filename() == "plant-0004.png");
    CHECK(told == std::vector<std::size_t>{1, 2, 2, 2});
    const auto image = read_png(files[1]);
    CHECK(image->GetDimensions()[0] == 96);
    CHECK(image->GetDimensions()[1] == 72);
    CHECK((bytes_of(files[0]) != bytes_of(files[1])));

    job.frames = {job.frames[1]};
    CHECK(render_pictures(job, rendered.path("one.png")) == std::vector{rendered.path("one.png")});
}

TEST_CASE("render: a frame in several files is drawn one file at a time, as a frame in one", "[pictures]") {
    if (!can_draw()) return;
    const double depth = GENERATE(0.0, 3.0);  // a flat run, and one with shadows
    const bool is_parallel = GENERATE(false, true);
    const auto drawn = [&](const std::string& settings) {
        const RunFolder folder;
        Timeline timeline(folder.path, timeline_table("fields = [\"light\"]\n" + settings), 0);
        const HandmadePlant left = branched_plant();
        HandmadePlant right = branched_plant();
        right.number = 1;
        for (Internode& internode : right.interpretation.geometry.internodes) {
            internode.base += glm::dvec3(0.5, 0, depth);
            internode.tip += glm::dvec3(0.5, 0, depth);
        }
        right.add_triangle(50);
        Fields fields;
        fields.provide(light_field(0.5f));
        record(timeline, 0, {&left, &right}, fields);
        timeline.finish();
        timeline.write_run(run_json);
        const RecordedRun run(folder.path);
        CHECK(run.frame(0).pieces().size() == (settings.empty() ? 1 : 2));
        CameraPlace camera{20, 10};
        camera.is_parallel = is_parallel;
        PictureStyle style;
        style.fields.emplace_back().name = "light";
        const RenderJob job{run, {&run.frame(0)}, style, camera, 0, true, false, {96, 72}, {}};
        return read_png(render_pictures(job, folder.path / "picture.png").front());
    };
    const auto whole = drawn(""), cut = drawn("points_per_file = 1\n");
    int different = 0, seen = 0;
    // Light comes from fewer directions where a frame is cut, because that is large.
    const int most = depth == 0 ? 2 : 30;
    for (int y = 0; y < 72; ++y) {
        for (int x = 0; x < 96; ++x) {
            const Pixel p = pixel_at(*whole, x, y), q = pixel_at(*cut, x, y);
            seen += !is_white(p);
            for (std::size_t k = 0; k < 3; ++k) different += std::abs(p[k] - q[k]) > most;
        }
    }
    CHECK(seen > 300);
    CHECK(different == 0);
}

TEST_CASE("render: the camera stays where it is while plants grow, and follows if it is told to", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    RenderJob job = rendered.job();
    job.style = Pictured::plain();
    job.ground = false;
    // The plant on the right is the same in both frames: so are its pixels.
    const auto same_pixels = [&](const std::string& name) {
        const auto files = render_pictures(job, rendered.path(name));
        const auto first = read_png(files[0]), last = read_png(files[1]);
        int different = 0, drawn = 0;
        for (int y = 0; y < 72; ++y) {
            for (int x = 60; x < 96; ++x) {
                different += pixel_at(*first, x, y) != pixel_at(*last, x, y);
                drawn += !is_white(pixel_at(*last, x, y));
            }
        }
        CHECK(drawn > 5);
        return different == 0;
    };
    CHECK(same_pixels("still.png"));
    job.orbit = 40;
    CHECK_FALSE(same_pixels("orbit.png"));
}

TEST_CASE("render: between two frames of a film organs unfold in as many pictures as asked for", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    RenderJob job = rendered.job();
    job.between = 3;
    std::size_t drawn = 0;
    job.progress = [&](std::size_t done, std::size_t all) {
        CHECK(done == ++drawn);
        CHECK(all == 5);
    };
    render_film(job, 10, rendered.path("unfolding.webm"));
    CHECK(drawn == 5);
    job.progress = nullptr;
    CHECK(render_pictures(job, rendered.path("still.png")).size() == 2);
}

TEST_CASE("render: a sheet has its frames side by side, and the keys at its right", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    RenderJob job = rendered.job();
    render_sheet(job, 2, rendered.path("row.png"));
    const auto row = read_png(rendered.path("row.png"));
    CHECK(row->GetDimensions()[0] == 192);
    CHECK(row->GetDimensions()[1] == 72);
    job.frames.push_back(job.frames[0]);
    render_sheet(job, 2, rendered.path("two-rows.png"));
    CHECK(read_png(rendered.path("two-rows.png"))->GetDimensions()[1] == 144);
    job.style.colour_by = "birth";
    render_sheet(job, 2, rendered.path("keys.png"));
    CHECK(read_png(rendered.path("keys.png"))->GetDimensions()[0] > 220);
}

TEST_CASE("render: a film is WebM that decodes to its pictures, in their size and colours", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    RenderJob job = rendered.job();
    job.size = {95, 71};  // colours have a value for 2 x 2 pixels, and here some for fewer
    job.orbit = 40;
    job.frames = evenly(job.frames, 70);  // more than from one key picture to the next
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);  // without ffmpeg
    render_film(job, 12.5, rendered.path("growth.webm"));
    render_film(job, 12.5, rendered.path("again.webm"));
    setenv("PATH", path.c_str(), 1);
    const std::string bytes = bytes_of(rendered.path("growth.webm"));
    CHECK((bytes == bytes_of(rendered.path("again.webm"))));
    const WebmReader film(bytes);
    CHECK(film.width == 95);
    CHECK(film.height == 71);
    CHECK(film.milliseconds == 5600);
    REQUIRE(film.pictures.size() == 70);
    for (std::size_t i = 0; i < 70; ++i) CHECK(film.pictures[i].time == std::lround(80.0 * static_cast<double>(i)));
    CHECK(film.pictures[0].is_key);
    CHECK(film.cues.size() >= 2);
    for (const auto& [time, place] : film.cues) CHECK(film.cluster_time_at(place) == time);

    RenderJob last = job;
    last.frames = {job.frames.back()};
    last.orbit = 0;
    last.camera.azimuth += 40;
    last.camera.turns = true;
    last.style.background.transparent = false;
    render_pictures(last, rendered.path("last.png"));
    const auto still = read_png(rendered.path("last.png"));
    const std::vector<DecodedPicture> decoded = decoded_pictures(film);
    REQUIRE(decoded.size() == 70);
    CHECK(decoded.back().difference(*still) < 4);
    CHECK(decoded.front().difference(*still) > decoded.back().difference(*still));
    CHECK_THROWS_AS(render_film(job, 10, rendered.path("no/growth.webm")), RunError);
    CHECK_FALSE(std::filesystem::exists(rendered.path("no")));
}

TEST_CASE("render: ffmpeg writes the other films, odd sizes too", "[pictures]") {
    if (!can_draw()) return;
    if (!has_ffmpeg()) {
        WARN("skipped: no ffmpeg here");
        return;
    }
    const Rendered rendered;
    RenderJob job = rendered.job();
    job.size = {95, 71};
    render_film(job, 10, rendered.path("growth.GIF"));
    CHECK(bytes_of(rendered.path("growth.GIF")).starts_with("GIF89a"));
    CHECK_THROWS_AS(render_film(job, 10, rendered.path("no/growth.gif")), RunError);
}

TEST_CASE("render: a film says what its colours are, since browsers guess", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    const auto film = [&](const std::string& name) {
        render_film(rendered.job(), 10, rendered.path(name));
        return bytes_of(rendered.path(name));
    };
    // The elements of Matroska (RFC 9559) for matrix, range, transfer and primaries: 6, limited, sRGB's, BT.709's.
    const WebmReader webm(film("growth.webm"));
    CHECK(webm.codec == "V_VP9");
    CHECK(webm.colour == std::map<std::uint64_t, std::uint64_t>{{0x55B1, 6}, {0x55B9, 1}, {0x55BA, 13}, {0x55BB, 1}});
    if (!has_ffmpeg()) {
        WARN("skipped: no ffmpeg here");
        return;
    }
    // The box `colr` of ISO 14496-12: primaries, transfer, matrix.
    const std::string colr("nclx\0\1\0\15\0\6\0", 11);
    CHECK(film("growth.mp4").find(colr) != std::string::npos);
}

TEST_CASE("render: where ffmpeg is missing or fails, that is said and no file is left", "[pictures]") {
    if (!can_draw()) return;
    const Rendered rendered;
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    CHECK_THROWS_WITH(render_film(rendered.job(), 10, rendered.path("growth.mp4")), Contains("apt-get install ffmpeg"));
    setenv("PATH", path.c_str(), 1);
    CHECK_FALSE(std::filesystem::exists(rendered.path("growth.mp4")));
    // Something called ffmpeg that reads nothing and says why.
    const std::filesystem::path folder = rendered.path("bin");
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "ffmpeg") << "#!/bin/sh\necho no such encoder >&2\nexit 1\n";
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
    CHECK_THROWS_WITH(render_film(rendered.job(), 10, rendered.path("growth.mp4")), Contains("no such encoder"));
    setenv("PATH", path.c_str(), 1);
    CHECK_FALSE(std::filesystem::exists(rendered.path("growth.mp4")));
}

TEST_CASE("render: other kinds and absurd sizes are refused", "[pictures]") {
    const Rendered rendered;
    RenderJob job = rendered.job();
    CHECK_THROWS_WITH(render_pictures(job, rendered.path("plant.jpg")), Contains(".png"));
    CHECK_THROWS_AS(render_film(job, 10, rendered.path("plant.avi")), UserError);
    CHECK(is_film("a.GIF"));
    CHECK_FALSE(is_film("a.png"));
    job.size = {0, 10};
    CHECK_THROWS_AS(render_pictures(job, rendered.path("plant.png")), UserError);
    job.size = {100000, 10};
    CHECK_THROWS_AS(render_pictures(job, rendered.path("plant.png")), UserError);
}

TEST_CASE("render: frames are chosen evenly, first and last among them", "[pictures]") {
    const std::vector<RecordedFrame> frames(10);
    std::vector<const RecordedFrame*> all;
    for (const RecordedFrame& frame : frames) all.push_back(&frame);
    CHECK(evenly(all, 4) == std::vector{all[0], all[3], all[6], all[9]});
    CHECK(evenly(all, 1) == std::vector{all[9]});
    CHECK(evenly({all[2]}, 3) == std::vector{all[2], all[2], all[2]});
    CHECK(evenly({}, 3).empty());
}

TEST_CASE("render: where nothing is drawn it says so", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant nothing;
    const Pictured pictured({&nothing});
    const RenderJob job{*pictured.run, {&pictured.run->frames()[1]}, {}, {}, 0, {}, false, {96, 72}, {}};
    const auto path = pictured.folder.path / "nothing.png";
    CHECK_THROWS_AS(render_pictures(job, path), UserError);
    CHECK_THROWS_WITH(render_pictures(job, path), Contains("nothing to draw"));
    CHECK_FALSE(std::filesystem::exists(path));
}

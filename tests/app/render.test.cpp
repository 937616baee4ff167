// espalier render, from outside: the files it makes and the words it says.
#include "catch.h"
#include "program.h"

#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>

using Catch::Contains;

namespace {

const char* const rendered_scene = R"([simulation]
steps = 4
[[plant]]
name = "left"
model = "bush.l"
[[plant]]
name = "right"
model = "bush.l"
position = [4, 0, 0]
[timeline]
parameters = { length = "F.1" }
)";

struct RenderPlace : Workplace {
    RenderPlace() {
        write("bush.l", models::bush);
        write("pair.toml", rendered_scene);
    }

    /// False, and says so, where nothing can be drawn.
    bool grow() const {
        REQUIRE(run("run pair.toml --output run --quiet").code == 0);
        const Outcome outcome = run("render run --size 16x16");
        if (outcome.code == 2 && outcome.err.find("no picture can be drawn here") != std::string::npos) {
            WARN("skipped: " << outcome.err);
            return false;
        }
        CHECK(outcome.err == "");
        REQUIRE(outcome.code == 0);
        return true;
    }

    std::string bytes(const std::string& name) const { return text_of(path() / name); }

    /// Width and height, as a PNG's header says.
    std::array<int, 2> size_of(const std::string& name) const {
        const std::string png = bytes(name);
        REQUIRE(png.size() > 24);
        REQUIRE(png.substr(1, 3) == "PNG");
        const auto number = [&](std::size_t at) {
            int value = 0;
            for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + static_cast<unsigned char>(png[i]);
            return value;
        };
        return {number(16), number(20)};
    }
};

/// Pictures of a GIF: graphic control extensions.
int pictures_in_gif(const std::string& bytes) {
    int count = 0;
    const std::string mark("\x21\xF9\x04", 3);
    for (std::size_t at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark, at + 1)) ++count;
    return count;
}

}  // namespace

TEST_CASE("render: a run becomes a picture of the last step, of the size asked for", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    CHECK(place.size_of("run/render.png") == std::array{16, 16});
    CHECK(place.run("render run --size 120x80 --output a.png").out == "a.png\n");
    CHECK(place.size_of("a.png") == std::array{120, 80});
    CHECK(place.run("render run --size 120x80 --output b.png").code == 0);
    CHECK((place.bytes("a.png") == place.bytes("b.png")));
    CHECK(place.run("render run --size 120x80 --step 0 --output first.png").code == 0);
    CHECK((place.bytes("a.png") != place.bytes("first.png")));
    const Outcome several = place.run("render run --size 60x40 --step 0:4:2 --output s.png");
    CHECK(several.out == "s-0000.png\ns-0002.png\ns-0004.png\n");
    CHECK_THAT(place.run("render run --size 60x40 --json --output j.png").out, Contains("\"j.png\""));
    CHECK(place.run("render run --size 60x40 --quiet --output q.png").out == "");
}

TEST_CASE("render: every way to look gives a picture of its own", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    std::set<std::string> pictures;
    int count = 0;
    for (const char* way :
         {"", "--dark", "--background '#ffeedd'", "--background transparent", "--colour-by birth", "--colour-by plant",
          "--colour-by length", "--colour-by length --range 0:5", "--colour-by order --no-legend", "--plant left",
          "--azimuth 80", "--elevation 60", "--zoom 2", "--scale-bar", "--time", "--title Bushes"}) {
        const Outcome outcome = place.run(std::string("render run --size 160x120 --output w.png ") + way);
        CHECK(outcome.err == "");
        CHECK(outcome.code == 0);
        pictures.insert(place.bytes("w.png"));
        ++count;
    }
    CHECK(static_cast<int>(pictures.size()) == count);
}

TEST_CASE("render: a scene is grown first, a model too", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    const Outcome outcome = place.run("render pair.toml --run-output grown --steps 3 --size 60x40 --output s.png");
    CHECK_THAT(outcome.out, Contains("3 of 3 steps") && Contains("s.png"));
    CHECK(outcome.code == 0);
    CHECK(place.size_of("s.png") == std::array{60, 40});
    CHECK(std::filesystem::exists(place.path() / "grown" / "run.json"));
    CHECK(place.run("render pair.toml --run-output grown --output s.png").code == 1);  // it is there already
    CHECK(place.run("render pair.toml --run-output grown --overwrite --quiet --size 60x40").out == "");
    CHECK(place.size_of("grown/render.png") == std::array{60, 40});
    CHECK(place.run("render bush.l --run-output bush --size 60x40 --quiet").code == 0);
    CHECK(place.size_of("bush/render.png") == std::array{60, 40});
}

TEST_CASE("render: a contact sheet holds columns and rows", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    CHECK(place.run("render run --sheet 3x2 --size 80x60 --output sheet.png").code == 0);
    CHECK(place.size_of("sheet.png") == std::array{240, 120});  // five frames
    CHECK(place.run("render run --sheet 2x1 --size 80x60 --output sheet.png").code == 0);
    CHECK(place.size_of("sheet.png") == std::array{160, 60});
    CHECK(place.run("render run --sheet 2x1 --size 80x60 --colour-by age --output keys.png").code == 0);
    CHECK(place.size_of("keys.png")[0] > 180);
}

TEST_CASE("render: films have the frames asked for", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    CHECK(place.run("render run --size 64x48 --output f.webm").code == 0);
    CHECK(place.bytes("f.webm").starts_with("\x1A\x45\xDF\xA3"));
    CHECK(place.run("render run --size 64x48 --output unfolding.webm --between 2").code == 0);
    CHECK_THAT(place.run("render run --output still.png --between 2").err, Contains("'still.png' is no film"));
    CHECK(place.run("render run --size 64x48 --output turn.webm --step last --orbit 360 --frames 6").code == 0);
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) {
        WARN("skipped: no ffmpeg here");
        return;
    }
    CHECK(place.run("render run --size 64x48 --output f.gif").code == 0);
    CHECK(pictures_in_gif(place.bytes("f.gif")) == 5);
    CHECK(place.run("render run --size 64x48 --output f.gif --step last --orbit 360 --frames 7").code == 0);
    CHECK(pictures_in_gif(place.bytes("f.gif")) == 7);
}

TEST_CASE("render: a film of a long run has 100 pictures, unless one asks for other steps", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    place.write("long.l", "lsystem: 1\nderivation length: 120\naxiom: A\nA --> F(0.1) A\nendlsystem\n");
    REQUIRE(place.run("run long.l --output long --quiet").code == 0);
    const auto seconds = [&](const std::string& options) {
        REQUIRE(place.run("render long --size 32x24 --rate 10 --output f.webm " + options).code == 0);
        const std::string bytes = place.bytes("f.webm"), duration = "\x44\x89";
        std::uint64_t bits = 0;
        const std::size_t at = bytes.find(duration) + 2 + 8;  // behind its name and its length
        for (std::size_t i = 0; i < 8; ++i) bits = bits << 8 | static_cast<unsigned char>(bytes.at(at + i));
        return std::bit_cast<double>(bits) / 1000;
    };
    CHECK(seconds("") == 10);
    CHECK(seconds("--step all") == 12.1);
    CHECK(seconds("--step 0:20") == 2.1);
    CHECK(seconds("--frames 130") == 13);
}

TEST_CASE("render: slices are seen from their front, unless one asks for a camera", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    place.write("lit.toml", std::string(rendered_scene) +
                                "fields = [\"light\"]\n[environment.light]\nprocess = \"voxel-shade\"\nvoxel = 0.5\n");
    REQUIRE(place.run("run lit.toml --output lit --quiet").code == 0);
    const auto picture = [&](const std::string& options) {
        REQUIRE(place.run("render lit --size 64x48 --output s.png --quiet " + options).code == 0);
        return place.bytes("s.png");
    };
    const std::string slice = "--field light:slice=";
    CHECK((picture(slice + "x") == picture(slice + "x --azimuth 90 --elevation 0")));
    CHECK((picture(slice + "y") == picture(slice + "y --azimuth 0 --elevation 90")));
    CHECK((picture(slice + "z") == picture(slice + "z --azimuth 0 --elevation 0")));
    CHECK((picture(slice + "x") != picture(slice + "x --azimuth 30")));
}

TEST_CASE("render: without ffmpeg it says what to install, exit code 2, and leaves nothing", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    const Outcome outcome = place.run("render run --size 64x48 --output f.mp4", "PATH=/nowhere");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("apt-get install ffmpeg"));
    CHECK_FALSE(std::filesystem::exists(place.path() / "f.mp4"));
}

TEST_CASE("render: a film that is interrupted leaves nothing", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    const auto begun = [&] {
        for (const auto& entry : std::filesystem::directory_iterator(place.path())) {
            if (entry.path().filename().string().find(".film.") == 0) return true;
        }
        return false;
    };
    const std::vector<std::string> many{"--frames", "100000", "--step", "last", "--orbit", "1"};
    const std::vector<std::string> slow{"--light", "--samples", "65536", "--size", "2000x2000"};
    for (const auto& how : {many, slow}) {
        std::vector<std::string> words{"render", "run", "--output", "film.webm"};
        words.insert(words.end(), how.begin(), how.end());
        // The first picture of the slow film takes minutes, and the film begins after it.
        const auto at_work = [&] { return begun() || how == slow; };
        const Outcome outcome = place.run_until(words, at_work, [](pid_t child) { kill(child, SIGINT); });
        CHECK(outcome.code == 130);
        CHECK_FALSE(begun());
        CHECK_FALSE(std::filesystem::exists(place.path() / "film.webm"));
    }
}

TEST_CASE("render: light makes pictures, sheets and films, the same with any number of threads", "[render][light]") {
    const RenderPlace place;
    if (!place.grow()) return;
    const std::string light = "--light --samples 2 --size 40x30 --quiet ";
    REQUIRE(place.run("render run --output plain.png --size 40x30 --quiet").code == 0);
    REQUIRE(place.run("render run --output a.png " + light).code == 0);
    CHECK(place.size_of("a.png") == std::array{40, 30});
    REQUIRE(place.run("render run --output b.png " + light, "taskset -c 0").code == 0);
    CHECK((place.bytes("a.png") == place.bytes("b.png")));
    std::set<std::string> all{place.bytes("plain.png"), place.bytes("a.png")};
    std::size_t count = 2;
    for (const char* words : {"--sun 60:20", "--sky overcast", "--sky uniform", "--exposure -1", "--background light",
                              "--dark", "--background transparent", "--samples 9", "--colour-by birth", "--plant left",
                              "--azimuth 90", "--title Light"}) {
        CAPTURE(words);
        const std::string own = std::string(words) == "--samples 9" ? "--light --size 40x30 --quiet " : light;
        REQUIRE(place.run("render run --output x.png " + own + words).code == 0);
        all.insert(place.bytes("x.png"));
        CHECK(all.size() == ++count);
    }
    REQUIRE(place.run("render run --output sheet.png --sheet 2x1 " + light).code == 0);
    CHECK(place.size_of("sheet.png") == std::array{80, 30});
    REQUIRE(place.run("render run --output film.webm --frames 2 " + light).code == 0);
    CHECK_FALSE(place.bytes("film.webm").empty());
    REQUIRE(place.run("render run --output many.png --step 3:4 " + light).code == 0);
    CHECK(std::filesystem::exists(place.path() / "many-0003.png"));
}

TEST_CASE("render: the sun of a picture by light stands where that of the scene does", "[render][light]") {
    const RenderPlace place;
    if (!place.grow()) return;
    const std::string head = std::string(rendered_scene) + "[environment.light]\nprocess = \"ray-light\"\npaths = 64\n";
    const std::string steady = "sky = { par = 1000, diffuse = 0.2, radiance = \"cie-12\", sun = [";
    place.write("east.toml", head + steady + "1, 1, 0] }\n");
    place.write("hours.toml", head + "days = 0.05\nsky = { latitude = 50, day = 172, hours = [12] }\n");
    const std::string light = " --light --samples 2 --size 40x30 --quiet ";
    REQUIRE(place.run("render east.toml --run-output east --output a.png" + light).code == 0);
    REQUIRE(place.run("render east --output b.png --sun 90:45" + light).code == 0);
    REQUIRE(place.run("render east --output c.png --sun -90:45" + light).code == 0);
    CHECK((place.bytes("a.png") == place.bytes("b.png")));
    CHECK((place.bytes("a.png") != place.bytes("c.png")));
    CHECK(place.run("render hours.toml --run-output hours --output d.png" + light).code == 0);
    // Of several suns the one that brings most light.
    const std::string two = "sky = { par = 1000, diffuse = 0.2, radiance = \"cie-12\", suns = [[0, 1, 1], [1, 1, 0]], ";
    place.write("suns.toml", head + two + "sun_shares = [1, 3] }\n");
    REQUIRE(place.run("render suns.toml --run-output suns --output e.png" + light).code == 0);
    CHECK((place.bytes("e.png") == place.bytes("b.png")));
}

TEST_CASE("render: wrong words are told with what is meant, exit code 1", "[render]") {
    const RenderPlace place;
    REQUIRE(place.run("run pair.toml --output run --quiet").code == 0);
    const auto refuses = [&](const std::string& words, const std::string& answer) {
        const Outcome outcome = place.run("render run --output x.png " + words);
        if (outcome.code == 2) return;  // nothing can be drawn here
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(answer));
        CHECK_FALSE(std::filesystem::exists(place.path() / "x.png"));
    };
    refuses("--colour-by brith", "did you mean 'birth'?");
    refuses("--field light", "no field 'light'");
    refuses("--field light:slcie", "did you mean 'slice'?");
    refuses("--field light:slice=w", "expected slice=z");
    refuses("--field light:iso=much", "expected iso=0.3");
    refuses("--field :slice", "the name of a field");
    refuses("--plant lefft", "did you mean 'left'?");
    refuses("--step 99", "no frame of step 99");
    refuses("--background blueish", "#rrggbb");
    refuses("--background '#12345g'", "#rrggbb");
    refuses("--range 3:1", "LOW:HIGH");
    refuses("--range nan:1", "LOW:HIGH");
    refuses("--size 0x10", "WIDTHxHEIGHT");
    refuses("--sheet 4", "COLUMNSxROWS");
    refuses("--sheet 1000x1000", "10,000");
    refuses("--elevation 100", "100");
    refuses("--samples 9", "needs --light");
    refuses("--sun 3:4", "needs --light");
    refuses("--light --no-shade", "do not go together");
    refuses("--light --sun 3", "AZIMUTH:ELEVATION");
    refuses("--light --sun 3:-4", "AZIMUTH:ELEVATION");
    refuses("--light --sky blue", "blue");
    refuses("--light --samples 0", "0");
    CHECK(place.run("render run --output x.jpg").code == 1);
    CHECK(place.run("render nothere").code == 1);
    CHECK(place.run("render").code == 1);
}

TEST_CASE("render: what a scene will not hold is told before it is grown", "[render]") {
    const RenderPlace place;
    const auto fails = [&](const std::string& options, const std::string& words, int code = 1,
                           const std::string& surroundings = {}) {
        const Outcome outcome = place.run("render pair.toml --run-output grown --quiet " + options, surroundings);
        CHECK(outcome.code == code);
        CHECK_THAT(outcome.err, Contains(words));
        CHECK_FALSE(std::filesystem::exists(place.path() / "grown"));
    };
    fails("--field light:slice", "--field light: pair.toml will have nothing with that name");
    fails("--colour-by lenght", "did you mean 'length'?");
    fails("--plant lef", "did you mean 'left'?");
    fails("--output x.jpg", "no picture that can be written");
    fails("--sheet 2x2 --output x.mp4", "no picture that can be written");
    fails("--range 2:1", "--range 2:1");
    fails("--background pale", "--background pale");
    fails("--step 3:x", "--step 3:x: expected a step, first, last");
    fails("--sheet 200x200", "10,000");
    fails("--output x.mp4", "apt-get install ffmpeg", 2, "PATH=/nowhere");
}

TEST_CASE("render: any file of a run stands for the run", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    for (const char* file : {"run/run.json", "run/plants.pvd", "run/plants/0004.vtp"}) {
        const Outcome outcome = place.run(std::string("render ") + file + " --size 16x16");
        INFO(file << outcome.err);
        CHECK(outcome.code == 0);
        CHECK(outcome.out == "run/render.png\n");
    }
}

TEST_CASE("render: a model that draws nothing is told, exit code 1", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    place.write("empty.l", "lsystem: 1\nderivation length: 1\naxiom: A\nA --> B\nendlsystem\n");
    const Outcome outcome = place.run("render empty.l --run-output empty --output empty.png --quiet");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("nothing to draw"));
    CHECK_FALSE(std::filesystem::exists(place.path() / "empty.png"));
}

TEST_CASE("render: a view file says from where, unless the camera is ours", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    place.write("bush.v", "viewpoint: 0,5,1\nbackground color: 0,0,1\nline style: cylinder\n");
    REQUIRE(place.run("run bush.l --view bush.v --output seen --quiet").code == 0);
    const auto drawn = [&](const std::string& options) {
        REQUIRE(place.run("render seen --size 32x32 --output seen.png " + options).code == 0);
        return place.bytes("seen.png");
    };
    const std::string as_author = drawn("");
    CHECK(as_author == drawn("--camera author"));
    CHECK(as_author != drawn("--camera auto"));
    CHECK(as_author != drawn("--elevation 0"));
    CHECK(as_author != drawn("--background light"));
}

TEST_CASE("render: masks lie beside pictures, and films and sheets have none", "[render]") {
    const RenderPlace place;
    if (!place.grow()) return;
    const Outcome outcome = place.run("render run --masks --size 32x24 --step 0:4:4 --output two.png");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("two-0000.png\n") && Contains("two-0004-depth.npy\n") &&
                                Contains("two-0004-organs.csv\n") && Contains("two-0004-camera.json\n"));
    CHECK(place.bytes("two-0004-organ.npy").size() == 128 + 4 * 32 * 24);
    CHECK(place.bytes("two-0004-plant.png").substr(1, 3) == "PNG");
    for (const char* words : {"--sheet 2x2 --output x.png", "--output x.webm"}) {
        const Outcome wrong = place.run(std::string("render run --masks ") + words);
        CHECK(wrong.code == 1);
        CHECK_THAT(wrong.err, Contains("films and sheets have no masks"));
    }
}

// `espalier tree` from outside: options from a model's settings, files that are never replaced.
#include "espalier/archive/recorded_run.h"

#include "catch.h"
#include "formats/silhouette.h"
#include "program.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// A place with a small tree of its own: a cloud of points above a stem of one internode.
struct Nursery : Workplace {
    Nursery() {
        for (const char* folder : {"environments/presets", "models/colonization"}) {
            fs::create_directories(path() / folder);
        }
        write("models/colonization/tree.l", R"(/* --- Crown --- */
#define AGE 8        /* iterations; 0..400 whole; steps */
#define WIDTH 3      /* width of the crown; 0.5..40; m */
#define HEIGHT 1     /* where the crown begins; 0..500; m */
/* --- Stem --- */
#define TIP_RADIUS 0.01 /* of the thinnest twigs; 0.001..1; m */
#define STEM 1       /* internodes below the crown; 0..9 whole */
#define REACH (WIDTH / 2)
environment cloud;
lsystem: 1
derivation length: AGE
axiom: F(STEM * HEIGHT) ?cloud(0, 0, 0, 0)
?cloud(n, x, y, z) : n > 0 --> ?cloud(0, x, y, z) [@R(x, y, z) F(0.25) ?cloud(0, 0, 0, 0)]
homomorphism
F(l) : l == 0 --> *
endlsystem
)");
        write("environments/tree.toml", R"([simulation]
seed = 5
[[plant]]
model = "../models/colonization/tree.l"
[[plant.stage]]
stage = "pipe-radii"
tip = "= TIP_RADIUS"
[environment.cloud]
process = "markers"
influence = "= REACH"
kill = 0.3
[environment.cloud.cloud]
radii = ["= WIDTH / 2", 1, "= WIDTH / 2"]
base = [0, "= HEIGHT", 0]
number = 300
)");
        write("environments/presets/weeping.toml", "# A tree that weeps\nwidth = 5\nage = 6\n");
        write("environments/presets/young.toml", "# A young tree\nage = 3\n");
    }

    std::vector<std::string> files(const std::string& extension) const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(path())) {
            if (entry.path().extension() == extension) found.push_back(entry.path().filename().string());
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    std::string text(const std::string& file) const { return text_of(path() / file); }
};

std::size_t lines_that_begin(const std::string& beginning, const std::string& text) {
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with(beginning);
    return count;
}

/// Where the internodes of a kept run's last frame end.
std::set<std::array<float, 3>> nodes(const fs::path& folder) {
    const espalier::RecordedRun run(folder);
    std::set<std::array<float, 3>> found;
    for (const auto& internode : internodes_of(run.geometry(run.frames().back()))) {
        found.insert({internode.tip.x, internode.tip.y, internode.tip.z});
    }
    return found;
}

}  // namespace

namespace {

/// The last step of `espalier analyse`.
json measures_of(const Workplace& place, const std::string& folder) {
    REQUIRE(place.run("analyse " + folder + " --step last --no-picture --format json").code == 0);
    return json::parse(text_of(place.path() / folder / "analysis/analysis.json"))["frames"].back()["plants"][0];
}

/// Degrees from the vertical to the line from the middle of a trunk's foot to the middle of its section at a height.
double trunk_lean(const espalier::ObjFile& mesh, double height) {
    const auto middle_at = [&](double level) {
        glm::dvec3 low(1e9), high(-1e9);
        for (const auto& face : mesh.faces) {
            if (face.group.find("axis") == std::string::npos) continue;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 &a = mesh.points[face.points[static_cast<std::size_t>(k)]],
                                 &b = mesh.points[face.points[static_cast<std::size_t>((k + 1) % 3)]];
                if ((a.y < level) == (b.y < level)) continue;
                const glm::dvec3 cut = a + (level - a.y) / (b.y - a.y) * (b - a);
                low = glm::min(low, cut);
                high = glm::max(high, cut);
            }
        }
        return 0.5 * (low + high);
    };
    const glm::dvec3 along = middle_at(height) - middle_at(0.02 * height);
    return glm::degrees(std::acos(along.y / glm::length(along)));
}

}  // namespace

// Of a decurrent tree with less than about 13 streams of order 4, one in ten has only 5 orders, and a ratio of 5.7.
TEST_CASE_METHOD(Workplace,
                 "a tree of each preset has a branching ratio from 3 to 5 and a pipe exponent from 1.8 to 2.3",
                 "[tree]") {
    int seed = 90;
    for (const std::string preset : {"decurrent", "excurrent", "flat", "gnarly", "orchard", "shrub", "weeping",
                                     "decurrent", "decurrent", "decurrent"}) {
        INFO(preset << ", seed " << ++seed);
        const std::string name = fmt::format("{}-{}", preset, seed);
        REQUIRE(run(fmt::format("tree --preset {} --leaves 0 --seed {} --run {} --output t.stl --quiet", preset, seed,
                                name))
                    .code == 0);
        const json measures = measures_of(*this, name);
        CHECK(measures["branching_ratio"] >= 3);
        CHECK(measures["branching_ratio"] <= 5);
        CHECK(measures["pipe_exponent"] >= 1.8);
        CHECK(measures["pipe_exponent"] <= 2.3);
    }
}

TEST_CASE_METHOD(Workplace, "in a decurrent crown no axis is longer than 40 % of the crown's height", "[tree]") {
    for (const int seed : {101, 102, 103}) {
        INFO("seed " << seed);
        const std::string name = std::to_string(seed);
        REQUIRE(
            run("tree --preset decurrent --leaves 0 --seed " + name + " --run " + name + " --output " + name + ".stl")
                .code == 0);
        const json measures = measures_of(*this, name);
        const double base = measures["crown_base"], height = measures["height"];
        CHECK(base == Approx(2).margin(0.3));  // the stem's length
        const espalier::RecordedRun recorded(path() / name);
        std::map<espalier::LineIndex, double> length;
        for (const auto& one : internodes_of(recorded.geometry(recorded.frames().back()))) {
            if (one.base.y > base - 0.01) length[one.axis] += glm::distance(one.base, one.tip);
        }
        double longest = 0;
        for (const auto& [axis, metres] : length) longest = std::max(longest, metres);
        CHECK(longest <= 0.4 * (height - base));
        CHECK(longest > 1);
    }
}

TEST_CASE_METHOD(Nursery, "the settings of the model are options, in groups, with range, unit and default", "[tree]") {
    const Outcome help = run("tree --help");
    CHECK(help.code == 0);
    CHECK_THAT(help.out, Contains("Crown:\n") && Contains("Stem:\n") &&
                             Contains("of the thinnest twigs (0.001..1 m; default 0.01)") &&
                             Contains("iterations (0..400 whole steps; default 8)"));
    CHECK_THAT(help.out, Contains("5 settings") && Contains("weeping  A tree that weeps"));
    CHECK(help.out.find("Crown:") < help.out.find("--width"));
    CHECK(help.out.find("Stem:") < help.out.find("--tip-radius"));
}

TEST_CASE_METHOD(Nursery, "a tree is written as OBJ whose name says how many vertices and triangles it has", "[tree]") {
    const Outcome outcome = run("tree");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const std::vector<std::string> files = this->files(".obj");
    REQUIRE(files.size() == 1);
    const std::string obj = text(files[0]);
    const std::size_t vertices = lines_that_begin("v ", obj), triangles = lines_that_begin("f ", obj);
    CHECK(triangles > 100);
    CHECK(files[0] == fmt::format("tree-{}-{}.obj", vertices, triangles));
    CHECK_THAT(outcome.out,
               Contains(files[0]) && Contains(" vertices, ") && Contains(" triangles, ") && Contains(" s\n"));
    CHECK_THAT(outcome.err, Contains("step 8/8"));
    CHECK(run("tree --quiet").out.empty());
    CHECK(this->files(".obj").size() == 2);  // the same tree again, numbered
}

TEST_CASE_METHOD(Nursery, "a file that is there stays, whatever the format", "[tree]") {
    for (const std::string extension : {"obj", "glb", "usda", "ply", "stl"}) {
        const std::string command = "tree --quiet --age 3 --output oak." + extension;
        REQUIRE(run(command).code == 0);
        const std::string first = text("oak." + extension);
        CHECK(!first.empty());
        REQUIRE(run(command + " --width 5").code == 0);
        CHECK(text("oak." + extension) == first);
        CHECK(text("oak-2." + extension) != first);
    }
    CHECK_THAT(run("tree --output oak.bmp").err, Contains("--output oak.bmp") && Contains(".obj"));
    CHECK(run("tree --quiet --counts --age 3 --output counted.obj").code == 0);
    CHECK(lines_that_begin("counted-", files(".obj").front()) == 1);
}

TEST_CASE_METHOD(Nursery, "a new seed keeps the settings and changes the tree", "[tree]") {
    const Outcome first = run("tree --seed new --width 4 --save-settings a.toml --output a.obj");
    const Outcome second = run("tree --seed new --width 4 --save-settings b.toml --output b.obj");
    REQUIRE(first.code == 0);
    CHECK_THAT(first.out, Contains("seed "));
    const std::string a = text("a.toml"), b = text("b.toml");
    const auto settings = [](const std::string& table) { return table.substr(table.find("\n# Crown")); };
    CHECK(settings(a) == settings(b));
    CHECK_THAT(a, Contains("width = 4  # width of the crown; 0.5..40 m\n"));
    CHECK(a != b);
    CHECK(text("a.obj") != text("b.obj"));
    // The file grows the same tree again, also with another seed.
    CHECK(run("tree --settings a.toml --output again.obj").code == 0);
    CHECK(text("again.obj").substr(text("again.obj").find("\nv ")) == text("a.obj").substr(text("a.obj").find("\nv ")));
    CHECK(run("tree --settings a.toml --seed 1 --output other.obj").code == 0);
    CHECK(text("other.obj") != text("again.obj"));
    CHECK(run("tree --quiet --age 2 --save-settings a.toml").code == 0);
    CHECK(text("a.toml") == a);
    CHECK_THAT(text("a-2.toml"), Contains("age = 2 ") && Contains("seed = 5\n"));
}

TEST_CASE_METHOD(Nursery, "options count more than a file of settings, and that more than a preset", "[tree]") {
    write("wide.toml", "width = 7\n");
    CHECK(run("tree --preset weeping --settings wide.toml --height 2 --quiet --save-settings all.toml").code == 0);
    CHECK_THAT(text("all.toml"), Contains("\nwidth = 7 ") && Contains("\nage = 6 ") && Contains("\nheight = 2 "));
}

TEST_CASE_METHOD(Nursery, "tree explains what it cannot do", "[tree]") {
    const auto refused = [&](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run("tree " + arguments);
        INFO(outcome.err);
        CHECK(outcome.code == 1);
        CHECK(outcome.err.find(words) != std::string::npos);
    };
    refused("--preset weping", "there is no preset 'weping' (did you mean 'weeping'?); the presets are weeping, young");
    refused("--width 50", "--width (width of the crown) must be a number between 0.5 and 40 m, not 50");
    refused("--width broad", "--width (width of the crown) must be a number between 0.5 and 40 m, not broad");
    refused("--age 2.5", "--age (iterations) must be a whole number between 0 and 400 steps, not 2.5");
    refused("--widht 4", "espalier tree has no option '--widht' (did you mean '--width'?)");
    refused("--seed old", "--seed old: expected a whole number");
    write("wrong.toml", "age = 4\nwidht = 4\n");
    refused("--settings wrong.toml", "wrong.toml:2:1: there is no setting 'widht' (did you mean 'width'?)");
    write("far.toml", "age = 4\nwidth = 0.1\n");
    refused("--settings far.toml", "far.toml:2:1: 'width' (width of the crown) must be a number between 0.5 and 40 m");
    CHECK(files(".obj").empty());
    fs::remove(path() / "models/colonization/tree.l");
    refused("--width 4", "tree.l");
}

TEST_CASE_METHOD(Nursery, "a tree that cannot grow says why, and nothing is written without an internode", "[tree]") {
    // The crown begins far above the stem.
    const Outcome bare = run("tree --height 400 --stem 0");
    INFO(bare.err);
    CHECK(bare.code == 1);
    CHECK_THAT(bare.err, Contains("in the reach of a node") && Contains("no internode has grown"));
    CHECK(files(".obj").empty());
}

TEST_CASE_METHOD(Nursery, "an early end of growth has an exit code and a reason, and the tree is written", "[tree]") {
    const auto end = [&](const std::string& options, int code, const std::string& reason) {
        const Outcome outcome = run("tree --json " + options);
        INFO(options << outcome.err);
        CHECK(outcome.code == code);
        const json told = json::parse(outcome.out);
        CHECK(told["end"] == reason);
        CHECK(told["code"] == code);
        CHECK(fs::exists(path() / told["files"][0]["path"].get<std::string>()));
        CHECK((outcome.err.find("growth has ended") != std::string::npos) == (code != 0));
    };
    end("--age 4", 0, "age");
    end("--width 2 --age 100", 3, "no-point-left");
    end("--height 400 --stem 2 --age 3", 4, "no-point-in-reach");
}

TEST_CASE_METHOD(Workplace, "what an early end of growth advises are options of the command", "[tree]") {
    const std::string help = run("tree --help").out;
    const auto advised = [&](const std::string& options, int code) {
        const Outcome outcome = run("tree --leaves 0 --sides 3 --node-distance 0.5 " + options + " --output t.stl");
        INFO(options << ": " << outcome.err);
        CHECK(outcome.code == code);
        CHECK(outcome.err.find("cloud") == std::string::npos);
        CHECK(outcome.err.find("influence") == std::string::npos);
        const std::string advice = outcome.err.substr(outcome.err.find(": choose ") + 1);
        std::size_t count = 0;
        for (std::size_t at = advice.find("--"); at != std::string::npos; at = advice.find("--", at + 2), ++count) {
            const std::string option = advice.substr(at, advice.find_first_of(" ,;\n", at) - at);
            CHECK(help.find(option + " ") != std::string::npos);
        }
        return count;
    };
    CHECK(advised("--age 200", 3) == 4);
    CHECK(advised("--crown-width 60 --crown-depth 60 --crown-height 60 --cut-below 0.5 --perception 20 --age 60", 4) ==
          3);
}

TEST_CASE_METHOD(Nursery, "leaves wear a picture of one's own, wherever the run is read from", "[tree]") {
    write("environments/tree.toml",
          text("environments/tree.toml") + "[[plant.stage]]\nstage = \"leaves\"\ntexture = \"../models/plain.png\"\n");
    REQUIRE(run("leaf-texture --output models/plain.png --size 64").code == 0);
    REQUIRE(run("leaf-texture --output mine.png --size 80").code == 0);
    REQUIRE(run("tree --output plain.obj").code == 0);
    REQUIRE(run("tree --leaf-picture mine.png --output own.obj --run kept").code == 0);
    CHECK(text("own.mtl").find("tree-mine.png") != std::string::npos);
    CHECK(text("tree-mine.png").starts_with("\x89PNG"));
    CHECK(text("plain.mtl").find("mine.png") == std::string::npos);
    const Outcome missing = run("tree --leaf-picture nothing.png");
    CHECK(missing.code == 1);
    CHECK_THAT(missing.err, Contains("--leaf-picture nothing.png: there is no such picture"));
}

TEST_CASE_METHOD(Workplace, "a picture of one's own keeps its colours, unless a colour of the leaves is given",
                 "[tree]") {
    REQUIRE(run("leaf-texture --output mine.png --size 64").code == 0);
    const auto colour = [&](const std::string& options) {
        REQUIRE(run("tree --age 4 --leaf-picture mine.png --output own.obj " + options).code == 0);
        const std::string mtl = text_of(path() / "own.mtl");
        fs::remove(path() / "own.obj");
        fs::remove(path() / "own.mtl");
        const std::size_t kd = mtl.rfind("Kd ", mtl.find("tree-mine.png") - 8);
        return mtl.substr(kd, mtl.find('\n', kd) - kd);
    };
    const std::string white = "Kd 1.000000 1.000000 1.000000";
    CHECK(colour("") == white);
    CHECK(colour("--preset weeping") == white);
    CHECK(colour("--leaf-colour 16 --save-settings red.toml") == "Kd 0.643137 0.172549 0.133333");
    CHECK(colour("--settings red.toml") == "Kd 0.643137 0.172549 0.133333");
}

TEST_CASE_METHOD(Nursery, "a tree of one age is a part of the tree a year later", "[tree]") {
    REQUIRE(run("tree --quiet --age 5 --run five").code == 0);
    REQUIRE(run("tree --quiet --age 6 --run six").code == 0);
    const auto five = nodes(path() / "five"), six = nodes(path() / "six");
    CHECK(five.size() > 20);
    CHECK(six.size() > five.size());
    CHECK(std::includes(six.begin(), six.end(), five.begin(), five.end()));
    const Outcome again = run("tree --quiet --run five");
    CHECK(again.code == 1);  // a run is not replaced either
}

TEST_CASE_METHOD(Nursery, "Ctrl-C ends the growth and leaves no file", "[tree]") {
    const fs::path temporary = path() / "temporary";
    fs::create_directories(temporary);
    setenv("TMPDIR", temporary.c_str(), 1);
    write("models/colonization/tree.l",
          "#define AGE 9\nlsystem: 1\nderivation length: 1000000\naxiom: F(1)A\nF(x) --> F(x + 0.001)\nendlsystem\n");
    write("environments/tree.toml", "[[plant]]\nmodel = \"../models/colonization/tree.l\"\n");
    const auto begun = [&] { return text(".err").find("step") != std::string::npos; };
    const Outcome outcome =
        run_until({"tree", "--output", "oak.obj"}, begun, [](pid_t process) { kill(process, SIGINT); });
    unsetenv("TMPDIR");
    CHECK(outcome.code == 130);
    CHECK(files(".obj").empty());
    CHECK(fs::is_empty(temporary));
}

TEST_CASE_METHOD(Nursery, "the result as JSON names the files and the seed", "[tree]") {
    const json result = json::parse(run("tree --json --quiet --age 3 --seed 17 --output oak.ply").out);
    CHECK(result["seed"] == 17);
    REQUIRE(result["files"].size() == 1);
    CHECK(result["files"][0]["path"] == "oak.ply");
    CHECK(result["files"][0]["triangles"] > 20);
}

TEST_CASE_METHOD(Workplace, "tubes have three sides unless told otherwise, or there are no leaves", "[tree]") {
    const auto triangles = [&](const std::string& options) {
        const std::string out = run("tree --json --quiet --age 3 " + options).out;
        return json::parse(out)["files"][0]["triangles"].get<double>();
    };
    CHECK(triangles("--sides 6") > 1.8 * triangles(""));
    CHECK(triangles("--sides 3") == triangles(""));
    CHECK(triangles("--sides 12 --triangles 400") <= 440);
    // Of a tree without leaves one sees the wood alone.
    CHECK(triangles("--leaves 0") == triangles("--leaves 0 --sides 7"));
    CHECK(triangles("--leaves 0 --sides 3") < 0.5 * triangles("--leaves 0"));
}

TEST_CASE_METHOD(Workplace, "bare trees keep nine tenths of their silhouette with half of the triangles", "[tree]") {
    const auto tree = [&](const std::string& options, const std::string& name) {
        const std::string out = run("tree --json --quiet --leaves 0 " + options + " --output " + name).out;
        return json::parse(out)["files"][0]["triangles"].get<std::size_t>();
    };
    int seed = 7103;
    for (const std::string preset : {"", "decurrent", "excurrent", "flat", "shrub"}) {
        const std::string name = preset + "x";
        const std::string options = fmt::format("{} --seed {}", preset.empty() ? "" : "--preset " + preset, ++seed);
        const std::size_t whole = tree(options, name + ".obj");
        tree(options + fmt::format(" --triangles {}", whole / 2), name + "-half.obj");
        const espalier::ObjFile before(path() / (name + ".obj")), after(path() / (name + "-half.obj"));
        INFO(options << ": " << whole << " to " << after.faces.size());
        CHECK(after.faces.size() <= whole / 2);
        double top = 0;
        for (const glm::dvec3& point : before.points) top = std::max({top, point.y, std::abs(point.x)});
        for (const int right : {0, 2}) {
            const auto outline = [&](const espalier::ObjFile& mesh) {
                return espalier::Silhouette(mesh, right, 1, {0, top / 2, 0}, 1.1 * top);
            };
            CHECK(outline(before).overlap(outline(after)) >= 0.9);
        }
    }
}

TEST_CASE_METHOD(Workplace, "a tree with leaves keeps the trunk that they stand on, however few triangles are left",
                 "[tree]") {
    const std::string tree = "tree --age 26 --leaves 4 --seed 7160 --json --quiet --run kept --output whole.obj";
    const std::size_t whole = json::parse(run(tree).out)["files"][0]["triangles"];
    for (const int part : {3, 6, 20}) {
        INFO("1/" << part << " of " << whole);
        const std::string triangles = std::to_string(whole / part);
        REQUIRE(run("export kept --sides 3 --triangles " + triangles + " --output few.obj").code == 0);
        const espalier::ObjFile mesh(path() / "few.obj");
        CHECK(mesh.faces.size() <= whole / part);
        double lowest = 1, crown = 0;
        for (const glm::dvec3& point : mesh.points) {
            lowest = std::min(lowest, point.y);
            crown = std::max(crown, point.y);
        }
        CHECK(lowest < 0.05);
        CHECK(crown > 4);
    }
}

TEST_CASE_METHOD(Workplace, "a tree has the leaf area index that was asked for, as analyse measures it", "[tree]") {
    for (const std::string options :
         {"2 --seed 41", "4 --leaf-kind 3 --seed 42", "3 --leaf-shade 0.3 --preset shrub"}) {
        INFO(options);
        REQUIRE(run("tree --quiet --age 24 --leaf-area-index " + options + " --run kept --output t.stl").code == 0);
        const json measures = measures_of(*this, "kept");
        CHECK(measures["leaf_area_index"].get<double>() == Approx(options[0] - '0').epsilon(0.15));
        fs::remove_all(path() / "kept");
    }
    const Outcome both = run("tree --age 3 --leaves 2 --leaf-area-index 3 --output t.stl");
    CHECK_THAT(both.err, Contains("--leaves is not used"));
}

TEST_CASE_METHOD(Workplace, "a run takes the settings of tree, and the tree by default warns of nothing", "[app]") {
    const Outcome tree = run("tree --preset shrub --age 6 --run kept --output t.obj");
    CHECK(tree.code == 0);
    const Outcome grown =
        run("run environments/tree.toml --settings environments/presets/shrub.toml "
            "--set plant.0.define.AGE=6 --output out --quiet");
    CHECK(grown.code == 0);
    CHECK(text_of(path() / "out/statistics.csv") == text_of(path() / "kept/statistics.csv"));
    CHECK(run("rerun out").code == 0);
    CHECK_THAT(run("run environments/tree.toml --settings environments/tree.toml").err, Contains("no setting 'plant'"));
    CHECK(run("tree --output d.obj").err.find("warning") == std::string::npos);
}

TEST_CASE_METHOD(Workplace, "few triangles leave a tree its outline, its upright trunk and its limbs", "[tree]") {
    const auto tree = [&](std::size_t triangles) {
        const std::string name = fmt::format("of-{}.obj", triangles);
        REQUIRE(run(fmt::format("tree --preset decurrent --seed 7 --triangles {} --output {}", triangles, name)).code ==
                0);
        return espalier::ObjFile(path() / name);
    };
    const espalier::ObjFile whole = tree(50000);
    double top = 0;
    for (const glm::dvec3& point : whole.points) top = std::max(top, point.y);
    const glm::dvec3 middle(0, top / 2, 0);
    struct Expected {
        std::size_t triangles, limbs;
        double overlap;  ///< by as much as leaves that are larger and fewer allow
    };
    for (const auto& [triangles, limbs, overlap] : {Expected{5000, 30, 0.8}, {2000, 15, 0.7}, {500, 5, 0.35}}) {
        INFO(triangles);
        const espalier::ObjFile few = tree(triangles);
        for (const int right : {0, 2}) {
            CHECK(espalier::Silhouette(whole, right, 1, middle, 1.5 * top)
                      .overlap(espalier::Silhouette(few, right, 1, middle, 1.5 * top)) > overlap);
        }
        std::set<std::string> axes;
        for (const auto& face : few.faces) {
            if (face.group.find("axis") != std::string::npos) axes.insert(face.group);
        }
        CHECK(axes.size() > limbs);
        CHECK(trunk_lean(few, 0.15 * top) < 3);
    }
}

// Models written for cpfg: folders, side files, and what they become.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <set>

using Catch::Contains;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

// An apex that leaves internodes whose lengths a function gives, and counts its steps.
const char* const model =
    "/* A shoot */\nlsystem: 1\nderivation length: 4\naxiom: A(0)\n"
    "A(n) --> F(func(LENGTH,n/4))+[~l]A(n+1)\nendlsystem\n";

// A straight line from (0,0) to (1,2): LENGTH(x) = 2x, within the 0.001 of x to which functions are evaluated.
const char* const function_set =
    "funcgalleryver 1 1\nitems: 1\nfver 1 1\nname: LENGTH\nsamples: 0\nflip: off\npoints: 4\n"
    "0 0\n0.333333333333 0.666666666667\n0.666666666667 1.333333333333\n1 2\n";

const char* const leaf =
    "-1 1 -1 1 -1 1\nCONTACT POINT X: 0 Y: 0 Z: 0\nEND POINT X: 0 Y: 0 Z: 0\nHEADING X: 0 Y: 1 Z: 0\n"
    "UP X: 0 Y: 0 Z: 1\nSIZE: 1\nleaf\nTOP COLOR: 0 DIFFUSE: 0 BOTTOM COLOR: 0 DIFFUSE: 0\nAL: ~ A: ~ AR: ~\n"
    "L: ~ R: ~\nBL: ~ B: ~ BR: ~\n"
    "0 0 0  1 0 0  2 0 0  3 0 0\n0 1 0  1 1 0  2 1 0  3 1 0\n0 2 0  1 2 0  2 2 0  3 2 0\n0 3 0  1 3 0  2 3 0  3 3 0\n";

class Objects : public Workplace {
public:
    Objects() {
        fs::create_directories(path() / "shoot/ext/other");
        put("shoot.l", model);
        put("shoot.v",
            "#define TURN 90\nangle increment: TURN\nline style: cylinder\ninitial color: 2\n"
            "surface: l leaf.s 1\nfunction set: lengths.fset\nprojection: parallel\nwindow: 300 300\n");
        put("shoot.a", "double buffer: on\nfirst frame: 1\nlast frame: 3\nstep: 2\n");
        put("lengths.fset", function_set);
        put("leaf.s", leaf);
        put("shoot.map", std::string(768, '\x40'));
        put("notes.txt", "nothing\n");
        put("specifications",
            "shoot.l\nshoot.v\nshoot.a\nlengths.fset\nleaf.s\nshoot.map\nnotes.txt\nignore:\n*.o\n*\n"
            "L-system:\n\tgenerate:\n\t\tcpfg -m shoot.map -w 300 300 shoot.l shoot.v shoot.a\n\tedit:\n\t\tEDIT "
            "shoot.l\n");
    }
    void put(const std::string& name, const std::string& text) const { write("shoot/" + name, text); }
    void menu(const std::string& command) const {
        put("specifications", "*\nL-system:\n\tgenerate:\n\t\t" + command + "\n");
    }
    std::set<std::string> frames(const std::string& folder) const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(path() / folder / "plants")) {
            names.insert(entry.path().stem().string());
        }
        return names;
    }
};

// The first length is 2^-9 as a 32-bit float, which %g rounds to even.
const std::string four_steps = "F(0.00195312)+[~l]F(0.5)+[~l]F(1)+[~l]F(1.5)+[~l]A(4)\n";

}  // namespace

TEST_CASE_METHOD(Objects, "derive reads the view first, so that the model may name its functions", "[app]") {
    const Outcome outcome = run("derive shoot/shoot.l --view shoot/shoot.v");
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out == four_steps);
    CHECK(run("derive shoot").out == four_steps);
    CHECK(run("derive shoot/").out == four_steps);
    CHECK(run("derive shoot --steps 1").out == "F(0.00195312)+[~l]A(1)\n");
}

TEST_CASE_METHOD(Objects, "running a folder records the frames its author chose", "[app]") {
    const Outcome outcome = run("run shoot --output out");
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("shoot: model shoot.l, view shoot.v, animation shoot.a, colours 1 shoot.map"));
    CHECK_THAT(outcome.out, Contains("shoot: 3 of 3 steps"));
    CHECK(frames("out") == std::set<std::string>{"0001", "0003"});
    CHECK(json::parse(text_of(path() / "out/run.json"))["scene"]["name"] == "shoot");
    CHECK(run("info out").code == 0);
    const json unnamed = json::parse(run("run shoot --json --quiet").out);
    CHECK_THAT(unnamed["output"].get<std::string>(), Catch::StartsWith("output/shoot-20"));
}

TEST_CASE_METHOD(Objects, "what a run of an object wrote down can be run again", "[app]") {
    REQUIRE(run("run shoot --quiet --output a").code == 0);
    write("again.toml", json::parse(text_of(path() / "a/run.json"))["scene"]["text"]);
    const Outcome outcome = run("run again.toml --quiet --output b");
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(text_of(path() / "a/plants/0003.vtp") == text_of(path() / "b/plants/0003.vtp"));
    CHECK(text_of(path() / "a/plants/0003.vtp").size() > 1000);
}

TEST_CASE_METHOD(Objects, "options stand over what the folder says", "[app]") {
    write("straight.v", "angle increment: 10\nfunction set: shoot/lengths.fset\n");
    CHECK(run("run shoot --view straight.v --quiet --output a --steps 2").code == 0);
    CHECK(frames("a") == std::set<std::string>{"0001"});
    put("shoot.l", "#define N 2\n" + std::string(model));
    CHECK(run("derive shoot --define N=3").out == four_steps);
    CHECK_THAT(run("run again.toml --view straight.v").err, Contains("--view applies to a model"));
    CHECK(run("derive shoot --colour-map lost.map").code == 1);
    CHECK(run("derive shoot --colour-map 2=shoot/shoot.map").out == four_steps);
    CHECK_THAT(run("derive shoot --view lost.v").err, Contains("lost.v") && Contains("No such file"));
}

TEST_CASE_METHOD(Objects, "files of cpfg are computed with its arithmetic, others in double precision", "[app]") {
    put("thirds.l", "lsystem: 1\nderivation length: 1\naxiom: A(2.5)\nA(x) --> A(trunc(x))\nendlsystem\n");
    CHECK(run("derive shoot/thirds.l").out == "A(2)\n");
    CHECK(run("derive shoot/thirds.l --view shoot/shoot.v").out == "A(3)\n");
    CHECK(run("derive shoot/thirds.l --view shoot/shoot.v --arithmetic double").out == "A(2)\n");
    CHECK(run("derive shoot/thirds.l --arithmetic cpfg").out == "A(3)\n");
    CHECK_THAT(run("derive shoot/thirds.l --arithmetic single").err, Contains("double"));
    CHECK_THAT(run("check shoot").out, Contains("arithmetic of cpfg"));
    CHECK_THAT(run("check shoot --arithmetic double").out, !Contains("arithmetic of cpfg"));
    const auto recorded = [&](const std::string& what) {
        REQUIRE(run("run " + what + " --quiet --overwrite --output out").code == 0);
        return json::parse(text_of(path() / "out/run.json"))["plants"][0]["arithmetic"].get<std::string>();
    };
    CHECK(recorded("shoot") == "cpfg");
    CHECK(recorded("shoot/thirds.l") == "double");
    write("scene.toml", "[[plant]]\nmodel = \"shoot/thirds.l\"\narithmetic = \"cpfg\"\n");
    CHECK(recorded("scene.toml") == "cpfg");
    write("scene.toml", "[[plant]]\nmodel = \"shoot/thirds.l\"\nview = \"shoot/shoot.v\"\n");
    CHECK(recorded("scene.toml") == "double");
    CHECK_THAT(run("run scene.toml --arithmetic cpfg").err, Contains("--arithmetic applies to a model"));
}

TEST_CASE_METHOD(Objects, "queries are answered by the turtle as the view file starts it", "[app]") {
    write("walk.l", "lsystem: 1\nderivation length: 1\naxiom: +F?P(0,0)\nF --> F\nendlsystem\n");
    write("walk.v", "angle increment: 90\ninitial scale: 2\n");
    CHECK(run("derive walk.l --view walk.v").out == "+F?P(-2,0)\n");
    CHECK(run("derive walk.l --view walk.v --before-exchange").out == "+F?P(-2,0)\n");
    write("walk.l", "lsystem: 1\nderivation length: 1\naxiom: F?P(0,0)\nF --> FF\nendlsystem\n");
    CHECK(run("derive walk.l").out == "FF?P(0,2)\n");
    CHECK(run("derive walk.l --before-exchange").out == "FF?P(0,2)\n");
    write("walk.v", "environment display: before\nbox: x: -1,1 y: 0,2 z: -1,1\n");
    CHECK(run("derive walk.l --view walk.v --before-exchange").out == "FF?P(0,2)\n");
}

TEST_CASE_METHOD(Objects, "before the last exchange, the turtle has answered only if it had to find the view",
                 "[app]") {
    write("walk.l", "lsystem: 1\nderivation length: 2\naxiom: A\nA --> F(1)?P(0,0,0)A\nendlsystem\n");
    write("fitted.v", "angle increment: 90\n");
    write("boxed.v", "box: x: -1,1 y: 0,2 z: -1,1\n");
    CHECK(run("derive walk.l --view fitted.v --before-exchange").out == "F(1)?P(0,1,0)F(1)?P(0,2,0)A\n");
    CHECK(run("derive walk.l --view boxed.v --before-exchange").out == "F(1)?P(0,1,0)F(1)?P(0,0,0)A\n");
    CHECK(run("derive walk.l --view boxed.v --before-exchange --steps 1").out == "F(1)?P(0,0,0)A\n");
    CHECK(run("derive walk.l --view boxed.v").out == "F(1)?P(0,1,0)F(1)?P(0,2,0)A\n");
    // In a scene, the view file of the plant that is printed counts, whatever the first plant has.
    write("scene.toml",
          "[[plant]]\nname = 'fitted'\nmodel = 'walk.l'\nview = 'fitted.v'\n"
          "[[plant]]\nname = 'boxed'\nmodel = 'walk.l'\nview = 'boxed.v'\n");
    CHECK(run("derive scene.toml --plant fitted --before-exchange").out == "F(1)?P(0,1,0)F(1)?P(0,2,0)A\n");
    CHECK(run("derive scene.toml --plant boxed --before-exchange").out == "F(1)?P(0,1,0)F(1)?P(0,0,0)A\n");
}

TEST_CASE_METHOD(Objects, "a derivation length that a model changes holds for run and derive alike", "[app]") {
    write("longer.l",
          "lsystem: 1\nderivation length: 2\nEndEach: {if (Q == 2) {SetDerivationLength(4);}}\naxiom: A(0)\n"
          "A(n) --> FA(n+1)\nendlsystem\n");
    CHECK(run("derive longer.l").out == "FFFFA(4)\n");
    CHECK(run("run longer.l --quiet --output out").code == 0);
    CHECK(frames("out").count("0004") == 1);
    CHECK(frames("out").size() == 5);
}

TEST_CASE_METHOD(Objects, "an animation goes on past the derivation length", "[app]") {
    put("shoot.a", "first frame: 5\nlast frame: 6\n");
    CHECK(run("run shoot --quiet --output out").code == 0);
    CHECK(frames("out") == std::set<std::string>{"0005", "0006"});
    CHECK(run("derive shoot").out == four_steps);
}

TEST_CASE_METHOD(Objects, "an environment file names who answers, and derive asks as a run does", "[app]") {
    write("ask.l", "lsystem: 1\nderivation length: 2\naxiom: F?E(0)\n?E(x) --> F?E(x+10)\nendlsystem\n");
    write("ask.e", "executable: shape -e ask.e ball.toml\nturtle position: %.0f %.0f %.0f\n");
    write("ball.toml", "shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 2.5\nvoxel = 0.5\n");
    const Outcome answered = run("derive ask.l --environment ask.e");
    INFO(answered.err);
    CHECK(answered.out == "FFF?E(0)\n");
    CHECK(run("derive ask.l --environment ask.e --before-exchange").out == "FFF?E(11)\n");
    write("both.l",
          "lsystem: 1\nderivation length: 2\naxiom: F?P(0,0)?H(9,9,9)?E(0)\n?E(x) --> F?P(7,7)?E(x+10)\nendlsystem\n");
    CHECK(run("derive both.l --environment ask.e --before-exchange").out ==
          "F?P(0,1)?H(0,1,0)F?P(0,2)F?P(0,3)?E(11)\n");
    CHECK(run("derive both.l --environment ask.e").out == "F?P(0,1)?H(0,1,0)F?P(0,2)F?P(0,3)?E(0)\n");
    CHECK(run("derive ask.l --environment ask.e --steps 1").out == "FF?E(1)\n");

    const Outcome alone = run("derive ask.l");
    CHECK(alone.out == "FFF?E(20)\n");
    CHECK_THAT(alone.err, Contains("no process answers"));
    CHECK(run("derive ask.l --without-environment").err.empty());
    CHECK(run("run ask.l --quiet --output out").code == 0);
}

TEST_CASE_METHOD(Objects, "a process nobody provides stops the run, unless nobody need answer", "[app]") {
    put("shoot.e", "executable: weatherstation -e shoot.e shoot.map\n");
    menu("cpfg -e shoot.e shoot.l shoot.v");
    const Outcome outcome = run("run shoot --quiet --output out");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("shoot.e:1:1") && Contains("weatherstation") &&
                                Contains("--without-environment") && Contains("voxel-shade"));
    CHECK(run("run shoot --quiet --without-environment --output out").code == 0);
    CHECK(frames("out").size() == 5);
}

TEST_CASE_METHOD(Objects, "mistakes in side files are warnings of a run, and errors of check", "[app]") {
    put("shoot.v", "angel increment: 90\nfunction set: lengths.fset\n");
    const Outcome derived = run("derive shoot");
    CHECK(derived.out == four_steps);
    CHECK_THAT(derived.err, Contains("shoot.v:1") && Contains("warning") && Contains("angel increment"));
    CHECK(run("derive shoot --quiet").err.empty());
    CHECK(run("run shoot --quiet --output out").err.empty());
    const Outcome checked = run("check shoot");
    CHECK(checked.code == 1);
    CHECK_THAT(checked.err, Contains("shoot.v:1") && !Contains("warning"));
    CHECK(json::parse(run("check shoot --json").out)["errors"].size() == 1);
}

TEST_CASE_METHOD(Objects, "check lists what an object uses, what it does not, and what needs a window", "[app]") {
    const Outcome outcome = run("check shoot");
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("model shoot.l, view shoot.v") && Contains("notes.txt is listed") &&
                                Contains("double buffer") && Contains("1 surface, 1 function"));
    CHECK_THAT(outcome.out, !Contains("lengths.fset is listed"));
    CHECK(run("check shoot/shoot.v").code == 0);
    CHECK_THAT(run("check shoot/shoot.v").out, Contains("angle 90"));
    CHECK_THAT(run("check shoot/shoot.a").out, Contains("frames from 1 to 3, every 2"));
    CHECK_THAT(run("check shoot/shoot.map").out, Contains("256 colours"));
    CHECK(run("check shoot/leaf.s").out == "shoot/leaf.s: 1 surface\n");
    CHECK(run("check shoot/lengths.fset").out == "shoot/lengths.fset: 1 function\n");
    put("leaf.s", "no surface\n");
    CHECK(run("check shoot/leaf.s").code == 1);
    CHECK(run("check shoot").code == 1);
    CHECK(run("run shoot --quiet --output out").code == 1);
}

TEST_CASE_METHOD(Objects, "folders that are no objects exit with 1 and say why", "[app]") {
    const auto fails_with = [&](const std::string& words) {
        for (const char* command : {"run shoot --output out", "derive shoot", "check shoot"}) {
            const Outcome outcome = run(command);
            INFO(command << ": " << outcome.err);
            CHECK(outcome.code == 1);
            CHECK_THAT(outcome.err, Contains(words));
        }
        CHECK_FALSE(fs::exists(path() / "out"));
    };
    menu("lpfg shoot.l shoot.v");
    fails_with("lpfg");
    menu("cpfg ../shoot.l shoot.v");
    fails_with("not in the object's folder");
    menu("cpfg lost.l shoot.v");
    fails_with("specifications:4");
    put("specifications", std::string("\x7f\x45\x4c\x46\x00\xff\xfe", 7));
    fails_with("specifications");
    fs::remove(path() / "shoot/specifications");
    put("second.l", model);
    for (const char* command : {"run shoot --output out", "derive shoot"}) {
        const Outcome outcome = run(command);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("second.l, shoot.l"));
    }
    CHECK_THAT(run("run shoot/ext").err, Contains("holds no model"));
}

TEST_CASE_METHOD(Objects, "side files that are broken in any way are refused by name", "[app]") {
    const std::string noise("\x7f\x45\x4c\x46\x00\xff\xfe\n:\t:\n", 12);
    for (const char* name : {"x.s", "x.ray", "x.con", "x.func", "x.fset", "x.mat", "x.v", "x.e"}) {
        write(name, noise);
        const Outcome outcome = run(std::string("check ") + name);
        INFO(name << ": " << outcome.out << outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(name));
        CHECK(run(std::string("check lost") + name).code == 1);
    }
    write("x.a", "frame intervals: much\n");
    CHECK_THAT(run("check x.a").err, Contains("x.a:1:1") && Contains("'much' is no frame"));
    CHECK(run("check lost.a").code == 1);
}

TEST_CASE_METHOD(Objects, "what a model writes lies in the output folder, and what it reads beside it", "[app]") {
    write("write.l",
          "lsystem: 1\ndefine: { array a[1]; }\nStart: { f = fopen(\"in.txt\",\"r\"); fscanf(f,\"%f\",&x); fclose(f); "
          "g = fopen(\"log.txt\",\"w\"); fprintf(g,\"%g\\n\",x); }\nderivation length: 1\naxiom: A(x)\n"
          "A(x) --> A(x+1)\nEnd: { fclose(g); }\nendlsystem\n");
    write("in.txt", "2.5\n");
    const Outcome outcome = run("run write.l --quiet --output out");
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(text_of(path() / "out/files/log.txt") == "2.5\n");
    CHECK(run("derive write.l").out == "A(3.5)\n");
    CHECK_FALSE(fs::exists(path() / "log.txt"));
    CHECK(run("derive write.l --files kept").out == "A(3.5)\n");
    CHECK(text_of(path() / "kept/log.txt") == "2.5\n");
    write("two.toml", "[[plant]]\nmodel = 'write.l'\nname = 'a/b'\n[[plant]]\nmodel = 'write.l'\n");
    CHECK(run("run two.toml --quiet --output two").code == 0);
    CHECK(text_of(path() / "two/files/a%2Fb/log.txt") == "2.5\n");
    CHECK(text_of(path() / "two/files/write/log.txt") == "2.5\n");
}

TEST_CASE_METHOD(Objects, "scenes may name view, colours and environment files, too", "[app]") {
    write("scene.toml",
          "[[plant]]\nmodel = 'shoot/shoot.l'\nview = 'shoot/shoot.v'\ncolour_map = { 1 = 'shoot/shoot.map' }\n"
          "position = [3, 0, 0]\nturtle = { angle = 45 }\n[timeline]\nanimation = 'shoot/shoot.a'\n");
    CHECK(run("run scene.toml --quiet --output out").code == 0);
    CHECK(frames("out") == std::set<std::string>{"0001", "0003"});
    write("wrong.toml", "[[plant]]\nmodel = 'shoot/shoot.l'\nview = 'lost.v'\n");
    CHECK_THAT(run("check wrong.toml").err, Contains("wrong.toml:3:1") && Contains("lost.v"));
    write("wrong.toml", "[[plant]]\nmodel = 'shoot/shoot.l'\ncolour_map = { x = 'a' }\n");
    CHECK_THAT(run("check wrong.toml").err, Contains("wrong.toml:3") && Contains("'x' is no number of a set"));
    write("wrong.toml", "[[plant]]\nmodel = 'a.l'\n[timeline]\nevery = 2\nanimation = 'shoot/shoot.a'\n");
    CHECK_THAT(run("check wrong.toml").err, Contains("wrong.toml:4:1") && Contains("without 'every'"));
}

TEST_CASE_METHOD(Objects, "the library of models is listed folder by folder", "[app]") {
    fs::create_directories(path() / "library/trees");
    write("library/one.l", "/* 04  Context and signals\n\n   Two lines\n     more. */\nlsystem: 1\n");
    write("library/trees/honda.l", "/* Honda's tree */\nlsystem: 1\n");
    CHECK(run("list models --models library").out ==
          "library\n  one.l    Context and signals\n\nlibrary/trees\n  honda.l  Honda's tree\n");
    CHECK(run("list models trees --models library").out == "library/trees\n  honda.l  Honda's tree\n");
    CHECK(run("list models one --models library").out ==
          "library/one.l\n  Context and signals\n\n  Two lines\n    more.\n");
    CHECK(json::parse(run("list models --models library --json").out)[1]["summary"] == "Honda's tree");
    CHECK_THAT(run("list models hunda --models library").err, Contains("did you mean 'honda'?"));
    CHECK(run("list models --models nowhere").code == 1);
    // Elsewhere the models this program was built with are found.
    CHECK_THAT(run("list models").out, Contains("models/course"));
}

TEST_CASE_METHOD(Objects, "an object made for a window ends with its derivation length, and says so", "[app]") {
    put("shoot.a", "first frame: 0\nlast frame: 1000000000\nstep: 3\n");
    const Outcome outcome = run("run shoot --output out");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("shoot.a: warning: the last frame, 1000000000") &&
                                Contains("ends at the derivation length, 4") && Contains("--steps N"));
    CHECK(frames("out") == std::set<std::string>{"0000", "0003"});
    CHECK(run("run shoot --steps 7 --quiet --output seven").code == 0);
    CHECK(frames("seven") == std::set<std::string>{"0000", "0003", "0006"});
    CHECK(run("rerun out").code == 0);
}

TEST_CASE_METHOD(Objects, "an object whose derivation ends no sooner than its window asks for --steps", "[app]") {
    put("shoot.l", "lsystem: 1\nderivation length: 100000000\naxiom: F\nF --> F\nendlsystem\n");
    put("shoot.a", "last frame: 1000000000\n");
    const Outcome outcome = run("run shoot --output out");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("--steps N"));
    CHECK_FALSE(fs::exists(path() / "out"));
    CHECK(run("run shoot --steps 2 --quiet --output out").code == 0);
}

TEST_CASE_METHOD(Objects, "a model that stops between two frames of its animation leaves its last state", "[app]") {
    put("shoot.l",
        "lsystem: 1\nderivation length: 100\naxiom: F\nEndEach: { if (Q == 3) { stop(1); } }\n"
        "F --> FF\nendlsystem\n");
    put("shoot.a", "first frame: 0\nlast frame: 100\nstep: 20\n");
    REQUIRE(run("run shoot --quiet --output out").code == 0);
    CHECK(frames("out") == std::set<std::string>{"0000", "0003"});
}

TEST_CASE_METHOD(Objects, "a view file beside a model is spoken of, and read if it is named", "[app]") {
    write("bush.l", models::bush);
    write("bush.v", "line style: cylinder\n");
    CHECK_THAT(run("run bush.l --output out").err,
               Contains("bush.v: warning: this file lies beside the model but is not read: --view bush.v reads it"));
    CHECK(run("check bush.l --view bush.v").out.find("lies beside") == std::string::npos);
}

TEST_CASE_METHOD(Objects, "a folder of models, scenes and objects is checked file by file", "[app]") {
    fs::create_directories(path() / "all/deeper");
    fs::copy(path() / "shoot", path() / "all/shoot", fs::copy_options::recursive);
    write("all/bush.l", models::bush);
    write("all/herb.l", "lsystem: 1\nderivation length: 1\naxiom: A\nA --> F(func(LENGTH,1))\nendlsystem\n");
    write("all/herb.v", "function set: shoot/lengths.fset\n");
    write("all/deeper/scene.toml", "[[plant]]\nmodel = '../bush.l'\n");
    write("all/deeper/mesh.toml", "[[part]]\n");
    const Outcome good = run("check all");
    INFO(good.err);
    CHECK(good.code == 0);
    CHECK_THAT(good.out, Contains("all: 4 models, scenes and objects") && Contains("bush.l") &&
                             Contains("deeper/scene.toml") && Contains("herb.l"));
    write("all/worse.l", "lsystem: 1\naxiom: A\nA -->> B\nendlsystem\n");
    const Outcome bad = run("check all");
    CHECK(bad.code == 1);
    CHECK_THAT(bad.err, Contains("worse.l:3"));
    CHECK_THAT(bad.out, Contains("all: 5 models, scenes and objects"));
}

TEST_CASE_METHOD(Objects, "--insert does what a mouse did, in runs, their repetitions and derive", "[app]") {
    write("waits.l", "lsystem: 1\nderivation length: 4\naxiom: FA\nX > F --> \nX < F --> FF\nendlsystem\n");
    CHECK_THAT(run("check waits.l").out, Contains("if it waits for a mouse, --insert puts modules into a string"));
    CHECK(run("derive waits.l").out == "FA\n");
    CHECK(run("derive waits.l --insert X@1 --insert X@3").out == "FFFA\n");
    REQUIRE(run("run waits.l --insert X@1 --quiet --output out").code == 0);
    CHECK(run("rerun out").code == 0);
    CHECK_THAT(run("run waits.l --insert Z@1 --output no").err, Contains("no module 'Z' with 0 parameters"));
    write("waits.toml", "[[plant]]\nmodel = 'waits.l'\ninsert = ['X@1']\n");
    CHECK(run("run waits.toml --quiet --output scene").code == 0);
    CHECK_THAT(run("run waits.toml --insert X@1").err, Contains("--insert applies to a model"));
}

TEST_CASE_METHOD(Objects, "models that choose colours take the colour map of their library", "[app]") {
    const std::string lines = "lsystem: 1\nderivation length: 0\naxiom: ;(7)F(1)\nendlsystem\n";
    for (const char* folder : {"library/herbs", "alone/deep/down"})
        std::filesystem::create_directories(path() / folder);
    write("library/plants.map", std::string(3 * 256, '\x40'));
    write("library/herbs/red.l", lines);
    write("library/herbs/plain.l", "lsystem: 1\nderivation length: 0\naxiom: ;F(1)\nendlsystem\n");
    const auto has_colours = [&](const std::string& options) {
        const Outcome outcome = run("run " + options + " --quiet --overwrite --output out");
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        return text_of(path() / "out/plants/0000.vtp").find("rgb") != std::string::npos;
    };
    CHECK(has_colours("library/herbs/red.l"));
    CHECK_FALSE(has_colours("library/herbs/plain.l"));
    write("alone/deep/down/red.l", lines);
    CHECK_FALSE(has_colours("alone/deep/down/red.l"));
}

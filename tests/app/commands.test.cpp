// What the commands do when all is well.
#include "catch.h"
#include "program.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using Catch::Contains;
using Catch::StartsWith;
using nlohmann::json;

namespace {

std::size_t lines_in(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Returns the words of the line that begins so.
std::vector<std::string> words_after(const std::string& beginning, const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind(beginning, 0) != 0) continue;
        std::istringstream words(line.substr(beginning.size()));
        return {std::istream_iterator<std::string>(words), {}};
    }
    return {};
}

}  // namespace

TEST_CASE_METHOD(Workplace, "help teaches by example and never fails", "[app]") {
    CHECK(run("--help").code == 0);
    CHECK(run("--version").out == std::string(ESPALIER_VERSION) + "\n");
    for (const char* command :
         {"run", "check", "derive", "info", "list", "plot", "analyse", "export", "landscape", "leaf-texture"}) {
        const Outcome outcome = run(std::string(command) + " --help");
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.out, Contains("Example") && Contains(std::string("espalier ") + command));
    }
}

TEST_CASE_METHOD(Workplace, "a program without the half that looks says so before it complains of an option", "[app]") {
    const auto commands = [&](const std::string& help) {
        std::set<std::string> names;
        std::istringstream lines(help.substr(help.find("ommands:")));
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("  ") && std::islower(static_cast<unsigned char>(line[2]))) {
                names.insert(line.substr(2, line.find(' ', 2) - 2));
            }
        }
        return names;
    };
    const std::set<std::string> all = commands(run("--help").out);
    fs::copy_file(ESPALIER_PROGRAM, path() / "alone");
    const auto alone = [&](const std::string& arguments) { return run("--version >version; ./alone " + arguments); };
    const std::set<std::string> grow = commands(alone("--help").out);
    CHECK(grow.contains("run"));
    CHECK(all.size() > grow.size() + 10);
    for (const std::string& command : all) {
        INFO(command);
        if (!grow.contains(command)) CHECK_THAT(alone(command + " there --quantity x").err, Contains("is not here"));
    }
    CHECK_THAT(alone("plot there --quantity x").err, Contains("`./dev build` builds all"));
    CHECK_THAT(alone("rendr there").err, Contains("there is no command 'rendr'"));
    CHECK_THAT(run("rendr there --quantity x").err, Contains("did you mean 'render'"));
}

TEST_CASE_METHOD(Workplace, "a model on its own runs, tells where its output is, and info reads it", "[app]") {
    write("bush.l", models::bush);
    const Outcome outcome = run("run bush.l --output there");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("5 of 5 steps") && Contains("there/"));
    CHECK(std::filesystem::exists(path() / "there" / "plants.pvd"));

    const Outcome info = run("info there");
    CHECK(info.code == 0);
    CHECK_THAT(info.out, Contains("ended: done; 5 of 5 steps") && Contains("frames: 6 of plants"));
    const json summary = json::parse(run("info there --json").out);
    CHECK(summary["exit"] == "done");
    CHECK(summary["frames"] == 6);
    CHECK(summary["last_step"].size() == 1);
    CHECK(summary["last_step"][0]["step"] == 5);
    CHECK(summary["bytes"] > std::filesystem::file_size(path() / "there" / "run.json"));
}

TEST_CASE_METHOD(Workplace, "a run says at its end how many bytes it wrote", "[app]") {
    write("grow.l", "lsystem: 1\nderivation length: 6\naxiom: A\nA --> F(1)[+A]A\nendlsystem\n");
    const Outcome outcome = run("run grow.l --output out --json");
    REQUIRE(outcome.code == 0);
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path() / "out")) {
        if (entry.is_regular_file()) bytes += entry.file_size();
    }
    CHECK(nlohmann::json::parse(outcome.out)["bytes"] == bytes);
    CHECK_THAT(run("run grow.l --output out --overwrite").out, Contains("s, 0.0") && Contains(" MB\n"));
}

TEST_CASE_METHOD(Workplace, "info counts a frame of several files once", "[app]") {
    write("bush.l", models::bush);
    write("pair.toml",
          "[[plant]]\nmodel = 'bush.l'\npositions = [[0, 0, 0], [9, 0, 0]]\n[timeline]\npoints_per_file = 1\n");
    REQUIRE(run("run pair.toml --output there").code == 0);
    REQUIRE(std::filesystem::exists(path() / "there" / "plants" / "0005-1.vtp"));
    CHECK(json::parse(run("info there --json").out)["frames"] == 6);
}

TEST_CASE_METHOD(Workplace, "info shows a few plants side by side, of a stand the least, the mean and the most",
                 "[app]") {
    write("row.l", "Lsystem: 1\n#define N 1\nderivation length: 1\nAxiom: A\nA --> A F(N)\nendlsystem\n");
    const auto plant = [](int n) {
        return fmt::format("[[plant]]\nname = 'p{0}'\nmodel = 'row.l'\ndefine = {{ N = {0} }}\n", n);
    };
    const auto told = [&](int plants) {
        std::string scene;
        for (int n = 1; n <= plants; ++n) scene += plant(n);
        write("row.toml", scene);
        REQUIRE(run("run row.toml --quiet --overwrite --output row").code == 0);
        return run("info row").out;
    };
    using Words = std::vector<std::string>;
    CHECK(words_after("last step", told(2)) == Words{"p1", "p2"});
    CHECK(words_after("  length", told(2)) == Words{"1", "2"});
    CHECK(words_after("last step, 7 plants", told(7)) == Words{"least", "mean", "most"});
    CHECK(words_after("  length", told(7)) == Words{"1", "4", "7"});
}

TEST_CASE_METHOD(Workplace, "without --output the folder is named after scene and time", "[app]") {
    write("bush.l", models::bush);
    const json first = json::parse(run("run bush.l --json --quiet").out);
    const json second = json::parse(run("run bush.l --json --quiet").out);
    CHECK_THAT(first["output"].get<std::string>(), StartsWith("output/bush-20"));
    CHECK(first["output"] != second["output"]);
    CHECK(std::filesystem::exists(path() / first["output"].get<std::string>() / "run.json"));
}

TEST_CASE_METHOD(Workplace, "runs that begin at the same time have folders of their own", "[app]") {
    write("bush.l", models::bush);
    const std::string twelve = "for i in 1 2 3 4 5 6 7 8 9 10 11 12; do '" + std::string(ESPALIER_PROGRAM) +
                               "' run bush.l --quiet || echo failed >> failures & done; wait;";
    run("list", twelve);
    CHECK_FALSE(std::filesystem::exists(path() / "failures"));
    std::size_t runs = 0;
    for (const auto& folder : std::filesystem::directory_iterator(path() / "output")) {
        runs += std::filesystem::exists(folder.path() / "run.json");
    }
    CHECK(runs == 12);
}

TEST_CASE_METHOD(Workplace, "a command without what it needs says what to try", "[app]") {
    const Outcome run_alone = run("run");
    CHECK(run_alone.code == 1);
    CHECK_THAT(run_alone.err, StartsWith("espalier run needs `what`: a scene (.toml), a model (.l)") &&
                                  Contains("\n  espalier run environments/two-trees.toml\n") &&
                                  Contains("`espalier list models`"));
    CHECK_THAT(run("rerun").err, Contains("needs `folder`: the folder of a complete run"));
}

TEST_CASE_METHOD(Workplace, "list knows scenes from descriptions of meshes, and the keyframes of a scene", "[app]") {
    std::filesystem::create_directories(path() / "environments/meshes");
    write("environments/light.toml", "# A light.\n[[plant]]\nmodel = 'a.l'\n");
    write("environments/meshes/ball.toml", "# A ball.\nmesh = 'ball.ply'\n");
    const std::string scenes = run("list scenes").out;
    CHECK_THAT(scenes, Contains("light.toml") && !Contains("ball.toml"));
    CHECK_THAT(run("list scene").out, Contains("keyframes"));
}

TEST_CASE_METHOD(Workplace, "quiet is quiet, json is json, and a pipe gets about ten lines", "[app]") {
    write("bush.l", models::bush);
    write("calm.l", "lsystem: 1\nderivation length: 300\naxiom: F(1)\nF(x) --> F(x + 0.001)\nendlsystem\n");
    const Outcome quiet = run("run bush.l --quiet --output a");
    CHECK(quiet.out.empty());
    CHECK(quiet.err.empty());

    const Outcome result = run("run bush.l --json --output b");
    const json parsed = json::parse(result.out);
    CHECK(parsed["exit"] == "done");
    CHECK(parsed["steps_done"] == 5);
    CHECK(parsed["modules"] > 100);

    const Outcome piped = run("run calm.l --output c");
    CHECK(lines_in(piped.err) == 10);
    CHECK_THAT(piped.err, Contains("step 300/300"));
    CHECK_THAT(piped.err, !Contains("\r"));
}

TEST_CASE_METHOD(Workplace, "derive prints the string, its counts and its modules", "[app]") {
    write("tree.l",
          "#define GROWTH 2\nlsystem: 1\nderivation length: 2\naxiom: A(1)\n"
          "A(l) --> F(l)[+A(l*GROWTH)]A(l/2)\nendlsystem\n");
    CHECK(run("derive tree.l --steps 0").out == "A(1)\n");
    CHECK(run("derive tree.l --steps 1").out == "F(1)[+A(2)]A(0.5)\n");
    CHECK(run("derive tree.l").out == "F(1)[+F(2)[+A(4)]A(1)]F(0.5)[+A(1)]A(0.25)\n");
    CHECK(run("derive tree.l --steps 1 --define GROWTH=3").out == "F(1)[+A(3)]A(0.5)\n");
    CHECK_THAT(run("derive tree.l --format counts").out,
               Contains("F 3\n") && Contains("A 4\n") && Contains("total 16\n"));
    const json string = json::parse(run("derive tree.l --steps 1 --format json").out);
    CHECK(string["modules"] == 6);
    CHECK(string["string"][0]["symbol"] == "F");
    CHECK(string["string"][5]["parameters"][0] == 0.5);
}

TEST_CASE_METHOD(Workplace, "derive answers the turtle's queries, also before the last exchange, as cpfg does",
                 "[app]") {
    write("walk.l",
          "lsystem: 1\nderivation length: 2\naxiom: F(1)?P(0,0,0)\n"
          "?P(x,y,z) --> F(y)?P(9,9,9)\nendlsystem\n");
    CHECK(run("derive walk.l").out == "F(1)F(1)F(2)?P(0,4,0)\n");
    CHECK(run("derive walk.l --before-exchange").out == "F(1)F(1)F(2)?P(0,4,0)\n");
    write("ask.l", "lsystem: 1\nderivation length: 1\naxiom: F(1)?E(5)\nF(x) --> F(x)F(x)\nendlsystem\n");
    CHECK(run("derive ask.l").out == "F(1)F(1)?E(5)\n");
}

TEST_CASE_METHOD(Workplace, "derive prints the plants of a scene by their names, in their environment", "[app]") {
    write("ask.l",
          "#define V 1\nenvironment place;\nlsystem: 1\nderivation length: 2\naxiom: F(1)?place(V)\n"
          "?place(h) --> F(h + 1)?place(V)\nendlsystem\n");
    write("two.toml",
          "[[plant]]\nname = \"low\"\nmodel = \"ask.l\"\n\n[[plant]]\nname = \"high\"\nmodel = \"ask.l\"\n"
          "define = { V = 2 }\n\n[environment.place]\nprocess = \"honda81\"\nradius = 100\n");
    const Outcome low = run("derive two.toml --plant low"), high = run("derive two.toml --plant high");
    CHECK(low.code == 0);
    CHECK(low.out == "F(1)F(1)F(1)?place(0)\n");
    CHECK(high.out == "F(1)F(2)F(2)?place(1)\n");
    REQUIRE(run("run two.toml --output out --quiet").code == 0);
    const json record = json::parse(text_of(path() / "out/run.json"));
    CHECK(record["plants"][0]["modules"] == std::count(low.out.begin(), low.out.end(), '('));
    CHECK_THAT(run("derive two.toml").err, Contains("the plants are low, high; --plant NAME"));
    CHECK_THAT(run("derive two.toml --plant hihg").err, Contains("did you mean 'high'?"));
}

TEST_CASE_METHOD(Workplace,
                 "derive explains which production replaced a module in the last step, and why others did not",
                 "[app]") {
    write("why.l",
          "lsystem: 1\nderivation length: 2\naxiom: B A(1) C\nB < A(x) > D --> F\nD < A(x) --> F\n"
          "A(x) : x - 1 --> F\nA(x) : x + 1 --> A(x + 1)\nA(x) --> F\nendlsystem\n");
    const Outcome first = run("derive why.l --steps 1 --explain A");
    CHECK(first.code == 0);
    CHECK_THAT(first.out, Contains("step 1: A(1), module 1\n"));
    CHECK_THAT(first.out, Contains("- why.l:4:1: its right context is not there\n      B < A(x) > D --> F\n"));
    CHECK_THAT(first.out, Contains("- why.l:5:1: its left context is not there\n"));
    CHECK_THAT(first.out, Contains("- why.l:6:1: its condition is 0\n"));
    CHECK_THAT(first.out, Contains("* why.l:7:1: applied, its condition is 2\n"));
    CHECK_THAT(first.out, Contains("- why.l:8:1: not tried, because one before it applies\n"));
    CHECK_THAT(run("derive why.l --explain A").out,
               Contains("step 2: A(2), module 1\n") && Contains("* why.l:6:1: applied, its condition is 1\n"));
    CHECK_THAT(run("derive why.l --explain B").out, Contains("no production begins with it: it stays"));
    CHECK_THAT(run("derive why.l --explain X").err, Contains("has no module 'X'"));

    write("chance.l", "lsystem: 1\nseed: 3\nderivation length: 3\naxiom: A\nA --> FA : 3\nA --> GA : 1\nendlsystem\n");
    for (int seed = 11; seed < 15; ++seed) {
        const std::string chosen = " --seed " + std::to_string(seed);
        const std::string out = run("derive chance.l --explain A" + chosen).out;
        const bool took_first = out.find("* chance.l:5:1: applied, of probability 0.75") != std::string::npos;
        CHECK_THAT(out, Contains(took_first ? "- chance.l:6:1: not drawn, of probability 0.25"
                                            : "* chance.l:6:1: applied, of probability 0.25"));
        const std::string string = run("derive chance.l" + chosen).out;
        CHECK(string[2] == (took_first ? 'F' : 'G'));
    }
}

TEST_CASE_METHOD(Workplace, "a random seed is printed and repeats the result", "[app]") {
    write("chance.l", "lsystem: 1\nseed: 3\nderivation length: 1\naxiom: A\nA --> F(ran(1))\nendlsystem\n");
    const Outcome drawn = run("derive chance.l --seed random"), other = run("derive chance.l --seed random");
    REQUIRE(drawn.err.starts_with("seed "));
    CHECK(run("derive chance.l --seed " + drawn.err.substr(5, drawn.err.find('\n') - 5)).out == drawn.out);
    CHECK(drawn.out != other.out);
    CHECK(run("derive chance.l --seed lucky").code == 1);
    CHECK(run("derive chance.l --seed -1").code == 1);
}

TEST_CASE_METHOD(Workplace, "derive goes on as long as the model says, and no longer than it wants", "[app]") {
    const std::string steps = "lsystem: 1\nderivation length: 3\nEndEach: {if (Q == 2) {";
    const std::string rest = "}}\naxiom: A(0)\nA(n) --> A(n + 1)\nendlsystem\n";
    write("longer.l", steps + "SetDerivationLength(5);" + rest);
    write("stopping.l", steps + "stop(1);" + rest);
    CHECK(run("derive longer.l").out == "A(5)\n");
    CHECK(run("derive stopping.l").out == "A(2)\n");
}

TEST_CASE_METHOD(Workplace, "check says what was read and warns of what looks wrong", "[app]") {
    write("bush.l", models::bush);
    const Outcome outcome = run("check bush.l");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("1 production,") && Contains("derivation length 5") && Contains("in parallel"));
    write("counter.l", "lsystem: 1\nderivation length: 2\naxiom: A\nA : { n = n + 1; } 1 --> A\nB --> A\nendlsystem\n");
    const Outcome warned = run("check counter.l");
    CHECK(warned.code == 0);
    CHECK_THAT(warned.out, Contains("counter.l:5") && Contains("warning") && Contains("derived by one thread"));
    CHECK(json::parse(run("check counter.l --json").out)["warnings"].size() >= 1);
}

TEST_CASE_METHOD(Workplace, "check looks through a folder of models, but not through a machine", "[app]") {
    write("a.l", models::bush);
    write("b.l", models::bush);
    std::filesystem::create_directories(path() / "deep/er");
    write("deep/er/c.l", models::bush);
    std::filesystem::create_directory_symlink(path(), path() / "deep/round");
    const Outcome all = run("check .");
    CHECK(all.code == 0);
    CHECK_THAT(all.out, Contains("3 models, scenes and objects"));

    for (int i = 0; i <= 20000; ++i) std::ofstream(path() / "deep" / std::to_string(i));
    const Outcome many = run("check .");
    CHECK(many.code == 1);
    CHECK_THAT(many.err, Contains("more than 20000 files and folders lie below ."));
}

TEST_CASE_METHOD(Workplace, "check reads the panels beside a model", "[app]") {
    write("a.l", models::bush);
    write("a.panel", "[[panel]]\ntitle = 'All'\nsettings = ['ANGLE']\n");
    CHECK_THAT(run("check a.l").out, Contains("a.panel: 1 slider in 1 panel"));
    write("a.panel", "[[panel]]\ntitle = 'All'\nsettings = []\n");
    const Outcome outcome = run("check a.l");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("a.panel:1:1: a panel names its sliders"));
    std::filesystem::create_directory(path() / "object");
    write("object/b.l", models::bush);
    write("object/b.panel", "[[panel]]\ntitle = 'All'\nsettings = ['ANGLE']\n");
    CHECK_THAT(run("check object").out, Contains("b.panel: 1 slider in 1 panel"));
}

TEST_CASE_METHOD(Workplace, "checking a scene grows nothing and leaves nothing", "[app]") {
    write("bush.l", models::bush);
    write("scene.toml", "[[plant]]\nmodel = 'bush.l'\n[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.5\n");
    const Outcome outcome = run("check scene.toml --set simulation.steps=3");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("1 plant, 3 steps, processes: light"));
    CHECK_FALSE(std::filesystem::exists(path() / "output"));
}

TEST_CASE_METHOD(Workplace, "check finds a field that no process has, as a run does, with the nearest name", "[app]") {
    write("bush.l", models::bush);
    const std::string scene =
        "[[plant]]\nmodel = 'bush.l'\n[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.5\n";
    write("scene.toml", scene + "[timeline]\nfields = ['lihgt']\n");
    for (const char* command : {"check scene.toml", "run scene.toml"}) {
        const Outcome outcome = run(command);
        CHECK(outcome.code != 0);
        CHECK_THAT(outcome.err, Contains("scene.toml:7:1") && Contains("no field 'lihgt' (did you mean 'light'?)"));
    }
    for (const char* fields : {"['light', 'light.shade']", "['all']", "[]"}) {
        write("scene.toml", scene + "[timeline]\nfields = " + fields + "\n");
        CHECK(run("check scene.toml").code == 0);
    }
}

TEST_CASE_METHOD(Workplace, "a wrong name of a process is answered with the nearest one", "[app]") {
    write("bush.l", models::bush);
    for (const auto& [wrong, right] : {std::pair{"voxel-shde", "voxel-shade"},
                                       {"soilwater", "soil-water"},
                                       {"cannopy-light", "canopy-light"},
                                       {"desity", "density"}}) {
        write("scene.toml", fmt::format("[[plant]]\nmodel = 'bush.l'\n[environment.light]\nprocess = '{}'\n", wrong));
        const Outcome outcome = run("check scene.toml");
        CHECK(outcome.code != 0);
        CHECK_THAT(outcome.err,
                   Contains("scene.toml:4:1") && Contains(fmt::format("'{}' (did you mean '{}'?)", wrong, right)));
    }
}

TEST_CASE_METHOD(Workplace, "a polygon within a polygon is warned of, and grows all the same", "[app]") {
    write("leaf.l",
          "lsystem: 1\nderivation length: 1\naxiom: A\nA --> {.f+(90)f{.+(90)f+(90)f.}+(90)f.}\nendlsystem\n");
    const Outcome checked = run("check leaf.l");
    CHECK(checked.code == 0);
    CHECK_THAT(checked.out + checked.err, Contains("leaf.l:4") && Contains("begins within another one"));
    CHECK(run("run leaf.l --output leaf --quiet").code == 0);
    CHECK(run("derive leaf.l").code == 0);
}

TEST_CASE_METHOD(Workplace, "list documents what is registered", "[app]") {
    CHECK_THAT(run("list").out, Contains("processes") && Contains("symbols") && Contains("recorders"));
    CHECK_THAT(run("list processes").out, Contains("voxel-shade") && Contains("soil-water") && Contains("shape"));
    CHECK_THAT(run("list processes voxel-shade").out, Contains("voxel"));
    CHECK_THAT(run("list symbols").out, Contains("@o"));
    CHECK_THAT(run("list scene").out, Contains("[[plant]]"));
    CHECK(json::parse(run("list recorders --json").out).size() >= 3);
    write("bush.l", models::bush);
    std::filesystem::create_directories(path() / "models");
    write("models/b.l", "/* A small bush\n   with two branches. */\nlsystem: 1\n");
    CHECK_THAT(run("list models").out, Contains("A small bush"));
}

TEST_CASE_METHOD(Workplace, "the same seed gives the same string, another seed another", "[app]") {
    write("chance.l",
          "lsystem: 1\nseed: 1\nderivation length: 8\naxiom: A\nA --> F A : 1\nA --> F [+A] A : 1\nendlsystem\n");
    CHECK(run("derive chance.l --seed 3").out == run("derive chance.l --seed 3").out);
    CHECK(run("derive chance.l --seed 3").out != run("derive chance.l --seed 4").out);
}

TEST_CASE_METHOD(Workplace, "a run goes on although nobody reads its progress", "[app]") {
    write("bush.l", models::bush);
    for (const char* nowhere : {"2>/dev/full", "2> >(exec true)", "2>&-"}) {
        INFO(nowhere);
        const std::string arguments = std::string("run bush.l --steps 8 --overwrite --output out ") + nowhere;
        write("run.sh", std::string("sleep 0.1; '") + ESPALIER_PROGRAM + "' " + arguments + "\n");
        CHECK(run("--version >/dev/null; bash run.sh").code == 0);
        CHECK_THAT(text_of(path() / "out/run.json"), Contains("\"exit\": \"done\""));
        CHECK(text_of(path() / "out/.lock").empty());
    }
}

TEST_CASE_METHOD(Workplace, "a result that cannot be written out is a failure", "[app]") {
    write("bush.l", models::bush);
    for (const char* command : {"list", "derive bush.l", "run bush.l --output out", "check bush.l"}) {
        INFO(command);
        const Outcome outcome = run(std::string(command) + " >/dev/full");
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Contains("standard output"));
    }
}

TEST_CASE_METHOD(Workplace, "a query to a process that is not there is answered its default, and check says so",
                 "[app]") {
    write("root.l",
          "environment nitrate = 10;\nlsystem: 1\nderivation length: 2\naxiom: A?nitrate(0)\n"
          "A?nitrate(c) --> F(c)A?nitrate(0)\nendlsystem\n");
    const Outcome alone = run("derive root.l");
    CHECK(alone.out == "F(10)F(10)A?nitrate(10)\n");
    CHECK(alone.err.empty());
    CHECK(run("derive root.l --before-exchange").out == "F(10)F(10)A?nitrate(0)\n");
    CHECK_THAT(run("check root.l").out,
               Contains("no process 'nitrate', so queries ?nitrate are answered its default, 10"));
    const std::string box = "domain = { lower = [-9, -9, -9], upper = [9, 9, 9] }\nvoxel = 3\n";
    write("without.toml", "[[plant]]\nmodel = 'root.l'\n[environment.water]\nprocess = 'soil-water'\n" + box);
    CHECK(run("derive without.toml").out == "F(10)F(10)A?nitrate(10)\n");
    write("with.toml", "[[plant]]\nmodel = 'root.l'\n[environment.nitrate]\nprocess = 'nutrient'\ninitial = 3\n" + box);
    CHECK(run("derive with.toml").out == "F(3)F(3)A?nitrate(3)\n");
    write("misspelt.toml", "[[plant]]\nmodel = 'root.l'\n[environment.nitrat]\nprocess = 'nutrient'\n" + box);
    for (const char* const command : {"run misspelt.toml --output there", "check misspelt.toml"}) {
        const Outcome outcome = run(command);
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err + outcome.out,
                   Contains("?nitrate is answered the default of root.l") && Contains("did you mean 'nitrat'?"));
    }
}

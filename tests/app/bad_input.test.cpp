// Each mistake gets one clear message and the right exit code, and what was recorded before stays whole.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

using Catch::Contains;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

const std::string plant = "[[plant]]\nmodel = 'bush.l'\n";
const std::string light = "[environment.light]\nprocess = 'voxel-shade'\n";

class BadInput : public Workplace {
public:
    BadInput() { write("bush.l", models::bush); }

    Outcome run_scene(const std::string& text, const std::string& arguments = "") const {
        write("scene.toml", text);
        return run("run scene.toml --quiet --output out " + arguments);
    }
    std::string exit_of(const std::string& folder) const {
        return json::parse(text_of(path() / folder / "run.json"))["exit"];
    }
    std::size_t frames_in(const std::string& folder) const {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(path() / folder / "plants")) {
            CHECK_FALSE(entry.path().filename().string().starts_with("."));
            count += entry.path().extension() == ".vtp";
        }
        return count;
    }
};

}  // namespace

TEST_CASE_METHOD(BadInput, "mistakes on the command line exit with 1 and offer the nearest name", "[app]") {
    CHECK(run("").code == 1);
    CHECK_THAT(run("").err, Contains("derive") && Contains("check"));
    CHECK(run("rnu bush.l").code == 1);
    CHECK_THAT(run("drive bush.l").err, Contains("no command 'drive'") && Contains("did you mean 'derive'?"));
    CHECK_THAT(run("frobnicate").err,
               Contains("there is no command 'frobnicate'; the commands are run, resume, rerun"));
    CHECK_THAT(run("--frobnicate").err, Contains("espalier has no option '--frobnicate'"));
    CHECK_THAT(run("check bush.l other.l").err, Contains("espalier check does not accept 'other.l'"));
    CHECK_THAT(run("run bush.l --stpes 3").err, Contains("did you mean '--steps'?"));
    CHECK(run("run bush.l --steps -1").code == 1);
    CHECK(run("run bush.l --steps many").code == 1);
    CHECK(run("run bush.l --threads 0").code == 1);
    CHECK_THAT(run("run bush.l --seed -1").err,
               Contains("--seed: a whole number of at least 0, or random, is expected, not -1"));
    for (const std::string layer : {"0", "-1", "nan", "inf", "1m"}) {
        const Outcome outcome = run("analyse out --layer " + layer);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("--layer: expected a number above 0, found " + layer));
    }
    CHECK_THAT(run("run bush.l --memory lots").err, Contains("512M or 4G"));
    CHECK(run("run bush.l --memory -1G").code == 1);
    CHECK_THAT(run("run bush.l --set steps").err, Contains("KEY=VALUE"));
    CHECK(run("run bush.l --set plant.7.define.X=1").code == 1);
    CHECK_THAT(run("list proceses").err, Contains("did you mean 'processes'?"));
    CHECK_THAT(run("list processes voxel-shde").err, Contains("did you mean 'voxel-shade'?"));
    CHECK(run("derive bush.l --format xml").code == 1);
    CHECK_FALSE(fs::exists(path() / "output"));
}

TEST_CASE_METHOD(BadInput, "files that are missing, or are not what they should be, exit with 1", "[app]") {
    CHECK(run("run nowhere.toml").code == 1);
    CHECK_THAT(run("run nowhere.toml").err, Contains("nowhere.toml") && Contains("No such file"));
    CHECK(run("run nowhere.l").code == 1);
    fs::create_directories(path() / "empty");
    CHECK_THAT(run("run empty").err, Contains("empty holds no model"));
    CHECK(run("info nowhere").code == 1);
    CHECK(run_scene("[[plant]]\nmodel = 'oak.l'\n").code == 1);
    CHECK_THAT(run_scene("[[plant]]\nmodel = 'oak.l'\n").err, Contains("scene.toml:2:1") && Contains("oak.l"));
    write("run.json", "{}");
    CHECK(run("info .").code == 1);
    write("noise.l", std::string("\x7f\x45\x4c\x46\x00\xff\xfe", 7));
    CHECK(run("derive noise.l").code == 1);
    write("noise.toml", std::string("\xff\xfe\x00[", 4));
    CHECK(run("run noise.toml").code == 1);
}

TEST_CASE_METHOD(BadInput, "mistakes in a scene exit with 1 and leave no output folder", "[app]") {
    const auto fails_with = [&](const std::string& text, const std::string& words) {
        const Outcome outcome = run_scene(text);
        INFO(outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(words));
        CHECK_FALSE(fs::exists(path() / "out"));
    };
    fails_with(plant + "[simulation]\nstpes = 3\n",
               "scene.toml:4:1: 'stpes' means nothing here (did you mean 'steps'?)");
    fails_with(plant + "[simulation]\nvigour = 3\n",
               "'vigour' means nothing here; what can stand here: blocks, domain, dt, origin, seed, steps, time_unit");
    fails_with(plant + "[simulation\n", "scene.toml:3:");
    fails_with(plant + "[environment.light]\nprocess = 'voxle-shade'\n", "did you mean 'voxel-shade'?");
    fails_with(plant + light + "voxel = -0.25\n", "scene.toml:5:1: 'voxel' must be at least 1.5e-05, not -0.25");
    fails_with(plant + light + "voxel = 0\n", "'voxel' must be at least 1.5e-05, not 0");
    fails_with(plant + light + "voxel = nan\n", "'voxel' must be a finite number");
    fails_with(plant + light + "voxle = 0.25\n", "(did you mean 'voxel'?)");
    fails_with(plant + "[timeline]\nevry = 2\n", "(did you mean 'every'?)");
    fails_with("[simulation]\nsteps = 3\n", "no [[plant]]");
}

TEST_CASE_METHOD(BadInput, "a domain of 10^12 voxels is refused before it is allocated", "[app]") {
    for (const char* process : {"voxel-shade", "soil-water"}) {
        const Outcome outcome =
            run_scene("[simulation]\ndomain = { lower = [0, 0, 0], upper = [10000, 10000, 10000] }\n" + plant +
                      "[environment.field]\nprocess = '" + process + "'\nvoxel = 1.0\n");
        INFO(process << ": " << outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("scene.toml:7:1") && Contains("1e+12 voxels") && Contains("memory"));
        CHECK_FALSE(fs::exists(path() / "out"));
    }
}

TEST_CASE_METHOD(BadInput, "a typo in a model names its place, in a scene too", "[app]") {
    write("typo.l",
          "lsystem: 1\nderivation length: 3\naxiom: A(1)\nA(length) --> F(sqr(length))A(length)\nendlsystem\n");
    for (const char* command : {"derive typo.l", "check typo.l", "run typo.l"}) {
        const Outcome outcome = run(command);
        INFO(outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("typo.l:4:17") && Contains("sqr") && Contains("did you mean 'sqrt'?"));
    }
    CHECK(run_scene("[[plant]]\nmodel = 'typo.l'\n").code == 1);
}

TEST_CASE_METHOD(BadInput, "a name that nothing assigns is warned of, once", "[app]") {
    write("typo.l", "lsystem: 1\nderivation length: 1\naxiom: A(1)\nA(length) --> F(lenght)F(lenght)\nendlsystem\n");
    write("scene.toml", "[[plant]]\nmodel = 'typo.l'\n[[plant]]\nmodel = 'typo.l'\n");
    for (const char* command : {"derive typo.l", "run typo.l", "run scene.toml"}) {
        const Outcome outcome = run(command);
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("typo.l:4:17: warning") && Contains("did you mean 'length'?"));
        CHECK(outcome.err.find("warning") == outcome.err.rfind("warning"));
    }
    CHECK_THAT(run("check typo.l").out, Contains("typo.l:4:17: warning"));
    CHECK(run("derive typo.l --quiet").err.empty());
}

TEST_CASE_METHOD(BadInput, "growth without end stops within its memory and keeps its frames", "[app]") {
    write("doubling.l", models::doubling);
    const Outcome outcome = run("run doubling.l --quiet --memory 64M --output out");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("step ") && Contains("doubling.l:4"));
    CHECK_THAT(exit_of("out"), Contains("failed: "));
    const json record = json::parse(text_of(path() / "out" / "run.json"));
    CHECK(frames_in("out") == record["steps_done"].get<std::size_t>() + 1);
    CHECK(record["steps_done"] > 10);
    CHECK(run("derive doubling.l --memory 64M").code == 2);
}

TEST_CASE_METHOD(BadInput, "a run that has written as much as it may stops whole, and goes on where it may write more",
                 "[app]") {
    write("patient.l", models::patient);
    const Outcome outcome = run("run patient.l --steps 2000 --quiet --disk 1M --output out");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("--disk allows 1 MiB") && Contains("`espalier resume out --disk SIZE` goes on"));
    const json record = json::parse(text_of(path() / "out" / "run.json"));
    CHECK(record["steps_done"] < 2000);
    CHECK(frames_in("out") == record["steps_done"].get<std::size_t>() + 1);
    CHECK(run("resume out --disk 1G --quiet").code == 0);
    CHECK(frames_in("out") == 2001);
}

TEST_CASE_METHOD(BadInput, "sizes have units, or are refused", "[app]") {
    write("bush.l", models::bush);
    for (const char* good :
         {"--memory 500M", "--memory 1.5GiB", "--disk 100000000", "--disk 2TB", "--memory 64000KB"}) {
        INFO(good);
        CHECK(run(std::string("run bush.l --quiet --overwrite --output out ") + good).code == 0);
    }
    for (const char* bad : {"--memory 4XB", "--memory XB", "--memory 4 --disk 4Q", "--disk -4G", "--memory 4MM"}) {
        INFO(bad);
        const Outcome outcome = run(std::string("run bush.l --quiet --output bad ") + bad);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("expected a size such as 512M or 4G"));
    }
}

#ifndef __SANITIZE_ADDRESS__
// Array jobs pad their numbers with zeros.
TEST_CASE_METHOD(BadInput, "numbers of options are decimal", "[app]") {
    write("grow.l", models::bush);
    const std::pair<std::string, int> steps[] = {{"10", 10}, {"010", 10}, {"0008", 8}, {"+3", 3}, {"000", 0}};
    for (const auto& [text, count] : steps) {
        const Outcome outcome = run("run grow.l --json --overwrite --output out --memory 2G --steps " + text);
        CHECK(json::parse(outcome.out)["steps_done"] == count);
    }
    CHECK(run("run grow.l --steps 2 --quiet --every 02 --threads 01 --checkpoint-every 010 --output every").code == 0);
    CHECK(json::parse(text_of(path() / "every/run.json"))["checkpoint_every"] == 10);
    write("grow.toml", "[[plant]]\nmodel = \"grow.l\"\n");
    CHECK(json::parse(run("run grow.toml --set simulation.steps=007 --json --output set").out)["steps_done"] == 7);

    for (const std::string text : {"ten", "0x10", "1.5", "1e1", "''", "8-", "٣"}) {
        const Outcome outcome = run("run grow.l --output no --steps " + text);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("--steps: a whole number is expected, not '"));
    }
    CHECK_THAT(run("run grow.l --output no --blocks -1").err, Contains("a whole number of at least 0 is expected"));
    CHECK_THAT(run("run grow.l --output no --timeout 0x10").err,
               Contains("--timeout: a number is expected, not '0x10'"));
    CHECK_THAT(run("run grow.l --output no --timeout nan").err, Contains("a number is expected"));
    CHECK_THAT(run("run grow.l --output no --memory 0x1G").err, Contains("expected a size such as"));
    CHECK_THAT(run("run grow.l --output no --steps 1000000001").err, Contains("not in range"));
    CHECK_FALSE(fs::exists(path() / "no"));
}

TEST_CASE_METHOD(BadInput, "the file system's complaints are told in words", "[app]") {
    write("grow.l", models::bush);
    for (const std::string arguments :
         {"run ''", "check ''", "info ''", "derive ''", "resume ''", "rerun ''", "run grow.l --steps 1 --output ''",
          "run grow.l --steps 1 --output grow.l", "run grow.l --steps 1 --output grow.l/out", "check grow.l/x",
          "sweep grow.l --steps 1 --vary simulation.seed=1 --output grow.l", "render ''", "export '' --format obj",
          "run grow.l --steps 1 --view ''", "list models --models ''"}) {
        INFO(arguments);
        const Outcome outcome = run(arguments + " --quiet");
        INFO(outcome.err);
        CHECK((outcome.code == 0) == outcome.err.empty());
        CHECK_THAT(outcome.err, !Contains("filesystem error") && !Contains("[]") && !Contains("std::") &&
                                    !Contains("basic_") && !Contains("what()"));
        CHECK_THAT(outcome.err, !Catch::StartsWith(":"));
    }
}

TEST_CASE_METHOD(BadInput, "a voxel that fields cannot have is refused with its place, in words", "[app]") {
    write("ask.l", "environment p;\nlsystem: 1\nderivation length: 1\naxiom: !(0.01)F(1)A?p(0)\nendlsystem\n");
    const std::string solid = "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n";
    const std::vector<std::pair<std::string, std::string>> processes = {
        {"voxel-shade", ""},
        {"soil-water", ""},
        {"nutrient", ""},
        {"canopy-light", ""},
        {"shape", solid},
        {"greene", "solid = { shape = \"sphere\", center = [0, -1, 0], radius = 1 }\n"},
        {"markers", "kill = 0.1\ncloud = { radii = [1, 1, 1], base = [0, 1, 0] }\n"}};
    for (const auto& [process, more] : processes) {
        INFO(process);
        write("small.toml",
              "[simulation]\ndomain = { lower = [0, 0, 0], upper = [1e-5, 1e-5, 1e-5] }\n"
              "[[plant]]\nmodel = \"ask.l\"\n[environment.p]\nprocess = \"" +
                  process + "\"\nvoxel = 1e-7\n" + more);
        const Outcome outcome = run("run small.toml --quiet --output no");
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("small.toml:7:1: 'voxel' must be at least 1.5e-05, not 1e-07"));
    }
}

TEST_CASE_METHOD(BadInput, "voxels too small for a plant are refused before it is cut into them", "[app]") {
    write("ask.l", "environment p;\nlsystem: 1\nderivation length: 1\naxiom: !(0.01)F(1)A?p(0)\nendlsystem\n");
    write("cut.toml", "[[plant]]\nmodel = \"ask.l\"\n[environment.p]\nprocess = \"canopy-light\"\nvoxel = 2e-5\n");
    // Three strips of 50,000 pieces, in one row of voxels.
    const Outcome outcome = run("run cut.toml --quiet --memory 16M --output no");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("cut.toml:5:1") && Contains("1.5e+05 pieces") && Contains("larger voxels"));
    CHECK(run("run cut.toml --quiet --set environment.p.voxel=0.01 --memory 16M --output yes").code == 0);
}

TEST_CASE_METHOD(BadInput, "the peak memory of a run is its own, whoever started it", "[app]") {
    write("bush.l", models::bush);
    const std::size_t mib = std::size_t{1} << 20;
    const std::vector<char> held(400 * mib, 'x');
    CHECK(run("run bush.l --quiet --output out").code == 0);
    const json record = json::parse(text_of(path() / "out" / "run.json"));
    CHECK(record["peak_memory"].get<std::size_t>() < held.size() / 2);
}
#endif

TEST_CASE_METHOD(BadInput, "a plant rich in organs stays within its memory to the last frame", "[app]") {
    write("balls.l",
          "lsystem: 1\nderivation length: 1000\naxiom: A(0)\nA(n) : n > 0 --> A(n - 1)\n"
          "A(n) : n <= 0 --> F(0.5)@O(0.2)@O(0.3)[+(20)A(3)]-(30)A(4)\nendlsystem\n");
    const Outcome outcome = run("run balls.l --quiet --memory 192M --output out");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("step ") && Contains("--memory"));
    const json record = json::parse(text_of(path() / "out" / "run.json"));
    const int last = record["steps_done"];
    CHECK_THAT(text_of(path() / "out" / "plants.pvd"), Contains("timestep=\"" + std::to_string(last) + "\""));
    const std::size_t mib = std::size_t{1} << 20, peak = record["peak_memory"].get<std::size_t>();
    CHECK(peak > 96 * mib);
#ifndef __SANITIZE_ADDRESS__
    CHECK(peak < 256 * mib);  // 64 for the program itself
#endif
}

TEST_CASE_METHOD(BadInput, "0/0 in a model names file, line, module and step", "[app]") {
    write("zero.l", models::zero_by_zero);
    const Outcome outcome = run("run zero.l --quiet --output out");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("zero.l:4:") && Contains("zero"));
    CHECK(frames_in("out") == 2);
    CHECK_THAT(exit_of("out"), Contains("zero.l:4:"));
}

TEST_CASE_METHOD(BadInput, "a full disk ends the run with its reason and leaves whole frames", "[app]") {
    write("doubling.l", models::doubling);
    // Files of at most 32 blocks (16 or 32 KiB): the first frames fit, a later one does not.
    const Outcome outcome = run("run doubling.l --quiet --steps 14 --output out", "ulimit -f 32;");
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("cannot write") && Contains("out/"));
    const std::size_t frames = frames_in("out");
    CHECK(frames >= 5);
    CHECK(frames < 15);
    CHECK_THAT(text_of(path() / "out" / "plants.pvd"), Contains("</VTKFile>"));
}

TEST_CASE_METHOD(BadInput, "an output folder that cannot be written is named", "[app]") {
    fs::create_directories(path() / "sealed");
    write("file", "no folder");
    CHECK(run("run bush.l --quiet --output file/inside").code == 2);
    CHECK_THAT(run("run bush.l --quiet --output file/inside").err, Contains("file/inside"));
    if (geteuid() == 0) return;  // root writes everywhere
    fs::permissions(path() / "sealed", fs::perms::owner_read | fs::perms::owner_exec);
    const Outcome outcome = run("run bush.l --quiet --output sealed/out");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("sealed/out") && Contains("Permission denied"));
}

TEST_CASE_METHOD(BadInput, "a second run into one folder is refused, during the first and after it", "[app]") {
    write("patient.l", models::patient);
    Outcome second;
    const Outcome first = run_until(
        {"run", "patient.l", "--quiet", "--output", "out"}, [&] { return fs::exists(path() / "out/plants/0001.vtp"); },
        [&](pid_t process) {
            second = run("run bush.l --quiet --output out --overwrite");
            kill(process, SIGINT);
        });
    CHECK(first.code == 130);
    CHECK(second.code == 1);
    CHECK_THAT(second.err, Contains("another run is writing into out"));
    const Outcome third = run("run bush.l --quiet --output out");
    CHECK(third.code == 1);
    CHECK_THAT(third.err, Contains("--overwrite"));
    CHECK(exit_of("out") == "interrupted");
    CHECK(run("run bush.l --quiet --output out --overwrite").code == 0);
    CHECK(frames_in("out") == 6);
}

TEST_CASE_METHOD(BadInput, "interrupting a run leaves a whole timeline", "[app]") {
    write("patient.l", models::patient);
    for (int signal : {SIGINT, SIGTERM}) {
        const std::string folder = "out" + std::to_string(signal);
        const Outcome outcome = run_until(
            {"run", "patient.l", "--json", "--output", folder},
            [&] { return fs::exists(path() / folder / "plants/0003.vtp"); },
            [&](pid_t process) { kill(process, signal); });
        CHECK(outcome.code == 130);
        CHECK(json::parse(outcome.out)["exit"] == "interrupted");
        CHECK(exit_of(folder) == "interrupted");
        const std::size_t frames = frames_in(folder);
        CHECK(frames == json::parse(outcome.out)["steps_done"].get<std::size_t>() + 1);
        const std::string collection = text_of(path() / folder / "plants.pvd");
        CHECK_THAT(collection, Contains("</VTKFile>"));
        std::size_t named = 0;
        for (std::size_t at = 0; (at = collection.find("<DataSet", at)) != std::string::npos; ++at) ++named;
        CHECK(named == frames);
        CHECK_THAT(run("info " + folder).out, Contains("ended: interrupted"));
    }
}

TEST_CASE_METHOD(BadInput, "a second interrupt stops at once", "[app]") {
    write("endless.l",
          "lsystem: 1\nStartEach: { if (Q > 1) { while (1) { n = 1; } } }\nderivation length: 3\naxiom: F\n"
          "F --> FF\nendlsystem\n");
    const auto says_it_finishes = [&] {
        return text_of(path() / ".err").find("a second time: stopping at once") != std::string::npos;
    };
    const Outcome outcome = run_until(
        {"run", "endless.l", "--output", "out"}, [&] { return fs::exists(path() / "out/plants/0001.vtp"); },
        [&](pid_t process) {
            kill(process, SIGINT);
            for (int i = 0; i < 500 && !says_it_finishes(); ++i) usleep(10000);
            CHECK(says_it_finishes());
            CHECK(waitpid(process, nullptr, WNOHANG) == 0);
            kill(process, SIGINT);
        });
    CHECK(outcome.code == -SIGINT);
    CHECK_THAT(text_of(path() / "out/plants.pvd"), Contains("</VTKFile>"));
}

TEST_CASE_METHOD(BadInput, "a run that is killed leaves a collection of whole frames", "[app]") {
    write("patient.l", models::patient);
    const Outcome outcome = run_until(
        {"run", "patient.l", "--quiet", "--output", "out"}, [&] { return fs::exists(path() / "out/plants/0003.vtp"); },
        [&](pid_t process) { kill(process, SIGKILL); });
    CHECK(outcome.code == -SIGKILL);
    CHECK(exit_of("out") == "running");
    CHECK_THAT(run("info out").out, Contains("ended: killed"));
    CHECK_THAT(run("info out --json").out, Contains("\"exit\": \"killed\""));
    const std::string collection = text_of(path() / "out/plants.pvd");
    CHECK_THAT(collection, Contains("plants/0002.vtp") && Contains("</VTKFile>"));
}

TEST_CASE_METHOD(BadInput, "names that no disk takes are mistakes of the user", "[app]") {
    const std::string name(300, 'x');
    for (const std::string command : {"check", "run", "derive", "info", "rerun", "resume", "plot", "analyse",
                                      "export --format obj", "sweep --vary a=1,2"}) {
        INFO(command);
        const Outcome outcome = run(command + " " + name);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, !Contains("filesystem error"));
    }
}

TEST_CASE_METHOD(BadInput, "with --json a failure is an object too", "[app]") {
    const json failure = json::parse(run("run nowhere.toml --json").out);
    CHECK(failure["exit"] == "failed");
    CHECK(failure["code"] == 1);
    CHECK_THAT(failure["message"].get<std::string>(), Contains("nowhere.toml"));
    CHECK(json::parse(run("run bush.l --json --stpes 3").out)["code"] == 1);
}

TEST_CASE_METHOD(BadInput, "a process that does not answer in time ends the run, and says so in run.json", "[app]") {
    write("leaves.l",
          "environment light;\nlsystem: 1\nderivation length: 3\naxiom: A(400)\n"
          "A(n) : n > 0 --> f(1)?light(1)A(n - 1)\ndecomposition\nmaximum depth: 500\n"
          "A(n) : n > 0 --> f(1)?light(1)A(n - 1)\nendlsystem\n");
    const std::string slow =
        "[[plant]]\nmodel = 'leaves.l'\n[environment.light]\nprocess = 'chiba'\nnumber_of_samples = 131072\n"
        "radius = 1\n";
    const Outcome outcome = run_scene(slow, "--timeout 0.05 --json");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("process 'light' has not answered") && Contains("--timeout"));
    CHECK(json::parse(outcome.out)["exit"] == "failed");
    CHECK_THAT(exit_of("out"), Contains("failed: process 'light' has not answered"));
    CHECK_THAT(run("run scene.toml --timeout -1").err, Contains("--timeout"));
}

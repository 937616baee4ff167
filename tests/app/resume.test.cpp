// Runs that are killed or interrupted, and go on.
#include "catch.h"
#include "program.h"
#include "recorded_files.h"

#include <filesystem>

using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const char* const resumed =
    "environment light;\nlsystem: 1\nseed: 2\nderivation length: 60\naxiom: A(1)\n"
    "A(x) --> F(x)[+A(x*0.9)?light(1)] : 1\nA(x) --> F(x)A(x*0.99) : 2\nF(x) : x < 4 --> F(x*1.01)\nendlsystem\n";

const char* const lit =
    "[[plant]]\nmodel = \"growing.l\"\npositions = [[0, 0, 0], [1, 0, 0]]\n"
    "[[plant.stage]]\nstage = \"pipe-radii\"\n[[plant.stage]]\nstage = \"leaves\"\n"
    "[environment.light]\nprocess = \"voxel-shade\"\n[timeline]\nfields = [\"light\"]\n";

class Resumed : public Workplace {
public:
    Resumed() {
        write("growing.l", resumed);
        write("lit.toml", lit);
        REQUIRE(run("run lit.toml --quiet --output whole").code == 0);
    }

    void check_same(const std::string& folder, const std::string& whole = "whole") const {
        const auto expected = recorded_files(path() / whole), resumed = recorded_files(path() / folder);
        CHECK(resumed.size() == expected.size());
        for (const auto& [name, bytes] : expected) {
            INFO(name);
            REQUIRE(resumed.contains(name));
            CHECK(resumed.at(name) == bytes);
        }
    }
};

}  // namespace

TEST_CASE_METHOD(Resumed, "a run that is killed again and again ends with the bytes of one that was not", "[app]") {
    const auto has_checkpoint = [&] { return fs::exists(path() / "again" / "checkpoint"); };
    const auto strike = [](pid_t process) { kill(process, SIGKILL); };
    run_until({"run", "lit.toml", "--quiet", "--output", "again", "--checkpoint-every", "3"}, has_checkpoint, strike);
    for (int wait = 0; wait < 8 && has_checkpoint(); ++wait) {
        run_until(
            {"resume", "again", "--quiet"}, [] { return true; },
            [&](pid_t process) {
                usleep(static_cast<unsigned>(20'000 + 15'000 * wait));
                kill(process, SIGKILL);
            });
    }
    if (has_checkpoint()) CHECK(run("resume again --quiet --threads 1").code == 0);
    check_same("again");
    CHECK(run("resume again").code == 0);  // nothing is left to do
}

TEST_CASE_METHOD(Resumed, "an interrupted run leaves a checkpoint, whatever it was told", "[app]") {
    const Outcome outcome = run_until(
        {"run", "lit.toml", "--quiet", "--output", "again"},
        [&] { return fs::exists(path() / "again" / "plants" / "0002.vtp"); },
        [](pid_t process) { kill(process, SIGTERM); });
    if (outcome.code == 130) CHECK(run("resume again --quiet").code == 0);
    check_same("again");
}

TEST_CASE_METHOD(Resumed, "light in photons is the same in a run that was killed and went on with one thread",
                 "[app]") {
    const char* const leaves =
        "environment light;\nlsystem: 1\nseed: 2\nderivation length: 12\naxiom: !(0.006) A\n"
        "A --> F(0.03) [ &(55) ?light(1, 0) L(0.08) ] /(137.5) A\n?light(f, m) L(s) : f < 0.2 --> *\n"
        "L(s) --> L(s * 1.02)\nhomomorphism\nL(s) --> { . +(25) f(s / 2) . -(50) f(s / 2) . -(130) f(s / 2) . }\n"
        "endlsystem\n";
    const std::string rest =
        "periodic = true\nbands.par = { leaf = [0.1, 0.1] }\nbands.nir = { leaf = [0.4, "
        "0.4] "
        "}\nsky = { latitude = 50, day = 172, clearness = 0.5 }\n[timeline]\norgans = [\"light.absorbed\", "
        "\"light.brightest\"]\n";
    write("leaves.l", leaves);
    for (const auto& [process, own] :
         {std::pair<std::string, std::string>{"ray-light", "paths = 4096\n"}, {"canopy-light", "voxel = 0.1\n"}}) {
        CAPTURE(process);
        write(process + ".toml",
              "[simulation]\ndomain = { lower = [-0.2, 0, -0.2], upper = [0.2, 1, 0.2] }\n[[plant]]\nmodel = "
              "\"leaves.l\"\npositions = [[0, 0, 0], [0.1, 0, 0.05]]\n[environment.light]\nprocess = \"" +
                  process + "\"\n" + own + rest);
        const std::string whole = process + "-whole", again = process + "-again";
        REQUIRE(run("run " + process + ".toml --quiet --output " + whole).code == 0);
        const auto has_checkpoint = [&] { return fs::exists(path() / again / "checkpoint"); };
        run_until({"run", process + ".toml", "--quiet", "--output", again, "--checkpoint-every", "2"}, has_checkpoint,
                  [](pid_t child) { kill(child, SIGKILL); });
        if (has_checkpoint()) CHECK(run("resume " + again + " --quiet --threads 1").code == 0);
        check_same(again, whole);
    }
}

TEST_CASE_METHOD(Resumed, "water from soil to leaves is the same in a run that was killed and went on with one thread",
                 "[app][leaf]") {
    const std::string scene = std::string(ESPALIER_SOURCE_DIR) + "/environments/drought-stand.toml";
    const std::string store = "environment.roots.leaf.capacitance=2";
    REQUIRE(run("run " + scene + " --steps 24 --set " + store + " --quiet --threads 2 --output stand").code == 0);
    const auto has_checkpoint = [&] { return fs::exists(path() / "stand-again" / "checkpoint"); };
    run_until({"run", scene, "--steps", "24", "--set", store, "--quiet", "--output", "stand-again",
               "--checkpoint-every", "5"},
              has_checkpoint, [](pid_t child) { kill(child, SIGKILL); });
    if (has_checkpoint()) CHECK(run("resume stand-again --quiet --threads 1").code == 0);
    check_same("stand-again", "stand");
}

TEST_CASE_METHOD(Resumed, "what cannot go on is refused in words", "[app]") {
    CHECK_THAT(run("resume nowhere").err, Contains("nowhere holds no run"));
    run_until(
        {"run", "lit.toml", "--quiet", "--output", "again", "--checkpoint-every", "1"},
        [&] { return fs::exists(path() / "again" / "checkpoint"); }, [](pid_t process) { kill(process, SIGKILL); });
    write("growing.l", std::string(resumed) + "\n");
    const Outcome changed = run("resume again");
    CHECK(changed.code == 1);
    CHECK_THAT(changed.err, Contains("growing.l has changed since the run began"));
    write("growing.l", resumed);
    const std::string bytes = text_of(path() / "again" / "checkpoint");
    write("again/checkpoint", bytes.substr(0, bytes.size() / 2));
    CHECK(run("resume again").code != 0);
    for (std::size_t at = 8; at < bytes.size(); at += bytes.size() / 5) {
        std::string other = bytes;
        other[at] = static_cast<char>(other[at] ^ 0x10);
        write("again/checkpoint", other);
        CHECK_THAT(run("resume again").err, Contains("checkpoint is damaged"));
    }
    fs::remove(path() / "again" / "checkpoint");
    CHECK_THAT(run("resume again").err, Contains("has no checkpoint"));
}

TEST_CASE_METHOD(Resumed, "a run goes on through no link in its folder, and replaces none", "[app]") {
    write("short.toml", lit + std::string("skeleton = false\n"));
    REQUIRE(run("run short.toml --quiet --output linked --disk 1K --checkpoint-every 2").code == 2);
    REQUIRE(fs::exists(path() / "linked/checkpoint"));
    fs::create_directory(path() / "theirs");
    const std::string rows = text_of(path() / "linked/statistics.csv") + "theirs\n";
    write("theirs/statistics.csv", rows);
    write("theirs/0001.vti", "theirs");
    fs::remove(path() / "linked/statistics.csv");
    fs::create_symlink(path() / "theirs/statistics.csv", path() / "linked/statistics.csv");
    const Outcome continued = run("resume linked");
    CHECK(continued.code == 2);
    CHECK_THAT(continued.err, Contains("statistics.csv: it is a link, which is not followed for writing"));
    fs::remove_all(path() / "linked/fields/light");
    fs::create_directory_symlink(path() / "theirs", path() / "linked/fields/light");
    fs::create_directory_symlink(path() / "theirs", path() / "linked/files");
    const Outcome replaced = run("run short.toml --output linked --overwrite");
    CHECK(replaced.code == 2);
    CHECK_THAT(replaced.err, Contains("light is a link, which is not followed for writing"));
    CHECK(text_of(path() / "theirs/statistics.csv") == rows);
    CHECK(text_of(path() / "theirs/0001.vti") == "theirs");
}

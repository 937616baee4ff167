// Ctrl-C ends a run in the midst of whatever it does, and keeps what was whole.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// A second is what is promised; a busy machine may take longer.
constexpr double most_seconds = 5;

struct Work {
    std::string name;
    int last_whole;  ///< the last step that ends; -1: not even the model is read
    std::string model;
    std::string scene = "";  ///< what follows the plant in a scene file; empty: the model alone
};

/// Who asks process p, in so many steps.
std::string asking(const std::string& query) {
    return "environment p;\nlsystem: 1\nderivation length: 9\naxiom: F(1)A?p" + query + "\nA --> F(1)A\nendlsystem\n";
}

std::string doubled(int times, const std::string& text) {
    std::string macros = "#define A0 " + text + "\n";
    for (int i = 1; i <= times; ++i) {
        const std::string half = "A" + std::to_string(i - 1);
        macros += "#define A" + std::to_string(i) + " " + half + " " + half + "\n";
    }
    return macros;
}

const std::string domain = "[simulation]\ndomain = { lower = [-2, -2, -2], upper = [2, 2, 2] }\n[environment.p]\n";

class Stoppable : public Workplace {
public:
    /// Runs it and interrupts it when it has been at its endless work for a while: at the step behind its last whole
    /// one, or, where it never comes to one, at a time. Returns the seconds that it takes to end.
    double interrupt(const Work& work) {
        using Clock = std::chrono::steady_clock;
        write("it.l", work.model);
        const std::string what = work.scene.empty() ? "it.l" : "it.toml";
        if (!work.scene.empty()) write(what, "[[plant]]\nmodel = \"it.l\"\n" + work.scene);
        fs::remove_all(path() / "out");
        auto begin = Clock::now();
        Clock::time_point asked;
        outcome = run_until(
            {"run", what, "--output", "out"},
            [&] {
                if (frames() <= work.last_whole) begin = Clock::now();
                return Clock::now() - begin > std::chrono::milliseconds(500);
            },
            [&](pid_t process) {
                CHECK(waitpid(process, nullptr, WNOHANG) == 0);
                asked = Clock::now();
                kill(process, SIGINT);
            });
        return std::chrono::duration<double>(Clock::now() - asked).count();
    }

    json record() const { return json::parse(text_of(path() / "out" / "run.json")); }
    int frames() const {
        if (!fs::exists(path() / "out" / "plants.pvd")) return 0;
        const std::string collection = text_of(path() / "out" / "plants.pvd");
        CHECK_THAT(collection, Contains("</VTKFile>"));
        int count = 0;
        for (std::size_t at = 0; (at = collection.find("<DataSet", at)) != std::string::npos; ++at) ++count;
        return count;
    }

    Outcome outcome;
};

// Each is at its first step, or at its second, for hours.
const std::string vanishing = "A(x) : x < 50 --> A(x+1) A(x+1)\nA(x) : x >= 50 --> *\nendlsystem\n";
const std::string header = "lsystem: 1\nderivation length: 9\naxiom: ";
const std::vector<Work> works{
    {"loops of blocks", 1,
     header + std::string(500, 'F') +
         "\nF : {i = 0; while (Q > 1 && i < 90000000) {i = i + 1;}} 1 --> F\nendlsystem\n"},
    {"random numbers", 0, header + std::string(500, 'F') + "\nF --> G(biran(1e8, 0.5))\nendlsystem\n"},
    {"printing", 1,
     "lsystem: 1\nStartEach: { for (j = 0; Q > 1 && j < 1e4; j += 1) { for (i = 0; i < 1e4; i += 1) { "
     "printf(\"%1000d\", 1); } } }\n"
     "derivation length: 9\naxiom: F\nF --> F\nendlsystem\n"},
    {"printing into a file", 1,
     "lsystem: 1\nStart: { f = fopen(\"it.txt\", \"w\"); }\n"
     "StartEach: { for (i = 0; Q > 1 && i < 1e6; i += 1) { fprintf(f, \"%999999d%999999d%999999d\", 1, 2, 3); "
     "fclose(f); f = fopen(\"it.txt\", \"w\"); } }\n"
     "derivation length: 9\naxiom: F\nF --> F\nendlsystem\n"},
    {"filling an array", 1,
     "lsystem: 1\ndefine: { array a[20000000]; }\n"
     "StartEach: { for (j = 0; Q > 1 && j < 1000; j += 1) { for (i = 0; i < 2e7; i += 1) { a[i] = i; } } }\n"
     "derivation length: 9\naxiom: F\nF --> F\nendlsystem\n"},
    {"a decomposition that writes nothing", 1,
     header + "B\nB : Q > 1 --> A(0)\ndecomposition\nmaximum depth: 60\n" + vanishing},
    {"a homomorphism that draws nothing", 1,
     header + "B\nB : Q > 1 --> A(0)\nhomomorphism\nmaximum depth: 60\n" + vanishing},
    {"substeps of a diffusion", 0, asking("(1)"),
     domain + "process = \"soil-water\"\nvoxel = 0.04\ndiffusion = 1\nmax_substeps = 1000000000\n"},
    {"sweeps of a relaxation", 0, asking("(1)"),
     domain + "process = \"soil-water\"\nvoxel = 0.04\nmode = \"relaxation\"\nsweeps = 1000000000\n"
              "regions = [{ shape = \"box\", lower = [-1, -1, -1], upper = [0, 0, 0], value = 1 }]\n"},
    {"rounds of a reaction", 0, asking("(1)"),
     domain + "process = \"reaction-diffusion\"\npattern = \"net\"\ncolumns = 400\nrows = 400\nrounds = 100000\n"},
};

}  // namespace

TEST_CASE_METHOD(Stoppable, "Ctrl-C ends a run in the midst of a step, and the frames before it stay", "[app][stop]") {
    for (const Work& work : works) {
        INFO(work.name);
        CHECK(interrupt(work) < most_seconds);
        CHECK(outcome.code == 130);
        CHECK_THAT(outcome.out, Contains("0 of 9 steps (interrupted)") || Contains("1 of 9 steps (interrupted)"));
        CHECK(record()["exit"] == "interrupted");
        CHECK(record()["steps_done"] == work.last_whole);
        CHECK(frames() == work.last_whole + 1);
    }
}

TEST_CASE_METHOD(Stoppable, "Ctrl-C ends the reading of macros that multiply", "[app][stop]") {
    // Each use is about as long as one may be, and all together nearly as long as a text may be.
    std::string model = doubled(18, "F") + "lsystem: 1\naxiom:";
    for (int i = 0; i < 450; ++i) model += " A18";
    CHECK(interrupt({"macros", -1, model + "\nendlsystem\n"}) < most_seconds);
    CHECK(outcome.code == 130);
    CHECK_THAT(outcome.err, Contains("interrupted before anything was grown"));
    CHECK_FALSE(fs::exists(path() / "out"));
}

TEST_CASE_METHOD(Stoppable, "a run of long steps can go on from before the step that was dropped", "[app][stop]") {
    // The steps take longer and longer, until none ends in time.
    const std::string model =
        "lsystem: 1\nStartEach: { n = 0; for (i = 0; i < 0.4e6 * Q * Q; i += 1) { n += sin(i); } }\nderivation length: "
        "7\n"
        "axiom: A(0)\nA(x) --> F(n)A(x+1)\nendlsystem\n";
    write("it.l", model);
    REQUIRE(run("run it.l --quiet --output whole").code == 0);
    interrupt({"", 3, model});
    if (outcome.code == 0) return;  // a fast machine
    CHECK(outcome.code == 130);
    REQUIRE(fs::exists(path() / "out" / "checkpoint"));
    CHECK(run("resume out --quiet").code == 0);
    for (int step = 0; step <= 7; ++step) {
        const std::string name = "plants/000" + std::to_string(step) + ".vtp";
        CHECK(text_of(path() / "out" / name) == text_of(path() / "whole" / name));
    }
    CHECK(text_of(path() / "out" / "statistics.csv") == text_of(path() / "whole" / "statistics.csv"));
}

TEST_CASE_METHOD(Workplace, "what a model prints is shown without escape sequences, and not without end",
                 "[app][stop]") {
    write("it.l",
          "lsystem: 1\nStart: { printf(\"red %c[31m bell %c\\n\", 27, 7); for (i = 0; i < 1e6; i += 1) { printf(\"line "
          "%g\\n\", i); } }\n"
          "derivation length: 1\naxiom: F\nF --> F F\nendlsystem\n");
    for (const std::string command : {"derive", "run --quiet --output out"}) {
        const Outcome outcome = Workplace::run(command + " it.l");
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("red \\x1b[31m bell \\x07\nline 0\n"));
        CHECK(outcome.err.size() < (std::size_t{1} << 20) + 1000);
        CHECK_THAT(outcome.err, Contains("what they print from here on is left out"));
        CHECK(outcome.err.find('\x1b') == std::string::npos);
    }
}

TEST_CASE_METHOD(Workplace, "arrays count against the memory, and the largest is named with its place", "[app][stop]") {
    write("one.l", "lsystem: 1\ndefine: {\n  array a[90000000], b[2]; }\naxiom: F\nendlsystem\n");
    write("half.l", "lsystem: 1\ndefine: { array a[60][1000][1000]; }\naxiom: F\nendlsystem\n");
    write("two.toml", "[[plant]]\nmodel = \"half.l\"\npositions = [[0, 0, 0], [1, 0, 0]]\n");
    write("inner.l",
          "lsystem: 1\nderivation length: 20\naxiom: A\nA --> A ?(2) B $\nendlsystem\n"
          "lsystem: 2\ndefine: { array a[10000000]; }\nStart: { a[1] = 1; }\naxiom: B\nB --> B\nendlsystem\n");
    for (const std::string command : {"derive", "run --quiet --overwrite --output out"}) {
        const Outcome one = run(command + " one.l --memory 500M");
        CHECK(one.code == 2);
        CHECK_THAT(one.err, Contains("one.l:3:9: array 'a' takes 686 MiB"));
        const Outcome inner = run(command + " inner.l --memory 500M");
        CHECK(inner.code == 2);
        CHECK_THAT(inner.err, Contains("inner.l:7:17: array 'a' takes 76 MiB"));
    }
    CHECK(run("run half.l --steps 0 --quiet --memory 900M --output half").code == 0);
    const Outcome two = run("run two.toml --steps 0 --quiet --memory 900M --output two");
    CHECK(two.code == 2);
    CHECK_THAT(two.err, Contains("half.l:1") || Contains("half.l:2"));
}

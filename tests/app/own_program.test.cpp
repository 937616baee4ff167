// Environment programs of one's own, as a user attaches them: the example of docs/external, exit codes, Ctrl-C.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

class Own : public Workplace {
public:
    Own() { fs::copy(ESPALIER_SOURCE_DIR "/docs/external", path() / "external"); }

    void script(const std::string& text) const {
        write("external/mine", "#!/bin/sh\n" + text);
        fs::permissions(path() / "external/mine", fs::perms::owner_all);
        write("external/bush.e", "executable: ./mine\nturtle position: %g %g %g\ntimeout: 1\n");
    }
    Outcome run_bush(const std::string& more = "") const {
        return run("run external/bush.l --environment external/bush.e --overwrite --output out --quiet " + more);
    }
    json record(const std::string& folder) const { return json::parse(text_of(path() / folder / "run.json")); }
};

}  // namespace

TEST_CASE_METHOD(Own, "the program of the page answers, attached by a scene and by an environment file", "[app]") {
    CHECK(run("run external/bush.toml --output a --quiet").code == 0);
    CHECK(run_bush("--arithmetic double").code == 0);
    const std::string statistics = text_of(path() / "a/statistics.csv");
    CHECK(statistics == text_of(path() / "out/statistics.csv"));

    // Most apices of the eighth step are in the shade: unshaded, there would be 256.
    const Outcome counts = run("derive external/bush.l --environment external/bush.e --format counts");
    CHECK(counts.code == 0);
    const std::size_t at = counts.out.find("\nA ");
    REQUIRE(at != std::string::npos);
    const int apices = std::stoi(counts.out.substr(at + 3));
    CHECK(apices > 8);
    CHECK(apices < 200);
}

TEST_CASE_METHOD(Own, "run.json tells the command of a program and digests of its files, and rerun repeats it",
                 "[app]") {
    REQUIRE(run_bush().code == 0);
    const json out = record("out");
    const std::string light = (path() / "external/light.py").string();
    CHECK(out["processes"]["light.py"]["command"] == json({light, "-e", "bush.e"}));
    bool is_told = false;
    for (const json& input : out["inputs"]) {
        is_told = is_told || (input["path"] == light && input["digest"].get<std::string>().size() == 16 &&
                              !input.contains("text"));
    }
    CHECK(is_told);
    const Outcome again = run("rerun out");
    CHECK_THAT(again.out, Contains("all files have the same bytes"));
    CHECK(again.code == 0);

    std::ofstream(light, std::ios::app) << "# changed\n";
    const Outcome changed = run("rerun out");
    CHECK(changed.code == 1);
    CHECK_THAT(changed.err, Contains("light.py, and it has changed since"));
}

TEST_CASE_METHOD(Own, "a program that fails ends the run with exit code 2, one that cannot be started with 1",
                 "[app]") {
    const auto said = [&](const std::string& text) {
        script(text);
        const Outcome outcome = run_bush();
        CHECK(outcome.code == 2);
        CHECK_THAT(record("out")["exit"].get<std::string>(), Contains("failed: step 0: process 'mine' (external)"));
        return outcome.err;
    };
    CHECK_THAT(said("exit 7\n"), Contains("has ended with exit code 7"));
    CHECK_THAT(said("echo hello\nsleep 9\n"), Contains("answers 'hello'"));
    CHECK_THAT(said("sleep 9\n"), Contains("within 1 s"));
    CHECK_THAT(said("echo what went wrong >&2\nexit 1\n"), Contains("what went wrong"));
    fs::permissions(path() / "external/mine", fs::perms::owner_read);
    const Outcome denied = run_bush();
    CHECK(denied.code == 1);
    CHECK_THAT(denied.err, Contains("bush.e:1") && Contains("is no file that can be executed"));
}

TEST_CASE_METHOD(Own, "check starts no program", "[app]") {
    script("touch started\n");
    CHECK(run("check external/bush.l --environment external/bush.e").code == 0);
    CHECK_FALSE(fs::exists(path() / "external/started"));
}

TEST_CASE_METHOD(Own, "the command line starts nothing that a folder from a link names", "[app]") {
    write("external/.came-by-a-link", "");
    for (const char* what :
         {"run external/bush.toml --output a", "run external/bush.l --environment external/bush.e"}) {
        const Outcome outcome = run(what);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("came by a link"));
    }
}

TEST_CASE_METHOD(Own, "Ctrl-C ends a run that waits for a program within a second", "[app]") {
    script("echo $$ >process\nsleep 100\n");
    write("external/bush.e", "executable: ./mine\ntimeout: 100\n");
    const fs::path number = path() / "external/process";
    std::chrono::steady_clock::time_point asked;
    const Outcome outcome = run_until(
        {"run", "external/bush.l", "--environment", "external/bush.e", "--output", "out"},
        [&] { return fs::exists(number) && !text_of(number).empty(); },
        [&](pid_t process) {
            asked = std::chrono::steady_clock::now();
            kill(process, SIGINT);
        });
    CHECK(outcome.code == 130);
    CHECK(std::chrono::steady_clock::now() - asked < std::chrono::milliseconds(1500));
    CHECK(kill(std::stoi(text_of(number)), 0) != 0);
}

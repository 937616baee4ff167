// Environment programs of one's own, as a user attaches them: the example of docs/external, exit codes, Ctrl-C.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <pty.h>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

class Own : public Workplace {
public:
    Own() {
        fs::copy(ESPALIER_SOURCE_DIR "/docs/external", path() / "external");
        setenv("XDG_STATE_HOME", (path() / "state").c_str(), 1);  // whom the tester trusts is his own affair
    }
    ~Own() { unsetenv("XDG_STATE_HOME"); }

    /// Runs the program on a terminal of its own, where the user types this once he is asked.
    Outcome run_on_terminal(const std::vector<std::string>& arguments, const std::string& typed) const {
        int terminal = -1;
        const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
        if (child == 0) {
            std::vector<char*> argv{const_cast<char*>(ESPALIER_PROGRAM)};
            for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
            argv.push_back(nullptr);
            if (chdir(path().c_str()) == 0) execv(ESPALIER_PROGRAM, argv.data());
            _exit(127);
        }
        Outcome outcome;
        char bytes[4096];
        bool has_typed = false;
        for (ssize_t got = 0; (got = read(terminal, bytes, sizeof bytes)) > 0;) {
            outcome.out.append(bytes, static_cast<std::size_t>(got));
            if (has_typed || outcome.out.find("[y/N]") == std::string::npos) continue;
            has_typed = write_all(terminal, typed);
        }
        int status = 0;
        waitpid(child, &status, 0);
        close(terminal);
        outcome.code = code_of(status);
        return outcome;
    }

    void script(const std::string& text) const {
        write("external/mine", "#!/bin/sh\n" + text);
        fs::permissions(path() / "external/mine", fs::perms::owner_all);
        write("external/bush.e", "executable: ./mine\nturtle position: %g %g %g\ntimeout: 1\n");
    }
    Outcome run_bush(const std::string& more = "") const {
        return run("run external/bush.l --environment external/bush.e --overwrite --output out --quiet --trust " +
                   more);
    }
    json record(const std::string& folder) const { return json::parse(text_of(path() / folder / "run.json")); }
    bool has_started() const { return fs::exists(path() / "external/started"); }

private:
    static bool write_all(int to, const std::string& text) {
        return ::write(to, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    }
};

const std::vector<std::string> quiet_bush{"run", "external/bush.l", "--environment", "external/bush.e", "--steps",
                                          "1",   "--quiet",         "--overwrite",   "--output",        "out"};

}  // namespace

TEST_CASE_METHOD(Own, "the program of the page answers, attached by a scene and by an environment file", "[app]") {
    CHECK(run("run external/bush.toml --output a --quiet --trust").code == 0);
    CHECK(run_bush("--arithmetic double").code == 0);
    const std::string statistics = text_of(path() / "a/statistics.csv");
    CHECK(statistics == text_of(path() / "out/statistics.csv"));

    // Most apices of the eighth step are in the shade: unshaded, there would be 256.
    const Outcome counts = run("derive external/bush.l --environment external/bush.e --format counts --trust");
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
    CHECK_THAT(run("rerun out").err, Contains("run.json") && Contains("say --trust"));
    const Outcome again = run("rerun out --trust");
    CHECK_THAT(again.out, Contains("all files have the same bytes"));
    CHECK(again.code == 0);

    std::ofstream(light, std::ios::app) << "# changed\n";
    const Outcome changed = run("rerun out --trust");
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
        for (const char* trust : {"", " --trust"}) {
            const Outcome outcome = run(what + std::string(trust));
            CHECK(outcome.code == 1);
            CHECK_THAT(outcome.err, Contains("came by a link"));
        }
    }
}

TEST_CASE_METHOD(Own, "without consent no command starts a program, and each says what it would start", "[app]") {
    script("touch started\nexit 1\n");
    write("scene.toml",
          "[[plant]]\nmodel = \"external/bush.l\"\n[environment.light]\nprocess = \"external\"\n"
          "command = [\"touch\", \"external/started\"]\n");
    const std::string object = " external/bush.l --environment external/bush.e";
    for (const std::string& command : std::vector<std::string>{
             "run" + object + " --output a", "derive" + object,
             "sweep" + object + " --vary simulation.seed=1 --output s", "render" + object + " --output a.png",
             "view" + object + " --screenshot a.png", "run scene.toml --output a", "derive scene.toml",
             "run scene.toml --set plant.0.name=x --output a"}) {
        INFO(command);
        const Outcome outcome = run(command + " --steps 1");
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("starts a program, which may do all that you may do"));
        CHECK_THAT(outcome.err, Contains("mine") || Contains("touch external/started"));
        CHECK_FALSE(has_started());
    }
    CHECK(run_bush("--steps 1").code == 2);
    CHECK(has_started());
}

TEST_CASE_METHOD(Own, "a program that the command line gives a scene is asked for like the scene's own", "[app]") {
    write("scene.toml", "[[plant]]\nmodel = \"external/bush.l\"\n[environment.light]\nprocess = \"voxel-shade\"\n");
    const Outcome outcome =
        run("run scene.toml --output a --set environment.light.process=external "
            "--set 'environment.light.command=[\"touch\", \"external/started\"]'");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("say --trust"));
    CHECK_FALSE(has_started());
}

TEST_CASE_METHOD(Own, "consent on a terminal is asked for once and holds for the folder and for what it recorded",
                 "[app]") {
    const Outcome no = run_on_terminal(quiet_bush, "n\n");
    CHECK(no.code == 1);
    CHECK_THAT(no.out, Contains("bush.e:1") && Contains("light.py -e bush.e") && Contains("Do you trust the files in"));
    CHECK(run_on_terminal(quiet_bush, "\n").code == 1);

    CHECK(run_on_terminal(quiet_bush, "y\n").code == 0);
    const Outcome again = run_on_terminal(quiet_bush, "");
    CHECK(again.code == 0);
    CHECK_THAT(again.out, !Contains("Do you trust"));
    CHECK(run("derive external/bush.toml --steps 1").code == 0);
    CHECK(run("rerun out").code == 0);
    CHECK((fs::status(path() / "state/espalier/trusted-folders.json").permissions() & fs::perms::others_read) ==
          fs::perms::none);

    // Neither a folder beside it nor one below it is meant.
    fs::copy(path() / "external", path() / "other");
    fs::copy(path() / "external", path() / "external/below");
    for (const std::string folder : {"other", "external/below"}) {
        const std::string bush = folder + "/bush";
        CHECK(run("derive " + bush + ".l --environment " + bush + ".e --steps 1").code == 1);
    }
    // Whatever leads there.
    fs::create_directory_symlink("external", path() / "link");
    CHECK(run("derive link/bush.toml --steps 1").code == 0);
}

TEST_CASE_METHOD(Own, "Ctrl-C at the question ends the command", "[app]") {
    const Outcome outcome = run_on_terminal(quiet_bush, "\x03");
    CHECK(outcome.code == 130);
    CHECK_FALSE(fs::exists(path() / "out"));
}

TEST_CASE_METHOD(Own, "a run of others cannot start a program by what its run.json says", "[app]") {
    REQUIRE(run_bush("--steps 1").code == 0);
    json record = this->record("out");
    record["exit"] = "interrupted";
    record["processes"] = json::object();
    std::ofstream(path() / "out/run.json") << record;
    std::ofstream(path() / "out/checkpoint") << "a checkpoint";
    CHECK_THAT(run("resume out").err, Contains("say --trust"));
    record["exit"] = "done";
    std::ofstream(path() / "out/run.json") << record;
    const Outcome outcome = run("rerun out");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("say --trust"));
    for (const char* consent : {"--trust", "--trust=true"}) {
        json forged = record;
        forged["command"]["arguments"].push_back(consent);
        std::ofstream(path() / "out/run.json") << forged;
        for (const char* command : {"resume out", "rerun out"}) {
            CHECK_THAT(run(command).err, Contains("consent to start programs is no setting of a run"));
        }
    }
}

TEST_CASE_METHOD(Own, "a run whose scene may start programs goes on without being asked once more", "[app]") {
    REQUIRE(run_on_terminal(quiet_bush, "y\n").code == 0);
    const std::string again =
        "run external/bush.l --environment external/bush.e --steps 4 --quiet --output new --continue ";
    REQUIRE(run(again + "--disk 1K --checkpoint-every 1").code == 2);
    REQUIRE(fs::exists(path() / "new/checkpoint"));
    CHECK(run("resume new --disk 1G").code == 1);  // its run.json could be anybody's
    const Outcome outcome = run(again);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
}

TEST_CASE_METHOD(Own, "the runs of a sweep share the consent to its first", "[app]") {
    const std::string sweep =
        "sweep external/bush.l --environment external/bush.e --vary simulation.seed=1,2 --steps 1";
    CHECK(run(sweep + " --output s").code == 1);
    CHECK(run(sweep + " --output s --trust").code == 0);
    CHECK(fs::exists(path() / "s/seed=2/run.json"));
    CHECK_THAT(run(sweep + " --output l --list --trust").out, Contains("--trust"));
}

TEST_CASE_METHOD(Own, "Ctrl-C ends a run that waits for a program, and the program", "[app]") {
    script("echo $$ >process\nsleep 100\n");
    write("external/bush.e", "executable: ./mine\ntimeout: 100\n");
    const fs::path number = path() / "external/process";
    const Outcome outcome = run_until(
        {"run", "external/bush.l", "--environment", "external/bush.e", "--output", "out", "--trust"},
        [&] { return fs::exists(number) && !text_of(number).empty(); }, [](pid_t process) { kill(process, SIGINT); });
    CHECK(outcome.code == 130);
    CHECK(kill(std::stoi(text_of(number)), 0) != 0);
}

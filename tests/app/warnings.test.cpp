// Warnings: by run, derive and check alike, once each, and which of them --quiet does not silence.
#include "catch.h"
#include "program.h"

#include <string>
#include <string_view>

using Catch::Contains;

namespace {

std::size_t times_told(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

std::string model(const std::string& axiom, const std::string& productions) {
    return "lsystem: 1\nderivation length: 2\naxiom: " + axiom + "\n" + productions + "endlsystem\n";
}

struct Silent {
    const char *axiom, *productions, *warning;
};

class Warned : public Workplace {
public:
    /// The warning is told by all three commands, once each, also under --quiet.
    void check_alike(const std::string& what, const std::string& warning) const {
        INFO(what << ": " << warning);
        const Outcome checked = run("check " + what);
        CHECK(checked.code == 0);
        CHECK(times_told(checked.out, warning) == 1);
        for (const std::string& command : {"run " + what + " --output out --overwrite", "derive " + what}) {
            for (const char* quiet : {"", " --quiet"}) {
                const Outcome outcome = run(command + quiet);
                INFO(command << quiet << ": " << outcome.err);
                CHECK(outcome.code == 0);
                CHECK(times_told(outcome.err, warning) == 1);
            }
        }
    }
};

}  // namespace

TEST_CASE_METHOD(Warned, "silent mistakes of models are told by run, derive and check alike, once each", "[app]") {
    const Silent all[] = {
        {"F[+F", "F --> FF\n", "']' is missing"},
        {"F(1)", "F(x) --> F(1,5)F(x)\n", "'F' with 2 parameters is another module"},
        {"F\u2212(30)F\u2212(30)F", "F --> FF\n", "a minus sign (U+2212): type '-'"},
        {"F(1)A(1)", "F(x) --> F(x)F(x)\nA --> F(1)\n", "nothing produces 'A' (only with 1 parameter)"},
        {"F", "F : 0.2 --> FF\n", "is it a probability?"},
        {"F", "p1 : F --> FF\nF --> FF\n", "If it is a label: productions have none"},
    };
    for (const Silent& each : all) {
        write("model.l", model(each.axiom, each.productions));
        check_alike("model.l", each.warning);
    }
    write("model.l", model("F", "F --> FF\n") + "F --> F\n");
    check_alike("model.l", "text after 'endlsystem' is ignored");
}

TEST_CASE_METHOD(Warned, "what is odd but done as written is silenced by --quiet", "[app]") {
    write("odd.l", model("F", "F --> FF\nX --> F\n"));
    CHECK_THAT(run("check odd.l").out, Contains("nothing produces 'X'"));
    CHECK_THAT(run("run odd.l --output out").err, Contains("nothing produces 'X'"));
    CHECK_THAT(run("derive odd.l").err, Contains("nothing produces 'X'"));
    CHECK(run("run odd.l --output out --overwrite --quiet").err == "");
    CHECK(run("derive odd.l --quiet").err == "");
}

TEST_CASE_METHOD(Warned, "a process that no plant asks is told by run, derive and check alike", "[app]") {
    write("mute.l", model("FA", "A --> FA\n"));
    write("scene.toml", "[[plant]]\nmodel = 'mute.l'\n[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.5\n");
    const char* const warning = "no plant asks the process 'light'";
    CHECK(times_told(run("check scene.toml").out, warning) == 1);
    CHECK(times_told(run("run scene.toml --output out").err, warning) == 1);
    CHECK(times_told(run("derive scene.toml").err, warning) == 1);
    CHECK(run("run scene.toml --output out --overwrite --quiet").err == "");
}

TEST_CASE_METHOD(Warned, "a plant of which nothing was drawn is told at the end of a run", "[app]") {
    write("bare.l", model("A", "A --> AB\n"));
    const Outcome outcome = run("run bare.l --output out --quiet");
    CHECK(outcome.code == 0);
    CHECK(times_told(outcome.err, "bare.l: warning: nothing was drawn of this model in 2 steps") == 1);
    // A string is all that derive prints, so it may be all there is.
    CHECK(run("derive bare.l").err.find("drawn") == std::string::npos);
}

TEST_CASE_METHOD(Warned, "a sweep tells the warnings of its model once, not once a run", "[app]") {
    write("open.l", "#define N 1\n" + model("F(N)[+F(N)", "F(x) --> F(x)F(x)\n"));
    const Outcome outcome = run("sweep open.l --vary N=1:3:3 --output swept --quiet");
    CHECK(outcome.code == 0);
    CHECK(times_told(outcome.err, "']' is missing") == 1);
}

TEST_CASE_METHOD(Warned, "a text without quotes and a path with backslashes are told what to write", "[app]") {
    write("x.l", model("F", "F --> FF\n"));
    const auto told = [&](const std::string& line) {
        write("scene.toml", "[[plant]]\n" + line + "\n");
        const Outcome outcome = run("run scene.toml --output out");
        CHECK(outcome.code == 1);
        return outcome.err;
    };
    CHECK_THAT(told("model = x.l"), Contains("scene.toml:2:") && Contains("A text stands in quotes: \"x.l\""));
    CHECK_THAT(told("model = plants/x.l   # mine"), Contains("A text stands in quotes: \"plants/x.l\""));
    CHECK_THAT(told("model = C:\\plants\\x.l"), Contains("A text stands in quotes: 'C:\\plants\\x.l'"));
    CHECK_THAT(told("model = \"C:\\plants\\x.l\""), Contains("a backslash begins an escape"));
    CHECK_THAT(told("model = \"C:\\users\\x.l\""), Contains("a backslash begins an escape"));
    CHECK_THAT(told("model = \"C:\\trees\\new.l\""), Contains("\\t and \\n mean these"));
    // Other mistakes are not taken for these.
    CHECK(told("model = 'x.l' 'y.l'").find("stands in quotes") == std::string::npos);
    CHECK(run("run x.l --output out").code == 0);
}

// A program of one's own answers: what it is told, what its answers do, and each way in which it may fail.
#include "espalier/base/error.h"
#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "temporary_folder.h"

#include <chrono>
#include <sstream>
#include <thread>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A shell script as the process that answers.
class ScriptFolder : public TemporaryFolder {
public:
    std::string table(const std::string& script, const std::string& more = "") const {
        write("script", script);
        return "[light]\nprocess = \"external\"\ncommand = [\"sh\", \"script\"]\nfolder = \"" + path().string() +
               "\"\n" + more;
    }
    Environment environment(const std::string& script, const std::string& more = "") const {
        return environment_of(table(script, more));
    }
    /// What is wrong with the answers to two queries, of one and of two parameters.
    std::string complaint(const std::string& answers, const std::string& more = "") const {
        Environment environment = this->environment(R"(while read -r line; do
case $line in Control*) break ;; esac
done
)" + answers,
                                                    more);
        AskingPlants plants;
        plants.add({{{1, 2, 3}, {0.5}}, {{4, 5, 6}, {7, 8}, ""}});
        environment.set_default("light");
        return message_of([&] { plants.exchange(environment, 3); });
    }
    /// Waits for the process whose number a script has written. Nobody may have asked yet how it ended.
    bool has_ended(const std::string& file) const {
        const std::string process = std::to_string(std::stoi(text_of(path() / file)));
        for (int i = 0; i < 200; ++i) {
            const std::string state = text_of("/proc/" + process + "/stat");
            if (state.empty() || state.find(") Z") != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
};

/// Keeps what it is told, and says that all is answered.
const char* const scribe = R"(while read -r line; do
echo "$line" >>told
case $line in
*": 8 "*) echo bye >>told; exit ;;
Control*) echo "Control: 4" ;;
esac
done
)";

}  // namespace

TEST_CASE_METHOD(ScriptFolder, "a program is told the queries of all plants in the protocol of cpfg", "[external]") {
    {
        Environment environment = this->environment(
            scribe, "turtle = { position = \"P: %.1f %.0f %g\", heading = \"%g %g %g\", line_width = \"w %g\" }\n");
        environment.set_default("light");
        AskingPlants plants;
        plants.add({{{1.25, 2.6, 1e-7}, {0.1}}, {{0, 0, 0}, {1, 1.0 / 3}, ""}}).add({{{-1, 0, 0}, {5}}});
        const LetterId following = plants.model().alphabet.letter("F", 1);
        const double length = 2.5;
        plants.interpretation(0).queries[0].following = following;
        plants.interpretation(0).queries[0].following_parameters = {&length, 1};
        plants.exchange(environment, 6);
        CHECK(plants.parameters(0) == std::vector<double>{0.1, 1, 1.0 / 3});
        plants.exchange(environment, 7);
    }
    const std::string step =
        "0 light(0.1)F(2.5)\nP: 1.2 3 1e-07\n0 1 0\nw 0\n1 E(1,0.3333333333333333)\nP: 0.0 0 0\n0 1 0\nw 0\n"
        "2 light(5)\nP: -1.0 0 0\n0 1 0\nw 0\n";
    CHECK(text_of(path() / "told") == step + "Control: 5 6\n" + step + "Control: 5 7\nControl: 8 7\nbye\n");
}

TEST_CASE_METHOD(ScriptFolder, "digits and the following module are what the table says", "[external]") {
    {
        Environment environment = this->environment(scribe, "digits = 3\nfollowing_module = false\n");
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {1.0 / 3, 123456}}});
        plants.interpretation(0).queries[0].following = plants.model().alphabet.letter("F", 0);
        plants.exchange(environment);
    }
    CHECK(text_of(path() / "told") == "0 light(0.333,1.23e+05)\nControl: 5 0\nControl: 8 0\nbye\n");
}

TEST_CASE_METHOD(ScriptFolder, "values that are left out, and queries that are, keep their parameters", "[external]") {
    Environment environment = this->environment(R"(printf '\001'
while read -r line; do
case $line in Control*) printf '2  light( ,-2.5e-3 )\r\n\n0 light(9)\nControl: 4\n' ;; esac
done
)");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {1, 2}}, {{0, 0, 0}, {3}}, {{0, 0, 0}, {4, 5, 6}}});
    plants.exchange(environment);
    CHECK(plants.parameters() == std::vector<double>{9, 2, 3, 4, -2.5e-3, 6});
}

TEST_CASE_METHOD(ScriptFolder, "a program may answer while it reads, however many queries there are", "[external]") {
    write("echo.py",
          "import sys\nfor line in sys.stdin:\n    words = line.split()\n"
          "    if words[0] == 'Control:':\n        print('Control: 4', flush=True)\n"
          "    else:\n        print(words[0], 'light(%d,%s)' % (int(words[0]) % 7, 'x' * 0), flush=True)\n");
    Environment environment = environment_of(
        "[light]\nprocess = \"external\"\ncommand = [\"python3\", \"echo.py\"]\n"
        "folder = \"" +
        path().string() + "\"\n");
    const std::size_t count = 50000;
    AskingPlants plants;
    plants.add(std::vector<Asked>(count, {{1, 2, 3}, {0.123456789, 0.987654321}}));
    for (int step = 0; step < 2; ++step) plants.exchange(environment, step);
    const std::vector<double> answers = plants.parameters();
    bool alike = true;
    for (std::size_t i = 0; i < count; ++i) alike = alike && answers[2 * i] == double(i % 7);
    CHECK(alike);
    CHECK(answers[1] == 0.987654321);
}

TEST_CASE_METHOD(ScriptFolder, "no query means that the program is not asked, nor started", "[external]") {
    Environment environment = this->environment("echo started >started\n");
    AskingPlants plants;
    plants.add({}).exchange(environment);
    CHECK_FALSE(std::filesystem::exists(path() / "started"));
}

TEST_CASE_METHOD(ScriptFolder, "a program that lies about addresses or modules is told apart", "[external]") {
    const char* const end = "'; echo 'Control: 4'\n";
    const auto said = [&](const std::string& line) { return complaint("echo '" + line + end); };
    CHECK(lacks(said("2 light(1)"), {"step 3", "'light' (external)", "'2 light(1)'", "addresses 0 to 1"}) == "");
    CHECK(lacks(said("99999999999999999999 light(1)"), {"ADDRESS MODULE"}) == "");
    CHECK(lacks(said("-1 light(1)"), {"ADDRESS MODULE"}) == "");
    CHECK(lacks(said("0 E(1)"), {"'0 E(1)'", "the module at this address is light"}) == "");
    CHECK(lacks(said("1 light(1)"), {"the module at this address is E"}) == "");
    CHECK(lacks(said("0 light(1)\n0 light(1)"), {"answered already"}) == "");
    CHECK(lacks(said("0 light(1,2)"), {"the query has 1 parameter"}) == "");
    CHECK(lacks(said("1 E(1,2,)"), {"the query has 2 parameters"}) == "");
    CHECK(said("1 E(1,2)") == "");
}

TEST_CASE_METHOD(ScriptFolder, "a program that says garbage is quoted without its control characters", "[external]") {
    const auto said = [&](const std::string& text) { return complaint("printf '" + text + "\\nControl: 4\\n'\n"); };
    CHECK(lacks(said("Hello, world"), {"'Hello, world'", "ADDRESS MODULE(VALUE,...)"}) == "");
    CHECK(lacks(said("0 light(1x)"), {"'1x' is no number"}) == "");
    CHECK(lacks(said("0 light(1"), {"ADDRESS MODULE"}) == "");
    CHECK(lacks(said("0"), {"ADDRESS MODULE"}) == "");
    CHECK(lacks(said("\\033[2J\\000\\377"), {"ADDRESS MODULE"}) == "");
    CHECK(said("\\033[2J").find('\033') == std::string::npos);
    CHECK(lacks(said("0 light(nan)"), {"'light' (external) answers nan"}) == "");
    CHECK(lacks(said("0 light(inf)"), {"answers inf"}) == "");
    CHECK(lacks(complaint("head -c 1000000 /dev/zero\nsleep 10\n"), {"a line of more than 65536 bytes"}) == "");
    CHECK(lacks(complaint("printf 'Control: 4\\nmore'; sleep 10\n"), {"says more after the end"}) == "");
}

TEST_CASE_METHOD(ScriptFolder, "a program that ends is named with its exit code or signal", "[external]") {
    CHECK(lacks(complaint("exit 3\n"), {"sh has ended with exit code 3 before it had answered"}) == "");
    CHECK(lacks(complaint("exit 0\n"), {"exit code 0"}) == "");
    CHECK(lacks(complaint("kill -9 $$\n"), {"was ended by signal 9"}) == "");
    CHECK(lacks(complaint("exec >&- <&-; sleep 30\n"), {"closed its standard output"}) == "");
    CHECK(lacks(complaint("printf '0 light(1)\\n'; exit 3\n"), {"exit code 3"}) == "");
}

TEST_CASE_METHOD(ScriptFolder, "a silent program is ended with all that it has started", "[external]") {
    const Clock::time_point begin = Clock::now();
    const std::string said = complaint("echo $$ >one\nsh -c 'echo $$ >two; sleep 100'\n", "timeout = 0.5\n");
    CHECK(lacks(said, {"sh has not answered the queries of this step within 0.5 s", "`timeout` gives it longer"}) ==
          "");
    CHECK(seconds_since(begin) < 5);
    CHECK(has_ended("one"));
    CHECK(has_ended("two"));
}

TEST_CASE_METHOD(ScriptFolder, "the work that waits for a program can be stopped within a second", "[external]") {
    Environment environment = this->environment("echo $$ >one\nsleep 100\n");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {1}}});
    StopRequest request;
    const StopRequest::Scope scope(&request);
    std::thread asker([&] {
        while (!std::filesystem::exists(path() / "one")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        request.ask(patience_with_steps);
    });
    CHECK_THROWS_AS(plants.exchange(environment), Stopped);
    const Clock::time_point end = Clock::now();
    asker.join();
    CHECK(has_ended("one"));
    CHECK(seconds_since(end) < 0.5);
}

TEST_CASE_METHOD(ScriptFolder, "a program that does not end when it is told to is ended", "[external]") {
    const Clock::time_point begin = Clock::now();
    {
        Environment environment =
            this->environment("echo $$ >one\nread -r a; read -r b; echo 'Control: 4'; sleep 100\n");
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {1}}}).exchange(environment);
    }
    CHECK(has_ended("one"));
    CHECK(seconds_since(begin) < 5);
}

TEST_CASE_METHOD(ScriptFolder, "a program that cannot be started is a mistake of who names it", "[external]") {
    const auto said = [&](const std::string& command) {
        return message_of([&] {
            Environment environment =
                environment_of("[light]\nprocess = \"external\"\nfolder = \"" + path().string() + "\"\n" + command);
            AskingPlants plants;
            plants.add({{{0, 0, 0}, {1}}}).exchange(environment);
        });
    };
    write("script", "exit 0\n");
    write("lost", "#!/nowhere/sh\n");
    std::filesystem::permissions(path() / "lost", std::filesystem::perms::owner_all);
    CHECK(lacks(said("command = [\"./nothing\"]\n"), {"scene.toml:4", "/nothing is no file that can be executed"}) ==
          "");
    CHECK(lacks(said("command = [\"./script\"]\n"), {"is no file that can be executed"}) == "");
    CHECK(lacks(said("command = [\"no-such-script\"]\n"),
                {"no program no-such-script in the folders of PATH", "./no-such-script"}) == "");
    CHECK(lacks(said("command = [\"./lost\"]\n"), {"/lost cannot be started: No such file"}) == "");
    CHECK(lacks(said("command = []\n"), {"'command' must be a program"}) == "");
    CHECK(lacks(said(""), {"'command' must be a program"}) == "");
    CHECK(lacks(said("command = [\"sh\"]\ntimeout = 0\n"), {"timeout"}) == "");
}

TEST_CASE_METHOD(ScriptFolder, "nothing is started for what came by a link", "[external]") {
    const std::string script = "echo started >started\n";
    {
        const ReadLog limited(0, {}, ReadPermission{{path()}, 1000});
        CHECK(lacks(message_of([&] { environment(script); }), {"scene.toml", "came by a link", "no program"}) == "");
    }
    write(".came-by-a-link", "");
    const auto exchange = [&] {
        Environment environment = this->environment(script);
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {1}}}).exchange(environment);
    };
    CHECK(lacks(message_of(exchange), {"came by a link", "remove the file '.came-by-a-link'"}) == "");
    CHECK_FALSE(std::filesystem::exists(path() / "started"));
    std::filesystem::remove(path() / ".came-by-a-link");
    CHECK(lacks(message_of(exchange), {"exit code 0"}) == "");
    CHECK(std::filesystem::exists(path() / "started"));
}

TEST_CASE_METHOD(ScriptFolder, "the files of the command are among what a run has read", "[external]") {
    const ReadLog reads;
    environment("exit\n");
    bool has_script = false, has_program = false;
    for (const auto& [file, read] : reads.files()) {
        has_script = has_script || (file == path() / "script" && read.bytes == "exit\n");
        has_program = has_program || (file.filename() == "sh" && !read.kept && read.size > 0);
    }
    CHECK(has_script);
    CHECK(has_program);
}

TEST_CASE_METHOD(ScriptFolder, "a run that goes on from a checkpoint says that the program begins anew", "[external]") {
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.warnings = &warnings;
    std::stringstream saved;
    environment_of(table("exit\n"), context).save(saved);
    Environment restored = environment_of(table("exit\n"), context);
    CHECK(warnings.empty());
    restored.restore(saved);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].message, Contains("begins anew"));
}

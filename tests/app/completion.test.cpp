// Completions and man pages against the help that they are made from.
#include "app/program.h"
#include "catch.h"

#include <regex>
#include <set>
#include <sstream>

using Catch::Contains;

namespace {

/// Every command that the program's help tells of.
std::vector<std::string> commands_of(const std::string& help) {
    static const std::regex entry("\n  ([a-z-]+)  ");
    const std::string list = help.substr(help.find("\nSubcommands:"));
    std::vector<std::string> commands;
    for (std::sregex_iterator at(list.begin(), list.end(), entry), end; at != end; ++at) commands.push_back((*at)[1]);
    return commands;
}

/// Every long option of a command's help, whatever group it stands in.
std::set<std::string> options_of(const std::string& help) {
    static const std::regex entry("\n  (-[^ ]+)"), option("--[a-z-]+");
    std::set<std::string> options;
    const std::sregex_iterator end;
    for (std::sregex_iterator at(help.begin(), help.end(), entry); at != end; ++at) {
        const std::string names = (*at)[1];  // "-h,--help", "--ground,--no-ground{false}"
        for (std::sregex_iterator name(names.begin(), names.end(), option); name != end; ++name) {
            options.insert(name->str());
        }
    }
    return options;
}

struct Help {
    std::string text;
    std::set<std::string> options;
};

/// By command. The program is asked once.
const std::map<std::string, Help>& help_of_commands() {
    static const std::map<std::string, Help> all = [] {
        const Workplace place;
        std::map<std::string, Help> helps;
        for (const std::string& command : commands_of(place.run("--help").out)) {
            const std::string text = place.run(command + " --help").out;
            helps[command] = {text, options_of(text)};
        }
        return helps;
    }();
    return all;
}

bool is_installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// A place with the script that the program writes for bash.
class BashPlace {
public:
    BashPlace() { REQUIRE(place_.run("completion bash >script").code == 0); }

    /// What bash offers for the last of these words.
    std::set<std::string> offers(const std::string& words) const {
        place_.write("offer",
                     "source ./script\nCOMP_WORDS=(" + words +
                         ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_espalier\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
        const std::string ask = "cd '" + place_.path().string() + "' && bash ./offer >offers";
        REQUIRE(std::system(ask.c_str()) == 0);
        std::istringstream lines(text_of(place_.path() / "offers"));
        std::set<std::string> offers;
        for (std::string line; std::getline(lines, line);) offers.insert(line);
        return offers;
    }

private:
    Workplace place_;
};

}  // namespace

TEST_CASE("bash completes every command and every option of each", "[app][completion]") {
    const BashPlace bash;
    const auto& commands = help_of_commands();
    REQUIRE(commands.size() >= 20);
    const std::set<std::string> offered = bash.offers("espalier ''");
    for (const auto& [command, help] : commands) {
        INFO(command);
        CHECK(offered.contains(command));
        REQUIRE(!help.options.empty());
        CHECK(bash.offers("espalier " + command + " --") == help.options);
    }
    CHECK(!offered.contains("man"));
}

TEST_CASE("bash completes beginnings, words that an option accepts, and else names of files", "[app][completion]") {
    const BashPlace bash;
    CHECK(bash.offers("espalier ren") == std::set<std::string>{"render"});
    CHECK(bash.offers("espalier run --over") == std::set<std::string>{"--overwrite"});
    CHECK(bash.offers("espalier run --arithmetic ''") == std::set<std::string>{"double", "cpfg"});
    CHECK(bash.offers("espalier run --output ''") == std::set<std::string>{""});
}

TEST_CASE("zsh and fish are told of every command and option, in scripts that they can read", "[app][completion]") {
    const Workplace place;
    for (const std::string shell : {"zsh", "fish"}) {
        const Outcome script = place.run("completion " + shell);
        REQUIRE(script.code == 0);
        for (const auto& [command, help] : help_of_commands()) {
            CHECK_THAT(script.out, Contains(shell == "zsh" ? "'" + command + ":" : "-a " + command + " "));
            for (const std::string& option : help.options) {
                INFO(shell << ": " << command << " " << option);
                CHECK_THAT(script.out,
                           Contains(shell == "zsh" ? "'*" + option + "[" : " -l " + option.substr(2) + " "));
            }
        }
        if (is_installed(shell))
            CHECK(place.run("completion " + shell + " >script && " + shell + " -n script").code == 0);
    }
    CHECK(place.run("completion csh").code == 1);
}

TEST_CASE("fish completes what it was told", "[app][completion]") {
    if (!is_installed("fish")) return;
    const Workplace place;
    place.write("ask.fish", "source script\ncomplete -C 'espalier ren'\ncomplete -C 'espalier run --arithmetic '\n");
    REQUIRE(place.run("completion fish >script && fish ask.fish >offers").code == 0);
    CHECK_THAT(text_of(place.path() / "offers"), Contains("render\t") && Contains("cpfg") && Contains("double"));
}

TEST_CASE("Each command has a man page with its options and examples", "[app][completion]") {
    const Workplace place;
    REQUIRE(place.run("man pages").code == 0);
    const std::string all = text_of(place.path() / "pages/espalier.1");
    for (const auto& [command, help] : help_of_commands()) {
        const std::string name = std::regex_replace(command, std::regex("-"), "\\-");
        CHECK_THAT(all, Contains(".BR espalier\\-" + name + " (1)"));
        const std::string page = text_of(place.path() / ("pages/espalier-" + command + ".1"));
        CHECK_THAT(page, Contains("espalier\\-" + name + " \\- "));
        if (help.text.find("\nExamples:") != help.text.npos) {
            CHECK_THAT(page, Contains(".SH EXAMPLES\n.EX\n  espalier "));
        }
        for (const std::string& option : help.options) {
            INFO(command << " " << option);
            CHECK_THAT(page, Contains("\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR"));
        }
    }
    if (!is_installed("mandoc")) return;
    REQUIRE(place.run("man pages && mandoc -T lint -W error pages/*.1").code == 0);
}

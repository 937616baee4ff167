// Every command of README.md and docs/ is run as a reader would paste it, in a copy of the folders it reads.
//
// The README's commands are run first, in a fresh copy. Every other page begins in the folder that the README left,
// with the program on PATH. A comment above a block says which options tests add there, so that a film has four
// pictures here.
#include "catch.h"
#include "not_run.h"
#include "page.h"
#include "temporary_folder.h"

#include <sys/wait.h>

namespace {

using namespace pages;

const NotRun* exception_for(const fs::path& page, const Command& command) {
    for (const NotRun& entry : not_run()) {
        if (page == entry.page && name_of(command) == entry.command) return &entry;
    }
    return nullptr;
}

bool is_run(const fs::path& page, const Command& command) {
    const NotRun* const exception = exception_for(page, command);
    return !exception || is_installed(exception->needs);
}

fs::path log_of(const fs::path& logs, const Command& command) {
    return logs / std::to_string(command.line);
}

// The commands of a page one after the other in one shell. `espalier` is a function that adds what the page says that
// tests add; what each command prints goes to a file named after its line. A command whose output the page shows may
// fail.
std::string script_of(const fs::path& page, const fs::path& logs) {
    std::ostringstream script;
    script << "set -eo pipefail\n"
              "espalier() { local extra=\"shorter_${1//-/_}\"; command espalier \"$@\" ${!extra}; }\n"
              "exec </dev/null\n";
    for (const Block& block : blocks_of(page)) {
        script << "unset ${!shorter_*}\n";
        for (const auto& [command, options] : block.shorter)
            script << "shorter_" << command << "='" << options << "'\n";
        for (const Command& command : commands_of(block)) {
            if (!is_run(page, command)) continue;
            script << "echo " << command.line << " >'" << (logs / "at").string() << "'\n"
                   << "exec >'" << log_of(logs, command).string() << "' 2>&1\n"
                   << (command.shows_output ? "set +e\n" + command.text + "\nset -e\n" : command.text + "\n");
        }
    }
    return std::move(script).str();
}

// A folder where a page's commands run, and what they printed.
class Session {
public:
    Session(const fs::path& page, const fs::path& begin_with) : page_(page) {
        fs::create_directories(logs());
        // Hard links: no command writes into a file that is there, they all write beside it and rename.
        copy_ = std::system(("cp -al '" + begin_with.string() + "' '" + work().string() + "'").c_str());
    }

    fs::path work() const { return folder_.path() / "work"; }
    fs::path logs() const { return folder_.path() / "logs"; }

    /// The exit code of the first command that failed, or 0.
    int run(const std::string& path) const {
        const fs::path script = folder_.write("script", script_of(page_, logs()));
        const std::string shell =
            "cd '" + work().string() + "' && PATH=\"" + path + "\" bash '" + script.string() + "'";
        return copy_ != 0 ? copy_ : WEXITSTATUS(std::system(shell.c_str()));
    }

    /// "docs/render.md:7" and what the command there printed.
    std::string last_words() const {
        std::string line = text_of(logs() / "at");
        line.erase(line.find_last_not_of('\n') + 1);
        return page_.string() + ":" + line + " printed:\n" + text_of(logs() / line);
    }

private:
    fs::path page_;
    TemporaryFolder folder_;
    int copy_ = 0;
};

// What a clone has, and build/release as ./dev leaves it.
fs::path fresh_clone(const TemporaryFolder& folder) {
    const fs::path clone = folder.path() / "clone";
    for (const char* part : {"models", "environments", "lessons", "docs", "output/README.md"}) {
        fs::create_directories((clone / part).parent_path());
        fs::copy(root / part, clone / part, fs::copy_options::recursive);
    }
    for (const auto& entry : fs::directory_iterator(clone / "output")) {
        if (entry.path().filename() != "README.md") fs::remove_all(entry.path());
    }
    fs::create_directories(clone / "build");
    fs::create_directory_symlink(fs::path(ESPALIER_PROGRAM).parent_path(), clone / "build/release");
    return clone;
}

// The README in a fresh clone. It is run once.
struct Readme {
    TemporaryFolder folder;
    Session session{"README.md", fresh_clone(folder)};
    int code = session.run("$PATH");  // the page itself says how the program gets on PATH
};

const Readme& readme() {
    static const Readme run;
    return run;
}

// Where a page shows "..." it leaves out lines; seconds and sizes of memory differ from run to run.
std::string pattern_of(const std::vector<std::string>& output) {
    static const std::regex special(R"([.^$|()\[\]{}*+?\\])");
    std::string pattern;
    for (const std::string& line : output) {
        pattern += line == "..." ? "(.*\n)*" : std::regex_replace(line, special, R"(\$&)") + "\n";
    }
    return pattern;
}

void check_output(const fs::path& page, const fs::path& logs) {
    for (const Block& block : blocks_of(page)) {
        for (const Command& command : commands_of(block)) {
            if (!command.shows_output || !is_run(page, command)) continue;
            const std::string printed = text_of(log_of(logs, command));
            INFO(page.string() << ":" << command.line << " " << name_of(command) << " printed:\n" << printed);
            CHECK(std::regex_match(printed, std::regex(pattern_of(command.output))));
        }
    }
}

void check_session(const fs::path& page, const Session& session, int code) {
    INFO(session.last_words());
    CHECK(code == 0);
    if (code == 0) check_output(page, session.logs());
}

bool has_commands(const fs::path& page) {
    for (const Block& block : blocks_of(page)) {
        for (const Command& command : commands_of(block)) {
            if (is_run(page, command)) return true;
        }
    }
    return false;
}

// Found once: every section of a test case runs all that stands before it.
const std::vector<fs::path>& other_pages() {
    static const std::vector<fs::path> pages = [] {
        std::vector<fs::path> found;
        for (const fs::path& page : all_pages()) {
            if (page != "README.md" && has_commands(page)) found.push_back(page);
        }
        return found;
    }();
    return pages;
}

}  // namespace

TEST_CASE("The README's commands run as pasted into a fresh clone", "[docs]") {
    check_session("README.md", readme().session, readme().code);
}

TEST_CASE("Every page's commands run as pasted where the README's were", "[docs]") {
    REQUIRE(readme().code == 0);
    for (const fs::path& page : other_pages()) {
        DYNAMIC_SECTION(page.string()) {
            const Session session(page, readme().session.work());
            check_session(page, session, session.run((readme().session.work() / "build/release").string() + ":$PATH"));
        }
    }
}

TEST_CASE("Every command that is not run stands in a page, and says why it is not run", "[docs]") {
    for (const NotRun& entry : not_run()) {
        INFO(entry.page << ": " << entry.command);
        CHECK(!entry.reason.empty());
        bool found = false;
        for (const Block& block : blocks_of(entry.page)) {
            for (const Command& command : commands_of(block)) found = found || name_of(command) == entry.command;
        }
        CHECK(found);
    }
}

TEST_CASE("./dev knows its commands that pages name", "[docs]") {
    const TemporaryFolder folder;
    const fs::path help = folder.path() / "help";
    REQUIRE(std::system(("'" + (root / "dev").string() + "' help >'" + help.string() + "'").c_str()) == 0);
    const std::string usage = text_of(help);
    for (const NotRun& entry : not_run()) {
        if (!entry.command.starts_with("./dev ")) continue;
        const std::string command = entry.command.substr(6, entry.command.find(' ', 6) - 6);
        INFO(entry.page << ": " << entry.command);
        CHECK(usage.find("\n  " + command + " ") != std::string::npos);
    }
}

TEST_CASE("Blocks are read: loops, continued lines, output, options for tests", "[docs]") {
    Block block{
        "sh", {"for i in 1 2; do", "    echo $i", "done   # counts", "", "# remark", "echo a \\", "  b"}, 10, {}};
    const std::vector<Command> commands = commands_of(block);
    REQUIRE(commands.size() == 2);
    CHECK(name_of(commands[0]) == "for i in 1 2; do echo $i done");
    CHECK(commands[1].line == 15);
    CHECK(commands[1].text == "echo a \\\n  b");

    block = {"console", {"$ echo 1", "1", "$ true"}, 1, {}};
    REQUIRE(commands_of(block).size() == 2);
    CHECK(commands_of(block)[0].output == std::vector<std::string>{"1"});
    CHECK(std::regex_match("a.b\nx\ny\nend\n", std::regex(pattern_of({"a.b", "...", "end"}))));
    CHECK_FALSE(std::regex_match("a-b\nend\n", std::regex(pattern_of({"a.b", "...", "end"}))));

    const auto shorter = shorter_in("<!-- shortened in tests: run --steps 5; render --size 9x9 --frames 2 -->");
    CHECK(shorter == std::map<std::string, std::string>{{"run", "--steps 5"}, {"render", "--size 9x9 --frames 2"}});
}

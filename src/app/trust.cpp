#include "trust.h"

#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include "base/excerpt.h"
#include "base/link_mark.h"
#include "base/platform.h"
#include "child.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

std::string command_text(const NamedProgram& program) {
    std::vector<std::string> words;
    for (const std::string& word : program.command) words.push_back(quoted(printable(word)));
    return fmt::format("{}", fmt::join(words, " "));
}

// It may lie in a folder from a link that no file of the scene is in: that of a run.
void require_no_link(const NamedProgram& program) {
    if (!folder_of_link(program.folder)) return;
    throw UserError(program.place,
                    fmt::format("{} came by a link, and for what came by a link no program is started; if you trust "
                                "its author, remove the file '{}' from its folder",
                                program.folder.string(), link_mark));
}

bool says_yes(const std::string& question) {
    fmt::print(stderr, "{} ", question);
    std::fflush(stderr);
    while (!platform::input_waits(std::chrono::milliseconds(100))) end_if_asked();
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

void ask(const NamedProgram& program) {
    const bool agrees = says_yes(
        fmt::format("{}: the process '{}' starts a program, which may do all that you may do:\n    {}\n"
                    "Do you trust the files in {}? They may start programs from now on [y/N]",
                    to_string(program.place), program.process, command_text(program), program.folder.string()));
    if (!agrees) throw UserError("without your consent no program is started, and nothing was grown");
}

[[noreturn]] void refuse(const NamedProgram& program) {
    throw UserError(program.place,
                    fmt::format("the process '{}' starts a program, which may do all that you may do: {}. Look at it; "
                                "if you trust the files in {}, say --trust, or agree on a terminal, where you are "
                                "asked once",
                                program.process, command_text(program), program.folder.string()));
}

void remember(const fs::path& folder) {
    try {
        remember_trust(folder);
    } catch (const RunError& error) {
        fmt::print(stderr, "your consent holds for this time only: {}\n", error.what());
    }
}

}  // namespace

void require_trust(const std::vector<NamedProgram>& programs, bool given) {
    std::vector<fs::path> agreed;
    for (const NamedProgram& program : programs) {
        require_no_link(program);
        const bool is_agreed = std::find(agreed.begin(), agreed.end(), program.folder) != agreed.end();
        if (given || is_agreed || is_trusted(program.folder)) continue;
        if (!platform::can_ask()) refuse(program);
        ask(program);
        agreed.push_back(program.folder);
        remember(program.folder);
    }
}

void trust_record(const std::vector<NamedProgram>& programs, bool given, const fs::path& output) {
    if (!programs.empty() && !given && !is_trusted(output)) remember(output);
}

}  // namespace espalier::app

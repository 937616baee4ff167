// The command line, and the one place that catches.
#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include "base/json_text.h"
#include "base/platform.h"
#include "base/reason.h"
#include "base/text.h"
#include "command_line.h"
#include "looking_half.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace espalier::app {
namespace {

const char* const not_here =
    "Commands that read runs, such as render and export, are not here: `./dev build` builds them.";

// What CLI11 could make nothing of: a first word that is no command, else options first; "" if it made something of
// everything.
std::string unexpected(const CLI::App& program) {
    const std::vector<std::string> rest = program.remaining(true);
    if (program.get_subcommands().empty() && !rest.empty() && !rest.front().starts_with('-')) return rest.front();
    const auto option = std::find_if(rest.begin(), rest.end(), [](const auto& word) { return word.starts_with('-'); });
    if (option != rest.end()) return *option;
    return rest.empty() ? "" : rest.front();
}

// The first line of the examples of a command's help.
std::string first_example(const CLI::App& command) {
    const std::string footer = command.get_footer();
    const std::size_t examples = footer.find("Examples:");
    if (examples == std::string::npos) return "";
    const std::size_t begin = footer.find("espalier", examples);
    const std::string line = footer.substr(begin, footer.find('\n', begin) - begin);
    return line.substr(0, line.find("   "));  // without what it is about
}

// "espalier run needs `what`: a scene ...; for example: ..."
std::string missing_argument(const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_required() || !option->get_positional() || option->count() > 0) continue;
        std::string message = fmt::format("{} needs `{}`: {}", name, option->get_name(), option->get_description());
        if (const std::string example = first_example(command); !example.empty()) {
            message += fmt::format("; for example\n  {}", example);
        }
        if (option->get_name() == "what")
            message += "\n`espalier list models` and `espalier list scenes` show what there is";
        return message;
    }
    return "";
}

// CLI11 says that something is wrong; what it is is named, and the nearest name offered as everywhere.
std::string explain(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App* command = &program;
    for (const CLI::App* subcommand : program.get_subcommands()) command = subcommand;
    const std::string name = command == &program ? "espalier" : "espalier " + command->get_name();
    std::vector<std::string> options, commands;
    for (const CLI::Option* option : command->get_options()) options.push_back(option->get_name());
    for (const CLI::App* subcommand : shown_commands(*command)) commands.push_back(subcommand->get_name());

    const std::string word = unexpected(program);
    std::string message = error.what();
    if (word.starts_with('-')) {
        message = fmt::format("{} has no option '{}'{}", name, word, did_you_mean(word, options));
    } else if (command == &program && is_of_looking_half(word) && !open_looking_half()) {
        return fmt::format(
            "`espalier {}` is not here: this build has the commands that grow plants alone, as `./dev run` makes it. "
            "`./dev build` builds all.",
            word);
    } else if (!word.empty() && command == &program) {
        message = fmt::format("there is no command '{}'; the commands are {}{}", word, fmt::join(commands, ", "),
                              did_you_mean(word, commands));
        if (!open_looking_half()) message += fmt::format(". {}", not_here);
    } else if (!word.empty()) {
        message = fmt::format("{} does not accept '{}'", name, word);
    } else if (const std::string missing = missing_argument(*command, name); !missing.empty()) {
        message = missing;
    }
    return fmt::format("{}\n`{} --help` explains the options", message, name);
}

// What is still in the buffer must arrive too, or a full disk behind `espalier list > file` goes unnoticed.
int run_whole(Command& command) {
    const int code = command.run();
    if (std::fflush(stdout) != 0) {
        throw RunError(fmt::format("cannot write to standard output: {}", std::generic_category().message(errno)));
    }
    return code;
}

bool grows(const CommandLine& line, std::string_view word) {
    const std::vector<const CLI::App*> commands = std::as_const(line.program).get_subcommands({});
    return word == "--version" || std::any_of(commands.begin(), commands.end(),
                                              [&](const auto* command) { return command->get_name() == word; });
}

/// With the commands of the looking half unless the first word needs none of them.
std::unique_ptr<CommandLine> command_line(int argc, char** argv) {
    auto line = std::make_unique<CommandLine>();
    if (argc > 1 && grows(*line, argv[1])) return line;
    if (open_looking_half()) return std::make_unique<CommandLine>();
    line->program.footer(not_here);
    return line;
}

int parse_and_run(int argc, char** argv) {
    const bool json_wanted = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
    std::unique_ptr<CommandLine> line;
    try {
        line = command_line(argc, argv);
    } catch (const RunError& error) {
        return fail(error.what(), exit_code::run_failed, json_wanted);
    }
    CLI::App& program = line->program;
    if (argc == 1) return fail(program.help(), exit_code::user_error, false);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        return fail(explain(program, error), exit_code::user_error, json_wanted);
    }
    Command& command = **std::find_if(line->commands.begin(), line->commands.end(),
                                      [](const auto& known) { return known->asked_for(); });
    const bool json = command.wants_json();
    try {
        return run_whole(command);
    } catch (const Stopped&) {
        return fail("interrupted before anything was grown", exit_code::interrupted, json);
    } catch (const UserError& error) {
        return fail(error.what(), exit_code::user_error, json);
    } catch (const std::filesystem::filesystem_error& error) {
        // A path that cannot be looked at: too long a name, a loop of links, a folder without permission.
        const bool disk = error.code() == std::errc::no_space_on_device || error.code() == std::errc::io_error ||
                          error.code() == std::errc::read_only_file_system;
        return fail(reason_of(error), disk ? exit_code::run_failed : exit_code::user_error, json);
    } catch (const std::bad_alloc&) {
        return fail("the machine has no memory left; set a limit with --memory", exit_code::run_failed, json);
    } catch (const std::exception& error) {
        return fail(reason_of(error), exit_code::run_failed, json);
    }
}

}  // namespace

int fail(const std::string& message, int code, bool json) {
    // There is no output left to tell of one that cannot be written; the exit code still says it.
    std::fputs((message + "\n").c_str(), stderr);
    if (json) {
        const char* const exit = code == exit_code::interrupted ? "interrupted" : "failed";
        const nlohmann::ordered_json result = {{"exit", exit}, {"code", code}, {"message", message}};
        std::fputs((json_text(result) + "\n").c_str(), stdout);
    }
    return code;
}

CommandMakers& command_makers() {
    static CommandMakers makers;
    return makers;
}

}  // namespace espalier::app

int main(int argc, char** argv) {
    espalier::platform::occupy_standard_streams();
    espalier::platform::report_large_files();
    return espalier::app::parse_and_run(argc, argv);
}

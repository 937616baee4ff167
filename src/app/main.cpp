// The command line, and the one place that catches.
#include "espalier/base/error.h"
#include "espalier/base/text.h"

#include "commands.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <new>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace espalier {
namespace {

std::pair<std::string, std::string> key_and_value(const std::string& text, const char* option) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw UserError(fmt::format("{} {}: KEY=VALUE is expected", option, text));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

// "512M", "4G", "1.5GiB", "1000000": bytes; K, M, G, T are powers of 1024.
std::size_t memory_size(const std::string& text) {
    std::size_t used = 0;
    double number = 0;
    try {
        number = std::stod(text, &used);
    } catch (const std::exception&) {
    }
    const std::string unit = text.substr(used);
    const std::size_t power = unit.empty() || unit == "B" ? 0 : std::string("KMGT").find(unit[0]) + 1;
    const std::string rest = power == 0 ? "" : unit.substr(1);
    const bool known = power <= 4 && (rest.empty() || rest == "B" || rest == "iB");
    const double bytes = number * std::pow(1024.0, static_cast<double>(known ? power : 0));
    if (!known || used == 0 || !(bytes >= 1) || bytes > 1e18) {
        throw UserError(fmt::format("--memory {}: a size such as 512M or 4G is expected", text));
    }
    return static_cast<std::size_t>(bytes);
}

// What CLI11 fills in; the commands get it in their own terms.
struct CommandLine {
    RunArguments run;
    CheckArguments check;
    DeriveArguments derive;
    InfoArguments info;
    ListArguments list;
    ModelArguments model;
    std::vector<std::string> sets, defines;
    std::string memory;
    int steps = -1;
    std::int64_t seed = -1;

    std::optional<int> steps_if_any() const { return steps < 0 ? std::nullopt : std::optional(steps); }
    std::optional<std::uint64_t> seed_if_any() const {
        return seed < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(seed));
    }
    std::size_t bytes() const { return memory.empty() ? 0 : memory_size(memory); }
    KeyValues overrides() const {
        KeyValues result;
        for (const std::string& set : sets) result.push_back(key_and_value(set, "--set"));
        return result;
    }
    KeyValues definitions() const {
        KeyValues result;
        for (const std::string& define : defines) result.push_back(key_and_value(define, "--define"));
        return result;
    }
};

void add_growth_options(CLI::App* command, CommandLine& line) {
    command->add_option("--steps", line.steps, "derivations; default: what the scene or the model says")
        ->check(CLI::Range(0, 1000000000));
    command->add_option("--seed", line.seed, "of all random numbers; the same seed gives the same bytes")
        ->check(CLI::NonNegativeNumber);
    command->add_option("--memory", line.memory, "what it may take, such as 4G; default: half of the machine");
}

void add_set_option(CLI::App* command, CommandLine& line) {
    command->add_option("--set", line.sets, "KEY=VALUE overrides one value of the scene; may be repeated")
        ->allow_extra_args(false);
}

void add_model_options(CLI::App* command, CommandLine& line) {
    ModelArguments& model = line.model;
    command->add_option("--view", model.view, "a view file (.v): turtle, surfaces, contours, functions");
    command->add_option("--environment", model.environment, "an environment file (.e): who answers ?E");
    command->add_flag("--without-environment", model.without_environment,
                      "nobody answers: queries keep their parameters");
    command->add_option("--define", line.defines, "NAME=VALUE overrides a #define of the model; may be repeated")
        ->allow_extra_args(false);
    command->add_flag("--cpfg-quirks", model.quirks, "trunc rounds, x/0 = x, subscripts are clamped");
}

void add_drawing_options(CLI::App* command, CommandLine& line) {
    ModelArguments& model = line.model;
    command->add_option("--animate", model.animation, "an animation file (.a): which steps are frames");
    command->add_option("--colour-map", model.colour_maps, "a colour map (.map), or N=FILE for set N; may be repeated")
        ->allow_extra_args(false);
    command->add_option("--materials", model.materials, "materials (.mat), or N=FILE for set N; may be repeated")
        ->allow_extra_args(false);
}

void add_run(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("run", "grow a scene, a model or an object, and record it");
    command->add_option("what", line.model.file, "a scene (.toml), a model (.l), or the folder of an object")
        ->required();
    add_model_options(command, line);
    add_drawing_options(command, line);
    add_set_option(command, line);
    add_growth_options(command, line);
    command->add_option("--threads", line.run.threads, "default: all; the result is the same with any number")
        ->check(CLI::Range(1, 4096));
    command->add_option("--output", line.run.output, "folder; default: output/<scene>-<time>");
    command->add_flag("--overwrite", line.run.overwrite, "replace the timeline in that folder");
    command->add_flag("--quiet", line.run.quiet, "print nothing but errors");
    command->add_flag("--json", line.run.json, "print the result as JSON");
    command->footer(R"(Examples:
  espalier run environments/two-trees.toml
  espalier run environments/two-trees.toml --set environment.light.voxel=0.5 --output output/coarse
  espalier run models/course/02-branching.l --steps 5
  espalier run plant.l --view plant.v --animate plant.a --colour-map plant.map
  espalier run objects/lilac            the model that the folder's file 'specifications' starts
Ctrl-C ends the run after the step at hand and keeps what was recorded; once more stops at once.)");
}

void add_check(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("check", "read a model or a scene and explain what is wrong");
    command
        ->add_option("what", line.model.file,
                     "a scene (.toml), a model (.l), the folder of an object, or a side file (.v, .a, .e, ...)")
        ->required();
    add_model_options(command, line);
    add_drawing_options(command, line);
    add_set_option(command, line);
    command->add_flag("--json", line.check.json, "print the findings as JSON");
    command->footer(R"(Mistakes make the exit code 1; what only looks wrong is a warning.
Examples:
  espalier check models/course/02-branching.l
  espalier check plant.l --view plant.v
  espalier check plant.v
  espalier check objects/lilac          every file of the object, and which of them it does not use)");
}

void add_derive(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("derive", "print the string of a model after its steps");
    command->add_option("model", line.model.file, "a model (.l), or the folder of an object")->required();
    add_model_options(command, line);
    add_drawing_options(command, line);
    add_growth_options(command, line);
    command->add_option("--format", line.derive.format, "text (cpfg's notation), counts (per symbol) or json")
        ->check(CLI::IsMember({"text", "counts", "json"}));
    command->add_flag("--before-exchange", line.derive.before_exchange,
                      "leave the last step's queries unanswered, as cpfg does");
    command->add_option("--files", line.derive.files, "folder for files the model writes; default: they are forgotten");
    command->add_flag("--quiet", line.derive.quiet, "print no warnings");
    command->footer(
        R"(The derivation length decides how far, not an animation. ?P ?H ?L ?U ?Q are answered by the turtle as the view
file starts it; ?E and named queries keep their parameters unless an environment file says who answers.
Examples:
  espalier derive models/course/02-branching.l --steps 3
  espalier derive models/course/03-parameters.l --format counts
  espalier derive plant.l --view plant.v --environment plant.e
  espalier derive objects/lilac --before-exchange)");
}

void add_info(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("info", "summarise what a run left in a folder");
    command->add_option("folder", line.info.folder, "an output folder")->required();
    command->add_flag("--json", line.info.json, "print it as JSON");
    command->footer("Example:\n  espalier info output/two-trees-20260101-120000");
}

void add_list(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("list", "document processes, symbols, recorders, models, scenes");
    command->add_option("kind", line.list.kind, fmt::format("{}", fmt::join(list_kinds(), ", ")));
    command->add_option("name", line.list.name, "one of them, in full");
    command->add_option("--models", line.list.models, "the library of models; default: ./models, or the one installed");
    command->add_flag("--json", line.list.json, "print it as JSON");
    command->footer(
        "Examples:\n  espalier list processes\n  espalier list processes voxel-shade\n  espalier list scene\n"
        "  espalier list models\n  espalier list models koch");
}

// What CLI11 could make nothing of, options first; "" if it made something of everything.
std::string unexpected(const CLI::App& program) {
    const std::vector<std::string> rest = program.remaining(true);
    const auto option = std::find_if(rest.begin(), rest.end(), [](const auto& word) { return word.starts_with('-'); });
    if (option != rest.end()) return *option;
    return rest.empty() ? "" : rest.front();
}

// CLI11 says that something is wrong; what it is is named, and the nearest name offered as everywhere.
std::string explain(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App* command = &program;
    for (const CLI::App* subcommand : program.get_subcommands()) command = subcommand;
    const std::string name = command == &program ? "espalier" : "espalier " + command->get_name();
    std::vector<std::string> options, commands;
    for (const CLI::Option* option : command->get_options()) options.push_back(option->get_name());
    for (const CLI::App* subcommand : command->get_subcommands({})) commands.push_back(subcommand->get_name());

    const std::string word = unexpected(program);
    std::string message = error.what();
    if (word.starts_with('-')) {
        message = fmt::format("{} has no option '{}'{}", name, word, did_you_mean(word, options));
    } else if (!word.empty() && command == &program) {
        message = fmt::format("'{}' is none of the commands {}{}", word, fmt::join(commands, ", "),
                              did_you_mean(word, commands));
    } else if (!word.empty()) {
        message = fmt::format("{} does not expect '{}'", name, word);
    }
    return fmt::format("{}\n`{} --help` explains the options", message, name);
}

int run_subcommand(const CLI::App& program, CommandLine& line) {
    line.model.defines = line.definitions();
    if (program.got_subcommand("run")) {
        line.run.model = line.model;
        line.run.overrides = line.overrides();
        line.run.steps = line.steps_if_any();
        line.run.seed = line.seed_if_any();
        line.run.memory = line.bytes();
        return run_command(line.run);
    }
    if (program.got_subcommand("check")) {
        line.check.model = line.model;
        line.check.overrides = line.overrides();
        return check_command(line.check);
    }
    if (program.got_subcommand("derive")) {
        line.derive.model = line.model;
        line.derive.steps = line.steps_if_any();
        line.derive.seed = line.seed_if_any();
        line.derive.memory = line.bytes();
        return derive_command(line.derive);
    }
    if (program.got_subcommand("info")) return info_command(line.info);
    return list_command(line.list);
}

// What is still in the buffer must arrive too, or a full disk behind `espalier list > file` goes unnoticed.
int dispatch(const CLI::App& program, CommandLine& line) {
    const int code = run_subcommand(program, line);
    if (std::fflush(stdout) != 0) {
        throw RunError(fmt::format("cannot write to standard output: {}", std::generic_category().message(errno)));
    }
    return code;
}

// A file must not be opened under the number of a standard stream that somebody closed, or messages land in it.
void occupy_standard_streams() {
    int descriptor = open("/dev/null", O_RDWR);
    while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDWR);
    if (descriptor >= 0) close(descriptor);
}

int fail(const std::string& message, int code, bool json) {
    // Nobody is left to be told of an output that cannot be written; the exit code still says it.
    std::fputs((message + "\n").c_str(), stderr);
    if (json) {
        const nlohmann::ordered_json result = {{"exit", "failed"}, {"code", code}, {"message", message}};
        std::fputs((result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n").c_str(), stdout);
    }
    return code;
}

int parse_and_dispatch(int argc, char** argv) {
    CommandLine line;
    CLI::App program("Espalier grows plants from L-systems in environments they shape, and records their growth.",
                     "espalier");
    program.set_version_flag("--version", ESPALIER_VERSION);
    program.require_subcommand(1);
    program.footer("`espalier COMMAND --help` explains a command, with examples.");
    add_run(program, line);
    add_check(program, line);
    add_derive(program, line);
    add_info(program, line);
    add_list(program, line);
    if (argc == 1) return fail(program.help(), exit_code::user_error, false);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        const bool json_wanted = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
        return fail(explain(program, error), exit_code::user_error, json_wanted);
    }
    const bool json = line.run.json || line.check.json || line.info.json || line.list.json;
    try {
        return dispatch(program, line);
    } catch (const UserError& error) {
        return fail(error.what(), exit_code::user_error, json);
    } catch (const std::bad_alloc&) {
        return fail("the machine has no memory left; --memory sets a limit below that", exit_code::run_failed, json);
    } catch (const std::exception& error) {
        return fail(error.what(), exit_code::run_failed, json);
    }
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
    espalier::occupy_standard_streams();
    // A file larger than the system allows is an error of the writer, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    return espalier::parse_and_dispatch(argc, argv);
}

// The program's options and commands as the command line, completions and man pages know them.
#pragma once

#include "command.h"

#include <memory>
#include <vector>

namespace espalier::app {

/// The program's options and the commands that have registered themselves by now.
struct CommandLine {
    CommandLine();

    CLI::App program;
    std::vector<std::unique_ptr<Command>> commands;
};

/// The commands that `--help` tells of.
std::vector<const CLI::App*> shown_commands(const CLI::App& program);

/// The options that `--help` tells of: those with a `-`, or the positional ones.
std::vector<const CLI::Option*> shown_options(const CLI::App& command, bool positional = false);

/// Whether a value follows the option.
bool takes_value(const CLI::Option& option);

/// Of an option that takes one of a few words, these words; else none.
std::vector<std::string> values_of(const CLI::Option& option);

}  // namespace espalier::app

#include "command_line.h"

#include "options.h"

#include <sstream>

namespace espalier::app {

CommandLine::CommandLine()
    : program("Espalier grows plants from L-systems in a simulated environment, and records their growth.",
              "espalier") {
    program.set_version_flag("--version", ESPALIER_VERSION);
    program.require_subcommand(1);
    program.footer("`espalier COMMAND --help` explains a command, with examples.");
    for (const auto& [place, make] : command_makers()) commands.push_back(make(program));
    for (CLI::App* command : program.get_subcommands({})) {
        read_decimal_numbers(*command);
        refuse_empty_names(*command);
    }
}

std::vector<const CLI::App*> shown_commands(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> shown_options(const CLI::App& command, bool positional) {
    return command.get_options([&](const CLI::Option* option) {
        return !option->get_group().empty() && option->nonpositional() != positional;
    });
}

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

// CLI11 tells of the words that it accepts only in the name of the type: "TEXT:{double,cpfg}".
std::vector<std::string> values_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find(":{"), end = type.rfind('}');
    std::vector<std::string> values;
    if (begin == std::string::npos || end == std::string::npos) return values;
    std::istringstream words(type.substr(begin + 2, end - begin - 2));
    for (std::string word; std::getline(words, word, ',');) values.push_back(word);
    return values;
}

}  // namespace espalier::app

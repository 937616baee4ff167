#include "completions.h"

#include "command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace espalier::app {
namespace {

/// "-h", "--help".
std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> names_of_all(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : shown_options(command)) {
        for (const std::string& name : names_of(*option)) names.push_back(name);
    }
    return names;
}

std::vector<std::string> names_of_commands(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : shown_commands(program)) names.push_back(command->get_name());
    return names;
}

/// With a backslash before each of these characters.
std::string escaped(std::string_view text, std::string_view special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != special.npos) out += '\\';
        out += c;
    }
    return out;
}

/// As one word of a shell whose quoted words know no escapes: zsh.
std::string zsh_word(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// As one word of fish.
std::string fish_word(std::string_view text) {
    return "'" + escaped(text, "\\'") + "'";
}

std::string bash_values(const CLI::App& command) {
    std::string cases;
    for (const CLI::Option* option : shown_options(command)) {
        const std::vector<std::string> values = values_of(*option);
        if (values.empty()) continue;
        cases += fmt::format("        '{} {}') words='{}' ;;\n", command.get_name(),
                             fmt::join(names_of(*option), fmt::format("' | '{} ", command.get_name())),
                             fmt::join(values, " "));
    }
    return cases;
}

/// What stands between the brackets of _arguments.
std::string zsh_summary(const std::string& text) {
    return escaped(text, "\\[]:");
}

std::string zsh_option(const CLI::Option& option) {
    const std::vector<std::string> values = values_of(option);
    std::string what;
    if (!values.empty()) {
        what = fmt::format(":value:({})", fmt::join(values, " "));
    } else if (takes_value(option)) {
        what = ":value:_files";
    }
    std::string lines;
    for (const std::string& name : names_of(option)) {
        lines +=
            " \\\n            " + zsh_word(fmt::format("*{}[{}]{}", name, zsh_summary(option.get_description()), what));
    }
    return lines;
}

std::string fish_option(const std::string& condition, const CLI::Option& option) {
    std::string line = "complete -c espalier -n " + fish_word(condition);
    for (const std::string& name : option.get_snames()) line += " -s " + name;
    for (const std::string& name : option.get_lnames()) line += " -l " + name;
    if (takes_value(option)) line += " -r";
    if (const auto values = values_of(option); !values.empty()) {
        line += " -f -a " + fish_word(fmt::format("{}", fmt::join(values, " ")));
    }
    return line + " -d " + fish_word(option.get_description()) + "\n";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
    std::string options, values;
    for (const CLI::App* command : shown_commands(program)) {
        options +=
            fmt::format("        {}) words='{}' ;;\n", command->get_name(), fmt::join(names_of_all(*command), " "));
        values += bash_values(*command);
    }
    return fmt::format(R"(# Completes the command line of espalier in bash. Made by `espalier completion bash`.
_espalier() {{
    local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD - 1]}}" command='' words='' i
    for ((i = 1; i < COMP_CWORD; i++)); do
        [[ ${{COMP_WORDS[i]}} == -* ]] || {{ command="${{COMP_WORDS[i]}}" && break; }}
    done
    COMPREPLY=()
    case "$command $before" in
{}        *) words='' ;;
    esac
    [[ -z $words ]] || {{ COMPREPLY=($(compgen -W "$words" -- "$word")) && return; }}
    case "$command" in
        '') words='{} {}' ;;
{}    esac
    # Without a match, bash completes names of files.
    [[ -n $command && $word != -* ]] || COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o bashdefault -o default -F _espalier espalier
)",
                       values, fmt::join(names_of_commands(program), " "), fmt::join(names_of_all(program), " "),
                       options);
}

std::string zsh_completion(const CLI::App& program) {
    std::string commands, cases, options;
    for (const CLI::Option* option : shown_options(program)) options += zsh_option(*option);
    for (const CLI::App* command : shown_commands(program)) {
        commands += "        " +
                    zsh_word(fmt::format("{}:{}", command->get_name(), escaped(command->get_description(), ":"))) +
                    "\n";
        cases += fmt::format("        {}) _arguments", command->get_name());
        for (const CLI::Option* option : shown_options(*command)) cases += zsh_option(*option);
        cases += " \\\n            '*:file:_files' ;;\n";
    }
    return fmt::format(R"(#compdef espalier
# Completes the command line of espalier in zsh. Made by `espalier completion zsh`.
_espalier() {{
    local state line context
    typeset -A opt_args
    local -a commands=(
{}    )
    _arguments -C{} \
        '1:command:->command' '*::argument:->argument'
    case $state in
    command) _describe command commands ;;
    argument)
        case $words[1] in
{}        esac ;;
    esac
}}
if [[ $funcstack[1] == _espalier ]]; then
    _espalier "$@"
else
    compdef _espalier espalier
fi
)",
                       commands, options, cases);
}

std::string fish_completion(const CLI::App& program) {
    std::string text = "# Completes the command line of espalier in fish. Made by `espalier completion fish`.\n";
    for (const CLI::Option* option : shown_options(program)) text += fish_option("__fish_use_subcommand", *option);
    for (const CLI::App* command : shown_commands(program)) {
        text += fmt::format("complete -c espalier -f -n __fish_use_subcommand -a {} -d {}\n", command->get_name(),
                            fish_word(command->get_description()));
        for (const CLI::Option* option : shown_options(*command)) {
            text += fish_option("__fish_seen_subcommand_from " + command->get_name(), *option);
        }
    }
    return text;
}

}  // namespace espalier::app

#include "man_pages.h"

#include "command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace espalier::app {
namespace {

/// Text as troff reads it: a hyphen that can be copied, no escapes, and no line that is taken for a request.
std::string troff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            out += c;
        }
    }
    return out;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

std::string heading(const std::string& page, const std::string& summary) {
    // Without a date, the same program makes the same pages.
    return fmt::format(
        ".\\\" Made by `espalier man`.\n.TH {} 1 \"\" \"espalier {}\" \"Espalier\"\n.SH NAME\n{} \\- {}\n.SH "
        "SYNOPSIS\n",
        upper(page), ESPALIER_VERSION, troff(page), troff(summary));
}

/// "double|cpfg", or the type without what CLI11 adds of its range.
std::string value_of(const CLI::Option& option) {
    const std::vector<std::string> values = values_of(option);
    const std::string type = option.get_type_name();
    return values.empty() ? type.substr(0, type.find(':')) : fmt::format("{}", fmt::join(values, "|"));
}

std::string option_entry(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : option.get_snames()) names += "\\fB\\-" + troff(name) + "\\fR, ";
    for (const std::string& name : option.get_lnames()) names += "\\fB\\-\\-" + troff(name) + "\\fR, ";
    names.resize(names.size() - 2);
    if (takes_value(option)) names += " \\fI" + troff(value_of(option)) + "\\fR";
    return fmt::format(".TP\n{}\n{}\n", names, troff(option.get_description()));
}

std::string options_of(const CLI::App& command) {
    std::string text = ".SH OPTIONS\n";
    for (const CLI::Option* option : shown_options(command)) text += option_entry(*option);
    return text;
}

std::string arguments_of(const CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : shown_options(command, /*positional=*/true)) {
        text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", troff(option->get_name()), troff(option->get_description()));
    }
    return text.empty() ? text : ".SH ARGUMENTS\n" + text;
}

std::string synopsis_of(const CLI::App& command) {
    std::string text = fmt::format(".B espalier {}\n[\\fIOPTIONS\\fR]", command.get_name());
    for (const CLI::Option* option : shown_options(command, /*positional=*/true)) {
        const char* const form = option->get_required() ? " \\fI{}\\fR{}" : " [\\fI{}\\fR]{}";
        text += fmt::format(fmt::runtime(form), troff(option->get_name()),
                            option->get_items_expected_max() > 1 ? " ..." : "");
    }
    return text + "\n";
}

/// Lines that are set in stand as they are, others are text.
std::string notes_of(const std::string& footer) {
    std::istringstream lines(footer);
    std::string text = footer.empty() || footer.starts_with("Examples:") ? "" : ".SH NOTES\n";
    bool example = false;
    for (std::string line; std::getline(lines, line);) {
        const bool set_in = line.starts_with(' ');
        if (set_in && !example) text += text.ends_with(".SH EXAMPLES\n") ? ".EX\n" : ".PP\n.EX\n";
        if (!set_in && example) text += ".EE\n.PP\n";
        example = set_in;
        if (line == "Examples:") {
            text += ".SH EXAMPLES\n";
        } else if (!line.empty()) {
            text += troff(line) + "\n";
        }
    }
    return example ? text + ".EE\n" : text;
}

std::string page_of(const CLI::App& command) {
    return heading("espalier-" + command.get_name(), command.get_description()) + synopsis_of(command) +
           arguments_of(command) + options_of(command) + notes_of(command.get_footer()) +
           ".SH \"SEE ALSO\"\n.BR espalier (1)\n";
}

std::string page_of_program(const CLI::App& program) {
    std::string text = heading("espalier", "grow plants from L-systems in a simulated environment");
    text += ".B espalier\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n" + troff(program.get_description()) +
            "\n" + options_of(program) + ".SH COMMANDS\n";
    for (const CLI::App* command : shown_commands(program)) {
        text += fmt::format(".TP\n.BR espalier\\-{} (1)\n{}\n", troff(command->get_name()),
                            troff(command->get_description()));
    }
    return text + fmt::format(
                      ".SH \"EXIT STATUS\"\n.TP\n{}\nit is done\n.TP\n{}\na mistake in an option, a model, a "
                      "scene or another file\n.TP\n{}\na run that could not go on\n.TP\n{}\ninterrupted\n",
                      exit_code::done, exit_code::user_error, exit_code::run_failed, exit_code::interrupted);
}

}  // namespace

std::map<std::string, std::string> man_pages(const CLI::App& program) {
    std::map<std::string, std::string> pages{{"espalier.1", page_of_program(program)}};
    for (const CLI::App* command : shown_commands(program)) {
        pages["espalier-" + command->get_name() + ".1"] = page_of(*command);
    }
    return pages;
}

}  // namespace espalier::app

// `completion` prints a script for a shell; `man`, which only packages need, writes the man pages.
#include "espalier/base/file.h"

#include "command_line.h"
#include "completions.h"
#include "looking_half.h"
#include "man_pages.h"

#include <fmt/format.h>

#include <filesystem>

namespace espalier::app {
namespace {

/// With the commands of the looking half where it is installed, and all options.
std::unique_ptr<CommandLine> whole_command_line() {
    open_looking_half();
    auto line = std::make_unique<CommandLine>();
    for (const auto& command : line->commands) command->add_options_of_files();
    return line;
}

class Completion final : public Command {
public:
    explicit Completion(CLI::App& program)
        : Command(program, "completion", "print a script that completes commands and options in a shell") {
        app()
            .add_option("shell", shell_, "bash, zsh or fish")
            ->required()
            ->check(CLI::IsMember({"bash", "zsh", "fish"}));
        app().footer(
            "Examples:\n  espalier completion bash > ~/.local/share/bash-completion/completions/espalier\n"
            "  espalier completion zsh > ~/.zfunc/_espalier      a folder of your fpath\n"
            "  espalier completion fish > ~/.config/fish/completions/espalier.fish");
    }

    int run() override {
        const auto line = whole_command_line();
        const auto script = shell_ == "bash" ? bash_completion : shell_ == "zsh" ? zsh_completion : fish_completion;
        fmt::print("{}", script(line->program));
        return exit_code::done;
    }

private:
    std::string shell_;
};

class Man final : public Command {
public:
    explicit Man(CLI::App& program) : Command(program, "man", "write the man pages of all commands") {
        app().add_option("folder", folder_, "where they are written")->required();
        app().group("");
    }

    int run() override {
        std::filesystem::create_directories(folder_);
        const auto line = whole_command_line();
        for (const auto& [name, text] : man_pages(line->program)) {
            write_text(folder_ / name, text);
        }
        return exit_code::done;
    }

private:
    std::filesystem::path folder_;
};

const RegisteredCommand<Completion> completion_entry{60};
const RegisteredCommand<Man> man_entry{61};

}  // namespace
}  // namespace espalier::app

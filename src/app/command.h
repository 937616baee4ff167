// A command of the program: its options and what it does. One file per command; each registers itself.
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <memory>
#include <string>

namespace espalier::app {

namespace exit_code {
inline constexpr int done = 0, user_error = 1, run_failed = 2, interrupted = 130;
}

/// Says why the program fails, with --json as an object too. Returns the code.
int fail(const std::string& message, int code, bool json);

/// A derived class adds its options to app() in its constructor; they are filled in when run() is called.
class Command {
public:
    Command(CLI::App& program, const std::string& name, const std::string& summary)
        : app_(*program.add_subcommand(name, summary)) {}
    virtual ~Command() = default;
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// Adds the options that stand in files and are only read when the command is parsed.
    virtual void add_options_of_files() {}

    /// Returns the exit code. Throws UserError and RunError.
    virtual int run() = 0;

    bool asked_for() const { return app_.parsed(); }
    bool wants_json() const { return json_; }

protected:
    CLI::App& app() { return app_; }
    void add_json_flag(const std::string& help) { app_.add_flag("--json", json_, help); }

private:
    CLI::App& app_;
    bool json_ = false;
};

/// By their place in the program's help.
using CommandMakers = std::multimap<int, std::unique_ptr<Command> (*)(CLI::App& program)>;
CommandMakers& command_makers();

/// Defining one registers a command:  const RegisteredCommand<Info> info_entry{40};
template <class Derived>
struct RegisteredCommand {
    explicit RegisteredCommand(int place) {
        command_makers().emplace(
            place, [](CLI::App& program) -> std::unique_ptr<Command> { return std::make_unique<Derived>(program); });
    }
};

}  // namespace espalier::app

// resume: goes on with a run that was interrupted, killed, or stopped by a full disk.
#include "espalier/base/error.h"
#include "espalier/simulation/recorded_command.h"
#include "espalier/simulation/simulation.h"

#include "command.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <unistd.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

class Resume final : public Command {
public:
    explicit Resume(CLI::App& program)
        : Command(program, "resume", "go on with a run that was interrupted, from its last checkpoint") {
        app().add_option("folder", run_, "the output folder of the run")->required();
        app()
            .add_option("--checkpoint-every", checkpoint_every_, "N steps; default: as the run did")
            ->check(CLI::Range(1, 1000000000));
        app()
            .add_option("--threads", threads_, "default: all; the result is the same with any number")
            ->check(CLI::Range(1, 4096));
        app().add_flag("--quiet", quiet_, "print nothing but errors");
        add_json_flag("print the result as JSON");
        app().footer(
            R"(What comes out is the same, byte for byte, as if the run had never stopped. Ctrl-C leaves a checkpoint; so does
`espalier run --checkpoint-every N`, also for runs that are killed or fail. The run's files must not have changed.
Examples:
  espalier run environments/two-trees.toml --checkpoint-every 20 --output output/trees
  espalier resume output/trees)");
    }

    int run() override {
        const RecordedCommand command = read_command(run_);
        if (command.exit == "done") throw UserError(fmt::format("the run in {} has ended", run_.string()));
        if (!fs::exists(checkpoint_of(run_))) {
            throw UserError(
                fmt::format("{} holds no checkpoint: the run stopped before its first; `espalier run` "
                            "with --overwrite begins it anew",
                            run_.string()));
        }
        for (const auto& [path, file] : command.inputs) {
            if (!is_unchanged(path, file)) {
                throw UserError(
                    fmt::format("{} has changed since the run began, so it cannot go on as it was", path.string()));
            }
        }
        start(command);
    }

private:
    // The program itself once more, in the folder where the run was started.
    [[noreturn]] void start(const RecordedCommand& command) const {
        std::vector<std::string> words{fs::read_symlink("/proc/self/exe").string(), "run"};
        words.insert(words.end(), command.arguments.begin(), command.arguments.end());
        words.insert(words.end(), {"--output", fs::absolute(run_).lexically_normal().string(), "--resume"});
        const int every = checkpoint_every_ > 0 ? checkpoint_every_ : command.checkpoint_every;
        if (every > 0) words.insert(words.end(), {"--checkpoint-every", std::to_string(every)});
        if (threads_ > 0) words.insert(words.end(), {"--threads", std::to_string(threads_)});
        if (quiet_) words.emplace_back("--quiet");
        if (wants_json()) words.emplace_back("--json");
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        fs::current_path(command.folder);
        execv(arguments.front(), arguments.data());
        throw RunError("cannot start the run: " + std::generic_category().message(errno));
    }

    fs::path run_;
    int checkpoint_every_ = 0, threads_ = 0;
    bool quiet_ = false;
};

const RegisteredCommand<Resume> entry{12};

}  // namespace
}  // namespace espalier

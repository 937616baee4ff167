// resume: goes on with a run that was interrupted, killed, or stopped by a full disk.
#include "espalier/base/error.h"
#include "espalier/simulation/simulation.h"

#include "base/platform.h"
#include "command.h"
#include "options.h"
#include "run_command.h"
#include "simulation/run/recorded_command.h"
#include "trust.h"

#include <fmt/format.h>

#include <exception>
#include <system_error>
#include <utility>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

class Resume final : public Command {
public:
    explicit Resume(CLI::App& program)
        : Command(program, "resume", "continue an interrupted run from its last checkpoint"),
          disk_(app()),
          blocks_(app()) {
        app().add_option("folder", run_, "the folder of the run")->required();
        app()
            .add_option("--checkpoint-every", checkpoint_every_,
                        "write a checkpoint every N steps; default: like the run")
            ->check(CLI::Range(1, 1000000000));
        app()
            .add_option("--threads", threads_,
                        "number of threads; default: all cores. The result does not depend on it")
            ->check(CLI::Range(1, 4096));
        app().add_flag("--quiet", quiet_, quiet_growth_help);
        app().add_flag("--trust", trust_, trust_help);
        add_json_flag("print the result as JSON");
        app().footer(
            R"(The result is the same, byte for byte, as without the interruption. Ctrl-C leaves a checkpoint. So does
a run that has written as much as --disk allows, and `espalier run --checkpoint-every N`, also for runs that are killed or fail. The files that the run read must be unchanged.
Examples:
  espalier run environments/two-trees.toml --checkpoint-every 20 --output output/trees
  espalier resume output/trees)");
    }

    int run() override {
        try {
            start(checked_command());
        } catch (const std::exception&) {
            return fail_to_run(std::current_exception());
        }
    }

private:
    RecordedCommand checked_command() const {
        RecordedCommand command = read_command(run_);
        if (command.exit == "done")
            throw UserError(fmt::format("the run in {} is complete; there is nothing to continue", run_.string()));
        if (!fs::exists(checkpoint_of(run_))) {
            throw UserError(
                fmt::format("{} has no checkpoint: the run stopped before it wrote one. Start it again with "
                            "`espalier run --overwrite`",
                            run_.string()));
        }
        for (const auto& [path, file] : command.inputs) {
            if (!is_unchanged(path, file)) {
                throw UserError(
                    fmt::format("{} has changed since the run began, so the run cannot be continued", path.string()));
            }
        }
        return command;
    }

    // The program itself once more, in the folder where the run was started.
    [[noreturn]] void start(const RecordedCommand& command) const {
        std::vector<std::string> words{platform::program_file().string(), "run"};
        words.insert(words.end(), command.arguments.begin(), command.arguments.end());
        words.insert(words.end(), {"--output", fs::absolute(run_).lexically_normal().string(), "--resume"});
        const int every = checkpoint_every_ > 0 ? checkpoint_every_ : command.checkpoint_every;
        if (every > 0) words.insert(words.end(), {"--checkpoint-every", std::to_string(every)});
        if (threads_ > 0) words.insert(words.end(), {"--threads", std::to_string(threads_)});
        if (disk_.bytes() > 0) words.insert(words.end(), {"--disk", std::to_string(disk_.bytes())});
        if (blocks_.blocks() > 0) {
            words.insert(words.end(), {"--blocks", std::to_string(blocks_.blocks()), "--resident",
                                       std::to_string(blocks_.resident())});
        }
        if (quiet_) words.emplace_back("--quiet");
        if (wants_json()) words.emplace_back("--json");
        if (trust_) words.emplace_back("--trust");
        fs::current_path(command.folder);
        throw RunError("cannot start the run: " + platform::become(std::move(words)).message());
    }

    DiskOption disk_;
    BlockOptions blocks_;
    fs::path run_;
    int checkpoint_every_ = 0, threads_ = 0;
    bool quiet_ = false, trust_ = false;
};

const RegisteredCommand<Resume> resume_entry{12};

}  // namespace
}  // namespace espalier::app

// resume: goes on with a run that was interrupted, killed, or stopped by a full disk.
#include "espalier/base/error.h"
#include "espalier/simulation/simulation.h"

#include "base/platform.h"
#include "child.h"
#include "command.h"
#include "options.h"
#include "run_command.h"
#include "simulation/run/run_standing.h"
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
          memory_(app()),
          disk_(app()),
          blocks_(app()),
          timeout_(app()) {
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
            R"(The result is the same, byte for byte, as without the interruption. Ctrl-C leaves a checkpoint, and so do the signals of
batch systems and a run that has written as much as --disk allows. A run that is killed or fails has the last one that it
wrote: every minute, or as `espalier run --checkpoint-every N` says. The files that the run read must be unchanged.
--memory, --disk, --blocks and --timeout are those of the run unless they are given here.
A complete run has nothing to continue: that is said, and is no mistake. `espalier run ... --continue` begins a run, too.
Examples:
  espalier run environments/two-trees.toml --checkpoint-every 20 --output output/trees
  espalier resume output/trees)");
    }

    int run() override {
        try {
            const RecordedCommand command = read_command(run_);
            if (command.exit == "done") return tell_complete(command, run_, quiet_, wants_json());
            require_way_on(command);
            start(command);
        } catch (const std::exception&) {
            return fail_to_run(std::current_exception());
        }
    }

private:
    void require_way_on(const RecordedCommand& command) const {
        if (!fs::exists(checkpoint_of(run_))) {
            throw UserError(
                fmt::format("{} has no checkpoint: the run stopped before it wrote one. Start it again with "
                            "`espalier run ... --output {} --continue`",
                            run_.string(), quoted(run_.string())));
        }
        if (const fs::path changed = simulation::changed_input(command); !changed.empty()) {
            throw UserError(
                fmt::format("{} has changed since the run began, so the run cannot be continued", changed.string()));
        }
    }

    // The program itself once more, in the folder where the run was started.
    [[noreturn]] void start(const RecordedCommand& command) const {
        std::vector<std::string> words{platform::program_file().string(), "run"};
        words.insert(words.end(), command.arguments.begin(), command.arguments.end());
        words.insert(words.end(), {"--output", fs::absolute(run_).lexically_normal().string(), "--resume"});
        const int every = checkpoint_every_ > 0 ? checkpoint_every_ : command.checkpoint_every;
        if (every > 0) words.insert(words.end(), {"--checkpoint-every", std::to_string(every)});
        if (threads_ > 0) words.insert(words.end(), {"--threads", std::to_string(threads_)});
        const auto add = [&](const char* option, std::size_t given, std::size_t asked) {
            const std::size_t value = given > 0 ? given : asked;
            if (value > 0) words.insert(words.end(), {option, std::to_string(value)});
        };
        const AskedOptions& asked = command.asked;
        const bool has_blocks = blocks_.blocks() > 0;
        add("--memory", memory_.bytes(), asked.memory);
        add("--disk", disk_.bytes(), asked.disk);
        add("--blocks", blocks_.blocks(), asked.blocks);
        add("--resident", has_blocks ? blocks_.resident() : 0, asked.resident);
        const double timeout = timeout_.seconds() < 0 ? asked.patience : timeout_.seconds();
        if (timeout >= 0) words.insert(words.end(), {"--timeout", fmt::format("{}", timeout)});
        if (quiet_) words.emplace_back("--quiet");
        if (wants_json()) words.emplace_back("--json");
        if (trust_) words.emplace_back("--trust");
        fs::current_path(command.folder);
        throw RunError("cannot start the run: " + platform::become(std::move(words)).message());
    }

    MemoryOption memory_;
    DiskOption disk_;
    BlockOptions blocks_;
    TimeoutOption timeout_;
    fs::path run_;
    int checkpoint_every_ = 0, threads_ = 0;
    bool quiet_ = false, trust_ = false;
};

const RegisteredCommand<Resume> resume_entry{12};

}  // namespace
}  // namespace espalier::app

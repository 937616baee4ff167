// rerun: does a recorded run again from its run.json alone, and says which bytes differ.
#include "espalier/base/error.h"

#include "base/folder.h"
#include "child.h"
#include "command.h"
#include "simulation/run/recorded_command.h"
#include "temporary_folder.h"
#include "trust.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 20;

class Rerun final : public Command {
public:
    explicit Rerun(CLI::App& program) : Command(program, "rerun", "repeat a run and report every byte that differs") {
        app().add_option("folder", run_, "the folder of a complete run")->required();
        app().add_option("--output", output_, "keep the new timeline in this folder; default: it is deleted");
        app()
            .add_option("--threads", threads_,
                        "number of threads; default: all cores. The result does not depend on it")
            ->check(CLI::Range(1, 4096));
        app().add_flag("--quiet", quiet_, "print differences and errors only");
        app().add_flag("--trust", trust_, trust_help);
        app().footer(
            R"(run.json contains everything that the run read: scene, models, side files, meshes. Files that were too large for it must still
exist, unchanged. The exit code is 2 if a file differs.
Examples:
  espalier rerun output/two-trees
  espalier rerun output/two-trees --threads 1 --output output/again)");
    }

    int run() override {
        const RecordedCommand command = read_command(run_);
        require_ended(command);
        if (command.version != ESPALIER_VERSION) {
            fmt::print(stderr, "warning: the run was made by espalier {}, this is {}\n", command.version,
                       ESPALIER_VERSION);
        }
        require_apart();
        require_trust(command.programs, trust_);
        const SignalCounter signals;
        const TemporaryFolder temporary("rerun");
        const fs::path output = output_.empty() ? temporary.path() / "timeline" : fs::absolute(output_);
        if (!repeat(command, temporary.path() / "inputs", output, signals)) return exit_code::interrupted;
        return report(timeline_differences(run_, output));
    }

private:
    void require_ended(const RecordedCommand& command) const {
        if (command.exit == "done") return;
        throw UserError(fmt::format("the run in {} is not complete (\"{}\"), so there is nothing to compare with",
                                    run_.string(), command.exit));
    }

    // A timeline within the other would be compared with itself.
    void require_apart() const {
        if (output_.empty()) return;
        std::error_code unknown;
        if (!resolved_below(output_, run_, unknown).empty() || !resolved_below(run_, output_, unknown).empty()) {
            throw UserError(fmt::format("--output {}: the new timeline must be outside the folder of the run, {}",
                                        output_.string(), run_.string()));
        }
    }

    // False if it was interrupted.
    bool repeat(const RecordedCommand& command, const fs::path& root, const fs::path& output,
                const SignalCounter& signals) const {
        const fs::path folder = lay_out_inputs(command, root);
        std::vector<std::string> arguments = arguments_below(command, root);
        arguments.insert(arguments.end(), {"--output", output.string()});
        if (threads_ > 0) arguments.insert(arguments.end(), {"--threads", std::to_string(threads_)});
        if (quiet_) arguments.push_back("--quiet");
        if (trust_ || !command.programs.empty()) arguments.push_back("--trust");
        const int code = wait_for_program(start_run(arguments, folder, {}), signals);
        if (signals.count() > 0 && code != 0) return false;
        if (code == exit_code::user_error) throw UserError("the run could not be repeated: see above");
        if (code != 0) throw RunError(fmt::format("the run could not be repeated: it ended with code {}", code));
        return true;
    }

    int report(const std::vector<std::string>& differences) const {
        for (std::size_t i = 0; i < std::min(differences.size(), most_listed); ++i) {
            fmt::print("{}\n", differences[i]);
        }
        if (differences.size() > most_listed) fmt::print("... and {} more\n", differences.size() - most_listed);
        if (differences.empty() && !quiet_) fmt::print("all files have the same bytes\n");
        const std::vector<std::string> others = beside_timeline(run_);
        if (!others.empty() && !quiet_)
            fmt::print("not compared, because no run writes it: {}\n", fmt::join(others, ", "));
        return differences.empty() ? exit_code::done : exit_code::run_failed;
    }

    fs::path run_, output_;
    int threads_ = 0;
    bool quiet_ = false, trust_ = false;
};

const RegisteredCommand<Rerun> rerun_entry{14};

}  // namespace
}  // namespace espalier::app

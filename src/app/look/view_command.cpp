// view: a window on a run, or on a scene that is grown meanwhile.
#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/view/run_view.h"

#include "app/child.h"
#include "app/command.h"
#include "app/options.h"
#include "app/run_command.h"
#include "app/temporary_folder.h"
#include "app/trust.h"
#include "base/number.h"
#include "base/platform.h"
#include "picture_options.h"

#include <fmt/format.h>

#include <chrono>
#include <sstream>
#include <thread>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// A run of this program beside the window.
class Simulation {
public:
    Simulation(const RunArguments& arguments, const fs::path& log) : output_(arguments.output), log_(log) {
        std::vector<std::string> words = words_of(arguments);
        const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
        add({"--quiet", "--output", fs::absolute(output_).string()});
        if (arguments.overwrite) add({"--overwrite"});
        if (arguments.threads > 0) add({"--threads", std::to_string(arguments.threads)});
        if (arguments.memory > 0) add({"--memory", std::to_string(arguments.memory)});
        if (arguments.checkpoint_every > 0) add({"--checkpoint-every", std::to_string(arguments.checkpoint_every)});
        if (arguments.trust) add({"--trust"});
        child_ = start_run(words, fs::current_path(), log_);
    }

    bool is_running() {
        if (child_ && platform::poll(*child_, code_) != 0) child_.reset();
        return child_.has_value();
    }
    int code() const { return code_; }
    /// What it printed: warnings, and why it failed.
    std::string words() const { return fs::exists(log_) ? read_text(log_) : ""; }

    SimulationState state() {
        if (is_running()) return {true, false, "running"};
        if (code_ == exit_code::done) return {false, false, "done: the run has ended"};
        if (code_ == exit_code::interrupted) return {false, false, "the run was interrupted"};
        std::istringstream lines(words());
        std::string first, line;
        while (std::getline(lines, line)) {
            if (first.empty() && line.find("warning") == std::string::npos) first = line;
        }
        return {false, true, "the run failed: " + first};
    }

    /// Ends it after the step at hand, or waits for its end.
    void end(const SignalCounter& signals, bool wait) {
        if (!is_running()) return;
        // A signal that came is passed on below; a second would kill the run.
        if (!wait && signals.count() == 0) platform::end(*child_, platform::Ending::as_ctrl_c);
        code_ = wait_for_program(*child_, signals);
        child_.reset();
    }

private:
    fs::path output_, log_;
    std::optional<int> child_;
    int code_ = 0;
};

bool is_run(const fs::path& path) {
    std::error_code error;
    return fs::exists(path / "run.json", error);
}

class View final : public Command {
public:
    explicit View(CLI::App& program)
        : Command(program, "view", "show a run, or a scene while it grows, in a window"),
          model_(app(), "what",
                 "the folder of a run; or anything that `espalier run` accepts, which is shown while it grows",
                 ModelOptions::Files::reading_and_drawing),
          sets_(app()),
          growth_(app()),
          picture_(app()),
          camera_(app()) {
        app().add_option("--step", step_, "the first frame to show: N, first or last; default: last, and live");
        app()
            .add_option("--colour-by", options_.style.colour_by,
                        "how organs are coloured, as with the key c in the window")
            ->capture_default_str();
        app().add_option("--field", field_,
                         "show a field as volume, slice or iso, as with the key f in the window: light:slice");
        app().add_option("--screenshot", options_.screenshot, "write a picture of the window (.png) and exit");
        app().add_option("--script", script_, "execute a script line by line and exit: docs/view.md");
        app().add_option("--output", arguments_.output,
                         "output folder of a scene that grows; default: output/<scene>-<time>");
        app().add_flag("--overwrite", arguments_.overwrite, "replace the timeline in the output folder");
        app()
            .add_option("--threads", arguments_.threads, "number of threads that grow a scene; default: all cores")
            ->check(CLI::Range(1, 4096));
        app().add_flag("--keep-running", keep_running_, "grow a scene to its end after the window closes");
        app().footer(R"(The key h shows the keys of the window.
Examples:
  espalier view output/two-trees                        a run, finished or still growing
  espalier view environments/two-trees.toml             grows a scene and shows it; closing the window ends the run
  espalier view models/course/02-branching.l --steps 6
  espalier view output/two-trees --step 120 --screenshot tree.png
A screenshot and a script need no display.)");
    }

    int run() override {
        arguments_.model = model_.arguments();
        arguments_.model.file = folder_of_run(arguments_.model.file);
        options_.size = picture_.size(options_.size);
        if (picture_.dark()) options_.style.background = dark_background;
        options_.chooses_background = !picture_.dark();
        if (camera_.is_ours()) options_.camera.emplace();
        if (!field_.empty()) options_.style.fields.push_back(field_look(field_));
        if (!script_.empty()) options_.script = read_text(script_);
        options_.print = [](const std::string& line) { fmt::print("{}\n", line); };
        const bool needs_display = script_.empty() && options_.screenshot.empty();
        if (const std::string why = why_no_window(); needs_display && !why.empty()) throw RunError(why);
        return is_run(arguments_.model.file) ? view_recorded() : view_growing();
    }

private:
    int view_recorded() {
        const RecordedRun recorded(arguments_.model.file);
        options_.step = step_of(recorded);
        const SignalCounter signals;
        options_.interrupted = [&] { return signals.count() > 0; };
        view_run(arguments_.model.file, options_);
        return exit_code::done;
    }

    std::optional<int> step_of(const RecordedRun& recorded) const {
        if (step_.empty() || step_ == "last" || recorded.frames().empty()) return std::nullopt;
        if (step_ == "first") return recorded.frames().front().step;
        const std::optional<int> step = whole_text_as<int>(step_);
        if (!step) throw UserError(fmt::format("--step {}: expected a step, first or last", step_));
        return recorded.frame(*step).step;
    }

    int view_growing() {
        if (!step_.empty()) throw UserError("--step applies to recorded runs; a scene is shown while it grows");
        arguments_.overrides = sets_.overrides();
        arguments_.steps = growth_.steps();
        arguments_.seed = growth_.seed();
        arguments_.memory = growth_.memory();
        const std::vector<NamedProgram> programs = programs_of(arguments_);
        require_trust(programs, growth_.trust());
        arguments_.trust = !programs.empty();  // the process that grows it has no terminal to ask on
        std::optional<DefaultOutput> unnamed;
        if (arguments_.output.empty()) {
            arguments_.output = unnamed.emplace(arguments_.model.file.stem().string()).path();
        }
        const TemporaryFolder log_folder("view");
        const SignalCounter signals;
        Simulation simulation(arguments_, log_folder.path() / "log");
        while (simulation.is_running() && !is_run(arguments_.output) && signals.count() == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        options_.simulation = [&] { return simulation.state(); };
        options_.interrupted = [&] { return signals.count() > 0; };
        try {
            if (is_run(arguments_.output) && signals.count() == 0) view_run(arguments_.output, options_);
        } catch (...) {
            simulation.end(signals, false);
            throw;
        }
        simulation.end(signals, keep_running_);
        fmt::print(stderr, "{}", simulation.words());
        if (is_run(arguments_.output)) fmt::print("{}\n", (arguments_.output / "").string());
        const bool closed_early = simulation.code() == exit_code::interrupted && signals.count() == 0;
        return closed_early ? exit_code::done : simulation.code();
    }

    ModelOptions model_;
    SetOptions sets_;
    GrowthOptions growth_;
    PictureOptions picture_;
    CameraOption camera_;
    RunArguments arguments_;
    ViewOptions options_;
    std::string step_, field_;
    fs::path script_;
    bool keep_running_ = false;
};

const RegisteredCommand<View> view_entry{36};

}  // namespace
}  // namespace espalier::app

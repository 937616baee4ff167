#include "run_command.h"

#include "espalier/base/file.h"

#include "base/folder.h"
#include "base/json_text.h"
#include "child.h"
#include "command.h"
#include "options.h"
#include "program_data.h"
#include "progress.h"
#include "ranks/launcher.h"
#include "setting_values.h"
#include "simulation/run/allowed_memory.h"
#include "simulation/run/disk_budget.h"
#include "simulation/run/run_standing.h"
#include "trust.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

StopRequest interrupt;

std::atomic<bool> silent{false};

void request_interrupt(int signal) {
    if (platform::may_repeat(signal) && interrupt.is_asked()) return;
    interrupt.ask(patience_with_steps);
    if (silent) return;
    platform::write_error("\n");
    platform::write_error(platform::name_of_signal(signal));
    platform::write_error(platform::may_repeat(signal) ? ": finishing this step, then writing a checkpoint\n"
                                                       : ": finishing this step (a second time: stopping at once)\n");
}

// What takes more than a moment.
void say_what_is_saved(std::size_t bytes) {
    constexpr std::size_t worth_saying = std::size_t{100} << 20;
    if (bytes < worth_saying) return;
    platform::write_error(fmt::format("writing the checkpoint that `espalier resume` goes on from, about {}\n",
                                      simulation::size_text(bytes)));
}

// The process that does not answer cannot be left: the program ends where it is.
[[noreturn]] void end_without_answer(const std::string& why, bool json) {
    const int code = fail(why, exit_code::run_failed, json);
    std::fflush(stdout);
    std::_Exit(code);
}

// How an interrupted run is continued.
std::string way_on(const fs::path& output) {
    std::error_code ignored;
    if (fs::exists(checkpoint_of(output), ignored)) {
        return fmt::format("the run has a checkpoint: `espalier resume {}` continues it", quoted(output.string()));
    }
    return "the run has no checkpoint, because it was interrupted within its first long step; the same command with "
           "--continue begins it again";
}

/// "468 MB", "12.3 MB", "0.04 MB".
std::string megabytes(std::uintmax_t bytes) {
    return fmt::format("{:.{}f} MB", static_cast<double>(bytes) / 1e6,
                       bytes < 1'000'000     ? 2
                       : bytes < 100'000'000 ? 1
                                             : 0);
}

void print_result(const RunArguments& arguments, const Scene& scene, const fs::path& output, const RunResult& result) {
    if (arguments.json) {
        const nlohmann::ordered_json json = {{"exit", result.interrupted ? "interrupted" : "done"},
                                             {"output", output.string()},
                                             {"steps", result.last_step},
                                             {"steps_done", result.steps},
                                             {"stopped", result.stopped},
                                             {"plants", scene.plants.size()},
                                             {"modules", result.modules},
                                             {"peak_memory", result.peak_memory},
                                             {"bytes", bytes_below(output)},
                                             {"seconds", result.seconds}};
        fmt::print("{}\n", json_text(json));
        return;
    }
    if (arguments.quiet) return;
    fmt::print("{}: {} of {} steps{}, {} modules in {} plant{}, {}, {}\n", scene.name, result.steps, result.last_step,
               result.interrupted ? " (interrupted)"
               : result.stopped   ? " (the model stopped)"
                                  : "",
               grouped(result.modules), scene.plants.size(), scene.plants.size() == 1 ? "" : "s",
               duration_text(result.seconds), megabytes(bytes_below(output)));
    fmt::print("{}\n", (output / "").string());
    if (result.interrupted) fmt::print(stderr, "{}\n", way_on(output));
}

// Where neither the animation nor the derivation length ends soon, the user does.
void require_end(const Scene& scene) {
    if (scene.steps || scene.last_frame.value_or(0) <= Scene::most_frames_unasked) return;
    throw UserError(
        fmt::format("{}: the animation ends at frame {}, and the derivation length is no smaller; say with --steps N "
                    "how far it is to grow",
                    scene.name, *scene.last_frame));
}

}  // namespace

void take_settings(const fs::path& file, RunArguments& arguments) {
    const fs::path& what = arguments.model.file;
    const bool in_scene = is_scene(what);
    SettingValues values(
        ModelSettings::read(in_scene ? first_model_of(what) : object_of(arguments.model).model).list());
    values.read(here_or_with_program(file));
    if (!arguments.seed) arguments.seed = values.seed();
    for (const auto& [name, value] : values.defines()) {
        if (in_scene) {
            arguments.overrides.insert(arguments.overrides.begin(), {"plant.0.define." + name, value});
        } else {
            arguments.model.defines.insert(arguments.model.defines.begin(), {name, value});
        }
    }
}

namespace {

Scene read(const RunArguments& arguments) {
    const SceneOptions options{arguments.overrides, arguments.steps, arguments.seed};
    if (is_scene(arguments.model.file)) {
        reject_side_files(arguments.model);
        return read_scene(arguments.model.file, options);
    }
    const ObjectFiles object = object_of(arguments.model);
    const bool is_folder = fs::is_directory(arguments.model.file);
    if (is_folder && !arguments.quiet) fmt::print(stderr, "{}: {}\n", object.name, taken_files(object));
    return scene_of_object(object, options);
}

}  // namespace

Scene scene_of(const RunArguments& arguments) {
    Scene scene = read(arguments);
    std::vector<NamedProgram> programs = simulation::programs_of(scene);
    require_trust(programs, arguments.trust);
    // What a run is resumed with comes from its folder, too; but not its words, if the user gave them once more.
    for (NamedProgram& program : programs) program.folder = resolved(arguments.output);
    if (arguments.resume) require_trust(programs, arguments.trust || arguments.goes_on);
    return scene;
}

std::vector<NamedProgram> programs_of(RunArguments arguments) {
    arguments.quiet = true;
    return simulation::programs_of(read(arguments));
}

// To make a folder is the only way to know that no other run has it.
DefaultOutput::DefaultOutput(const std::string& scene) {
    const std::time_t now = std::time(nullptr);
    const fs::path base = fs::path("output") / fmt::format("{}-{:%Y%m%d-%H%M%S}", scene, *std::localtime(&now));
    std::error_code error;
    fs::create_directories(base.parent_path(), error);
    path_ = base;
    for (int number = 2; !error && !fs::create_directory(path_, error); ++number) {
        path_ = fmt::format("{}-{}", base.string(), number);
    }
    if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path_.string(), error.message()));
}

DefaultOutput::~DefaultOutput() {
    std::error_code holds_something;
    fs::remove(path_, holds_something);
}

std::vector<std::string> words_of(const RunArguments& arguments) {
    const ModelArguments& model = arguments.model;
    std::vector<std::string> words{model.file.string()};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) words.insert(words.end(), {option, value});
    };
    const auto add_pairs = [&](const char* option, const KeyValues& pairs) {
        for (const auto& [key, value] : pairs) add(option, key + "=" + value);
    };
    add("--view", model.view.string());
    add("--animate", model.animation.string());
    add("--environment", model.environment.string());
    for (const std::string& file : model.colour_maps) add("--colour-map", file);
    for (const std::string& file : model.materials) add("--materials", file);
    if (model.without_environment) words.emplace_back("--without-environment");
    if (model.arithmetic) add("--arithmetic", name_of(*model.arithmetic));
    add_pairs("--define", model.defines);
    for (const std::string& insertion : model.insertions) add("--insert", insertion);
    add_pairs("--set", arguments.overrides);
    if (arguments.steps) add("--steps", std::to_string(*arguments.steps));
    if (arguments.seed) add("--seed", std::to_string(*arguments.seed));
    return words;
}

InterruptibleRun::InterruptibleRun(bool quiet) : scope_(&interrupt), signals_(request_interrupt, /*only_once=*/true) {
    silent = quiet;
    platform::report_closed_outputs();  // progress that no terminal or pipe takes any more must not end a run
}

bool InterruptibleRun::interrupted() {
    return interrupt.is_asked();
}

namespace {

constexpr double default_timeout = 3600;

AskedOptions asked_of(const RunArguments& arguments) {
    return {arguments.memory, arguments.disk, arguments.blocks, arguments.blocks > 0 ? arguments.resident : 0,
            arguments.timeout};
}

}  // namespace

RunResult grow(const RunArguments& arguments, const Scene& scene, const ReadLog& inputs, const fs::path& output,
               Recorder* recorder, Ranks* ranks) {
    platform::give_back_large_blocks();
    std::optional<tbb::global_control> threads;
    if (arguments.threads > 0) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.threads));
    }
    RunOptions options;
    options.output = output;
    options.recorder = recorder;
    options.overwrite = arguments.overwrite;
    options.checkpoint_every = arguments.checkpoint_every;
    options.resume = arguments.resume;
    options.memory = allowed_memory(arguments.memory, arguments.model.file, ranks_on_node(ranks));
    options.disk = arguments.disk;
    options.blocks = arguments.blocks;
    options.resident = arguments.resident;
    options.arguments = words_of(arguments);
    options.asked = asked_of(arguments);
    options.inputs = &inputs;
    options.ranks = ranks;
    options.patience = arguments.timeout < 0 ? default_timeout : arguments.timeout;
    options.expired = [json = arguments.json](const std::string& why) { end_without_answer(why, json); };
    if (is_first(ranks)) {
        options.warn = [&arguments](const auto& warnings) { arguments.warn(warnings, arguments.quiet); };
    }
    if (!arguments.quiet) options.saving = say_what_is_saved;
    ProgressReport report(arguments.quiet);
    options.progress = [&](const Progress& progress) { report(progress); };
    return run(scene, options);
}

namespace {

int grow_here(const RunArguments& arguments, Ranks* ranks) {
    const InterruptibleRun interruptible(arguments.quiet);
    const ReadLog inputs;
    Scene scene;
    std::optional<DefaultOutput> unnamed;
    together(ranks, [&] {
        scene = scene_of(arguments);
        require_end(scene);
        if (arguments.output.empty() && is_first(ranks)) unnamed.emplace(scene.name);
    });
    if (is_first(ranks)) print_warnings(scene.notes.diagnostics, arguments.quiet);
    const fs::path output = from_first(ranks, unnamed ? unnamed->path().string() : arguments.output.string());
    const RunResult result = grow(arguments, scene, inputs, output, nullptr, ranks);
    if (is_first(ranks)) trust_record(simulation::programs_of(scene), arguments.trust, output);
    if (is_first(ranks)) print_result(arguments, scene, output, result);
    if (ranks) ranks->agree();
    return result.interrupted ? exit_code::interrupted : exit_code::done;
}

void say_unless_quiet(const RunArguments& arguments, const std::string& text) {
    if (!arguments.quiet) fmt::print(stderr, "{}: {}\n", arguments.output.string(), text);
}

void say_how_it_goes_on(const RunArguments& arguments, const RunStanding& standing) {
    if (is_locked(arguments.output)) return;  // by another process, and what is begun now will be refused
    if (standing.kind == RunStanding::Kind::resumable) {
        const std::optional<int> step = step_of_checkpoint(arguments.output);
        return say_unless_quiet(arguments, step ? fmt::format("continued from the checkpoint of step {}", *step)
                                                : "continued from its checkpoint");
    }
    if (standing.kind == RunStanding::Kind::begun) {
        return say_unless_quiet(arguments, standing.why.empty()
                                               ? "begun again: the run here ended before its first checkpoint"
                                               : fmt::format("begun again: {}", standing.why));
    }
    if (standing.kind == RunStanding::Kind::other) {
        say_unless_quiet(arguments, fmt::format("the run here is replaced: {}", standing.why));
    }
}

// What the first rank finds in the folder holds for all: a moment later it may look otherwise.
int go_on_here(RunArguments arguments, Ranks* ranks) {
    using Kind = RunStanding::Kind;
    RunStanding standing;
    together(ranks, [&] {
        if (!is_first(ranks)) return;
        standing = simulation::standing_of(arguments.output, words_of(arguments));
        if (standing.kind == Kind::other && !arguments.overwrite) {
            throw UserError(
                fmt::format("{} holds another run: {}. Choose another folder with --output, or replace it "
                            "with --overwrite",
                            arguments.output.string(), standing.why));
        }
    });
    const auto kind = static_cast<Kind>(from_first(ranks, {static_cast<char>(standing.kind)}).front());
    if (kind == Kind::complete) {
        return tell_complete(standing.command, arguments.output, arguments.quiet, arguments.json);
    }
    say_how_it_goes_on(arguments, standing);
    arguments.resume = kind == Kind::resumable;
    arguments.overwrite = !arguments.resume;
    return grow_here(arguments, ranks);
}

int run_here(const RunArguments& arguments, Ranks* ranks) {
    return arguments.goes_on ? go_on_here(arguments, ranks) : grow_here(arguments, ranks);
}

// The first rank tells of the run and of what went wrong anywhere: the others keep silent.
int in_silence(const std::function<int()>& work) {
    try {
        return work();
    } catch (const Stopped&) {
        return exit_code::interrupted;
    } catch (const UserError&) {
        return exit_code::user_error;
    } catch (const RunError&) {
        return exit_code::run_failed;
    }
}

// Until the program ends: the first rank has told what failed before the launcher sees another one end.
Ranks* launched_ranks() {
    static const std::unique_ptr<Ranks> ranks = ranks_of_launcher();
    return ranks.get();
}

}  // namespace

int tell_complete(const RecordedCommand& command, const fs::path& folder, bool quiet, bool json) {
    Ranks* const ranks = launched_ranks();
    together(ranks, [&] {
        if (!is_first(ranks)) return;
        simulation::mark_complete(folder);
        if (json) {
            const nlohmann::ordered_json result = {{"exit", "done"},
                                                   {"output", folder.string()},
                                                   {"steps", command.steps},
                                                   {"steps_done", command.steps_done}};
            fmt::print("{}\n", json_text(result));
        } else if (!quiet) {
            fmt::print("{}: complete, {} of {} steps; there is nothing left to do\n", folder.string(),
                       command.steps_done, command.steps);
        }
    });
    if (ranks) ranks->agree();
    return exit_code::done;
}

int run_command(const RunArguments& arguments) {
    Ranks* const ranks = launched_ranks();
    if (is_first(ranks)) return run_here(arguments, ranks);
    RunArguments silent = arguments;
    silent.quiet = true;
    silent.json = false;
    return in_silence([&] { return run_here(silent, ranks); });
}

int fail_to_run(const std::exception_ptr& error) {
    Ranks* const ranks = launched_ranks();
    const auto fail = [&] {
        together(ranks, [&] { std::rethrow_exception(error); });
        return exit_code::run_failed;
    };
    return is_first(ranks) ? fail() : in_silence(fail);
}

namespace {

class RunCommand final : public Command {
public:
    explicit RunCommand(CLI::App& program)
        : Command(program, "run", "grow a scene, a model or an object, and record the growth"),
          model_(app(), "what", "a scene (.toml), a model (.l), or the folder of an object",
                 ModelOptions::Files::reading_and_drawing),
          sets_(app()),
          growth_(app()),
          intervals_(app()),
          disk_(app()),
          blocks_(app()),
          timeout_(app()) {
        app()
            .add_option("--threads", arguments_.threads,
                        "number of threads; default: all cores. The result does not depend on it")
            ->check(CLI::Range(1, 4096));
        app().add_option("--settings", settings_,
                         "a file with settings of the model, or of the first plant of a scene, as `espalier tree` "
                         "saves them: crown-width = 6");
        CLI::Option* const output =
            app().add_option("--output", arguments_.output, "output folder; default: output/<scene>-<time>");
        app().add_flag("--overwrite", arguments_.overwrite,
                       "replace the timeline in the output folder; with --continue: only that of another run");
        app()
            .add_flag("--continue", arguments_.goes_on,
                      "do what is left to do in the output folder: nothing if the run there is complete, else go on "
                      "from its checkpoint, or begin if it has none")
            ->needs(output);
        app().add_flag("--resume", arguments_.resume)->group("");  // what `resume` starts
        app().add_flag(child_flag, is_child_)->group("");
        app().add_flag("--quiet", arguments_.quiet, quiet_growth_help);
        add_json_flag("print the result as JSON");
        app().footer(R"(Examples:
  espalier run environments/two-trees.toml
  espalier run environments/two-trees.toml --set environment.light.voxel=0.5 --output output/coarse
  espalier run models/course/02-branching.l --steps 5
  espalier run models/organs/shoot.l --view models/organs/shoot.v
  espalier run environments/tree.toml --settings environments/presets/shrub.toml
  espalier run models/language/shoot          a folder; its file 'specifications' names the files
  espalier run environments/two-trees.toml --output output/trees --continue      the same line again after any end
Ctrl-C ends the run after the current step, or within half a second of it, and keeps all recorded frames. A second
Ctrl-C stops at once.)");
    }

    int run() override {
        arguments_.model = model_.arguments();
        arguments_.overrides = sets_.overrides();
        intervals_.add_to(arguments_.overrides);
        arguments_.checkpoint_every = intervals_.checkpoint_every();
        arguments_.steps = growth_.steps();
        arguments_.seed = growth_.seed();
        arguments_.memory = growth_.memory();
        arguments_.trust = growth_.trust();
        arguments_.disk = disk_.bytes();
        arguments_.blocks = blocks_.blocks();
        arguments_.resident = blocks_.resident();
        arguments_.timeout = timeout_.seconds();
        arguments_.json = wants_json();
        if (!settings_.empty()) take_settings(settings_, arguments_);
        if (is_child_) end_with_parent();
        return run_command(arguments_);
    }

private:
    ModelOptions model_;
    SetOptions sets_;
    GrowthOptions growth_;
    IntervalOptions intervals_;
    DiskOption disk_;
    BlockOptions blocks_;
    TimeoutOption timeout_;
    RunArguments arguments_;
    fs::path settings_;
    bool is_child_ = false;
};

const RegisteredCommand<RunCommand> run_entry{10};

}  // namespace
}  // namespace espalier::app

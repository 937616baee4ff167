// tree: grows a tree from a handful of settings and writes its mesh.
#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"
#include "espalier/timeline/last_frame.h"

#include "app/command.h"
#include "app/model_library.h"
#include "app/options.h"
#include "app/program_data.h"
#include "app/progress.h"
#include "app/run_command.h"
#include "app/setting_values.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "base/number.h"
#include "base/text.h"
#include "environment/space/markers/end_of_growth.h"
#include "mesh_file_options.h"
#include "tree_levels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <span>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* scene_file = "environments/tree.toml";
constexpr int fewest_sides = 3;   // few vertices, as in Brzoska 2019, section 5.1
constexpr int sides_if_bare = 7;  // with half of the triangles, tubes that have sides to lose keep their outline

/// What can be said of the tree, and how: found where the program's scenes and models are.
struct TreeKind {
    fs::path scene = here_or_with_program(scene_file);
    SettingValues values{ModelSettings::read(first_model_of(scene)).list()};

    fs::path preset_folder() const { return scene.parent_path() / "presets"; }
    std::vector<std::string> presets() const {
        std::vector<std::string> names;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(preset_folder(), none)) {
            if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    }
    fs::path preset(const std::string& name) const {
        const std::vector<std::string> names = presets();
        if (std::find(names.begin(), names.end(), name) != names.end()) return preset_folder() / (name + ".toml");
        throw UserError(fmt::format("there is no preset '{}'{}; the presets are {}", name, did_you_mean(name, names),
                                    fmt::join(names, ", ")));
    }
};

/// Whether a tree grew as old as it was asked to, or why not, by what its process says of the last step.
struct End {
    const char* reason = "age";
    int code = exit_code::done;
};

constexpr int no_point_left = 3, no_point_in_reach = 4;

End end_of(std::span<const Quantity> quantities) {
    const auto last = [&](const std::string& name) {
        for (const Quantity& quantity : quantities) {
            if (quantity.name.ends_with("." + name)) return quantity.value;
        }
        return std::numeric_limits<double>::quiet_NaN();
    };
    if (last("winners") != 0) return {};
    if (last("left") == 0) return {"no-point-left", no_point_left};
    return {"no-point-in-reach", no_point_in_reach};
}

/// The file itself, or the first of oak-2.toml, oak-3.toml, ... that is not there.
fs::path unused(const fs::path& file) {
    fs::path free = file;
    for (int number = 2; fs::exists(free); ++number) {
        free = file.parent_path() / fmt::format("{}-{}{}", file.stem().string(), number, file.extension().string());
    }
    return free;
}

std::uint64_t random_seed() {
    return std::random_device{}() & 0x7fffffffU;
}

std::optional<std::uint64_t> parse_seed(const std::string& text) {
    if (text.empty()) return std::nullopt;
    if (text == "new") return random_seed();
    const std::optional<std::int64_t> seed = whole_text_as<std::int64_t>(text);
    if (seed && *seed >= 0) return static_cast<std::uint64_t>(*seed);
    throw UserError(fmt::format("--seed {}: expected a whole number of at least 0, or new", text));
}

class Tree final : public Command {
public:
    explicit Tree(CLI::App& program)
        : Command(program, "tree", "grow a tree from a few settings, and write its mesh"),
          mesh_(app(), fewest_sides, "Mesh") {
        app().add_option("--output", output_,
                         "file, whose extension selects the format; default: tree-VERTICES-TRIANGLES.obj");
        app().add_option("--preset", preset_, "a named table of settings, listed below");
        app().add_option("--settings", settings_, "a file with settings: crown-width = 6 in a line of its own");
        app().add_option("--save-settings", saved_, "write all settings, and the seed, to a file for --settings");
        app().add_option("--seed", seed_, "seed of all random numbers; new: draw a seed and print it");
        app().add_option(
            "--leaf-picture", leaf_picture_,
            "PNG with opacity that leaves wear, in its own colours unless --leaf-colour is given; default: "
            "that of the scene. See espalier leaf-texture");
        app()
            .add_option("--lod", levels_,
                        "glb: so many levels of detail in one file (MSFT_lod): meshes, each of a fourth of the "
                        "triangles of the one before, and last two cards that cross and wear pictures of the tree")
            ->check(CLI::Range(2, 8))
            ->group("Mesh");
        app().add_option("--run", run_, "keep the run in this folder; default: it is removed");
        app()
            .add_option("--threads", arguments_.threads, "number of threads; default: all cores")
            ->check(CLI::Range(1, 4096));
        app().add_option("--memory", memory_,
                         "memory that the growth may use, such as 4G; default: half of the machine");
        app().add_flag("--quiet", arguments_.quiet, quiet_growth_help);
        add_json_flag("print the result as JSON");
        // The model is read only if a tree is asked for.
        app().preparse_callback([this](std::size_t) { add_options_of_files(); });
    }

    // A mistake in the scene or its model is told when the command runs: here only mistakes of options are.
    void add_options_of_files() override {
        try {
            kind_.emplace();
        } catch (const UserError& error) {
            unreadable_ = error.what();
            app().allow_extras();
            return;
        }
        for (const ModelSetting& setting : kind_->values.settings()) {
            const std::string meaning =
                fmt::format("{} ({}{}{}; default {})", setting.summary, setting.range(),
                            setting.unit.empty() ? "" : " ", setting.unit, format_general(setting.value));
            app()
                .add_option_function<std::string>(
                    "--" + option_name(setting),
                    [this, &setting](const std::string& text) { said_.emplace_back(&setting, text); }, meaning)
                ->type_name("NUMBER")
                ->group(setting.group.empty() ? "Settings" : setting.group);
        }
        app().footer(footer());
    }

    int run() override {
        if (!kind_) throw UserError(unreadable_);
        const auto begin = std::chrono::steady_clock::now();
        const Target target = this->target();
        collect_values();
        const InterruptibleRun interruptible(arguments_.quiet);
        const std::optional<Grown> grown = grow_tree();
        if (!grown) return exit_code::interrupted;
        const Json files = write(grown->run, target);
        save_settings(grown->seed);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        tell(files, grown->seed, grown->end, seconds.count());
        return grown->end.code;
    }

private:
    struct Target {
        fs::path folder;
        std::string name;
        std::string format;
        bool counts;
    };

    std::string footer() const {
        std::string text =
            fmt::format("{} settings, each with its range, unit and default.", kind_->values.settings().size());
        const std::vector<std::string> presets = kind_->presets();
        std::size_t width = 0;
        for (const std::string& name : presets) width = std::max(width, name.size());
        if (!presets.empty()) text += "\nPresets:\n";
        for (const std::string& name : presets) {
            text += fmt::format("  {:{}}  {}\n", name, width, describe_file(kind_->preset(name)).summary);
        }
        return text + R"(
Without --sides, branches of a tree without leaves have 7 sides.
An option counts more than --settings, and that more than --preset. A file that is there stays: a new one is numbered.
Examples:
  espalier tree --output oak.obj
  espalier tree --crown-width 8 --gnarly 0.9 --seed new --save-settings oak.toml
  espalier tree --settings oak.toml --age 12 --output young.glb
Exit codes besides those of all commands: 3, growth ended early because no attraction point was left; 4, because none was
in the reach of a branch. The files are written all the same.
Ctrl-C ends the growth after the step at hand, and no file is written.)";
    }

    Target target() const {
        if (output_.empty()) return {"", "tree", levels_ > 0 ? "gltf" : "obj", true};
        const std::string format = format_of_extension(output_.extension().string());
        if (levels_ > 0 && format != "gltf") {
            throw UserError(fmt::format("--output {}: --lod needs the extension .glb", output_.string()));
        }
        if (!format.empty()) return {output_.parent_path(), output_.stem().string(), format, false};
        throw UserError(fmt::format(
            "--output {}: the extension must be that of a format: .obj, .glb, .usda, .ply, .stl", output_.string()));
    }

    void collect_values() {
        SettingValues& values = kind_->values;
        if (!preset_.empty()) values.read(kind_->preset(preset_));
        if (!leaf_picture_.empty()) show_picture_as_it_is(values);
        if (!settings_.empty()) values.read(settings_);
        for (const auto& [setting, text] : said_) values.set(*setting, text);
        const auto said = [this](const char* name) {
            const auto is_it = [&](const auto& one) { return one.first->name == name; };
            const auto found = std::find_if(said_.rbegin(), said_.rend(), is_it);
            return found == said_.rend() ? nullptr : &found->second;
        };
        const std::string* const index = said("LEAF_AREA_INDEX");
        if (!arguments_.quiet && said("LEAVES") && index && finite_number(*index).value_or(0) > 0) {
            fmt::print(stderr, "warning: --leaves is not used: --leaf-area-index says how many leaves there are\n");
        }
    }

    /// A picture is multiplied by the colour of the leaves, which is white unless --settings or an option says another.
    static void show_picture_as_it_is(SettingValues& values) {
        constexpr int white = 17;  // in the colour map of the scene
        for (const ModelSetting& setting : values.settings()) {
            if (setting.name == "LEAF_COLOUR" && setting.allows(white)) values.set(setting, std::to_string(white));
        }
    }

    struct Grown {
        RecordedRun run;  ///< its last frame, in memory
        std::uint64_t seed;
        End end;
    };

    // None if it was interrupted.
    std::optional<Grown> grow_tree() {
        arguments_.model.file = kind_->scene;
        arguments_.output = run_;
        arguments_.seed = parse_seed(seed_);
        if (!memory_.empty()) arguments_.memory = size_in_bytes(memory_, "--memory");
        if (!arguments_.seed) arguments_.seed = kind_->values.seed();
        for (const auto& [name, value] : kind_->values.defines()) {
            arguments_.overrides.emplace_back("plant.0.define." + name, value);
        }
        dress_leaves();
        arguments_.warn = [this](const std::vector<Diagnostic>& warnings, bool quiet) { warn(warnings, quiet); };
        const ReadLog inputs;
        const Scene scene = scene_of(arguments_);
        print_warnings(scene.notes.diagnostics, arguments_.quiet);
        LastFrame last;
        const RunResult result = grow(arguments_, scene, inputs, run_, &last);
        if (InterruptibleRun::interrupted()) return std::nullopt;
        const RecordedFrame frame{last.step(), last.time(), {}, {}, last.geometry()};
        return Grown{RecordedRun(result.record, {frame}), scene.seed, end_of(last.quantities().back())};
    }

    /// The remedy of a scene's process is one for its file; here options have one.
    void warn(std::vector<Diagnostic> warnings, bool quiet) const {
        for (Diagnostic& warning : warnings) {
            const std::string end = environment::told_end_of_growth(warning.message);
            if (!end.empty()) warning = {warning.severity, {}, end + remedy(warning.message)};
        }
        print_warnings(warnings, quiet);
    }

    std::string remedy(const std::string& message) const {
        const bool out_of_reach = message.find("in the reach") != std::string::npos;
        std::vector<std::string> options;
        const auto offer = [&](std::string_view option, const char* what) {
            for (const ModelSetting& setting : kind_->values.settings()) {
                if (option_name(setting) == option) options.push_back(fmt::format("{} --{}", what, option));
            }
        };
        if (out_of_reach) {
            options.push_back("another --seed");
            offer("density-begin", "a higher");
            offer("node-distance", "a larger");
        } else {
            for (const char* size : {"crown-width", "crown-depth", "crown-height"}) offer(size, "a larger");
            offer("age", "a lower");
        }
        const std::string scene = fmt::format("or change its process in {}", kind_->scene.string());
        return fmt::format(": choose {}{}{}", fmt::join(options, ", "), options.empty() ? "" : "; ", scene);
    }

    /// The stages of the scene whose leaves are cards with a picture; blossoms and fruit have an id.
    void dress_leaves() {
        if (leaf_picture_.empty()) return;
        if (!is_readable(leaf_picture_)) {
            throw UserError(fmt::format("--leaf-picture {}: there is no such picture", leaf_picture_.string()));
        }
        const std::vector<Settings> stages = Settings::read_toml(kind_->scene).tables("plant").front().tables("stage");
        for (std::size_t i = 0; i < stages.size(); ++i) {
            if (stages[i].text("stage") != "leaves" || !stages[i].has("texture") || stages[i].has("id")) continue;
            arguments_.overrides.emplace_back(fmt::format("plant.0.stage.{}.texture", i),
                                              fmt::format("{:?}", fs::absolute(leaf_picture_).string()));
        }
    }

    Json write(const RecordedRun& run, const Target& target) const {
        const RecordedFrame* const frame = &run.frames().front();
        if (internodes_of(*frame->geometry).empty()) {
            throw UserError(
                "no internode has grown, and nothing was written: see the warnings, or choose more steps, a larger "
                "crown, a longer stem, or another seed");
        }
        Json files = Json::array();
        const auto report = [&](const ExportedFile& file) {
            files.push_back({{"path", file.path.string()}, {"vertices", file.vertices}, {"triangles", file.triangles}});
            if (!arguments_.quiet && !file.hint.empty()) fmt::print(stderr, "{}\n", file.hint);
        };
        ExportJob job{run, {&frame, 1}, {}, target.folder, report, target.name};
        mesh_.put_into(job);
        if (!mesh_.says_sides() && frame->geometry->polygons.size() == 0) job.options.sides = sides_if_bare;
        job.counts = job.counts || target.counts;
        job.keep = true;
        if (levels_ == 0) {
            export_run(job, std::vector{target.format});
            return files;
        }
        const LevelsFile levels = tree_levels(job, levels_);
        if (!job.folder.empty()) make_folder(job.folder);
        report(write_levels(levels, job.path("glb")));
        files.back()["levels"] = levels.triangles();
        return files;
    }

    void save_settings(std::uint64_t seed) const {
        if (!saved_.empty()) write_text(unused(saved_), kind_->values.table(seed));
    }

    void tell(const Json& files, std::uint64_t seed, const End& end, double seconds) const {
        if (wants_json()) {
            const Json result = {
                {"files", files}, {"seed", seed}, {"end", end.reason}, {"code", end.code}, {"seconds", seconds}};
            fmt::print("{}\n", json_text(result));
            return;
        }
        if (seed_ == "new") fmt::print("seed {}\n", seed);
        if (arguments_.quiet) return;
        for (const Json& file : files) {
            fmt::print("{}: {} vertices, {} triangles, {}\n", file["path"].get<std::string>(),
                       grouped(file["vertices"].get<std::size_t>()), grouped(file["triangles"].get<std::size_t>()),
                       duration_text(seconds));
            for (std::size_t level = 0; file.contains("levels") && level < file["levels"].size(); ++level) {
                fmt::print("  level {}: {} triangles\n", level, grouped(file["levels"][level].get<std::size_t>()));
            }
        }
    }

    std::optional<TreeKind> kind_;  ///< none: `unreadable_` says why
    std::string unreadable_;
    std::vector<std::pair<const ModelSetting*, std::string>> said_;
    RunArguments arguments_;
    std::string preset_, seed_, memory_;
    fs::path output_, settings_, saved_, leaf_picture_, run_;
    MeshFileOptions mesh_;
    std::size_t levels_ = 0;  ///< 0: the tree with all its detail alone
};

const RegisteredCommand<Tree> tree_entry{18};

}  // namespace
}  // namespace espalier::app

#include "espalier/simulation/scene.h"

#include "espalier/base/file.h"
#include "espalier/simulation/object.h"

#include "base/text.h"
#include "simulation/object/animation_file.h"
#include "simulation/object/environment_file.h"
#include "simulation/object/panels.h"
#include "simulation/scene/expressions.h"
#include "simulation/scene/plant_table.h"
#include "simulation/scene/scene_keyframes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace espalier::simulation {
namespace {

constexpr double most_steps = 1e9;

Box read_domain(const Settings& table) {
    const Box domain{table.vector("lower"), table.vector("upper")};
    table.reject_unread();
    for (int axis = 0; axis < 3; ++axis) {
        const bool flat = axis == 2 && domain.lower.z == domain.upper.z;  // a two-dimensional world
        if (domain.lower[axis] < domain.upper[axis] || flat) continue;
        throw UserError(table.place(), "'lower' of the domain must be less than 'upper' (along z it may be equal)");
    }
    return domain;
}

std::array<int, 2> read_blocks(const Settings& table) {
    constexpr double most = 1024;
    const std::vector<double> blocks = table.numbers("blocks");
    const auto is_count = [](double n) { return n >= 1 && n <= most && n == std::floor(n); };
    if (blocks.size() != 2 || !std::all_of(blocks.begin(), blocks.end(), is_count)) {
        throw UserError(table.place("blocks"), "'blocks' are two whole numbers from 1 to 1024, along x and along z");
    }
    return {static_cast<int>(blocks[0]), static_cast<int>(blocks[1])};
}

void read_simulation(const Settings& table, Scene& scene) {
    if (table.has("steps")) scene.steps = static_cast<int>(table.integer("steps", Range::between(0, most_steps)));
    scene.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, Range::not_negative()));
    scene.dt = table.number_or("dt", 1, Range::positive());
    scene.time_unit = table.text_or("time_unit", "step");
    scene.origin =
        table.has("origin") ? std::make_shared<MapOrigin>(table.vector("origin")) : std::make_shared<MapOrigin>();
    if (table.has("domain")) scene.domain = read_domain(table.table("domain"));
    if (table.has("blocks")) scene.blocks = read_blocks(table);
    table.integer_or("steps", 0);  // so that a misspelt 'steps' is offered it
    table.reject_unread();
}

void add_notes(SceneNotes& notes, const std::filesystem::path& path, const std::vector<Diagnostic>& diagnostics,
               const std::vector<std::string>& unused) {
    notes.diagnostics.insert(notes.diagnostics.end(), diagnostics.begin(), diagnostics.end());
    if (!unused.empty()) notes.unused.push_back(fmt::format("{}: {}", path.string(), fmt::join(unused, ", ")));
}

// Processes of an environment file (.e) stand before the scene's own.
void add_environment_file(const Settings& table, Scene& scene) {
    const std::filesystem::path folder = table.path_if_any("folder").value_or("");
    if (!table.has("file")) return;
    const std::filesystem::path path = table.path("file");
    if (!std::filesystem::exists(path)) {
        throw UserError(table.place("file"), fmt::format("there is no environment file {}", path.string()));
    }
    EnvironmentFile file = read_environment_file(path, folder);
    add_notes(scene.notes, path, file.diagnostics, file.unused);
    scene.notes.files.insert(scene.notes.files.end(), file.files.begin(), file.files.end());
    scene.environment.routed = file.routed;
    if (scene.environment.default_process.empty()) scene.environment.default_process = file.processes.front().first;
    for (auto& process : file.processes) scene.environment.processes.push_back(std::move(process));
}

// [environment.licht] with a voxel only: the name of a process is misspelt, or says what no table does.
[[noreturn]] void reject_unnamed(const Settings& table, const std::vector<std::string>& unnamed,
                                 const SceneEnvironment& environment) {
    std::vector<std::string> named;
    for (const auto& process : environment.processes) {
        if (std::find(unnamed.begin(), unnamed.end(), process.first) == unnamed.end()) named.push_back(process.first);
    }
    throw UserError(table.place(unnamed.front()),
                    fmt::format("[environment.{}] does not say which process it is: 'process' is missing{}",
                                unnamed.front(), did_you_mean(unnamed.front(), named)));
}

// The processes read their own parameters when the world makes them.
void read_environment(const Settings& table, Scene& scene) {
    scene.environment.default_process = table.text_or("default", "");
    scene.environment.keeps_unanswered = table.choice_or("unanswered", "error", {"error", "keep"}) == "keep";
    add_environment_file(table, scene);
    const std::vector<std::string> words{"default", "file", "folder", "unanswered"};
    std::vector<std::string> unnamed;
    for (const std::string& name : table.keys()) {
        if (std::find(words.begin(), words.end(), name) != words.end()) continue;
        if (!table.is_table(name)) {
            throw UserError(table.place(name),
                            fmt::format("'{}' must be a table: [environment.{}] with process = \"...\"{}", name, name,
                                        did_you_mean(name, words)));
        }
        scene.environment.processes.emplace_back(name, table.table(name));
        if (!table.table(name).has("process")) unnamed.push_back(name);
    }
    if (!unnamed.empty()) reject_unnamed(table, unnamed, scene.environment);
    std::vector<std::string> names;
    for (const auto& process : scene.environment.processes) {
        if (std::find(names.begin(), names.end(), process.first) != names.end()) {
            throw UserError(table.place(process.first),
                            fmt::format("the environment file has a process '{}' already", process.first));
        }
        names.push_back(process.first);
    }
    if (scene.environment.default_process.empty()) return;
    if (std::find(names.begin(), names.end(), scene.environment.default_process) != names.end()) return;
    throw UserError(table.place("default"),
                    fmt::format("no process of this scene is called '{}'{}", scene.environment.default_process,
                                did_you_mean(scene.environment.default_process, names)));
}

// An animation file says which steps become frames, and which is the last.
void read_timeline(const Settings& table, Scene& scene) {
    scene.timeline = table;
    if (!table.has("animation")) return;
    const std::filesystem::path path = table.path("animation");
    for (const char* other : {"first", "every", "keyframes"}) {
        if (table.has(other)) {
            throw UserError(table.place(other),
                            fmt::format("the animation file says which steps are frames; without '{}'", other));
        }
    }
    if (!std::filesystem::exists(path)) {
        throw UserError(table.place("animation"), fmt::format("there is no animation file {}", path.string()));
    }
    const Animation animation = read_animation_file(path);
    add_notes(scene.notes, path, animation.diagnostics, animation.unused);
    scene.notes.files.push_back(path);
    scene.frames = animation.frames;
    scene.last_frame = animation.last;
}

void reject_unknown_tables(const Settings& root) {
    const std::vector<std::string> known{"simulation", "plant", "environment", "timeline", "keyframes", "fit", "panel"};
    std::vector<Diagnostic> unknown;
    for (const std::string& key : root.keys()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        unknown.push_back({Diagnostic::Severity::error, root.place(key),
                           fmt::format("'{}' means nothing here{}; a scene has [simulation], [[plant]], "
                                       "[environment.<name>], [[keyframes]], [timeline], [fit] and [[panel]]",
                                       key, did_you_mean(key, known))});
    }
    if (!unknown.empty()) throw UserError(unknown);
}

// Objects made for a window say that their last frame is number 1,000,000,000: they end with their derivation length.
void end_without_window(Scene& scene) {
    if (scene.last_frame.value_or(0) <= Scene::most_frames_unasked) return;
    int longest = 0;
    for (const Plant& plant : scene.plants) longest = std::max(longest, Derivation(plant.model).length());
    if (longest > Scene::most_frames_unasked) return;
    Diagnostic warning;
    warning.severity = Diagnostic::Severity::warning;
    warning.place.file = scene.timeline.path("animation").string();
    warning.message = fmt::format(
        "the last frame, {}, is meant for a window that the user closes: the run ends at the derivation length, {}; "
        "--steps N grows further",
        *scene.last_frame, longest);
    scene.notes.diagnostics.push_back(warning);
    scene.last_frame.reset();
}

/// What a file decided, and plants that stand where 32 bits, which are recorded, do not keep a millimetre.
void tell_origin(Scene& scene) {
    if (!scene.origin) return;
    for (Diagnostic& warning : scene.origin->take_warnings()) scene.notes.diagnostics.push_back(std::move(warning));
    for (const Plant& plant : scene.plants) {
        const glm::dvec3& at = plant.turtle.pose.position;
        const double farthest = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        if (farthest <= MapOrigin::far_away) continue;
        Diagnostic& warning = scene.notes.diagnostics.emplace_back();
        warning.severity = Diagnostic::Severity::warning;
        warning.place = scene.root.place();
        warning.message = fmt::format(
            "plant '{}' stands {:.0f} m from the origin, and 32 bits keep a millimetre only up to {:.0f} m: places "
            "that a "
            "scene writes are relative to the 'origin' of [simulation]",
            plant.name, farthest, MapOrigin::far_away);
        return;
    }
}

Scene read(Settings root, Scene scene, const SceneOptions& options) {
    scene.overrides = options.overrides;
    if (options.steps) scene.overrides.emplace_back("simulation.steps", std::to_string(*options.steps));
    if (options.seed) scene.overrides.emplace_back("simulation.seed", std::to_string(*options.seed));
    for (const auto& [key, value] : scene.overrides) root.set(key, value);

    scene.computed = evaluate_expressions(root);
    Mistakes mistakes;
    mistakes.attempt([&] { reject_unknown_tables(root); });
    mistakes.attempt([&] { read_simulation(root.table("simulation"), scene); });
    mistakes.attempt([&] { read_environment(root.table("environment"), scene); });
    mistakes.attempt([&] { read_timeline(root.table("timeline"), scene); });
    root.table("fit").ignore();                    // `espalier fit` reads it
    mistakes.attempt([&] { read_panels(root); });  // which the studio shows
    SceneKeyframes keyframes;
    mistakes.attempt([&] { keyframes = read_scene_keyframes(root); });
    if (!keyframes.of_processes.empty()) {
        scene.environment.in_time = std::make_shared<const EnvironmentInTime>(keyframes.of_processes);
    }
    const MapOrigin::Scope of_files(scene.origin.get());
    scene.plants = read_plants(root, scene.seed, scene.dt, mistakes, scene.notes, keyframes.of_plants);
    try {
        mistakes.throw_if_any();
    } catch (const UserError& error) {
        throw explained(error, scene.computed);
    }
    scene.root = root;
    tell_origin(scene);
    if (scene.steps) scene.last_frame.reset();
    end_without_window(scene);
    return scene;
}

}  // namespace

Plant plant_of_file(const std::filesystem::path& model, const Defines& defines) {
    return {.model = compile(read_model(model, {.defines = defines}))};
}

Plant plant_of_text(std::string_view model, const std::string& name, const Defines& defines) {
    return {.model = compile(read_model_text(model, name, {}, {.defines = defines}))};
}

void SceneEnvironment::add(const std::string& name, const std::string& process, const Settings& parameters) {
    Settings table = parameters.copy("environment." + name);
    table.put("process", process);
    processes.emplace_back(name, std::move(table));
}

Scene read_scene(const std::filesystem::path& path, const SceneOptions& options) {
    Scene scene;
    scene.path = path;
    scene.name = path.stem().string();
    scene.text = read_text(path);
    Settings root = Settings::parse_toml(scene.text, path.string(), path.parent_path());
    return read(std::move(root), std::move(scene), options);
}

Scene read_scene_text(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                      const SceneOptions& options) {
    Scene scene;
    scene.name = name;
    scene.text = text;
    return read(Settings::parse_toml(text, name, folder), std::move(scene), options);
}

Scene scene_of_model(const std::filesystem::path& model, const SceneOptions& options) {
    ObjectFiles object;
    object.model = model;
    return scene_of_object(object, options);
}

const char* scene_help() {
    return R"([simulation]
  steps        the longest derivation length of the models; number of derivation steps
  seed         0; the same seed gives the same bytes
  dt           1, > 0; duration of a step, in units of time
  time_unit    "step"; name of the unit of time
  blocks       by the number of plants; [x, z]: number of blocks of ground, which the ranks of `mpiexec` share
  origin       that of a file, m; [x, y, z]: the place on the map, y upwards, that everything in the scene is relative to.
               It is subtracted from the places in files (measured plants, meshes, fields, points); places that the scene
               writes are relative to it. Without it, the first file with places beyond 10 km decides it, rounded to 100 m,
               with a warning, and files that lie nearer to 0 are relative to the scene
  domain       grows with the plants, m; { lower = [x, y, z], upper = [x, y, z] }: the box of the environment

[[plant]]      one table per individual or per stand
  model        required; a model file, relative to the scene
  name         that of the model with a number; name of the plant in statistics and messages
  position     [0, 0, 0] m; where the plant begins
  positions    none, m; [[x, y, z], ...]: one plant at each
  grid         none; { columns, rows = 1, spacing (m), jitter = 0 (m) }: a stand around `position` on x and z
  heading      [0, 1, 0]; heading of the turtle
  roll         0 degrees; turn about the heading
  define       {}; { NAME = value }: replaces #define NAME of the model
  keyframes    none; [[plant.keyframes]]: { name = "HEIGHT", times = [0, 20], values = [1, 8], spline = false }: a
               #define of the model has these values at these times
  age          that of each step; the time at which the keyframes are read
  regrow       false; true: every step grows the plant anew, with the values of that time; without keyframes it
               has grown before step 0 and stays
  arithmetic   "double", or "cpfg"; cpfg: computes as cpfg does, with 32-bit parameters
  view         none; view file (.v): settings of the turtle, surfaces, contours, functions, curves
  colour_map   none; a file (.map) for set 1, or { 1 = file, 2 = file }
  materials    none; the same with materials (.mat)
  folder       none; a second folder in which side files are looked for
  stream       the number of the plant in the scene; selects the random numbers
  stage        none; [[plant.stage]] tables, which change what is drawn: { stage = "...", when = true }; with
               when = false a stage is left out. `espalier list stages`
  insert       []; ["X(1)@5", "X@9:F.3"]: modules put into the string of a step, at its beginning or before a module
  unit, up, pixel, plants, begin   of a file of measured plants (rsml, mtg, ... in `espalier list notations`):
               unit of its lengths, "m", "dm", "cm", "mm", "um" or "inch"; the axis that points upwards, "x", "y", "z",
               "-x", "-y" or "-z"; width of a pixel, mm; "separate", each plant of the file is one of its own, or
               "together"; "file", plants stand where the file has them, from `position`, or "position", the first
               begins there. Without them they are as the file says
  turtle       {}; overrides the view file: { angle = 45 (degrees), line_width (none), line_width_increment = 0,
               colour = 128, colour_increment = 1, scale = 1, scale_multiplier = 1, past_cut = true,
               tropism = [{ direction = [0, -1, 0], angle = 0 (degrees), elasticity = 0, elasticity_step = 0,
               torque = false }] }

[environment]
  default      the only one; the process that answers ?E
  file         none; an environment file (.e), whose process answers ?E
  folder       none; a second folder in which its parameter file is looked for
  unanswered   "error", or "keep"; keep: queries without a process keep their parameters

[environment.<name>]
  process      required; kind of process: `espalier list processes`; its parameters follow
  digits       0, 0 to 17; significant digits of queries and answers, 0: all
  turtle       {}; { position = "%.4f %.4f %.4f", heading, left, up, line_width, scale_factor }: printf formats that
               round the state of the turtle for the process
  following_module  true; the process sees the module that follows the query

[[keyframes]]  A number of a process, of a plant's turtle (plant.0.turtle.line_width) or of a stage (plant.0.stage.1.tip)
               changes with time.
  key          required; "environment.light.strength": where the number stands
  times        required; [0, 20]: times, in units of time
  values       required; [0.1, 0.3]: the values at these times
  spline       false; values change evenly between the times; true: along a smooth curve

[timeline]     `espalier list recorders` has further keys
  first        0; step of the first frame
  every        1; steps between frames; the last step is always a frame
  keyframes    none; [step, ...]: these frames; together with `first` or `every`, besides theirs
  animation    none; animation file (.a) that selects the frames, instead of `first`, `every` and `keyframes`
  compression  "lz4", or "zlib"; of .vtp and .vti: zlib takes longer, and makes smaller files that browsers read, too

[fit]          what `espalier fit` finds; a run ignores it
  targets      none; files that hold what was measured: ["traits.csv"]
  parameters   none; { "KEY" = "LOW:HIGH" }: keys of this scene, each with what is known of it; see docs/fitting.md

[[panel]]      sliders of the studio, as the author lays them out; a run ignores them
  title        required; its heading
  settings     required; ["environment.light.voxel", ...]: settings as the studio names them, or a table for each:
               { name, label, unit, lowest, highest, step }, of which only the name is required
  columns      1, 1 to 4; how many sliders stand side by side
  open         true; false: closed at first

influence = "= 3 * LENGTH": a text that begins with = is an expression in the #defines of a model: of its own plant in
[[plant]] (positions, grid, turtle, stages), of the first in [simulation], [environment] and [timeline]. Flags may be 0 or 1.
)";
}

}  // namespace espalier::simulation

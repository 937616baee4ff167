#include "espalier/simulation/scene.h"

#include "espalier/base/file.h"
#include "espalier/base/text.h"

#include "plant_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {
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

// Returns the steps the scene gives, or nothing.
std::optional<int> read_simulation(const Settings& table, Scene& scene) {
    std::optional<int> steps;
    if (table.has("steps")) steps = static_cast<int>(table.integer("steps", Range::between(0, most_steps)));
    scene.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, Range::not_negative()));
    scene.dt = table.number_or("dt", 1, Range::positive());
    scene.time_unit = table.text_or("time_unit", "step");
    if (table.has("domain")) scene.domain = read_domain(table.table("domain"));
    table.integer_or("steps", 0);  // so that a misspelt 'steps' is offered it
    table.reject_unread();
    return steps;
}

// The processes read their own parameters when the world makes them.
void read_environment(const Settings& table, Scene& scene) {
    scene.default_process = table.text_or("default", "");
    for (const std::string& name : table.keys()) {
        if (name == "default") continue;
        if (!table.is_table(name)) {
            throw UserError(table.place(name),
                            fmt::format("'{}' must be a table: [environment.{}] with process = \"...\"{}", name, name,
                                        did_you_mean(name, std::vector<std::string>{"default"})));
        }
        scene.processes.emplace_back(name, table.table(name));
    }
    const auto has_name = [&](const auto& process) { return process.first == scene.default_process; };
    if (scene.default_process.empty() || std::any_of(scene.processes.begin(), scene.processes.end(), has_name)) return;
    std::vector<std::string> names;
    for (const auto& process : scene.processes) names.push_back(process.first);
    throw UserError(table.place("default"),
                    fmt::format("no process of this scene is called '{}'{}", scene.default_process,
                                did_you_mean(scene.default_process, names)));
}

void reject_unknown_tables(const Settings& root) {
    const std::vector<std::string> known{"simulation", "plant", "environment", "timeline"};
    std::vector<Diagnostic> unknown;
    for (const std::string& key : root.keys()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        unknown.push_back({Diagnostic::Severity::error, root.place(key),
                           fmt::format("'{}' means nothing here{}; a scene has [simulation], [[plant]], "
                                       "[environment.<name>] and [timeline]",
                                       key, did_you_mean(key, known))});
    }
    if (!unknown.empty()) throw UserError(unknown);
}

// How long the models themselves want to grow: the longest decides.
int longest_derivation(const std::vector<PlantDescription>& plants) {
    int length = 0;
    const CompiledModel* previous = nullptr;
    for (const PlantDescription& plant : plants) {
        if (plant.model.get() != previous) length = std::max(length, Derivation(plant.model).length());
        previous = plant.model.get();
    }
    return length;
}

Scene read(Settings root, Scene scene, const SceneOptions& options) {
    scene.overrides = options.overrides;
    if (options.steps) scene.overrides.emplace_back("simulation.steps", std::to_string(*options.steps));
    if (options.seed) scene.overrides.emplace_back("simulation.seed", std::to_string(*options.seed));
    for (const auto& [key, value] : scene.overrides) root.set(key, value);

    Mistakes mistakes;
    std::optional<int> steps;
    mistakes.attempt([&] { reject_unknown_tables(root); });
    mistakes.attempt([&] { steps = read_simulation(root.table("simulation"), scene); });
    mistakes.attempt([&] { read_environment(root.table("environment"), scene); });
    mistakes.attempt([&] { scene.timeline = root.table("timeline"); });
    scene.plants = read_plants(root, scene.seed, mistakes);
    mistakes.throw_if_any();
    scene.steps = steps ? *steps : longest_derivation(scene.plants);
    if (!steps) root.set("simulation.steps", std::to_string(scene.steps));
    scene.root = root;
    return scene;
}

}  // namespace

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
    Scene scene;
    scene.name = model.stem().string();
    scene.text = "[[plant]]\n";
    Settings root = Settings::parse_toml(scene.text, model.string());
    SceneOptions with_model = options;
    with_model.overrides.insert(with_model.overrides.begin(), {"plant.0.model", model.string()});
    return read(std::move(root), std::move(scene), with_model);
}

const char* scene_help() {
    return R"([simulation]
  steps        derivations; default: the longest derivation length of the models
  seed         0; the same seed gives the same bytes
  dt           1; time one step stands for
  time_unit    "step"
  domain       { lower = [x, y, z], upper = [x, y, z] } in metres; default: grows with the plants

[[plant]]      one table per individual or per stand
  model        a model file, relative to the scene
  name         default: the model's name, numbered
  position     [0, 0, 0], metres
  positions    [[x, y, z], ...]: one plant at each
  grid         { columns, rows = 1, spacing (m), jitter = 0 (m) }: a stand around `position` on x and z
  heading      [0, 1, 0]; where the turtle looks
  roll         0 degrees about the heading
  define       { NAME = value }: overrides #define NAME of the model
  stream       its number in the scene; which random numbers it draws
  turtle       { angle = 45 (degrees), line_width = 1, line_width_increment = 0, colour = 128,
                 colour_increment = 1, scale = 1, scale_multiplier = 1, past_cut = true,
                 tropism = [{ direction = [0, -1, 0], angle = 0 (degrees), elasticity = 0,
                              elasticity_step = 0, torque = false }] }

[environment]
  default      the process that answers ?E; default: the only one

[environment.<name>]
  process      what it is: `espalier list processes`; its parameters stand beside it

[timeline]     `espalier list recorders`
)";
}

}  // namespace espalier

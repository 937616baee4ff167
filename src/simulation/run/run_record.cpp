#include "simulation/run/run_record.h"

#include "base/bytes.h"
#include "base/json_text.h"
#include "simulation/run/run_inputs.h"
#include "simulation/run/view_record.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>

namespace espalier::simulation {
namespace {

using Json = nlohmann::ordered_json;

Json plants_json(const World& world) {
    Json plants = Json::array();
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Plant& plant = world.scene().plants[i];
        plants.push_back({{"name", plant.name},
                          {"model", world.model(i).path.string()},
                          {"arithmetic", name_of(world.model(i).arithmetic)},
                          {"stream", *plant.stream},
                          {"modules", world.modules(i)}});
    }
    return plants;
}

// Those that emit light or are transparent: recorded colours tell neither.
Json materials_json(const Scene& scene) {
    Json materials = Json::array();
    std::set<std::shared_ptr<const Palette>> seen;
    for (const Plant& plant : scene.plants) {
        if (!plant.palette || !seen.insert(plant.palette).second) continue;
        for (const auto& [index, material] : plant.palette->entries) {
            const glm::dvec3 emission(glm::clamp(material.emissive, 0.0, 1.0));
            const double opacity = std::clamp(material.diffuse.a, 0.0, 1.0);
            if (emission == glm::dvec3(0) && opacity == 1) continue;
            materials.push_back(
                {{"rgb", shown_colour(material)}, {"emission", vector_json(emission)}, {"opacity", opacity}});
        }
    }
    return materials;
}

// With the values that were used, those of environment files among them.
Json processes_json(const Scene& scene) {
    Json processes = Json::object();
    for (const auto& [name, table] : scene.environment.processes) processes[name] = Json::parse(table.resolved_json());
    return processes;
}

Json units_json(const World& world) {
    Json units = Json::object();
    for (const Quantity& quantity : world.environment().statistics(0)) {
        if (!quantity.unit.empty()) units[quantity.name] = quantity.unit;
    }
    return units;
}

Json overrides_json(const Scene& scene) {
    Json overrides = Json::array();
    for (const auto& [key, value] : scene.overrides) overrides.push_back(key + "=" + value);
    return overrides;
}

// Returns the settings of the whole scene, with the steps that it leaves to its models.
Json parameters_json(const Scene& scene, int planned_steps) {
    Json parameters = Json::parse(scene.root.resolved_json());
    if (!scene.steps && !scene.frames) parameters["simulation"]["steps"] = planned_steps;
    return parameters;
}

Json asked_json(const AskedOptions& asked) {
    Json json = Json::object();
    for (const auto& [name, value] : {std::pair{"memory", asked.memory},
                                      {"disk", asked.disk},
                                      {"blocks", asked.blocks},
                                      {"resident", asked.resident}}) {
        if (value > 0) json[name] = value;
    }
    if (asked.patience >= 0) json["timeout"] = asked.patience;
    return json;
}

Json names_json(const std::set<std::filesystem::path>& files) {
    Json names = Json::array();
    for (const std::filesystem::path& file : files) names.push_back(file.string());
    return names;
}

}  // namespace

RunRecord::RunRecord(const World& world, const RunOptions& options)
    : world_(world),
      planned_steps_(world.last_step()),
      memory_(options.memory),
      ranks_(options.ranks ? options.ranks->count() : 1),
      checkpoint_every_(options.checkpoint_every),
      asked_(options.asked),
      output_(options.output),
      inputs_(options.inputs),
      arguments_(options.arguments),
      folder_(std::filesystem::current_path().string()),
      started_(fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))) {}

void RunRecord::begin(const Timeline& timeline) {
    timings_.emplace(timeline.folder() / "timings.csv", "step,derive,interpret,exchange,record,messages,bytes");
}

void RunRecord::save(std::ostream& out) const {
    if (timings_) timings_->keep();
    put(out, static_cast<std::uint64_t>(timings_ ? timings_->size() : 0));
    put(out, steps_);
    put(out, total_);
}

int RunRecord::step_saved_in(std::istream& in) {
    get<std::uint64_t>(in);  // of timings.csv
    return get<int>(in) - 1;
}

void RunRecord::resume(const Timeline* timeline, std::istream& in) {
    const auto timings = static_cast<std::size_t>(get<std::uint64_t>(in));
    if (timeline) timings_.emplace(timeline->folder() / "timings.csv", timings);
    steps_ = get<int>(in);
    total_ = get<StageTimes>(in);
}

void RunRecord::add_step(const StageTimes& times) {
    if (timings_) {
        timings_->append(fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f},{},{}\n", steps_, times.derive, times.interpret,
                                     times.exchange, times.record, times.messages, times.bytes));
    }
    ++steps_;
    total_.derive += times.derive;
    total_.interpret += times.interpret;
    total_.exchange += times.exchange;
    total_.record += times.record;
    total_.messages += times.messages;
    total_.bytes += times.bytes;
}

std::string RunRecord::json(const std::string& exit, double seconds) const {
    const Scene& scene = world_.scene();
    Json json;
    json["program"] = "espalier";
    json["version"] = ESPALIER_VERSION;
    json["exit"] = exit;
    json["scene"] = {{"name", scene.name}, {"path", scene.path.string()}, {"text", scene.text}};
    json["command"] = {{"folder", folder_}, {"arguments", arguments_}};
    json["overrides"] = overrides_json(scene);
    json["seed"] = scene.seed;
    json["steps"] = planned_steps_;
    json["steps_done"] = steps_done();
    json["dt"] = scene.dt;
    json["time_unit"] = scene.time_unit;
    if (scene.origin && scene.origin->value()) json["origin"] = vector_json(*scene.origin->value());
    json["threads"] = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    if (ranks_ > 1) json["ranks"] = ranks_;
    json["memory"] = memory_;
    json["peak_memory"] = peak_memory();
    json["started"] = started_;
    json["checkpoint_every"] = checkpoint_every_;
    json["asked"] = asked_json(asked_);
    json["files_before"] = names_json(files_before_);
    json["plants"] = plants_json(world_);
    if (Json view = view_json(scene); !view.is_null()) json["view"] = std::move(view);
    if (Json materials = materials_json(scene); !materials.empty()) json["materials"] = std::move(materials);
    json["processes"] = processes_json(scene);
    json["units"] = units_json(world_);
    json["timings"] = {{"total", seconds},
                       {"derive", total_.derive},
                       {"interpret", total_.interpret},
                       {"exchange", total_.exchange},
                       {"record", total_.record}};
    json["inputs"] = inputs_json(inputs_, output_);
    json["parameters"] = parameters_json(scene, planned_steps_);
    return json_text(json) + "\n";
}

void RunRecord::write(const Timeline& timeline, const std::string& exit, double seconds) const {
    timeline.write_run(json(exit, seconds));
}

}  // namespace espalier::simulation

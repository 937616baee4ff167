#include "run_record.h"

#include "espalier/base/bytes.h"

#include "run_inputs.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>

namespace espalier {
namespace {

using Json = nlohmann::ordered_json;

Json plants_json(const Scene& scene, const World& world) {
    Json plants = Json::array();
    for (std::size_t i = 0; i < scene.plants.size(); ++i) {
        plants.push_back({{"name", scene.plants[i].name},
                          {"model", world.model(i).path.string()},
                          {"stream", scene.plants[i].stream},
                          {"modules", world.string(i).size()}});
    }
    return plants;
}

// With the values that were used, those of environment files among them.
Json processes_json(const Scene& scene) {
    Json processes = Json::object();
    for (const auto& [name, table] : scene.processes) processes[name] = Json::parse(table.resolved_json());
    return processes;
}

Json overrides_json(const Scene& scene) {
    Json overrides = Json::array();
    for (const auto& [key, value] : scene.overrides) overrides.push_back(key + "=" + value);
    return overrides;
}

Json names_json(const std::set<std::filesystem::path>& files) {
    Json names = Json::array();
    for (const std::filesystem::path& file : files) names.push_back(file.string());
    return names;
}

}  // namespace

RunRecord::RunRecord(const Scene& scene, const RunOptions& options)
    : scene_(scene),
      memory_(options.memory),
      checkpoint_every_(options.checkpoint_every),
      output_(options.output),
      inputs_(options.inputs),
      arguments_(options.arguments),
      folder_(std::filesystem::current_path().string()),
      started_(fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))) {}

void RunRecord::begin(const Timeline& timeline) {
    timings_.emplace(timeline.folder() / "timings.csv", "step,derive,interpret,exchange,record");
}

void RunRecord::save(std::ostream& out) const {
    put(out, static_cast<std::uint64_t>(timings_ ? timings_->size() : 0));
    put(out, steps_);
    put(out, total_);
}

void RunRecord::resume(const Timeline& timeline, std::istream& in) {
    timings_.emplace(timeline.folder() / "timings.csv", std::size_t{get<std::uint64_t>(in)});
    steps_ = get<int>(in);
    total_ = get<StageTimes>(in);
}

void RunRecord::add_step(const StageTimes& times) {
    if (timings_) {
        timings_->append(fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f}\n", steps_, times.derive, times.interpret,
                                     times.exchange, times.record));
    }
    ++steps_;
    total_.derive += times.derive;
    total_.interpret += times.interpret;
    total_.exchange += times.exchange;
    total_.record += times.record;
}

std::string RunRecord::json(const World& world, const std::string& exit, double seconds) const {
    Json json;
    json["program"] = "espalier";
    json["version"] = ESPALIER_VERSION;
    json["exit"] = exit;
    json["scene"] = {{"name", scene_.name}, {"path", scene_.path.string()}, {"text", scene_.text}};
    json["command"] = {{"folder", folder_}, {"arguments", arguments_}};
    json["overrides"] = overrides_json(scene_);
    json["seed"] = scene_.seed;
    json["steps"] = scene_.steps;
    json["steps_done"] = std::max(steps_ - 1, 0);
    json["dt"] = scene_.dt;
    json["time_unit"] = scene_.time_unit;
    json["threads"] = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    json["memory"] = memory_;
    json["peak_memory"] = peak_memory();
    json["started"] = started_;
    json["checkpoint_every"] = checkpoint_every_;
    json["files_before"] = names_json(files_before_);
    json["plants"] = plants_json(scene_, world);
    json["processes"] = processes_json(scene_);
    json["timings"] = {{"total", seconds},
                       {"derive", total_.derive},
                       {"interpret", total_.interpret},
                       {"exchange", total_.exchange},
                       {"record", total_.record}};
    json["inputs"] = inputs_json(inputs_, output_);
    json["parameters"] = Json::parse(scene_.root.resolved_json());
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void RunRecord::write(const Timeline& timeline, const World& world, const std::string& exit, double seconds) const {
    timeline.write_run(json(world, exit, seconds));
}

}  // namespace espalier

#include "environment/light/sky/scene_sky.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/settings.h"

#include "base/json_text.h"
#include "environment/light/sky/daylight.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace espalier::environment {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double least_sky_rise = 0.0349;  // sine of 2 degrees, as the processes have it

/// A table as run.json holds it: JSON writes numbers, texts and lists as TOML does.
Settings settings_of(const Json& json, const std::string& name, const fs::path& folder) {
    std::string text;
    for (const auto& [key, value] : json.items()) {
        if (!value.is_object()) text += fmt::format("{} = {}\n", key, value.dump());
    }
    return Settings::parse_toml(text, name, folder);
}

/// The CIE's skies 1 to 6 are overcast.
SceneSky::Kind kind_of(const Json& sky) {
    const std::string radiance = sky.value("radiance", "overcast");
    if (radiance == "uniform") return SceneSky::Kind::uniform;
    const bool is_overcast = radiance == "overcast" || (radiance.size() == 5 && radiance[4] <= '6');
    return is_overcast ? SceneSky::Kind::overcast : SceneSky::Kind::clear;
}

double number_or(const Json& table, const char* key, double otherwise) {
    return table.contains(key) && table[key].is_number() ? table[key].get<double>() : otherwise;
}

/// That the sky names; null: none.
std::shared_ptr<const Weather> weather_of(const Json& sky, const Json& processes, const fs::path& folder) {
    if (!sky.contains("weather") || !sky["weather"].is_string()) return nullptr;
    const std::string name = sky["weather"];
    return std::make_shared<Weather>(settings_of(processes.at(name), name, folder));
}

// A run.json from elsewhere may hold anything.
std::string text_or_none(const Json& run, const char* table, const char* key) {
    const auto place = Json::json_pointer(fmt::format("/{}/{}", table, key));
    return run.contains(place) && run[place].is_string() ? run[place].get<std::string>() : "";
}

fs::path folder_of_scene(const Json& run) {
    return (fs::path(text_or_none(run, "command", "folder")) / text_or_none(run, "scene", "path")).parent_path();
}

}  // namespace

SceneSky::SceneSky(std::shared_ptr<const DaylightSeries> light, Kind kind, double days, double dt)
    : light_(std::move(light)), kind_(kind), days_(days), dt_(dt) {}

StepSky SceneSky::at_step(int step) const {
    const Daylight light = light_->of_step(step, dt_ * days_);
    StepSky sky;
    if (light.on_ground <= 0) return sky;
    double of_suns = 0, brightest = 0;
    for (const LightBeam& beam : light.beams) {
        if (!beam.is_sun) continue;
        const double on_ground = beam.photons * beam.towards.y;
        of_suns += on_ground;
        if (on_ground <= brightest) continue;
        brightest = on_ground;
        sky.sun = beam.towards;
    }
    sky.diffuse = 1 - std::min(1.0, of_suns / light.on_ground);
    sky.par = 1e6 * light.on_ground / light.seconds;
    return sky;
}

std::optional<SceneSky> sky_of_processes(const Json& processes, double dt, const fs::path& folder) {
    for (const auto& [name, process] : processes.items()) {
        if (!process.contains("sky") || !process["sky"].is_object() || process["sky"].empty()) continue;
        const Json& sky = process["sky"];
        try {
            auto light = std::make_shared<DaylightSeries>(settings_of(sky, name + ".sky", folder), least_sky_rise,
                                                          weather_of(sky, processes, folder), nullptr);
            return SceneSky(std::move(light), kind_of(sky), number_or(process, "days", 1), dt);
        } catch (const UserError& error) {
            throw UserError(fmt::format("the sky of '{}' cannot be drawn: {}", name, error.what()));
        } catch (const Json::exception&) {
            throw UserError(fmt::format("the sky of '{}' is not what a run writes", name));
        }
    }
    return std::nullopt;
}

std::optional<SceneSky> sky_of_run(const fs::path& run, const fs::path& root) {
    if (run.empty()) return std::nullopt;
    const Json record = read_json<Json>(read_text(run / "run.json"));
    const fs::path folder = folder_of_scene(record);
    if (!record.is_object() || !record.contains("processes")) return std::nullopt;
    return sky_of_processes(record["processes"], number_or(record, "dt", 1),
                            root.empty() ? folder : root / folder.relative_path());
}

}  // namespace espalier::environment

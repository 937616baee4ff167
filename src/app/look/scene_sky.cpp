#include "scene_sky.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/settings.h"

#include "environment/sky/daylight.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double least_rise = 0.0349;  // sine of 2 degrees, as the processes have it

/// A table as run.json holds it; names of files are relative to `folder`.
Settings settings_of(const Json& json, const fs::path& folder) {
    Settings settings;
    for (const auto& [key, value] : json.items()) {
        if (value.is_boolean()) settings.put(key, value.get<bool>());
        if (value.is_number()) settings.put(key, value.get<double>());
        if (value.is_string() && key == "series") settings.put(key, folder / value.get<std::string>());
        if (value.is_string() && key != "series") settings.put(key, value.get<std::string>());
        if (value.is_array()) settings.put(key, value.get<std::vector<double>>());
    }
    return settings;
}

/// The CIE's skies 1 to 6 are overcast.
PictureSky::Kind kind_of(const Json& sky) {
    const std::string radiance = sky.value("radiance", "overcast");
    if (radiance == "uniform") return PictureSky::Kind::uniform;
    const bool is_overcast = radiance == "overcast" || (radiance.size() == 5 && radiance[4] <= '6');
    return is_overcast ? PictureSky::Kind::overcast : PictureSky::Kind::clear;
}

double number_or(const Json& table, const char* key, double otherwise) {
    return table.contains(key) && table[key].is_number() ? table[key].get<double>() : otherwise;
}

fs::path folder_of_scene(const Json& run) {
    const fs::path command = run["command"].value("folder", "");
    return (command / run["scene"].value("path", "")).parent_path();
}

}  // namespace

SceneSky::SceneSky(std::shared_ptr<const environment::DaylightSeries> light, PictureSky::Kind kind, double days,
                   double dt)
    : light_(std::move(light)), kind_(kind), days_(days), dt_(dt) {}

PictureSky SceneSky::at(const RecordedFrame& frame) const {
    const environment::Daylight light = light_->over(frame.time * days_, dt_ * days_);
    PictureSky sky;
    sky.kind = kind_;
    const environment::LightBeam* brightest = nullptr;
    double of_sun = 0;
    for (const environment::LightBeam& beam : light.beams) {
        if (!beam.is_sun) continue;
        of_sun += beam.photons * beam.towards.y;
        if (!brightest || beam.photons * beam.towards.y > brightest->photons * brightest->towards.y) brightest = &beam;
    }
    sky.diffuse = light.on_ground > 0 ? 1 - std::min(1.0, of_sun / light.on_ground) : 1;
    if (!brightest) return sky;
    const glm::dvec3& towards = brightest->towards;
    sky.sun = {glm::degrees(std::atan2(towards.x, towards.z)), glm::degrees(std::asin(std::min(1.0, towards.y)))};
    return sky;
}

std::optional<SceneSky> sky_of_scene(const fs::path& run) {
    if (run.empty()) return std::nullopt;
    const Json record = Json::parse(read_text(run / "run.json"));
    const Json processes = record.value("processes", Json::object());
    for (const auto& [name, process] : processes.items()) {
        if (!process.contains("sky") || !process["sky"].is_object() || process["sky"].empty()) continue;
        const Json& sky = process["sky"];
        try {
            const Settings settings = settings_of(sky, folder_of_scene(record));
            auto light = std::make_shared<environment::DaylightSeries>(settings, least_rise);
            return SceneSky(std::move(light), kind_of(sky), number_or(process, "days", 1), number_or(record, "dt", 1));
        } catch (const UserError& error) {
            throw UserError(
                fmt::format("the sky of '{}' cannot be drawn: {}; --sky clear takes another one", name, error.what()));
        }
    }
    return std::nullopt;
}

}  // namespace espalier::app

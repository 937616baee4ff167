#include "setting_values.h"

#include "espalier/base/settings.h"

#include "base/number.h"
#include "base/text.h"
#include "options.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::app {
namespace {

constexpr const char* seed_name = "seed";

}  // namespace

std::string option_name(const ModelSetting& setting) {
    std::string name = in_small_letters(setting.name);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

std::filesystem::path first_model_of(const std::filesystem::path& scene) {
    const std::vector<Settings> plants = Settings::read_toml(scene).tables("plant");
    if (plants.empty()) throw UserError(fmt::format("{}: no [[plant]] in this scene", scene.string()));
    return plants.front().path("model");
}

void SettingValues::read(const std::filesystem::path& file) {
    const Settings table = Settings::read_toml(file);
    std::vector<std::string> names{seed_name};
    for (const ModelSetting& setting : settings_) names.push_back(option_name(setting));
    for (const std::string& key : table.keys()) {
        const auto at = std::find(names.begin(), names.end(), key);
        if (at == names.end()) {
            throw UserError(table.place(key),
                            fmt::format("there is no setting '{}'{}; `espalier tree --help` lists them", key,
                                        did_you_mean(key, names)));
        }
        if (at == names.begin()) {
            seed_ = static_cast<std::uint64_t>(table.integer(key, Range::not_negative()));
        } else {
            put(settings_[static_cast<std::size_t>(at - names.begin()) - 1], table.value_text(key), "'" + key + "'",
                table.place(key));
        }
    }
}

void SettingValues::set(const ModelSetting& setting, const std::string& text) {
    put(setting, text, "--" + option_name(setting), {});
}

void SettingValues::put(const ModelSetting& setting, const std::string& text, const std::string& called,
                        const Place& place) {
    const std::optional<double> value = finite_number(text);
    if (!value || !setting.allows(*value)) {
        const std::string message =
            fmt::format("{} ({}) must be {}, not {}", called, setting.summary, setting.what_is_allowed(), text);
        if (place.known()) throw UserError(place, message);
        throw UserError(message);
    }
    values_[setting.name] = *value;
}

KeyValues SettingValues::defines() const {
    KeyValues defines;
    for (const auto& [name, value] : values_) defines.emplace_back(name, format_exact(value));
    return defines;
}

std::string SettingValues::table(std::uint64_t seed) const {
    std::string text = fmt::format("# Settings of `espalier tree`\n{} = {}\n", seed_name, seed);
    std::string group;
    for (const ModelSetting& setting : settings_) {
        if (setting.group != group) text += fmt::format("\n# {}\n", group = setting.group);
        const auto chosen = values_.find(setting.name);
        const double value = chosen == values_.end() ? setting.value : chosen->second;
        text += fmt::format("{} = {}  # {}; {}{}{}\n", option_name(setting), format_exact(value), setting.summary,
                            setting.range(), setting.unit.empty() ? "" : " ", setting.unit);
    }
    return text;
}

}  // namespace espalier::app

#include "simulation/scene/expressions.h"

#include "espalier/language/model_settings.h"

#include "simulation/scene/plant_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace espalier::simulation {
namespace {

bool holds(const Settings& table, const std::string& key) {
    const std::vector<std::string> keys = table.keys();
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// The definitions of a plant's model, read when the first expression asks.
class PlantDefinitions {
public:
    PlantDefinitions(const Settings& plant, std::vector<ComputedValue>& computed)
        : plant_(plant), computed_(computed) {}

    void replace_expressions(const Settings& table) {
        // A model that is missing is told of when the plant is read.
        if (!holds(plant_, "model") || !std::filesystem::exists(plant_.path("model"))) return;
        table.replace_expressions(
            [this](std::string_view expression, const Place& key) { return value(expression, key); });
    }

private:
    double value(std::string_view expression, const Place& key) {
        if (!settings_) settings_ = ModelSettings::read(plant_.path("model"), read_defines(plant_.table("define")));
        computed_.push_back({key, std::string(expression), settings_->read_by(expression)});
        return settings_->value(expression);
    }

    Settings plant_;
    std::vector<ComputedValue>& computed_;
    std::optional<ModelSettings> settings_;
};

}  // namespace

std::vector<ComputedValue> evaluate_expressions(const Settings& root) {
    std::vector<ComputedValue> computed;
    if (!holds(root, "plant")) return computed;
    const std::vector<Settings> plants = root.tables("plant");
    for (const Settings& plant : plants) {
        PlantDefinitions(plant, computed).replace_expressions(plant);
    }
    if (plants.empty()) return computed;
    PlantDefinitions first(plants.front(), computed);
    for (const char* key : {"simulation", "environment", "timeline"}) {
        if (root.is_table(key)) first.replace_expressions(root.table(key));
    }
    return computed;
}

std::vector<Diagnostic> explained(std::vector<Diagnostic> diagnostics, const std::vector<ComputedValue>& computed) {
    for (Diagnostic& diagnostic : diagnostics) {
        std::vector<std::string> settings;
        for (const ComputedValue& value : computed) {
            if (to_string(value.place) != to_string(diagnostic.place)) continue;
            settings.insert(settings.end(), value.settings.begin(), value.settings.end());
        }
        if (!settings.empty()) diagnostic.message += fmt::format(" (computed from {})", fmt::join(settings, ", "));
    }
    return diagnostics;
}

UserError explained(const UserError& error, const std::vector<ComputedValue>& computed) {
    return UserError(explained(error.diagnostics(), computed));
}

}  // namespace espalier::simulation

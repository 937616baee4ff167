#include "expressions.h"

#include "espalier/language/model_settings.h"

#include "plant_table.h"

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
    explicit PlantDefinitions(const Settings& plant) : plant_(plant) {}

    void replace_expressions(const Settings& table) {
        // A model that is missing is told of when the plant is read.
        if (!holds(plant_, "model") || !std::filesystem::exists(plant_.path("model"))) return;
        table.replace_expressions([this](std::string_view expression) { return value(expression); });
    }

private:
    double value(std::string_view expression) {
        if (!settings_) settings_ = ModelSettings::read(plant_.path("model"), read_defines(plant_.table("define")));
        return settings_->value(expression);
    }

    Settings plant_;
    std::optional<ModelSettings> settings_;
};

}  // namespace

void evaluate_expressions(const Settings& root) {
    if (!holds(root, "plant")) return;
    const std::vector<Settings> plants = root.tables("plant");
    for (const Settings& plant : plants) {
        PlantDefinitions definitions(plant);
        if (plant.is_table("turtle")) definitions.replace_expressions(plant.table("turtle"));
        if (!holds(plant, "stage")) continue;
        for (const Settings& stage : plant.tables("stage")) definitions.replace_expressions(stage);
    }
    if (plants.empty()) return;
    PlantDefinitions first(plants.front());
    for (const char* key : {"simulation", "environment", "timeline"}) {
        if (root.is_table(key)) first.replace_expressions(root.table(key));
    }
}

}  // namespace espalier::simulation

// Values for the settings of a model, under the names that options and files have for them.
#pragma once

#include "espalier/language/model_settings.h"

#include "model_arguments.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::app {

/// CROWN_WIDTH is "crown-width".
std::string option_name(const ModelSetting& setting);

/// Returns the model of the first plant of a scene. Throws UserError if it has none.
std::filesystem::path first_model_of(const std::filesystem::path& scene);

class SettingValues {
public:
    explicit SettingValues(std::vector<ModelSetting> settings) : settings_(std::move(settings)) {}

    const std::vector<ModelSetting>& settings() const { return settings_; }

    /// Takes the values of a table: crown-width = 6. Its `seed` is kept apart. Throws UserError at the place of a name
    /// that is unknown and of a value that is not allowed.
    void read(const std::filesystem::path& file);
    /// Takes a value of the command line, "--crown-width".
    void set(const ModelSetting& setting, const std::string& text);

    /// What replaces the model's #defines: what differs from them or was said all the same.
    KeyValues defines() const;
    std::optional<std::uint64_t> seed() const { return seed_; }

    /// All values as a table that `read` takes, with what each means.
    std::string table(std::uint64_t seed) const;

private:
    void put(const ModelSetting& setting, const std::string& text, const std::string& called, const Place& place);

    std::vector<ModelSetting> settings_;
    std::map<std::string, double> values_;  ///< by the names of the model
    std::optional<std::uint64_t> seed_;
};

}  // namespace espalier::app

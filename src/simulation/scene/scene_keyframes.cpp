#include "simulation/scene/scene_keyframes.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace espalier::simulation {
namespace {

[[noreturn]] void reject_key(const Keyframes& keyframes, const std::string& why) {
    throw UserError(keyframes.place,
                    fmt::format("'{}' {}; keyframes change numbers of processes (environment.light.strength), of "
                                "turtles (plant.0.turtle.line_width) and of geometry stages (plant.0.stage.1.tip), and "
                                "[[plant.keyframes]] the #defines of a model",
                                keyframes.name, why));
}

/// The table that a number in a key counts, if there are so many.
std::optional<std::size_t> index_of(const std::string& word, std::size_t count) {
    const std::optional<std::size_t> index = whole_text_as<std::size_t>(word);
    return index && *index < count ? index : std::nullopt;
}

std::string joined(const std::vector<std::string>& words, std::size_t from) {
    return fmt::format("{}", fmt::join(words.begin() + static_cast<std::ptrdiff_t>(from), words.end(), "."));
}

void add_setting_of_process(SceneKeyframes& all, const std::vector<std::string>& words, const Keyframes& keyframes) {
    if (words.size() < 3) reject_key(keyframes, "does not name a setting of a process");
    all.of_processes.push_back({words[1], joined(words, 2), keyframes});
}

void add_setting_of_plant(SceneKeyframes& all, const std::vector<std::string>& words, const Keyframes& keyframes) {
    const std::optional<std::size_t> plant = words.size() > 1 ? index_of(words[1], all.of_plants.size()) : std::nullopt;
    if (!plant) {
        reject_key(keyframes,
                   fmt::format("does not name one of the {} [[plant]] tables, counted from 0", all.of_plants.size()));
    }
    // stage.<number>.<key>, turtle.<key>
    const bool is_drawing = words.size() > 3 && (words[2] == "turtle" || (words[2] == "stage" && words.size() > 4));
    if (!is_drawing) reject_key(keyframes, "does not change with time");
    Keyframes of_table = keyframes;
    of_table.name = joined(words, 2);
    all.of_plants[*plant].push_back(std::move(of_table));
}

const ChangingSetting* find(const std::vector<ChangingSetting>& settings, const std::string& key) {
    const auto found =
        std::find_if(settings.begin(), settings.end(), [&](const auto& each) { return each.key == key; });
    return found == settings.end() ? nullptr : &*found;
}

[[noreturn]] void reject_setting(const EnvironmentInTime::Setting& setting,
                                 const std::vector<ChangingSetting>& settings) {
    std::vector<std::string> keys;
    for (const ChangingSetting& each : settings) keys.push_back(each.key);
    throw UserError(setting.values.place,
                    fmt::format("'{}' of process '{}' does not change with time{}; {}", setting.key, setting.process,
                                did_you_mean(setting.key, keys),
                                keys.empty() ? "nothing of this process does"
                                             : fmt::format("what does: {}", fmt::join(keys, ", "))));
}

void require_range(const EnvironmentInTime::Setting& setting, const Range& range) {
    for (const double value : setting.values.values) {
        const bool is_low = value < range.lowest || (range.open_below && value == range.lowest);
        if (!is_low && value <= range.highest) continue;
        const std::string low = fmt::format("{} {}", range.open_below ? "greater than" : "at least", range.lowest);
        const std::string allowed =
            std::isfinite(range.highest) ? fmt::format("{} and at most {}", low, range.highest) : low;
        throw UserError(setting.values.place,
                        fmt::format("'{}' must be {}, not {}", setting.values.name, allowed, value));
    }
}

}  // namespace

void EnvironmentInTime::check(Environment& environment) const {
    for (const Setting& setting : settings_) {
        const std::optional<std::size_t> process = environment.find(setting.process);
        if (!process) {
            std::vector<std::string> names;
            for (std::size_t k = 0; k < environment.size(); ++k) names.push_back(environment.name(k));
            throw UserError(setting.values.place, fmt::format("the scene has no process '{}'{}", setting.process,
                                                              did_you_mean(setting.process, names)));
        }
        const std::vector<ChangingSetting> known = environment.changing_settings(*process);
        const ChangingSetting* changing = find(known, setting.key);
        if (!changing) reject_setting(setting, known);
        require_range(setting, changing->range);
    }
}

void EnvironmentInTime::set(Environment& environment, double time) const {
    for (const Setting& setting : settings_) {
        const std::vector<ChangingSetting> known = environment.changing_settings(*environment.find(setting.process));
        find(known, setting.key)->set(setting.values.at(time));
    }
}

std::shared_ptr<const Drawing> DrawingInTime::at_step(int step) const {
    const std::lock_guard lock(mutex_);
    if (step != step_) drawing_ = std::make_shared<const Drawing>(make_(step * dt_));
    step_ = step;
    return drawing_;
}

SceneKeyframes read_scene_keyframes(const Settings& root) {
    SceneKeyframes all;
    all.of_plants.resize(root.tables("plant").size());
    if (!root.has("keyframes")) return all;
    for (const Settings& table : root.tables("keyframes")) {
        const Keyframes keyframes = read_keyframes_table(table, "key");
        const std::vector<std::string> words = words_of(keyframes.name, ".");
        const std::string first = words.empty() ? "" : words.front();
        if (first == "environment") {
            add_setting_of_process(all, words, keyframes);
        } else if (first == "plant") {
            add_setting_of_plant(all, words, keyframes);
        } else {
            reject_key(keyframes, "does not change with time");
        }
    }
    return all;
}

}  // namespace espalier::simulation

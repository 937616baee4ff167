#include "study/fit/growth.h"

#include "espalier/base/error.h"
#include "espalier/simulation/world.h"
#include "espalier/timeline/last_frame.h"

#include "base/text.h"
#include "timeline/measures/plant_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace espalier::study {
namespace {

/// Values of a parameter may let a plant grow without bounds.
constexpr std::size_t most_modules = 1'000'000;

/// Keeps what `needs` names of the plants that are measured.
class Keeper final : public Recorder {
public:
    Keeper(const Settings& timeline, const Needs& needs, const std::vector<std::uint32_t>& plants)
        : needs_(needs), statistics_(timeline), last_(timeline) {
        grown_.plants = plants;
    }

    bool sees_every_step() const override { return true; }
    bool reads_plants_at(int, bool may_end) const override { return needs_.course || may_end; }

    void record(const Frame& frame) override {
        if (frame.step == 0) statistics_.require_known(frame);
        if (needs_.geometry) last_.record(frame);
        if (frame.is_last) grown_.first = frame.plants.front().interpretation;
        if (needs_.course || frame.is_last) keep_row(frame);
        statistics_.end_step(frame);
    }
    void finish() override {}

    Grown take() {
        grown_.geometry = last_.geometry();
        return std::move(grown_);
    }

private:
    void keep_row(const Frame& frame) {
        if (grown_.columns.empty()) grown_.columns = statistics_.columns(quantity_names(frame.plants.front()));
        std::vector<double> sums(grown_.columns.size(), 0);
        for (const PlantFrame& plant : frame.plants) {
            const std::vector<double> row = statistics_.of(plant);
            if (std::find(grown_.plants.begin(), grown_.plants.end(), plant.plant) == grown_.plants.end()) continue;
            for (std::size_t i = 0; i < row.size(); ++i) sums[i] += row[i] / static_cast<double>(grown_.plants.size());
        }
        grown_.steps.push_back(frame.step);
        grown_.times.push_back(frame.time);
        grown_.course.push_back(std::move(sums));
    }

    Needs needs_;
    PlantStatistics statistics_;
    LastFrame last_;
    Grown grown_;
};

std::vector<std::uint32_t> numbers_of(const Scene& scene, const std::string& name) {
    std::vector<std::uint32_t> numbers;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.plants.size(); ++i) {
        names.push_back(scene.plants[i].name);
        if (name.empty() || names.back() == name) numbers.push_back(static_cast<std::uint32_t>(i));
    }
    if (!numbers.empty()) return numbers;
    throw UserError(fmt::format("--plant {}: the scene has no plant of that name{}", name, did_you_mean(name, names)));
}

}  // namespace

bool Growth::is_define(const std::string& key) const {
    return !subject_.is_scene() && key.find('.') == std::string::npos;
}

Scene Growth::scene(std::span<const std::pair<std::string, double>> values) const {
    if (subject_.read) return subject_.read(values);
    auto texts = subject_.values;
    for (const auto& [name, value] : values) texts.emplace_back(name, fmt::format("{:.17g}", value));
    if (subject_.is_scene()) return read_scene(subject_.file, {texts, subject_.steps, subject_.seed});
    Defines defines;
    for (const auto& [name, value] : texts) {
        if (!is_define(name)) throw UserError(fmt::format("{}: a model alone has no such key", name));
        defines[name] = value;
    }
    Scene scene;
    scene.plants.push_back(plant_of_file(subject_.file, defines));
    scene.steps = subject_.steps;
    scene.seed = subject_.seed.value_or(0);
    return scene;
}

std::optional<Grown> Growth::grow(const Scene& scene, std::uint64_t number, const Needs& needs) const {
    Scene own = scene;
    own.seed += number;
    WorldOptions options;
    options.is_looked_at = false;
    World world(own, options);
    Keeper keeper(own.timeline, needs, numbers_of(world.scene(), subject_.plant));
    world.attach(keeper);
    world.start();
    while (!world.at_end() && world.modules() <= most_modules) world.step();
    if (!world.at_end()) return std::nullopt;
    return keeper.take();
}

std::vector<std::string> Growth::options(std::span<const std::pair<std::string, double>> values) const {
    std::vector<std::string> words;
    const auto add = [&](const std::string& key, const std::string& value) {
        words.insert(words.end(), {is_define(key) ? "--define" : "--set", key + "=" + value});
    };
    for (const auto& [key, value] : subject_.values) add(key, value);
    for (const auto& [key, value] : values) add(key, fmt::format("{:.6g}", value));
    if (subject_.steps) words.insert(words.end(), {"--steps", std::to_string(*subject_.steps)});
    return words;
}

}  // namespace espalier::study

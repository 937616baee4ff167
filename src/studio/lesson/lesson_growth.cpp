#include "studio/lesson/lesson_growth.h"

#include "espalier/simulation/world.h"

#include "base/text.h"
#include "studio/session/document_texts.h"
#include "timeline/measures/plant_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace espalier::studio {
namespace {

constexpr std::size_t most_modules = 1'000'000;  // a page on a phone grows no more

/// Keeps the rows of the plants at the last step.
class LastRows final : public Recorder {
public:
    explicit LastRows(const Settings& timeline) : statistics_(timeline) {}

    bool sees_every_step() const override { return true; }
    bool reads_plants_at(int, bool) const override { return true; }
    void record(const Frame& frame) override {
        if (frame.step == 0) statistics_.require_known(frame);
        columns_ = statistics_.columns(timeline::quantity_names(frame.plants.front()));
        rows_.clear();
        for (const PlantFrame& plant : frame.plants) rows_.emplace_back(plant.name, statistics_.of(plant));
        statistics_.end_step(frame);
    }
    void finish() override {}

    double value(const Goal& goal) const {
        const auto column = std::find(columns_.begin(), columns_.end(), goal.column);
        if (column == columns_.end()) {
            throw UserError(goal.place, fmt::format("statistics.csv has no column '{}'{}; it has {}", goal.column,
                                                    did_you_mean(goal.column, columns_), fmt::join(columns_, ", ")));
        }
        double sum = 0;
        int plants = 0;
        for (const auto& [name, row] : rows_) {
            if (!goal.plant.empty() && name != goal.plant) continue;
            sum += row[static_cast<std::size_t>(column - columns_.begin())];
            ++plants;
        }
        if (plants == 0) throw UserError(goal.place, fmt::format("there is no plant '{}'", goal.plant));
        return sum / plants;
    }

private:
    timeline::PlantStatistics statistics_;
    std::vector<std::string> columns_;
    std::vector<std::pair<std::string, std::vector<double>>> rows_;
};

std::vector<double> grown(const Lesson& lesson, const Scene& scene) {
    WorldOptions options;
    options.is_looked_at = false;
    World world(scene, options);
    LastRows rows(scene.timeline);
    world.attach(rows);
    world.start();
    while (!world.at_end()) {
        world.step();
        if (world.modules() <= most_modules) continue;
        throw UserError(fmt::format("{} grows to more than {} modules: give it fewer `steps`", lesson.grows.string(),
                                    most_modules));
    }
    std::vector<double> values;
    for (const Goal& goal : lesson.goals) values.push_back(rows.value(goal));
    return values;
}

bool all_reached(const Lesson& lesson, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!lesson.goals[i].is_reached(values[i])) return false;
    }
    return true;
}

void require_settings(const Lesson& lesson, const DocumentTexts& texts, const DocumentState& state) {
    std::vector<std::string> names;
    for (const auto& [name, number] : texts.numbers(state)) names.push_back(name);
    for (const auto& [name, place] : lesson.places) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        throw UserError(place, fmt::format("{} has no setting '{}'{}; it has {}", lesson.grows.filename().string(),
                                           name, did_you_mean(name, names), fmt::join(names, ", ")));
    }
}

}  // namespace

LessonOutcome try_lesson(const Lesson& lesson, const std::filesystem::path& library,
                         const std::function<Scene(const Opened&)>& read) {
    LessonOutcome outcome;
    DocumentState state{{lesson.grows, lesson.steps, lesson.seed}, {}};
    {
        const ReadLog log;
        outcome.at_first = grown(lesson, read(state.opened));
        outcome.files = log.files();
    }
    DocumentTexts texts(library);
    texts.learn(outcome.files);
    require_settings(lesson, texts, state);
    if (lesson.answer.empty()) return outcome;
    for (const auto& [name, value] : lesson.answer) texts.set_number(name, value, state);
    const ReadLog log(std::size_t(16) << 20, state.unsaved);
    outcome.with_answer = grown(lesson, read(state.opened));
    for (std::size_t i = 0; i < lesson.goals.size(); ++i) {
        const Goal& goal = lesson.goals[i];
        if (goal.is_reached(outcome.with_answer[i])) continue;
        throw UserError(goal.place, fmt::format("the answer does not reach this goal: {} is {} then", goal.column,
                                                format_general(outcome.with_answer[i])));
    }
    if (!lesson.goals.empty() && all_reached(lesson, outcome.at_first)) {
        throw UserError(lesson.goals.front().place, "all goals are reached before anything was changed");
    }
    return outcome;
}

}  // namespace espalier::studio

#include "app/look/studio_fitting.h"

#include "study/fit/fit.h"

#include <fmt/format.h>

#include <memory>

namespace espalier::app {
namespace {

studio::Measurement measurement_of(const std::filesystem::path& file) {
    const std::shared_ptr<study::Target> target = study::read_target(file);
    studio::Measurement measured;
    measured.read = target;
    for (const study::Statistic& one : target->statistics()) {
        measured.values.push_back({one.name, one.value, one.scale});
    }
    measured.notes = target->notes;
    study::MeasuredPlaces places = target->places();
    measured.points = std::move(places.points);
    measured.lines = std::move(places.lines);
    measured.has_scale = places.has_scale;
    const study::MeasuredCourse course = target->course();
    measured.course_is_by_step = course.is_by_step;
    for (const study::Observation& one : course.observations) {
        measured.course.push_back({one.column, one.at, one.value});
    }
    return measured;
}

study::Unknown unknown_of(const studio::SoughtNumber& sought) {
    return {sought.name, sought.start, sought.lowest, sought.highest,
            study::Prior::uniform(sought.lowest, sought.highest, sought.is_whole)};
}

std::vector<std::string> remarks_of(const study::FitResult& result) {
    std::vector<std::string> remarks;
    for (const study::Inseparable& pair : result.inseparable) remarks.push_back(result.in_words(pair));
    for (const study::FittedParameter& one : result.parameters) {
        if (!one.is_decided) remarks.push_back(fmt::format("what was measured does not decide {}", one.name));
    }
    return remarks;
}

studio::FitOutcome fit(const studio::FitOrder& order) {
    study::Subject subject;
    subject.read = order.scene;
    study::FitTask task{study::Growth(subject), {}, {}};
    for (const studio::SoughtNumber& sought : order.sought) task.unknowns.push_back(unknown_of(sought));
    for (const auto& read : order.measured) task.targets.push_back(std::static_pointer_cast<const study::Target>(read));
    const study::FitResult result = fit_least_squares(task, {0, order.search}, [&](const study::FitState& state) {
        order.progress({state.done, state.all, {state.best.begin(), state.best.end()}, state.residual});
    });
    studio::FitOutcome outcome;
    for (const study::FittedParameter& one : result.parameters) {
        outcome.numbers.push_back({one.value, one.error, one.is_decided});
    }
    for (const study::Prediction& one : result.predictions) outcome.predicted.push_back(one.middle);
    outcome.remarks = remarks_of(result);
    outcome.residual = result.residual;
    outcome.worlds = result.evaluations;
    return outcome;
}

}  // namespace

studio::Fitting studio_fitting() {
    return {measurement_of, fit};
}

}  // namespace espalier::app

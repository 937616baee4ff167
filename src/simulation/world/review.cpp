#include "simulation/world/review.h"

#include "base/excerpt.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace espalier::simulation {
namespace {

Diagnostic warning_at(const Place& place, std::string message, bool insistent) {
    return {Diagnostic::Severity::warning, place, std::move(message), source_line(place), insistent};
}

std::string file_of(const Model& model) {
    return model.path.empty() ? model.name : model.path.string();
}

/// "light" of "light" and "light.gradient".
std::string process_of_field(const std::string& field) {
    return field.substr(0, field.find('.'));
}

/// Processes that a recorder or another process names.
std::set<std::string> named_processes(const Scene& scene, const Fields& fields) {
    std::set<std::string> named;
    const auto note = [&](const Settings& table, const std::string& but) {
        for (const std::string& text : table.texts_below()) {
            if (const std::string name = process_of_field(text); name != but) named.insert(name);
        }
    };
    for (const auto& [name, table] : scene.environment.processes) note(table, name);
    note(scene.timeline, "");
    if (named.contains("all")) {
        for (const auto& field : fields.all()) named.insert(process_of_field(field.first));
    }
    return named;
}

bool inserts_queries(const Plant& plant) {
    return std::any_of(plant.insertions.begin(), plant.insertions.end(),
                       [](const Insertion& insertion) { return insertion.modules.find('?') != std::string::npos; });
}

/// Who asks for none of the steps, for fewer than the models have, or for others than a scene file, looks at the first.
bool is_cut_short(const Scene& scene, int steps) {
    const bool asked = std::any_of(scene.overrides.begin(), scene.overrides.end(),
                                   [](const auto& override) { return override.first == "simulation.steps"; });
    if (!asked || steps == 0 || !scene.path.empty()) return asked;
    std::set<const CompiledModel*> seen;
    return std::any_of(scene.plants.begin(), scene.plants.end(), [&](const Plant& plant) {
        return seen.insert(plant.model.get()).second && Derivation(plant.model).length() > steps;
    });
}

}  // namespace

void Review::warn(Diagnostic warning) {
    if (told_.insert(to_string(warning)).second) warnings.push_back(std::move(warning));
}

std::set<std::size_t> Review::may_be_asked(const Environment& environment) const {
    std::set<std::size_t> asked;
    for (const KnownModel& known : models_) asked.merge(environment.may_ask(*known.model));
    return asked;
}

// A process that answers nothing may still be there for others: its fields are recorded or read, or it measures organs.
void Review::warn_of_unasked(const Scene& scene, const Environment& environment,
                             const std::vector<std::string>& fields_read) {
    if (environment.size() == 0) return;
    if (std::any_of(scene.plants.begin(), scene.plants.end(), inserts_queries)) return;
    const std::set<std::size_t> asked = may_be_asked(environment);
    std::set<std::string> named = named_processes(scene, environment.fields());
    for (const std::string& field : fields_read) named.insert(process_of_field(field));
    for (std::size_t process = 0; process < environment.size(); ++process) {
        const std::string& name = environment.name(process);
        if (asked.contains(process) || named.contains(name) || environment.measures_organs(process)) continue;
        warn(warning_at(scene.environment.processes[process].second.place(),
                        fmt::format("no plant asks the process '{0}', and nothing reads or records its fields: a model "
                                    "asks it by ?{0}(...), after 'environment {0};'",
                                    name),
                        /*insistent=*/false));
    }
}

// Of all plants with a model: which of them meets it first does not matter.
void Review::warn_of_ignored() {
    for (KnownModel& known : models_) {
        const unsigned ignored = ignored_by_turtle(*known.symbols) & ~known.ignored;
        known.ignored |= ignored;
        for (Diagnostic& warning : warnings_of_ignored(ignored, *known.model)) warn(std::move(warning));
    }
}

void Review::warn_of_ignored_elsewhere(Ranks* ranks) {
    for (KnownModel& known : models_) {
        unsigned ignored = 0;
        for (const std::string& bits : from_all(ranks, std::to_string(known.ignored))) {
            ignored |= static_cast<unsigned>(std::stoul(bits));
        }
        for (Diagnostic& warning : warnings_of_ignored(ignored, *known.model)) warn(std::move(warning));
    }
}

void Review::review(const WholeRun& run) {
    if (is_cut_short(run.scene, run.steps)) return;
    warn_of_undrawn(run);
    warn_of_never_asked(run);
}

// Some plants of a stand may never germinate, so nothing must be drawn of any.
void Review::warn_of_undrawn(const WholeRun& run) {
    std::map<std::string, bool> shown;  // by file, in the same order on all ranks
    for (const GrowingPlant& plant : run.plants) {
        bool& is_file_shown = shown[file_of(plant.model())];
        is_file_shown = is_file_shown || plant.has_shown();
    }
    for (const auto& [file, is_shown_here] : shown) {
        if (any(run.ranks, !run.is_seen || is_shown_here)) continue;
        std::string message =
            run.steps == 0 ? "nothing is drawn of this model: the run has no steps. Is 'derivation length' missing?"
                           : fmt::format(
                                 "nothing was drawn of this model in {} step{}, and it asked no process: its string "
                                 "never held an F or another symbol that the turtle draws",
                                 run.steps, run.steps == 1 ? "" : "s");
        warn(warning_at({file}, std::move(message), /*insistent=*/true));
    }
}

void Review::warn_of_never_asked(const WholeRun& run) {
    for (const std::size_t process : may_be_asked(run.environment)) {
        if (any(run.ranks, run.environment.was_asked(process))) continue;
        warn(warning_at(run.scene.environment.processes[process].second.place(),
                        fmt::format("in {} step{} no plant has asked the process '{}'", run.steps,
                                    run.steps == 1 ? "" : "s", run.environment.name(process)),
                        /*insistent=*/false));
    }
}

}  // namespace espalier::simulation

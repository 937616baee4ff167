// One exchange: gather every question, let every process advance and answer, then write the answers.
#include "espalier/base/error.h"
#include "espalier/environment/communication.h"
#include "espalier/environment/environment.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace espalier {
namespace {

std::string described(const PlantView& plant, int step) {
    return fmt::format("step {}: plant {} (model {})", step, plant.plant, plant.model->name);
}

}  // namespace

void Environment::exchange(const WorldView& world, std::span<ModuleString*> strings) {
    assert(strings.size() == world.plants.size());
    gather(world);
    answer_turtle_queries();
    for (std::size_t process = 0; process < processes_.size(); ++process) consult(process, world);
    // Only now: the queries' parameters point into these strings.
    for (const Batch& batch : batches_) {
        for (std::size_t i = 0; i < batch.queries.size(); ++i) {
            Column<double>& parameters = strings[batch.queries[i].plant]->parameters;
            std::copy(batch.answers[i].begin(), batch.answers[i].end(),
                      parameters.begin() + static_cast<std::ptrdiff_t>(batch.queries[i].parameters_at));
        }
    }
}

// Plant order, then string order; answers begin as copies of the parameters.
void Environment::gather(const WorldView& world) {
    for (Batch& batch : batches_) {
        batch.queries.clear();
        batch.values.clear();
        batch.answers.clear();
    }
    for (const PlantView& plant : world.plants) gather(plant, world.step);
    for (Batch& batch : batches_) {
        double* next = batch.values.data();
        for (const Query& query : batch.queries) {
            batch.answers.emplace_back(next, query.parameters.size());
            next += query.parameters.size();
        }
    }
    for (std::size_t process = 0; process < processes_.size(); ++process) send(process);
}

void Environment::gather(const PlantView& plant, int step) {
    by_name_.clear();
    for (const std::string& name : plant.model->processes) by_name_.push_back(find(name));
    for (const Query& asked : plant.interpretation->queries) {
        const std::optional<std::size_t> process = process_for(asked, plant, step);
        if (!process) continue;
        Batch& batch = batches_[*process];
        Query& query = batch.queries.emplace_back(asked);
        if (is_routed(query)) {
            query.parameters = query.parameters.subspan(1);
            ++query.parameters_at;
        }
        if (*process != batches_end()) require_sound(query, *process, plant, step);
        batch.values.insert(batch.values.end(), query.parameters.begin(), query.parameters.end());
    }
}

// Nothing for a query that is to stay as it is.
std::optional<std::size_t> Environment::process_for(const Query& query, const PlantView& plant, int step) const {
    if (query.kind != QueryKind::communication) return batches_end();
    const bool unnamed = query.process < 0;
    if (is_routed(query)) {
        const double number = query.parameters[0];
        if (!(number >= 0 && number < static_cast<double>(processes_.size()))) {
            throw RunError(fmt::format("{} asks ?E({}, ...), but the processes are numbered from 0 to {}",
                                       described(plant, step), number, processes_.size() - 1));
        }
        return static_cast<std::size_t>(number);
    }
    const std::optional<std::size_t> process = unnamed ? default_ : by_name_[static_cast<std::size_t>(query.process)];
    if (process || keeps_unanswered_) return process;
    const std::string name = unnamed ? "E" : plant.model->processes[static_cast<std::size_t>(query.process)];
    throw UserError(fmt::format("plant {} (model {}) asks ?{}, and no process of the scene answers that", plant.plant,
                                plant.model->name, name));
}

bool Environment::is_routed(const Query& query) const {
    return routed_ && query.kind == QueryKind::communication && query.process < 0 && !query.parameters.empty();
}

// Lets the process see the questions as its communication carries them.
void Environment::send(std::size_t process) {
    const Communication& communication = communications_[process];
    Batch& batch = batches_[process];
    if (communication.changes_queries()) {
        for (Query& query : batch.queries) communication.send(query);
    }
    if (!communication.rounds_parameters()) return;
    batch.sent.resize(batch.values.size());
    for (std::size_t i = 0; i < batch.values.size(); ++i) batch.sent[i] = communication.rounded(batch.values[i]);
    const double* next = batch.sent.data();
    for (Query& query : batch.queries) {
        query.parameters = {next, query.parameters.size()};
        next += query.parameters.size();
    }
}

// A module may be written by a rule that `require_answers` has not seen, and a NaN may come out of any expression.
void Environment::require_sound(const Query& query, std::size_t process, const PlantView& plant, int step) const {
    const auto [fewest, most] = arities_[process];
    const auto given = static_cast<int>(query.parameters.size());
    if (given < fewest || given > most) {
        throw UserError(fmt::format("{} asks process '{}' ({}) with {} parameters, which takes {} to {}",
                                    described(plant, step), names_[process], kinds_[process], given, fewest, most));
    }
    for (const double value : query.parameters) {
        if (std::isfinite(value)) continue;
        throw RunError(fmt::format("{} asks process '{}' ({}) with the parameter {}", described(plant, step),
                                   names_[process], kinds_[process], value));
    }
}

void Environment::answer_turtle_queries() {
    const Batch& batch = batches_[batches_end()];
    for (std::size_t i = 0; i < batch.queries.size(); ++i) answer_from_turtle(batch.queries[i], batch.answers[i]);
}

void Environment::consult(std::size_t process, const WorldView& world) {
    Batch& batch = batches_[process];
    try {
        processes_[process]->advance(world, batch.queries, fields_);
        processes_[process]->answer(world, batch.queries, batch.answers, fields_);
    } catch (const UserError&) {
        throw;
    } catch (const std::exception& error) {
        throw RunError(
            fmt::format("step {}: process '{}' ({}): {}", world.step, names_[process], kinds_[process], error.what()));
    }
    require_finite(process, world);
    round_answers(process);
}

// What a process left alone keeps all its digits.
void Environment::round_answers(std::size_t process) {
    const Communication& communication = communications_[process];
    if (!communication.rounds_parameters()) return;
    Batch& batch = batches_[process];
    for (std::size_t i = 0; i < batch.queries.size(); ++i) {
        const std::span<const double> sent = batch.queries[i].parameters;
        for (std::size_t k = 0; k < sent.size(); ++k) {
            const double told = communication.rounded(batch.answers[i][k]);
            if (told != sent[k]) batch.answers[i][k] = told;
        }
    }
}

void Environment::require_finite(std::size_t process, const WorldView& world) const {
    const Batch& batch = batches_[process];
    for (std::size_t i = 0; i < batch.answers.size(); ++i) {
        for (const double value : batch.answers[i]) {
            if (std::isfinite(value)) continue;
            throw RunError(fmt::format("{}: process '{}' ({}) answers {}",
                                       described(world.plants[batch.queries[i].plant], world.step), names_[process],
                                       kinds_[process], value));
        }
    }
}

}  // namespace espalier

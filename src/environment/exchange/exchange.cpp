// One exchange: gather every question, let every process advance and answer, then write the answers.
#include "espalier/base/error.h"
#include "espalier/environment/environment.h"

#include "base/parallel.h"
#include "base/reason.h"
#include "environment/exchange/answering.h"
#include "environment/exchange/communication.h"
#include "turtle/asking.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>

namespace espalier::environment {
namespace {

constexpr std::size_t block = 4096;  // queries: less is not worth a second thread

std::size_t blocks(std::size_t queries) {
    return (queries + block - 1) / block;
}

/// Calls work(begin, end) for one block of queries after the other, or side by side.
template <class Work>
void for_blocks(std::size_t queries, const Work& work) {
    if (queries == 0) return;
    if (queries <= block) return work(std::size_t{0}, queries);
    for_in_parallel(std::size_t{0}, blocks(queries),
                    [&](std::size_t i) { work(i * block, std::min(queries, (i + 1) * block)); });
}

std::string described(const PlantView& plant, int step) {
    return fmt::format("step {}: plant {} (model {})", step, plant.plant, plant.model->name);
}

// A module may be written by a rule that `require_answers` has not seen, and a NaN may come out of any expression.
bool is_sound(const Query& query, std::pair<int, int> arity) {
    const auto given = static_cast<int>(query.parameters.size());
    bool sound = given >= arity.first && given <= arity.second;
    for (const double value : query.parameters) sound = sound && std::isfinite(value);
    return sound;
}

void write_turtle_answers(const WorldView& world, std::span<ModuleString*> strings) {
    for (const PlantView& plant : world.plants) {
        if (!plant.asks) continue;
        const std::span<const TurtleAnswer> answers = plant.interpretation->answers;
        const std::span<const TurtleDirection> directions = plant.interpretation->directions;
        ModuleString& string = *strings[plant.plant];
        for_blocks(answers.size(), [&](std::size_t begin, std::size_t end) {
            write_turtle_answers(answers.subspan(begin, end - begin), {}, string);
        });
        for_blocks(directions.size(), [&](std::size_t begin, std::size_t end) {
            write_turtle_answers({}, directions.subspan(begin, end - begin), string);
        });
    }
}

}  // namespace

void Environment::exchange(const WorldView& world, std::span<ModuleString*> strings) {
    assert(strings.size() == world.plants.size());
    if (TakesParts* taker = world.waiting ? taker_of_parts() : nullptr) {
        exchange_in_parts(*taker, world, strings);
    } else {
        gather(world);
        for (std::size_t process = 0; process < processes_.size(); ++process) {
            if (!batches_[process].queries.empty()) asked_[process] = true;
            consult(process, world);
        }
        // Only now: the queries' parameters point into these strings.
        for (const Batch& batch : batches_) write_answers(batch, strings);
    }
    write_defaults(strings);
    write_turtle_answers(world, strings);
    // Until the next exchange others need the room.
    if (world.waiting) {
        for (Batch& batch : batches_) batch.copies = QueryColumn();
    }
    note_memory();
}

// The only process, where its communication leaves the queries as they are.
TakesParts* Environment::taker_of_parts() const {
    if (processes_.size() != 1 || routed_) return nullptr;
    const Communication& communication = communications_.front();
    if (communication.changes_queries() || communication.rounds_parameters()) return nullptr;
    return processes_.front()->in_parts();
}

void Environment::exchange_in_parts(TakesParts& taker, const WorldView& world, std::span<ModuleString*> strings) {
    const Answering::Turn turn(*answering_, names_.front());
    have_work(0, world.step, [&] { taker.begin(); });
    for_parts(world, [&](Batch& batch) {
        asked_.front() = true;
        have_work(0, world.step, [&] { taker.take(batch.queries); });
    });
    have_work(0, world.step, [&] { taker.settle(); });
    for_parts(world, [&](Batch& batch) {
        begin_answers(batch);
        have_work(0, world.step, [&] { taker.answer_part(batch.queries, batch.answers); });
        require_finite(0, world);
        // What is asked later is of other plants.
        write_answers(batch, strings);
    });
}

// Calls use(plant, queries) in plant order. All threads fetch what waits, of some plants at a time.
template <class Use>
void Environment::for_plants(const WorldView& world, const Use& use) const {
    if (!world.waiting) {
        for (const PlantView& plant : world.plants) use(plant, plant.interpretation->queries);
        return;
    }
    constexpr std::size_t most_plants = 64, most_queries = 1 << 13;
    const std::size_t of_plant = world.waiting->count / std::max<std::size_t>(1, world.plants.size()) + 1;
    const std::size_t some = std::clamp<std::size_t>(most_queries / of_plant, 1, most_plants);
    std::vector<QueryColumn> rooms(some);
    std::vector<std::span<const Query>> queries(some);
    for (std::size_t first = 0; first < world.plants.size(); first += some) {
        const std::span plants = world.plants.subspan(first, std::min(some, world.plants.size() - first));
        for_in_parallel(std::size_t{0}, plants.size(),
                        [&](std::size_t i) { queries[i] = world.waiting->of(plants[i].plant, rooms[i]); });
        for (std::size_t i = 0; i < plants.size(); ++i) use(plants[i], queries[i]);
    }
}

// Calls use(batch) for the queries of some plants after the other, in plant order, then string order.
template <class Use>
void Environment::for_parts(const WorldView& world, const Use& use) {
    constexpr std::size_t part = 1 << 12;  // queries: 0.75 MB, which the second-level cache holds
    forget();
    Batch& batch = batches_.front();
    const auto use_some = [&] {
        batch.queries = batch.copies;
        batch.parameters.clear();
        use(batch);
        batch.copies.clear();
    };
    for_plants(world, [&](const PlantView& plant, std::span<const Query> queries) {
        gather(plant, queries, world);
        if (batch.copies.size() >= part) use_some();
    });
    if (!batch.copies.empty()) use_some();
}

void Environment::forget() {
    for (Batch& batch : batches_) {
        batch.copies.clear();
        batch.places.clear();
        batch.queries = {};
        batch.parameters.clear();
    }
    defaults_.clear();
    last_model_ = nullptr;
}

// Plant order, then string order.
void Environment::gather(const WorldView& world) {
    forget();
    if (world.waiting || !borrow(world)) {
        make_room(world);
        for_plants(world,
                   [&](const PlantView& plant, std::span<const Query> queries) { gather(plant, queries, world); });
        for (Batch& batch : batches_) batch.queries = copies(world) ? Queries(batch.copies) : Queries(batch.places);
    }
    for (std::size_t process = 0; process < processes_.size(); ++process) {
        begin_answers(batches_[process]);
        send(process);
    }
}

// Questions of plants that are not in memory last until the next plant's come, and routed ones lose a parameter.
bool Environment::copies(const WorldView& world) const {
    return world.waiting || routed_;
}

// Room for the questions of many plants at once: to double it would hold all of them twice for a moment.
void Environment::make_room(const WorldView& world) {
    if (!world.waiting || processes_.size() != 1) return;
    QueryColumn& copies = batches_.front().copies;
    if (copies.capacity() >= world.waiting->count) return;
    copies = QueryColumn();
    copies.reserve(world.waiting->count + world.waiting->count / 8);
}

// Where one plant asks nothing but one process, the process reads the questions where they are, unless its
// communication changes them.
bool Environment::borrow(const WorldView& world) {
    const PlantView* only = nullptr;
    for (const PlantView& plant : world.plants) {
        if (!plant.asks || plant.interpretation->queries.empty()) continue;
        if (only != nullptr) return false;
        only = &plant;
    }
    if (only == nullptr) return true;
    const std::span<const Query> queries = only->interpretation->queries;
    const Query& first = queries.front();
    if (routed_) return false;
    name_processes(*only);
    const std::optional<std::size_t> process = process_for(first, *only, world.step);
    if (!process) return false;
    const std::pair<int, int> arity = arities_[*process];
    Batch& batch = batches_[*process];
    batch.parameters.resize(blocks(queries.size()));
    std::atomic<bool> alike = true;
    for_blocks(queries.size(), [&](std::size_t begin, std::size_t end) {
        std::size_t parameters = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Query& query = queries[i];
            if (query.process != first.process || !is_sound(query, arity)) alike = false;
            parameters += query.parameters.size();
        }
        batch.parameters[begin / block] = parameters;
    });
    if (alike)
        batch.queries = queries;
    else
        batch.parameters.clear();
    return alike;
}

// Many plants share a model.
void Environment::name_processes(const PlantView& plant) {
    if (plant.model == last_model_) return;
    last_model_ = plant.model;
    by_name_.clear();
    for (const std::string& name : plant.model->processes) by_name_.push_back(find(name));
}

void Environment::gather(const PlantView& plant, std::span<const Query> queries, const WorldView& world) {
    if (queries.empty()) return;
    name_processes(plant);
    for (const Query& asked : queries) {
        const std::optional<std::size_t> process = process_for(asked, plant, world.step);
        if (!process) {
            const std::span<const double> answer = turtle::default_answer(*plant.model, asked);
            if (!answer.empty()) defaults_.push_back({asked.plant, asked.parameters_at, answer});
            continue;
        }
        const Query& query = copies(world) ? copy(asked, batches_[*process]) : asked;
        if (!copies(world)) batches_[*process].places.push_back(&asked);
        if (!is_sound(query, arities_[*process])) throw_unsound(query, *process, plant, world.step);
    }
}

const Query& Environment::copy(const Query& asked, Batch& batch) const {
    Query& query = batch.copies.emplace_back(asked);
    if (!is_routed(query)) return query;
    query.parameters = query.parameters.subspan(1);
    ++query.parameters_at;
    return query;
}

// Answers begin as copies of the parameters.
void Environment::begin_answers(Batch& batch) {
    const Queries queries = batch.queries;
    if (batch.parameters.empty()) {
        batch.parameters.resize(blocks(queries.size()));
        for_blocks(queries.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) batch.parameters[begin / block] += queries[i].parameters.size();
        });
    }
    std::vector<std::size_t> begins(batch.parameters.size());
    std::exclusive_scan(batch.parameters.begin(), batch.parameters.end(), begins.begin(), std::size_t{0});
    batch.values.resize(std::reduce(batch.parameters.begin(), batch.parameters.end()));
    batch.answers.resize(queries.size());
    for_blocks(queries.size(), [&](std::size_t begin, std::size_t end) {
        double* next = batch.values.data() + begins[begin / block];
        for (std::size_t i = begin; i < end; ++i) {
            const std::span<const double> parameters = queries[i].parameters;
            batch.answers[i] = {next, parameters.size()};
            for (const double parameter : parameters) *next++ = parameter;
        }
    });
}

void Environment::write_answers(const Batch& batch, std::span<ModuleString*> strings) {
    for_blocks(batch.queries.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            double* next = strings[batch.queries[i].plant]->parameters.data() + batch.queries[i].parameters_at;
            for (const double answer : batch.answers[i]) *next++ = answer;
        }
    });
}

void Environment::write_defaults(std::span<ModuleString*> strings) const {
    for (const DefaultAnswer& answer : defaults_) {
        std::copy(answer.values.begin(), answer.values.end(),
                  strings[answer.plant]->parameters.data() + answer.parameters_at);
    }
}

std::optional<std::size_t> Environment::process_of(const Query& query, const PlantView& plant, int step) {
    name_processes(plant);
    return process_for(query, plant, step);
}

// Nothing for a query that is to stay as it is.
std::optional<std::size_t> Environment::process_for(const Query& query, const PlantView& plant, int step) const {
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
    if (process || keeps_unanswered_ || !turtle::default_answer(*plant.model, query).empty()) return process;
    const std::string name = unnamed ? "E" : plant.model->processes[static_cast<std::size_t>(query.process)];
    throw UserError(fmt::format("plant {} (model {}) asks ?{}, and no process of the scene answers that", plant.plant,
                                plant.model->name, name));
}

bool Environment::is_routed(const Query& query) const {
    return routed_ && query.process < 0 && !query.parameters.empty();
}

// Lets the process see the questions as its communication carries them.
void Environment::send(std::size_t process) {
    const Communication& communication = communications_[process];
    Batch& batch = batches_[process];
    if (!communication.changes_queries() && !communication.rounds_parameters()) return;
    // Not new memory in every step in which there are more questions.
    if (batch.copies.capacity() < batch.queries.size()) batch.copies.reserve(2 * batch.queries.size());
    batch.copies.resize(batch.queries.size());
    batch.sent.resize(batch.values.size());
    for_blocks(batch.queries.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Query query = batch.queries[i];
            communication.send(query);
            const Answer exact = batch.answers[i];
            double* const sent = batch.sent.data() + (exact.data() - batch.values.data());
            for (std::size_t k = 0; k < exact.size(); ++k) sent[k] = communication.rounded(exact[k]);
            query.parameters = {sent, exact.size()};
            batch.copies[i] = query;
        }
    });
    batch.queries = batch.copies;
}

void Environment::throw_unsound(const Query& query, std::size_t process, const PlantView& plant, int step) const {
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

void Environment::consult(std::size_t process, const WorldView& world) {
    Batch& batch = batches_[process];
    const Answering::Turn turn(*answering_, names_[process]);
    WorldView seen = world;
    seen.environment = this;
    have_work(process, world.step, [&] {
        processes_[process]->advance(seen, batch.queries, fields_);
        processes_[process]->answer(seen, batch.queries, batch.answers, fields_);
    });
    require_finite(process, world);
    round_answers(process);
}

// What goes wrong in a process is said with its name.
template <class Work>
void Environment::have_work(std::size_t process, int step, const Work& work) {
    try {
        work();
    } catch (const UserError&) {
        throw;
    } catch (const std::exception& error) {
        throw RunError(
            fmt::format("step {}: process '{}' ({}): {}", step, names_[process], kinds_[process], reason_of(error)));
    }
}

// What a process left alone keeps all its digits.
void Environment::round_answers(std::size_t process) {
    const Communication& communication = communications_[process];
    if (!communication.rounds_parameters()) return;
    Batch& batch = batches_[process];
    for_blocks(batch.queries.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::span<const double> sent = batch.queries[i].parameters;
            for (std::size_t k = 0; k < sent.size(); ++k) {
                const double received = communication.rounded(batch.answers[i][k]);
                if (received != sent[k]) batch.answers[i][k] = received;
            }
        }
    });
}

void Environment::require_finite(std::size_t process, const WorldView& world) const {
    const Batch& batch = batches_[process];
    bool finite = true;
    for (const double value : batch.values) finite = finite & std::isfinite(value);
    for (std::size_t i = 0; !finite && i < batch.answers.size(); ++i) {
        for (const double value : batch.answers[i]) {
            if (std::isfinite(value)) continue;
            throw RunError(fmt::format("{}: process '{}' ({}) answers {}",
                                       described(world.plants[batch.queries[i].plant], world.step), names_[process],
                                       kinds_[process], value));
        }
    }
}

}  // namespace espalier::environment

#include "simulation/spread/spread.h"

#include "espalier/base/error.h"

#include "base/bytes.h"
#include "environment/space/neighbours/reach.h"
#include "simulation/plant/plant_bytes.h"
#include "simulation/spread/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

namespace espalier::simulation {
namespace {

/// Says whether the load of ranks differs so much that moving plants pays.
bool is_lopsided(const std::vector<double>& loads) {
    constexpr double worth_moving = 1.3;
    const double sum = std::accumulate(loads.begin(), loads.end(), 0.0);
    return *std::max_element(loads.begin(), loads.end()) > worth_moving * sum / static_cast<double>(loads.size());
}

/// Calls take(number, in) for each plant of which other ranks sent something; it reads what follows the number.
template <class Take>
void for_received(const std::vector<std::string>& received, const Take& take) {
    for (const std::string& bytes : received) {
        std::istringstream in(bytes);
        while (in.peek() != std::istringstream::traits_type::eof()) {
            const auto number = get<std::uint32_t>(in);
            take(number, in);
        }
    }
}

// The fields of a process are named "light" and "light.shade".
bool is_field_of(const std::string& field, const std::string& process) {
    return field == process || field.starts_with(process + ".");
}

Spreading spreading_of(const Environment& environment, std::size_t process, const std::vector<std::string>& fields) {
    const Spreading spreading = environment.spreading(process);
    const std::string& name = environment.name(process);
    if (spreading == Spreading::refused) {
        throw UserError(fmt::format("process '{}' cannot be spread over ranks; start the run without mpiexec", name));
    }
    // Turtles read fields anywhere.
    const bool is_read =
        std::any_of(fields.begin(), fields.end(), [&](const std::string& field) { return is_field_of(field, name); });
    return spreading == Spreading::reach && is_read ? Spreading::queries : spreading;
}

}  // namespace

Spread::Spread(Ranks& ranks, const Scene& scene, const Environment& environment,
               const std::vector<std::string>& fields_read)
    : ranks_(ranks), blocks_(blocks_of(scene)), statistics_(scene.plants.size()) {
    rank_of_ = ranks_of(blocks_, std::vector<double>(blocks_.size(), 1.0), ranks.count());
    for (std::size_t process = 0; process < environment.size(); ++process) {
        spreadings_.push_back(spreading_of(environment, process, fields_read));
        sends_plants_ = sends_plants_ || spreadings_.back() == Spreading::plants;
    }
}

void Spread::mark(std::span<GrowingPlant> plants) const {
    for (GrowingPlant& plant : plants) plant.is_local = rank_of_[plant.number] == ranks_.rank();
}

std::vector<std::string> Spread::notes(const Environment& environment) const {
    std::vector<std::string> notes;
    for (std::size_t process = 0; process < spreadings_.size(); ++process) {
        if (spreadings_[process] == Spreading::reach) continue;
        notes.push_back(fmt::format("process '{}' is not divided among the ranks: each of them {}",
                                    environment.name(process),
                                    spreadings_[process] == Spreading::plants ? "holds all plants while it answers"
                                                                              : "answers the queries of all plants"));
    }
    return notes;
}

std::vector<std::string> Spread::traded(const std::function<void(std::ostream& out, int rank)>& write) {
    std::vector<std::string> to_each(static_cast<std::size_t>(ranks_.count()));
    together(&ranks_, [&] {
        for (int rank = 0; rank < ranks_.count(); ++rank) {
            if (rank == ranks_.rank()) continue;
            std::ostringstream out;
            write(out, rank);
            to_each[static_cast<std::size_t>(rank)] = std::move(out).str();
        }
    });
    return ranks_.trade(std::move(to_each));
}

Spread::Asked Spread::asked(PlantSet& plants, Environment& environment, int step) const {
    Asked asked;
    asked.reaches.resize(plants.all().size());
    asked.goes_everywhere.resize(plants.all().size());
    std::map<std::size_t, std::vector<Box>> of_blocks;
    QueryColumn room;
    for (const GrowingPlant& plant : plants.all()) {
        if (!plant.is_local) continue;
        std::vector<Box>& places = of_blocks[blocks_[plant.number]];
        std::vector<Box>& reaches = asked.reaches[plant.number];
        places.resize(spreadings_.size());
        reaches.resize(spreadings_.size());
        const PlantView view = plant.view();
        for (const Query& query : plants.queries_of(plant, room)) {
            const std::optional<std::size_t> process = environment.process_of(query, view, step);
            if (!process) continue;
            places[*process].add(query.pose.position);
            if (spreadings_[*process] == Spreading::reach)
                reaches[*process].add(environment.reach(*process, query));
            else
                asked.goes_everywhere[plant.number] = true;
        }
    }
    for (auto& block : of_blocks) asked.places.push_back(std::move(block.second));
    return asked;
}

std::vector<Spread::Places> Spread::places_of_all(const Places& own) {
    std::ostringstream out;
    put(out, static_cast<std::uint64_t>(own.size()));
    for (const std::vector<Box>& boxes : own) put_column(out, boxes);
    std::vector<Places> all;
    for (const std::string& bytes : from_all(&ranks_, out.str())) {
        std::istringstream in(bytes);
        Places& places = all.emplace_back(get<std::uint64_t>(in));
        for (std::vector<Box>& boxes : places) get_column(in, boxes);
    }
    return all;
}

// Most plants are far from the blocks of another rank: their queries need not be tried one by one.
bool Spread::may_matter(const GrowingPlant& plant, const Asked& asked, const Places& places) const {
    if (asked.goes_everywhere[plant.number]) return true;
    const std::vector<Box>& reaches = asked.reaches[plant.number];
    return std::any_of(places.begin(), places.end(), [&](const std::vector<Box>& boxes) {
        for (std::size_t process = 0; process < reaches.size(); ++process) {
            if (overlap(reaches[process], boxes[process])) return true;
        }
        return false;
    });
}

void Spread::select(const GrowingPlant& plant, std::span<const Query> queries, Environment& environment, int step,
                    const Places& places, bool sees_all, std::vector<const Query*>& selected) const {
    selected.clear();
    const PlantView view = plant.view();
    for (const Query& query : queries) {
        const std::optional<std::size_t> process = environment.process_of(query, view, step);
        if (!process) continue;
        bool is_needed = sees_all || spreadings_[*process] != Spreading::reach;
        if (!is_needed) {
            const Box reach = environment.reach(*process, query);
            is_needed = !reach.empty() && std::any_of(places.begin(), places.end(), [&](const std::vector<Box>& boxes) {
                return overlap(reach, boxes[*process]);
            });
        }
        if (is_needed) selected.push_back(&query);
    }
}

void Spread::put_shared(std::ostream& out, PlantSet& plants, Environment& environment, int step, const Asked& asked,
                        const Places& places, bool sees_all) const {
    std::vector<const Query*> selected;
    QueryColumn room;
    for (const GrowingPlant& plant : plants.all()) {
        if (!plant.is_local) continue;
        if (sends_plants_) {
            put(out, plant.number);
            put_plant(out, plant);
            continue;
        }
        if (!sees_all && !may_matter(plant, asked, places)) continue;
        select(plant, plants.queries_of(plant, room), environment, step, places, sees_all, selected);
        if (selected.empty()) continue;
        put(out, plant.number);
        put_queries(out, selected);
    }
}

void Spread::share(PlantSet& plants, Environment& environment, int step, bool first_sees_all) {
    const std::span<GrowingPlant> all = plants.all();
    forget(all);
    Asked own;
    together(&ranks_, [&] { own = asked(plants, environment, step); });
    const std::vector<Places> places = places_of_all(own.places);
    const std::vector<std::string> received = traded([&](std::ostream& out, int rank) {
        put_shared(out, plants, environment, step, own, places[static_cast<std::size_t>(rank)],
                   first_sees_all && rank == 0);
    });
    for_received(received, [&](std::uint32_t number, std::istream& in) {
        if (sends_plants_)
            get_plant(in, all[number], step);
        else
            get_queries(in, all[number]);
    });
}

void Spread::distribute(PlantSet& plants, std::span<const PlantSet::Part> to_each, const Environment& environment,
                        int step) {
    const auto part_of = [&](int rank) {
        const auto at = static_cast<std::size_t>(rank);
        return at < to_each.size() ? to_each[at] : PlantSet::Part();
    };
    const std::vector<std::string> received = traded([&](std::ostream& out, int rank) {
        const PlantSet::Part part = part_of(rank);
        plants.show(std::span(&part, 1), environment, step);
        for (const GrowingPlant& plant : part) {
            if (!plant.is_local) continue;
            put(out, plant.number);
            std::vector<double> values;
            for (const Quantity& quantity : environment.statistics(plant.number)) values.push_back(quantity.value);
            put_column(out, values);
            if (!sends_plants_) put_plant(out, plant);
        }
        plants.hide();
    });
    const PlantSet::Part own = part_of(ranks_.rank());
    for_received(received, [&](std::uint32_t number, std::istream& in) {
        std::vector<double> values;
        get_column(in, values);
        statistics_[number] = environment.statistics(number);
        for (std::size_t i = 0; i < values.size(); ++i) statistics_[number].at(i).value = values[i];
        if (!sends_plants_) get_plant(in, own[number - own.front().number], step);
    });
}

std::vector<Quantity> Spread::statistics(const Environment& environment, const GrowingPlant& plant) const {
    return plant.is_local ? environment.statistics(plant.number) : statistics_[plant.number];
}

void Spread::forget(std::span<GrowingPlant> plants) {
    for (GrowingPlant& plant : plants) {
        statistics_[plant.number] = {};
        if (plant.is_local || (plant.string->empty() && !plant.interpretation->asks())) continue;
        plant.free_received();
    }
}

std::vector<std::string> Spread::states(PlantSet& plants, PlantSet::Part part) {
    const std::vector<std::string> received = traded([&](std::ostream& out, int rank) {
        if (rank != 0) return;
        for (GrowingPlant& plant : part) {
            if (!plant.is_local) continue;
            std::ostringstream state;
            plants.put_state(state, plant);
            put(out, plant.number);
            put_text(out, state.str());
        }
    });
    std::vector<std::string> states(part.size());
    for_received(received, [&](std::uint32_t number, std::istream& in) {
        states[number - part.front().number] = get_text(in, std::numeric_limits<std::uint64_t>::max());
    });
    return states;
}

// Seconds that each plant takes: those of its rank, by the modules.
std::vector<double> Spread::weights_of(std::span<const GrowingPlant> plants, double seconds) {
    double modules = 0;
    for (const GrowingPlant& plant : plants) {
        if (plant.is_local) modules += static_cast<double>(plant.modules);
    }
    return of_each(plants, [&](const GrowingPlant& plant) {
        return seconds * static_cast<double>(plant.modules) / std::max(modules, 1.0);
    });
}

std::vector<double> Spread::of_each(std::span<const GrowingPlant> plants,
                                    const std::function<double(const GrowingPlant&)>& of) {
    std::ostringstream out;
    for (const GrowingPlant& plant : plants) {
        if (!plant.is_local) continue;
        put(out, plant.number);
        put(out, of(plant));
    }
    std::vector<double> values(plants.size());
    for_received(from_all(&ranks_, out.str()), [&](std::uint32_t number, std::istream& in) {
        values[number - plants.front().number] = get<double>(in);
    });
    return values;
}

void Spread::balance(PlantSet& plants, double seconds, std::size_t memory) {
    const std::vector<double> weights = weights_of(plants.all(), seconds);
    const auto loads = [&](const std::vector<int>& rank_of) {
        std::vector<double> sums(static_cast<std::size_t>(ranks_.count()));
        for (std::size_t plant = 0; plant < weights.size(); ++plant) {
            sums[static_cast<std::size_t>(rank_of[plant])] += weights[plant];
        }
        return sums;
    };
    const auto heaviest = [&](const std::vector<int>& rank_of) {
        const std::vector<double> all = loads(rank_of);
        return *std::max_element(all.begin(), all.end());
    };
    if (!is_lopsided(loads(rank_of_))) return;
    const std::vector<int> better = ranks_of(blocks_, weights, ranks_.count());
    if (heaviest(better) < heaviest(rank_of_)) move(plants, better, memory);
}

void Spread::move(PlantSet& plants, const std::vector<int>& to, std::size_t memory) {
    const std::span<GrowingPlant> all = plants.all();
    const std::vector<std::string> received = traded([&](std::ostream& out, int rank) {
        for (GrowingPlant& plant : all) {
            if (!plant.is_local || to[plant.number] != rank) continue;
            put(out, plant.number);
            plants.put_state(out, plant);
        }
    });
    rank_of_ = to;
    forget(all);
    for (GrowingPlant& plant : all) {
        if (plant.is_local && to[plant.number] != ranks_.rank()) plant.become_remote();
    }
    together(&ranks_, [&] {
        for_received(received, [&](std::uint32_t number, std::istream& in) {
            get_state(in, all[number], memory);
            all[number].is_local = true;
            plants.take_restored(all[number]);
        });
    });
}

}  // namespace espalier::simulation

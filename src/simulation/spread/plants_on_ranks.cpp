#include "simulation/spread/plants_on_ranks.h"

#include <algorithm>
#include <string>
#include <utility>

namespace espalier::simulation {

PlantsOnRanks::PlantsOnRanks(std::unique_ptr<PlantSet> plants, std::unique_ptr<Spread> spread, MemoryBudget& memory)
    : plants_(std::move(plants)), spread_(std::move(spread)), memory_(memory) {
    spread_->mark(all());
}

void PlantsOnRanks::begin_growth(double busy, int step) {
    plants_->begin_growth(busy, step);
    spread_->forget(all());
    if (!std::exchange(is_saved_, false)) return;
    gathered_.reset();
    spread_->balance(*plants_, busy - std::exchange(busy_before_, busy), memory_.bytes());
    together(&spread_->ranks(), [&] { memory_.check_drawn(all(), step); });
}

// A rank with fewer plants has nothing to do in the last ones.
std::vector<PlantSet::Part> PlantsOnRanks::parts() {
    std::vector<Part> parts = plants_->parts();
    std::size_t most = 0;
    for (const std::string& count : from_all(&spread_->ranks(), std::to_string(parts.size()))) {
        most = std::max<std::size_t>(most, std::stoull(count));
    }
    parts.resize(most);
    return parts;
}

void PlantsOnRanks::place_births(std::uint64_t& births, bool is_recorded) {
    if (!is_recorded) return;
    const std::vector<double> born =
        spread_->of_each(all(), [](const GrowingPlant& plant) { return static_cast<double>(plant.born); });
    for (GrowingPlant& plant : all()) {
        plant.births_before = births;
        births += static_cast<std::uint64_t>(born[plant.number]);
    }
}

void PlantsOnRanks::share(Environment& environment, int step, bool first_sees_all) {
    spread_->share(*plants_, environment, step, first_sees_all);
    together(&spread_->ranks(), [&] { memory_.check_received(all(), step); });
}

std::vector<PlantSet::Part> PlantsOnRanks::frame_parts() {
    const std::size_t plants = all().size(), count = std::min(writers() * this->parts().size(), plants);
    std::vector<Part> parts;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = plants * i / count, end = plants * (i + 1) / count;
        parts.push_back(all().subspan(begin, end - begin));
    }
    return parts;
}

void PlantsOnRanks::show(std::span<const Part> to_each, const Environment& environment, int step) {
    spread_->distribute(*plants_, to_each, environment, step);
    const auto rank = static_cast<std::size_t>(spread_->ranks().rank());
    shown_ = rank < to_each.size() ? to_each[rank] : Part();
    together(&spread_->ranks(), [&] {
        plants_->show(std::span(&shown_, 1), environment, step);
        memory_.check_received(shown_, step);
    });
}

void PlantsOnRanks::hide() {
    plants_->hide();
    spread_->forget(std::exchange(shown_, {}));
}

std::vector<std::size_t> PlantsOnRanks::points() {
    const std::vector<std::size_t> own = plants_->points();
    const std::vector<double> all_points =
        spread_->of_each(all(), [&](const GrowingPlant& plant) { return static_cast<double>(own[plant.number]); });
    return {all_points.begin(), all_points.end()};
}

// Part by part, so that no rank holds many states at once.
void PlantsOnRanks::gather_states(const std::filesystem::path& folder) {
    Ranks* const ranks = &spread_->ranks();
    together(ranks, [&] {
        if (!is_first(ranks)) return;
        gathered_.reset(new Gathered{ScratchFile(folder), std::vector<Gathered::Place>(all().size())});
    });
    for (const Part& part : frame_parts()) {
        const std::vector<std::string> states = spread_->states(*plants_, part);
        together(ranks, [&] {
            if (!gathered_) return;
            for (std::size_t i = 0; i < states.size(); ++i) {
                if (states[i].empty()) continue;
                gathered_->of_plants[part[i].number] = {gathered_->states.append(states[i]), states[i].size()};
            }
        });
    }
    is_saved_ = true;
}

void PlantsOnRanks::put_state(std::ostream& out, GrowingPlant& plant) {
    if (plant.is_local) return plants_->put_state(out, plant);
    const Gathered::Place& place = gathered_->of_plants[plant.number];
    out << gathered_->states.read(place.at, place.size);
}

void PlantsOnRanks::take_restored(GrowingPlant& plant) {
    if (plant.is_local)
        plants_->take_restored(plant);
    else
        plant.become_remote();
}

}  // namespace espalier::simulation

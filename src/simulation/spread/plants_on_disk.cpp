#include "simulation/spread/plants_on_disk.h"

#include "base/bytes.h"
#include "geometry/drawn/mesh_size.h"
#include "simulation/plant/every_plant.h"
#include "simulation/plant/plant_bytes.h"
#include "simulation/plant/string_checkpoint.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

namespace espalier::simulation {
namespace {

/// Where the parameters of a query and of the module that follows it begin in the plant's string, and how many they
/// are.
struct QueryPlace {
    std::uint64_t own, following;
    std::uint32_t own_count, following_count;
};

std::vector<QueryPlace> places_of(const QueryColumn& queries, const ModuleString& string) {
    std::vector<QueryPlace> places;
    places.reserve(queries.size());
    for (const Query& query : queries) {
        places.push_back({query.parameters_at, following_at(query, string),
                          static_cast<std::uint32_t>(query.parameters.size()),
                          static_cast<std::uint32_t>(query.following_parameters.size())});
    }
    return places;
}

/// Makes a query read its parameters there.
void point(Query& query, const QueryPlace& place, const Column<double>& parameters) {
    const std::span all(parameters);
    query.parameters_at = place.own;
    query.parameters = all.subspan(place.own, place.own_count);
    query.following_parameters = all.subspan(place.following, place.following_count);
}

/// A string of nothing but the parameters of queries.
std::shared_ptr<ModuleString> parameters_alone(const ModuleString& string, const std::vector<QueryPlace>& places) {
    auto alone = std::make_shared<ModuleString>();
    std::size_t count = 0;
    for (const QueryPlace& place : places) count += place.own_count + place.following_count;
    alone->parameters.reserve(count);
    const auto copy = [&](std::uint64_t from, std::uint32_t size) {
        const auto begin = string.parameters.begin() + static_cast<std::ptrdiff_t>(from);
        alone->parameters.insert(alone->parameters.end(), begin, begin + size);
    };
    for (const QueryPlace& place : places) {
        copy(place.own, place.own_count);
        copy(place.following, place.following_count);
    }
    return alone;
}

/// Makes queries that come from disk read their parameters in such a string.
void point_alone(QueryColumn& queries, const Column<double>& parameters) {
    std::uint64_t next = 0;
    for (Query& query : queries) {
        const auto own = static_cast<std::uint32_t>(query.parameters.size());
        const auto following = static_cast<std::uint32_t>(query.following_parameters.size());
        point(query, {next, next + own, own, following}, parameters);
        next += own + following;
    }
}

/// From such a string.
void write_answers(const ModuleString& answered, const std::vector<QueryPlace>& places, ModuleString& string) {
    auto next = answered.parameters.begin();
    for (const QueryPlace& place : places) {
        std::copy(next, next + place.own_count, string.parameters.begin() + static_cast<std::ptrdiff_t>(place.own));
        next += place.own_count + place.following_count;
    }
}

}  // namespace

PlantsOnDisk::PlantsOnDisk(std::vector<GrowingPlant> plants, std::filesystem::path folder, std::size_t blocks,
                           std::size_t resident, MemoryBudget& memory, bool holds_queries)
    : PlantsInMemory(std::move(plants)),
      folder_(std::move(folder)),
      blocks_(blocks),
      resident_(resident),
      memory_(memory),
      holds_queries_(holds_queries),
      places_(all().size()),
      waiting_(all().size()) {}

// Which plants are local changes when plants move to other ranks.
std::vector<PlantSet::Part> PlantsOnDisk::parts() {
    const std::span<GrowingPlant> plants = all();
    const auto local = static_cast<std::size_t>(
        std::count_if(plants.begin(), plants.end(), [](const GrowingPlant& plant) { return plant.is_local; }));
    const std::size_t block = std::max<std::size_t>((local + blocks_ - 1) / blocks_, 1);
    std::vector<Part> parts;
    std::size_t begin = 0, held = 0;
    for (std::size_t plant = 0; plant < plants.size(); ++plant) {
        if (!plants[plant].is_local) continue;
        if (held == block * resident_) {
            parts.push_back(plants.subspan(begin, plant - begin));
            begin = plant;
            held = 0;
        }
        ++held;
    }
    parts.push_back(plants.subspan(begin));
    return parts;
}

template <class Action>
void PlantsOnDisk::for_local_plants(Part part, const Action& action) {
    for_every_plant(part, all().size() == 1, /*reads=*/nullptr,
                    {&GrowingPlant::prefetch_values, &GrowingPlant::prefetch_for_interpretation},
                    [&](GrowingPlant& plant, ModuleString&) {
                        if (plant.is_local) action(plant);
                    });
}

// Not when this is made: the folder of a run appears later.
void PlantsOnDisk::open_files() {
    for (std::optional<ScratchFile>& file : files_) {
        if (!file) file.emplace(folder_);
    }
}

// The string is there again, answered.
void PlantsOnDisk::fetch(Part part) {
    for_local_plants(part, [&](GrowingPlant& plant) {
        if (places_[plant.number].size > 0) read(plant, /*drawn=*/false);
    });
}

void PlantsOnDisk::store(Part part, int step, bool drawn) {
    open_files();
    for_local_plants(part, [&](GrowingPlant& plant) { write(plant, 1 - now_, drawn); });
    memory_.check_drawn(all(), step);
}

// The room on disk of what the plants were before is free again.
void PlantsOnDisk::end_growth() {
    open_files();
    files_[now_]->clear();
    now_ = 1 - now_;
}

void PlantsOnDisk::take_restored(GrowingPlant& plant) {
    open_files();
    write(plant, now_, /*drawn=*/false);
    places_[plant.number].queries = 0;
}

void PlantsOnDisk::write(GrowingPlant& plant, std::size_t file, bool drawn) {
    const Interpretation& from = *plant.interpretation;
    ModuleString& string = *plant.string;
    const std::vector<QueryPlace> places = places_of(from.queries, string);
    std::string room;
    room.reserve(places_[plant.number].size / 4 * 5);  // it grows
    std::ostringstream out(std::move(room));
    put_column(out, places);
    auto parameters = parameters_alone(string, places);
    // Processes answer queries only, so the turtle may be first.
    write_turtle_answers(from, string);
    save_string(string, out);
    Place place;
    place.string = static_cast<std::uint64_t>(out.tellp());
    put_column(out, from.queries);
    place.asked = static_cast<std::uint64_t>(out.tellp());
    place.queries = from.queries.size();
    place.is_drawn = drawn;
    static const auto nothing = std::make_shared<const Interpretation>();
    std::shared_ptr<const Interpretation> waiting = nothing;
    if (drawn) {
        const PlantGeometry& geometry = plant.drawn().geometry;
        put_column(out, from.answers);
        put_column(out, from.directions);
        put_geometry(out, geometry);
        auto shapes_alone = std::make_shared<Interpretation>();
        shapes_alone->geometry.shapes = geometry.shapes;
        waiting = std::move(shapes_alone);
        place.points = points_foreseen(geometry);
    }
    const std::string bytes = std::move(out).str();
    place.size = bytes.size();
    place.at = files_[file]->append(bytes);
    places_[plant.number] = place;
    plant.hold(std::move(parameters), std::move(waiting));
    memory_.count_waiting(plant, holds_queries_ ? place.queries : 0);
}

std::span<const Query> PlantsOnDisk::queries_of(const GrowingPlant& plant, QueryColumn& room) {
    if (!plant.is_local) return plant.interpretation->queries;
    const Place& place = places_[plant.number];
    if (place.queries == 0) return {};
    std::istringstream in(files_[now_]->read(place.at + place.string, place.asked - place.string));
    get_column(in, room);
    point_alone(room, plant.string->parameters);
    return room;
}

const environment::WaitingQueries* PlantsOnDisk::queries() {
    of_all_.count = 0;
    for (const GrowingPlant& plant : all()) {
        of_all_.count += plant.is_local ? places_[plant.number].queries : plant.interpretation->queries.size();
    }
    of_all_.of = [this](std::uint32_t plant, QueryColumn& room) { return queries_of(all()[plant], room); };
    return &of_all_;
}

void PlantsOnDisk::show(std::span<const Part> to_each, const Environment&, int) {
    shown_ = to_each.empty() ? Part() : to_each.front();
    for_local_plants(shown_, [&](GrowingPlant& plant) { show(plant); });
}

void PlantsOnDisk::hide() {
    for_local_plants(std::exchange(shown_, {}), [&](GrowingPlant& plant) { hide(plant); });
}

std::vector<std::size_t> PlantsOnDisk::points() {
    std::vector<std::size_t> points;
    points.reserve(places_.size());
    for (const Place& place : places_) points.push_back(place.points);
    return points;
}

void PlantsOnDisk::put_state(std::ostream& out, GrowingPlant& plant) {
    show(plant);
    PlantsInMemory::put_state(out, plant);
    hide(plant);
}

void PlantsOnDisk::show(GrowingPlant& plant) {
    waiting_[plant.number] = {plant.string.share(), plant.interpretation.share()};
    read(plant, places_[plant.number].is_drawn);
}

void PlantsOnDisk::hide(GrowingPlant& plant) {
    Waiting& waiting = waiting_[plant.number];
    plant.hold(std::move(waiting.string), std::move(waiting.interpretation));
    waiting = {};
}

void PlantsOnDisk::read(GrowingPlant& plant, bool drawn) {
    const Place& place = places_[plant.number];
    std::istringstream in(files_[now_]->read(place.at, drawn ? place.size : place.string));
    std::vector<QueryPlace> places;
    get_column(in, places);
    auto string = std::make_shared<ModuleString>();
    restore_string(*string, std::numeric_limits<std::size_t>::max(), in);
    write_answers(*plant.string, places, *string);
    round_as_stored(*string, plant.model().arithmetic);
    auto shown = std::make_shared<Interpretation>();
    if (drawn) {
        get_column(in, shown->queries);
        for (std::size_t i = 0; i < places.size(); ++i) point(shown->queries[i], places[i], string->parameters);
        get_column(in, shown->answers);
        get_column(in, shown->directions);
        get_geometry(in, shown->geometry);
        shown->geometry.shapes = plant.interpretation->geometry.shapes;
    }
    plant.hold(std::move(string), std::move(shown));
    plant.number_births();
}

}  // namespace espalier::simulation

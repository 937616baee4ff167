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

/// Makes the queries read their parameters there.
void point(QueryColumn& queries, const std::vector<QueryPlace>& places, const Column<double>& parameters) {
    const std::span all(parameters);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const QueryPlace& place = places[i];
        queries[i].parameters_at = place.own;
        queries[i].parameters = all.subspan(place.own, place.own_count);
        queries[i].following_parameters = all.subspan(place.following, place.following_count);
    }
}

/// Calls visit(place in the plant's string, place in a string of nothing but the parameters of queries).
template <class Visit>
void for_places(const std::vector<QueryPlace>& places, const Visit& visit) {
    std::uint64_t next = 0;
    for (const QueryPlace& place : places) {
        const std::uint64_t own = next, following = own + place.own_count;
        visit(place, QueryPlace{own, following, place.own_count, place.following_count});
        next = following + place.following_count;
    }
}

/// A string of nothing but the parameters of queries. `places` become those in it.
std::shared_ptr<ModuleString> parameters_alone(const ModuleString& string, std::vector<QueryPlace>& places) {
    auto alone = std::make_shared<ModuleString>();
    std::size_t count = 0;
    for (const QueryPlace& place : places) count += place.own_count + place.following_count;
    alone->parameters.reserve(count);
    const auto copy = [&](std::uint64_t from, std::uint32_t size) {
        const auto begin = string.parameters.begin() + static_cast<std::ptrdiff_t>(from);
        alone->parameters.insert(alone->parameters.end(), begin, begin + size);
    };
    std::vector<QueryPlace> now;
    now.reserve(places.size());
    for_places(places, [&](const QueryPlace& from, const QueryPlace& to) {
        copy(from.own, from.own_count);
        copy(from.following, from.following_count);
        now.push_back(to);
    });
    places = std::move(now);
    return alone;
}

void write_answers(const ModuleString& answered, const std::vector<QueryPlace>& places, ModuleString& string) {
    for_places(places, [&](const QueryPlace& to, const QueryPlace& from) {
        const auto begin = answered.parameters.begin() + static_cast<std::ptrdiff_t>(from.own);
        std::copy(begin, begin + from.own_count, string.parameters.begin() + static_cast<std::ptrdiff_t>(to.own));
    });
}

}  // namespace

PlantsOnDisk::PlantsOnDisk(std::vector<GrowingPlant> plants, std::filesystem::path folder, std::size_t blocks,
                           std::size_t resident, MemoryBudget& memory)
    : PlantsInMemory(std::move(plants)),
      folder_(std::move(folder)),
      blocks_(blocks),
      resident_(resident),
      memory_(memory),
      places_(all().size()),
      waiting_(all().size()),
      asked_(all().size()) {}

void PlantsOnDisk::begin_growth(double, int) {
    queries_.clear();
}

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
    gather_queries(part);
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
    asked_[plant.number] = {};
}

void PlantsOnDisk::write(GrowingPlant& plant, std::size_t file, bool drawn) {
    const Interpretation& from = *plant.interpretation;
    ModuleString& string = *plant.string;
    std::vector<QueryPlace> places = places_of(from.queries, string);
    std::ostringstream out;
    put_column(out, places);
    auto asked = std::make_shared<Interpretation>();
    asked->queries = from.queries;
    auto parameters = parameters_alone(string, places);
    point(asked->queries, places, parameters->parameters);
    // Processes answer queries only, so the turtle may be first.
    write_turtle_answers(from, string);
    save_string(string, out);
    const auto string_size = static_cast<std::uint64_t>(out.tellp());
    std::size_t points = 0;
    if (drawn) {
        const PlantGeometry& geometry = plant.drawn().geometry;
        put_column(out, from.queries);
        put_column(out, from.answers);
        put_column(out, from.directions);
        put_geometry(out, geometry);
        asked->geometry.shapes = geometry.shapes;
        points = points_foreseen(geometry);
    }
    const std::string bytes = std::move(out).str();
    places_[plant.number] = {files_[file]->append(bytes), bytes.size(), string_size, points};
    plant.hold(std::move(parameters), std::move(asked));
    memory_.count_waiting(plant);
}

// Puts the queries of a part's plants side by side.
void PlantsOnDisk::gather_queries(Part part) {
    QueryColumn& queries = queries_.emplace_back();
    std::size_t count = 0;
    for (const GrowingPlant& plant : part) {
        const std::size_t own = plant.is_local ? plant.interpretation->queries.size() : 0;
        asked_[plant.number] = {queries_.size() - 1, count, own};
        count += own;
    }
    queries.reserve(count);
    for (GrowingPlant& plant : part) {
        if (!plant.is_local) continue;
        QueryColumn& own = plant.interpretation->queries;
        queries.insert(queries.end(), own.begin(), own.end());
        own = QueryColumn();  // frees its memory; = {} would not
    }
}

std::span<const Query> PlantsOnDisk::queries_of(const GrowingPlant& plant) {
    if (!plant.is_local) return plant.interpretation->queries;
    const Asked& asked = asked_[plant.number];
    if (asked.count == 0) return {};
    return std::span(queries_[asked.part]).subspan(asked.begin, asked.count);
}

// Those of the part before have been read by now.
std::span<const Query> PlantsOnDisk::queries_in_order(std::uint32_t plant) {
    const std::size_t part = asked_[plant].part;
    if (part > 0) queries_[part - 1] = QueryColumn();
    return queries_of(all()[plant]);
}

const environment::WaitingQueries* PlantsOnDisk::queries() {
    of_all_.count = 0;
    for (const GrowingPlant& plant : all()) of_all_.count += queries_of(plant).size();
    of_all_.of = [this](std::uint32_t plant) { return queries_in_order(plant); };
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
    const Place& place = places_[plant.number];
    read(plant, /*drawn=*/place.size > place.string);
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
        point(shown->queries, places, string->parameters);
        get_column(in, shown->answers);
        get_column(in, shown->directions);
        get_geometry(in, shown->geometry);
        shown->geometry.shapes = plant.interpretation->geometry.shapes;
    }
    plant.hold(std::move(string), std::move(shown));
    plant.number_births();
}

}  // namespace espalier::simulation

#include "simulation/world/plant_store.h"

#include "base/bytes.h"
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

PlantStore::PlantStore(const std::filesystem::path& folder, std::span<GrowingPlant> plants, std::size_t in_memory)
    : places_(plants.size()), waiting_(plants.size()), files_{ScratchFile(folder), ScratchFile(folder)} {
    for (std::size_t first = 0; first < plants.size(); first += in_memory) {
        parts_.push_back(plants.subspan(first, std::min(in_memory, plants.size() - first)));
    }
    queries_.resize(parts_.size());
}

void PlantStore::rest(GrowingPlant& plant, bool drawn) {
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
    const std::uint64_t string_size = out.view().size();
    if (drawn) {
        put_column(out, from.queries);
        put_column(out, from.answers);
        put_column(out, from.directions);
        put_geometry(out, plant.drawn().geometry);
        asked->geometry.shapes = plant.drawn().geometry.shapes;
    }
    places_[plant.number] = {files_[1 - now_].append(out.view()), out.view().size(), string_size};
    plant.hold(std::move(parameters), std::move(asked));
}

void PlantStore::gather_queries(std::size_t part) {
    Queries& queries = queries_[part];
    queries.begins.assign(1, 0);
    for (const GrowingPlant& plant : parts_[part]) {
        queries.begins.push_back(queries.begins.back() + plant.interpretation->queries.size());
    }
    queries.all = QueryColumn();  // frees its memory; = {} would not
    queries.all.reserve(queries.begins.back());
    for (GrowingPlant& plant : parts_[part]) {
        QueryColumn& own = plant.interpretation->queries;
        queries.all.insert(queries.all.end(), own.begin(), own.end());
        own = QueryColumn();
    }
}

void PlantStore::turn() {
    files_[now_].clear();
    now_ = 1 - now_;
}

environment::WaitingQueries PlantStore::queries() {
    environment::WaitingQueries waiting;
    for (const Queries& queries : queries_) waiting.count += queries.all.size();
    waiting.of = [this](std::uint32_t plant) { return queries_of(plant); };
    return waiting;
}

std::span<const Query> PlantStore::queries_of(std::uint32_t plant) {
    const std::size_t part = plant / parts_.front().size(), row = plant % parts_.front().size();
    if (row == 0 && part > 0) queries_[part - 1].all = QueryColumn();
    const Queries& queries = queries_[part];
    if (queries.begins.empty()) return {};
    return std::span(queries.all).subspan(queries.begins[row], queries.begins[row + 1] - queries.begins[row]);
}

void PlantStore::wake(GrowingPlant& plant) {
    if (places_[plant.number].size > 0) fetch(plant, /*drawn=*/false);
}

void PlantStore::show(GrowingPlant& plant) {
    waiting_[plant.number] = {plant.string.share(), plant.interpretation.share()};
    const Place& place = places_[plant.number];
    fetch(plant, /*drawn=*/place.size > place.string);
}

void PlantStore::put_back(GrowingPlant& plant) {
    Waiting& waiting = waiting_[plant.number];
    plant.hold(std::move(waiting.string), std::move(waiting.interpretation));
    waiting = {};
}

void PlantStore::fetch(GrowingPlant& plant, bool drawn) {
    const Place& place = places_[plant.number];
    std::istringstream in(files_[now_].read(place.at, drawn ? place.size : place.string));
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

#include "simulation/world/plant_store.h"

#include "base/bytes.h"
#include "simulation/spread/plant_bytes.h"
#include "simulation/world/string_checkpoint.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

namespace espalier::simulation {
namespace {

/// Where the parameters of a query and of the module that follows begin in the plant's string.
struct QueryPlace {
    std::uint64_t own, following;
};

std::vector<QueryPlace> places_of(const QueryColumn& queries, const ModuleString& string) {
    std::vector<QueryPlace> places;
    places.reserve(queries.size());
    for (const Query& query : queries) {
        const bool has_following = !query.following_parameters.empty();
        const auto following = has_following ? query.following_parameters.data() - string.parameters.data() : 0;
        places.push_back({query.parameters_at, static_cast<std::uint64_t>(following)});
    }
    return places;
}

/// Makes the queries read their parameters there.
void point(QueryColumn& queries, const std::vector<QueryPlace>& places, const Column<double>& parameters) {
    const std::span all(parameters);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        Query& query = queries[i];
        query.parameters_at = places[i].own;
        query.parameters = all.subspan(places[i].own, query.parameters.size());
        query.following_parameters = all.subspan(places[i].following, query.following_parameters.size());
    }
}

/// The queries alone, with a string of nothing but their parameters.
std::pair<std::shared_ptr<ModuleString>, std::shared_ptr<Interpretation>> queries_alone(const Interpretation& from) {
    auto parameters = std::make_shared<ModuleString>();
    auto asked = std::make_shared<Interpretation>();
    std::size_t count = 0;
    for (const Query& query : from.queries) count += query.parameters.size() + query.following_parameters.size();
    parameters->parameters.reserve(count);
    std::vector<QueryPlace> places;
    Column<double>& to = parameters->parameters;
    const auto add = [&](std::span<const double> values) {
        const std::size_t at = to.size();
        to.insert(to.end(), values.begin(), values.end());
        return at;
    };
    for (const Query& query : from.queries) {
        const std::size_t own = add(query.parameters);
        places.push_back({own, add(query.following_parameters)});
    }
    asked->queries.assign(from.queries.begin(), from.queries.end());
    asked->geometry.shapes = from.geometry.shapes;
    point(asked->queries, places, to);
    return {std::move(parameters), std::move(asked)};
}

void write_answers(const QueryColumn& queries, const std::vector<QueryPlace>& places, ModuleString& string) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const std::span<const double> answer = queries[i].parameters;
        std::copy(answer.begin(), answer.end(), string.parameters.begin() + static_cast<std::ptrdiff_t>(places[i].own));
    }
}

}  // namespace

PlantStore::PlantStore(const std::filesystem::path& folder, std::span<GrowingPlant> plants, std::size_t in_memory,
                       bool drawn)
    : drawn_(drawn), places_(plants.size()), waiting_(plants.size()), files_{ScratchFile(folder), ScratchFile(folder)} {
    for (std::size_t first = 0; first < plants.size(); first += in_memory) {
        parts_.push_back(plants.subspan(first, std::min(in_memory, plants.size() - first)));
    }
}

void PlantStore::rest(GrowingPlant& plant) {
    const Interpretation& from = *plant.interpretation;
    ModuleString& string = *plant.string;
    const std::vector<QueryPlace> places = places_of(from.queries, string);
    auto [parameters, asked] = queries_alone(from);
    // Processes answer queries only, so the turtle may be first.
    write_turtle_answers(from, string);
    std::ostringstream out;
    save_string(string, out);
    put_column(out, places);
    if (drawn_) {
        put_column(out, from.answers);
        put_column(out, from.directions);
        put_geometry(out, plant.drawn().geometry);
        asked->geometry.shapes = plant.drawn().geometry.shapes;
    }
    places_[plant.number] = {files_[1 - now_].append(out.view()), out.view().size()};
    plant.hold(std::move(parameters), std::move(asked));
}

void PlantStore::turn() {
    files_[now_].clear();
    now_ = 1 - now_;
}

void PlantStore::wake(GrowingPlant& plant) {
    if (places_[plant.number].size > 0) fetch(plant, /*drawn=*/false);
}

void PlantStore::show(GrowingPlant& plant) {
    waiting_[plant.number] = {plant.string.share(), plant.interpretation.share()};
    fetch(plant, drawn_);
}

void PlantStore::put_back(GrowingPlant& plant) {
    Waiting& waiting = waiting_[plant.number];
    plant.hold(std::move(waiting.parameters), std::move(waiting.queries));
    waiting = {};
}

void PlantStore::fetch(GrowingPlant& plant, bool drawn) {
    const Place& place = places_[plant.number];
    std::istringstream in(files_[now_].read(place.at, place.size));
    auto string = std::make_shared<ModuleString>();
    restore_string(*string, std::numeric_limits<std::size_t>::max(), in);
    std::vector<QueryPlace> places;
    get_column(in, places);
    const Interpretation& asked = *plant.interpretation;
    write_answers(asked.queries, places, *string);
    round_as_stored(*string, plant.model().arithmetic);
    auto shown = std::make_shared<Interpretation>();
    if (drawn) {
        shown->queries = asked.queries;
        point(shown->queries, places, string->parameters);
        get_column(in, shown->answers);
        get_column(in, shown->directions);
        get_geometry(in, shown->geometry);
        shown->geometry.shapes = asked.geometry.shapes;
    }
    plant.hold(std::move(string), std::move(shown));
}

}  // namespace espalier::simulation

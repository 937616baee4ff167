#include "simulation/plant/plant_bytes.h"

#include "base/bytes.h"
#include "geometry/drawn/columns.h"
#include "simulation/plant/string_checkpoint.h"
#include "simulation/scene/keyframes.h"
#include "simulation/scene/scene_keyframes.h"

#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace espalier::simulation {
namespace {

/// A query whose parameters lie elsewhere.
struct SentQuery {
    Query query;
    std::uint32_t parameters, following;
    std::uint64_t following_at;  ///< where those of the module that follows begin, in the string that is sent
};

SentQuery sent(const Query& query, std::size_t following_at) {
    SentQuery result{query, static_cast<std::uint32_t>(query.parameters.size()),
                     static_cast<std::uint32_t>(query.following_parameters.size()), following_at};
    result.query.parameters = {};
    result.query.following_parameters = {};
    return result;
}

// The parameters of both modules lie in `parameters`, which does not move any more.
void take_queries(const std::vector<SentQuery>& all, const Column<double>& parameters, QueryColumn& queries) {
    queries.clear();
    for (const SentQuery& one : all) {
        Query& query = queries.emplace_back(one.query);
        query.parameters = std::span(parameters).subspan(query.parameters_at, one.parameters);
        query.following_parameters = std::span(parameters).subspan(one.following_at, one.following);
    }
}

template <class Column>
void put_drawn(std::ostream& out, const Column& column) {
    if constexpr (std::is_same_v<typename Column::value_type, Label>) {
        put(out, static_cast<std::uint64_t>(column.size()));
        for (const Label& label : column) {
            put(out, label.module);
            put(out, label.order);
            put(out, label.colour);
            put(out, label.position);
            put_text(out, label.text);
        }
    } else {
        put_column(out, column);
    }
}

template <class Column>
void get_drawn(std::istream& in, Column& column) {
    if constexpr (std::is_same_v<typename Column::value_type, Label>) {
        column.resize(get<std::uint64_t>(in));
        for (Label& label : column) {
            label.module = get<std::uint32_t>(in);
            label.order = get<std::uint16_t>(in);
            label.colour = get<std::uint16_t>(in);
            label.position = get<glm::dvec3>(in);
            label.text = get_text(in, std::numeric_limits<std::uint64_t>::max());
        }
    } else {
        get_column(in, column);
    }
}

// Stages add the surfaces of their organs, whatever is drawn: to a plant of which nothing is, too.
std::shared_ptr<const Shapes> shapes_of(const Plant& plant, int step) {
    const auto now = plant.drawing_in_time ? plant.drawing_in_time->at_step(step) : nullptr;
    PlantGeometry nothing;
    nothing.shapes = now ? now->turtle.shapes : plant.turtle.shapes;
    StagedPlant staged{nothing, {}, RandomKey(0, 0, Stream::stage)};
    apply(now ? now->stages : plant.stages, staged);
    return nothing.shapes;
}

}  // namespace

void put_queries(std::ostream& out, std::span<const Query* const> queries) {
    std::vector<SentQuery> all;
    Column<double> parameters;
    for (const Query* query : queries) {
        const std::size_t at = parameters.size();
        SentQuery& one = all.emplace_back(sent(*query, at + query->parameters.size()));
        one.query.parameters_at = at;
        parameters.insert(parameters.end(), query->parameters.begin(), query->parameters.end());
        parameters.insert(parameters.end(), query->following_parameters.begin(), query->following_parameters.end());
    }
    put_column(out, all);
    put_column(out, parameters);
}

void get_queries(std::istream& in, GrowingPlant& plant) {
    ModuleString& string = plant.string.for_writing();
    Interpretation& interpretation = plant.interpretation.for_writing();
    string.clear();
    interpretation.clear();
    std::vector<SentQuery> all;
    get_column(in, all);
    get_column(in, string.parameters);
    take_queries(all, string.parameters, interpretation.queries);
    plant.note_received();
}

void put_geometry(std::ostream& out, const PlantGeometry& drawn) {
    geometry::for_drawn_columns(drawn, [&](const auto& column) { put_drawn(out, column); });
    put(out, drawn.in_pixels);
    put(out, drawn.axes);
    put(out, drawn.bounds);
}

void get_geometry(std::istream& in, PlantGeometry& drawn) {
    geometry::for_drawn_columns(drawn, [&](auto& column) { get_drawn(in, column); });
    drawn.in_pixels = get<bool>(in);
    drawn.axes = get<std::uint32_t>(in);
    drawn.bounds = get<Box>(in);
}

std::size_t following_at(const Query& query, const ModuleString& string) {
    if (query.following_parameters.empty()) return 0;
    return static_cast<std::size_t>(query.following_parameters.data() - string.parameters.data());
}

void put_plant(std::ostream& out, const GrowingPlant& plant) {
    const ModuleString& string = *plant.string;
    save_string(string, out);
    std::vector<SentQuery> queries;
    for (const Query& query : plant.interpretation->queries) {
        queries.push_back(sent(query, following_at(query, string)));
    }
    put_column(out, queries);
    put_column(out, plant.interpretation->answers);
    put_column(out, plant.interpretation->directions);
    put_geometry(out, plant.drawn().geometry);
}

void get_plant(std::istream& in, GrowingPlant& plant, int step) {
    ModuleString& string = plant.string.for_writing();
    restore_string(string, std::numeric_limits<std::size_t>::max(), in);
    Interpretation& interpretation = plant.interpretation.for_writing();
    std::vector<SentQuery> queries;
    get_column(in, queries);
    take_queries(queries, string.parameters, interpretation.queries);
    get_column(in, interpretation.answers);
    get_column(in, interpretation.directions);
    get_geometry(in, interpretation.geometry);
    interpretation.geometry.shapes = shapes_of(*plant.description, step);
    plant.note_received();
}

void put_state(std::ostream& out, const GrowingPlant& plant) {
    plant.derivation.save(out);
    save_string(*plant.string, out);
    put(out, plant.memory);
    if (plant.numbers) plant.numbers->save(out);
}

void get_state(std::istream& in, GrowingPlant& plant, std::size_t memory) {
    plant.derivation.restore(in);
    restore_string(*plant.string, memory, in);
    require_modules_of(plant.model().alphabet, *plant.string);
    plant.note_derived();
    plant.memory = get<PlantMemory>(in);
    plant.is_numbered = true;
    if (plant.numbers) plant.numbers->restore(in);
}

}  // namespace espalier::simulation

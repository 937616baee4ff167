#include "timeline/frame_copy.h"

#include <algorithm>

namespace espalier {
namespace {

// Queries point at parameters in their string.
void point_into(QueryColumn& queries, const ModuleString& copy, const ModuleString& original) {
    const auto moved = [&](std::span<const double> values) {
        return values.empty()
                   ? values
                   : std::span(copy.parameters)
                         .subspan(static_cast<std::size_t>(values.data() - original.parameters.data()), values.size());
    };
    for (Query& query : queries) {
        query.parameters = moved(query.parameters);
        query.following_parameters = moved(query.following_parameters);
    }
}

template <class Values>
std::size_t bytes_of(const Values& values) {
    return values.size() * sizeof(values[0]);
}

std::size_t bytes_of(const ModuleString& string) {
    return bytes_of(string.letters) + bytes_of(string.parameters) + bytes_of(string.identities) +
           bytes_of(string.parents) + bytes_of(string.births);
}

std::size_t bytes_of(const PlantGeometry& geometry) {
    return bytes_of(geometry.internodes) + bytes_of(geometry.polygons) + bytes_of(geometry.vertices) +
           bytes_of(geometry.organs) + bytes_of(geometry.mesh.vertices) + bytes_of(geometry.mesh.triangles) +
           bytes_of(geometry.mesh.pieces) + bytes_of(geometry.labels) + bytes_of(geometry.textures);
}

// A plant grows from frame to frame: with room to spare, its copy is not put into fresh memory every time.
template <class Values>
void make_room(Values& copy, const Values& original) {
    if (original.size() <= copy.capacity()) return;
    copy.clear();
    copy.reserve(original.size() + original.size() / 2);
}

void make_room(ModuleString& copy, const ModuleString& original) {
    make_room(copy.letters, original.letters);
    make_room(copy.parameters, original.parameters);
    make_room(copy.identities, original.identities);
    make_room(copy.parents, original.parents);
    make_room(copy.births, original.births);
}

void make_room(Interpretation& copy, const Interpretation& original) {
    make_room(copy.geometry.internodes, original.geometry.internodes);
    make_room(copy.geometry.polygons, original.geometry.polygons);
    make_room(copy.geometry.vertices, original.geometry.vertices);
    make_room(copy.geometry.organs, original.geometry.organs);
    make_room(copy.queries, original.queries);
}

}  // namespace

void FrameCopy::take(const Frame& frame, std::span<const std::string> fields) {
    step_ = frame.step;
    time_ = frame.time;
    plants_.assign(frame.plants.begin(), frame.plants.end());
    storage_.resize(plants_.size());
    for (std::size_t i = 0; i < plants_.size(); ++i) {
        const PlantFrame& original = frame.plants[i];
        Plant& copy = storage_[i];
        make_room(copy.string, *original.string);
        copy.string = *original.string;
        make_room(copy.interpretation, *original.interpretation);
        copy.interpretation = *original.interpretation;
        point_into(copy.interpretation.queries, copy.string, *original.string);
        plants_[i].string = &copy.string;
        plants_[i].interpretation = &copy.interpretation;
    }
    fields_ = {};
    if (frame.fields) take_fields(*frame.fields, fields);
}

void FrameCopy::take_fields(const Fields& all, std::span<const std::string> wanted) {
    const auto keep = [this](Field field) {
        field.current = {};
        fields_.provide(std::move(field));
    };
    const auto is_there = [&all](const std::string& name) { return all.find(name) != nullptr; };
    if (std::all_of(wanted.begin(), wanted.end(), is_there)) {
        for (const std::string& name : wanted) keep(*all.find(name));
    } else {
        for (const auto& [name, field] : all.all()) keep(field);
    }
}

std::size_t FrameCopy::bytes(const Frame& frame) {
    std::size_t bytes = 0;
    for (const PlantFrame& plant : frame.plants) {
        bytes += bytes_of(*plant.string) + bytes_of(plant.interpretation->geometry) +
                 bytes_of(plant.interpretation->queries);
    }
    return bytes;
}

}  // namespace espalier

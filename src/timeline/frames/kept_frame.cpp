#include "timeline/frames/kept_frame.h"

#include "geometry/drawn/columns.h"

#include <algorithm>

namespace espalier::timeline {
namespace {

template <class Values>
std::size_t bytes_of(const Values& values) {
    return values.size() * sizeof(values[0]);
}

std::size_t bytes_of(const PlantGeometry& geometry) {
    std::size_t bytes = 0;
    geometry::for_drawn_columns(geometry, [&bytes](const auto& column) { bytes += bytes_of(column); });
    return bytes;
}

}  // namespace

void KeptFrame::take(const Frame& frame, std::span<const std::string> fields, std::span<const std::string> organs) {
    frame_ = frame;
    frame_.fields = &fields_;
    fields_ = {};
    if (frame.fields) take_fields(*frame.fields, fields);
    if (!frame.environment) return;
    for (PlantFrame& plant : frame_.plants) {
        for (const std::string& name : organs) plant.organs[name] = frame.environment->organ_values(name, plant.plant);
    }
}

void KeptFrame::take_fields(const Fields& all, std::span<const std::string> wanted) {
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

void KeptFrame::release() {
    frame_.plants.clear();
    fields_ = {};
}

std::size_t KeptFrame::bytes(const Frame& frame) {
    std::size_t bytes = 0;
    for (const PlantFrame& plant : frame.plants) {
        bytes += plant.string->content() + bytes_of(plant.interpretation->geometry) +
                 bytes_of(plant.interpretation->queries) + bytes_of(plant.interpretation->answers) +
                 bytes_of(plant.interpretation->directions);
    }
    return bytes;
}

}  // namespace espalier::timeline

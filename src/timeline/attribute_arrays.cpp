#include "timeline/attribute_arrays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace espalier {
namespace {

/// By several threads, if there are many: `visit` gets the run's number and its owner.
template <class Visit>
void for_each_owner(const Owners& owners, const Visit& visit) {
    constexpr std::size_t worth_sharing = std::size_t{1} << 16;
    const std::size_t count = owners.values.size();
    const auto visit_some = [&](const tbb::blocked_range<std::size_t>& some) {
        for (std::size_t i = some.begin(); i < some.end(); ++i) visit(i, owners.values[i]);
    };
    if (count < worth_sharing) {
        visit_some({0, count});
    } else {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, worth_sharing / 4), visit_some);
    }
}

}  // namespace

bool OwnerArrays::same_values(const OwnerArrays& other) const {
    if (count_ != other.count_) return false;
    return std::equal(arrays_.begin(), arrays_.begin() + static_cast<std::ptrdiff_t>(count_), other.arrays_.begin(),
                      [](const Array& a, const Array& b) {
                          return a.data.name == b.data.name && std::strcmp(a.data.type, b.data.type) == 0 &&
                                 same_bytes(a.values, b.values);
                      });
}

AttributeArrays::AttributeArrays(const Frame& frame, SymbolNumbers& symbols, std::span<const ChosenParameter> chosen)
    : chosen_(chosen) {
    for (const PlantFrame& plant_frame : frame.plants) {
        const Alphabet& alphabet = plant_frame.model->alphabet;
        Plant plant{&plant_frame, &symbols.of(*plant_frame.model), {}, {}, plant_frame.string->has_lineage()};
        if (!chosen.empty()) plant.offsets = parameter_offsets(*plant_frame.string, alphabet);
        for (const ChosenParameter& parameter : chosen) plant.slots.emplace_back(parameter, alphabet);
        plants_.push_back(std::move(plant));
    }
}

void AttributeArrays::add_attributes(OwnerArrays& arrays, const Owners& owners) const {
    auto* const identity = arrays.append<std::uint64_t>("identity", owners, 1);
    auto* const parent = arrays.append<std::uint64_t>("parent", owners, 1);
    auto* const number = arrays.append<std::uint32_t>("plant", owners, 1);
    auto* const symbol = arrays.append<std::uint16_t>("symbol", owners, 1);
    auto* const birth = arrays.append<std::int32_t>("birth", owners, 1);
    auto* const order = arrays.append<std::uint16_t>("order", owners, 1);
    auto* const colour = arrays.append<std::uint16_t>("colour", owners, 1);
    auto* const kind = arrays.append<std::uint8_t>("kind", owners, 1);
    for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
        const Plant& plant = plants_[owner.plant];
        const ModuleString& string = *plant.frame->string;
        identity[i] = plant.lineage ? string.identities[owner.module] : 0;
        parent[i] = plant.lineage ? string.parents[owner.module] : 0;
        number[i] = plant.frame->plant;
        symbol[i] = (*plant.symbols)[string.letters[owner.module]];
        birth[i] = plant.lineage ? static_cast<std::int32_t>(string.births[owner.module]) : 0;
        order[i] = owner.order;
        colour[i] = owner.colour;
        kind[i] = static_cast<std::uint8_t>(owner.kind);
    });
}

void AttributeArrays::add_looks(OwnerArrays& arrays, const Owners& owners,
                                std::vector<std::string>& texture_files) const {
    // Texture k of a plant is file numbers[k] of the run, whose file 0 is none.
    if (texture_files.empty()) texture_files.emplace_back();
    std::vector<std::vector<std::uint16_t>> numbers;
    for (const Plant& plant : plants_) {
        numbers.emplace_back(1, std::uint16_t{0});
        const Shapes* shapes = plant.frame->interpretation->geometry.shapes.get();
        if (!shapes) continue;
        for (const Texture& texture : shapes->textures) {
            const auto known = std::find(texture_files.begin() + 1, texture_files.end(), texture.file.string());
            numbers.back().push_back(static_cast<std::uint16_t>(known - texture_files.begin()));
            if (known == texture_files.end()) texture_files.push_back(texture.file.string());
        }
    }
    arrays.add<std::uint16_t>("texture", owners, [&](const Owner& owner) {
        const std::vector<std::uint16_t>& known = numbers[owner.plant];
        return owner.look.texture < known.size() ? known[owner.look.texture] : std::uint16_t{0};
    });
    arrays.add<std::uint16_t>("back_colour", owners, [](const Owner& owner) { return owner.look.back_colour; });
}

void AttributeArrays::add_colours(OwnerArrays& arrays, const Owners& owners) const {
    using Colour = std::array<std::uint8_t, 3>;
    if (std::none_of(plants_.begin(), plants_.end(), [](const Plant& plant) { return plant.frame->palette; })) return;
    std::size_t colours = 0;
    for (const Owner& owner : owners.values) colours = std::max(colours, std::size_t{owner.colour} + 1);
    std::vector<std::vector<Colour>> tables;
    for (const Plant& plant : plants_) {
        std::vector<Colour>& table = tables.emplace_back(colours, Colour{255, 255, 255});
        if (!plant.frame->palette) continue;
        for (std::size_t colour = 0; colour < colours; ++colour) {
            const Material material = plant.frame->palette->material(static_cast<int>(colour));
            for (int k = 0; k < 3; ++k) {
                const double light = std::clamp(material.diffuse[k] + material.emissive[k], 0.0, 1.0);
                table[colour][static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(255 * light));
            }
        }
    }
    std::uint8_t* values = arrays.append<std::uint8_t>("rgb", owners, 3);
    for (const Owner& owner : owners.values) {
        values = std::copy_n(tables[owner.plant][owner.colour].begin(), 3, values);
    }
}

void AttributeArrays::add_parameters(OwnerArrays& arrays, const Owners& owners) const {
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
        double* const values = arrays.append<double>(chosen_[k].name, owners, 1);
        for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
            const Plant& plant = plants_[owner.plant];
            const ModuleString& string = *plant.frame->string;
            const int slot = plant.slots[k].find(string, owner.module);
            values[i] = slot < 0 ? std::numeric_limits<double>::quiet_NaN()
                                 : string.parameters[plant.offsets[owner.module] + static_cast<std::size_t>(slot)];
        });
    }
}

}  // namespace espalier

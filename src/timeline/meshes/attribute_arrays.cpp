#include "timeline/meshes/attribute_arrays.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace espalier::timeline {
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
        for_all_in_parallel(tbb::blocked_range<std::size_t>(0, count, worth_sharing / 4), visit_some);
    }
}

/// Of a frame that is not kept the environment knows them still.
std::shared_ptr<const std::vector<float>> organ_values(const PlantFrame& plant, const std::string& name,
                                                       const Environment* environment) {
    const auto kept = plant.organs.find(name);
    if (kept != plant.organs.end()) return kept->second;
    return environment ? environment->organ_values(name, plant.plant) : nullptr;
}

/// How a file is reached from a folder; both are relative to the current one, or absolute. Without a folder the whole
/// path.
std::string name_from(const std::optional<std::filesystem::path>& folder, const std::filesystem::path& file) {
    if (file.empty()) return "";
    const auto whole = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path).lexically_normal();
    };
    if (!folder) return whole(file).generic_string();
    return whole(file).lexically_relative(whole(folder->empty() ? "." : *folder)).generic_string();
}

}  // namespace

void OwnerArrays::begin() {
    count_before_ = std::exchange(count_, 0);
}

OwnerArrays::Array& OwnerArrays::append(const DataArray& data, const Owners& owners) {
    if (count_ == arrays_.size()) arrays_.emplace_back();
    Array& array = arrays_[count_++];
    const std::size_t bytes = owners.values.size() * data.tuple_bytes;
    array.changed = owners.ends.changed() || array.data.name != data.name || array.values.size() != bytes;
    array.values.resize(bytes);
    array.data = data;
    array.data.tuples = owners.size();
    array.data.values = array.values.data();
    array.data.ends = owners.ends.values();
    return array;
}

DataArray OwnerArrays::operator[](std::size_t i) const {
    DataArray data = arrays_[i].data;
    data.changed = arrays_[i].changed;
    return data;
}

const OwnerArrays::Array* OwnerArrays::find(std::string_view name) const {
    const auto end = arrays_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto found = std::find_if(arrays_.begin(), end, [&](const Array& array) { return array.data.name == name; });
    return found == end ? nullptr : &*found;
}

bool OwnerArrays::changed() const {
    const auto end = arrays_.begin() + static_cast<std::ptrdiff_t>(count_);
    return count_ != count_before_ ||
           std::any_of(arrays_.begin(), end, [](const Array& array) -> bool { return array.changed; });
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
    const auto identity = arrays.append<std::uint64_t>("identity", owners);
    const auto organ = arrays.append<std::uint64_t>("organ", owners);
    const auto parent = arrays.append<std::uint64_t>("parent", owners);
    const auto number = arrays.append<std::uint32_t>("plant", owners);
    const auto symbol = arrays.append<std::uint16_t>("symbol", owners);
    const auto birth = arrays.append<std::int32_t>("birth", owners);
    const auto order = arrays.append<std::uint16_t>("order", owners);
    const auto colour = arrays.append<std::uint16_t>("colour", owners);
    const auto kind = arrays.append<std::uint8_t>("kind", owners);
    for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
        const Plant& plant = plants_[owner.plant];
        const ModuleString& string = *plant.frame->string;
        identity.put(i, plant.lineage ? string.identity(owner.module) : 0);
        organ.put(i, plant.lineage ? string.birth_number(owner.module) : 0);
        parent.put(i, plant.lineage ? string.parent(owner.module) : 0);
        number.put(i, plant.frame->plant);
        symbol.put(i, (*plant.symbols)[string.letters[owner.module]]);
        birth.put(i, plant.lineage ? static_cast<std::int32_t>(string.step_of_birth(owner.module)) : 0);
        order.put(i, owner.order);
        colour.put(i, owner.colour);
        kind.put(i, static_cast<std::uint8_t>(owner.kind));
    });
}

void AttributeArrays::add_looks(OwnerArrays& arrays, const Owners& owners,
                                const std::optional<std::filesystem::path>& folder,
                                std::vector<std::string>& texture_files) const {
    // Texture k of a plant is file numbers[k] of the run, whose file 0 is none.
    if (texture_files.empty()) texture_files.emplace_back();
    std::vector<std::vector<std::uint16_t>> numbers;
    for (const Plant& plant : plants_) {
        numbers.emplace_back(1, std::uint16_t{0});
        const Shapes* shapes = plant.frame->interpretation->geometry.shapes.get();
        if (!shapes) continue;
        for (const Texture& texture : shapes->textures) {
            const std::string name = name_from(folder, texture.file);
            const auto known = std::find(texture_files.begin() + 1, texture_files.end(), name);
            numbers.back().push_back(static_cast<std::uint16_t>(known - texture_files.begin()));
            if (known == texture_files.end()) texture_files.push_back(name);
        }
    }
    const auto texture = arrays.append<std::uint16_t>("texture", owners);
    const auto back_colour = arrays.append<std::uint16_t>("back_colour", owners);
    for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
        const std::vector<std::uint16_t>& known = numbers[owner.plant];
        texture.put(i, owner.look.texture < known.size() ? known[owner.look.texture] : std::uint16_t{0});
        back_colour.put(i, owner.look.back_colour);
    });
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
            table[colour] = shown_colour(plant.frame->palette->material(static_cast<int>(colour)));
        }
    }
    const auto values = arrays.append<std::uint8_t>("rgb", owners, 3);
    for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
        const Colour& colour = tables[owner.plant][owner.colour];
        for (std::size_t k = 0; k < 3; ++k) values.put(3 * i + k, colour[k]);
    });
}

void AttributeArrays::add_parameters(OwnerArrays& arrays, const Owners& owners) const {
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
        const auto values = arrays.append<double>(chosen_[k].name, owners);
        for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
            const Plant& plant = plants_[owner.plant];
            const ModuleString& string = *plant.frame->string;
            const int slot = plant.slots[k].find(string, owner.module);
            values.put(i, slot < 0 ? std::numeric_limits<double>::quiet_NaN()
                                   : string.parameters[plant.offsets[owner.module] + static_cast<std::size_t>(slot)]);
        });
    }
}

void AttributeArrays::add_organs(OwnerArrays& arrays, const Owners& owners, const Environment* environment,
                                 std::span<const OrganQuantity> quantities) const {
    for (const OrganQuantity& quantity : quantities) {
        const auto components = static_cast<std::size_t>(quantity.components);
        std::vector<std::shared_ptr<const std::vector<float>>> known;
        for (const Plant& plant : plants_) known.push_back(organ_values(*plant.frame, quantity.name, environment));
        const auto values = arrays.append<float>(quantity.name, owners, quantity.components);
        for_each_owner(owners, [&](std::size_t i, const Owner& owner) {
            const std::vector<float>* const of_plant = known[owner.plant].get();
            for (std::size_t k = 0; k < components; ++k) {
                const std::size_t at = components * owner.module + k;
                const bool has_value = of_plant && at < of_plant->size();
                values.put(components * i + k, has_value ? (*of_plant)[at] : std::numeric_limits<float>::quiet_NaN());
            }
        });
    }
}

}  // namespace espalier::timeline

#include "timeline/attribute_arrays.h"

#include <tbb/parallel_for.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeUInt16Array.h>
#include <vtkTypeUInt32Array.h>
#include <vtkTypeUInt64Array.h>
#include <vtkTypeUInt8Array.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace espalier {
namespace {

// One value per owner, filled in parallel: each is a function of its owner alone.
template <class Array, class Value>
void add_array(vtkFieldData& data, const char* name, const Column<Owner>& owners, const Value& value) {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(owners.size()));
    auto* values = array->GetPointer(0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, owners.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) values[i] = value(owners[i]);
    });
    data.AddArray(array);
}

}  // namespace

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

void AttributeArrays::add_attributes(vtkFieldData& data, const Column<Owner>& owners) const {
    const auto string = [&](const Owner& owner) -> const ModuleString& { return *plants_[owner.plant].frame->string; };
    const auto lineage = [&](const Owner& owner) { return plants_[owner.plant].lineage; };
    add_array<vtkTypeUInt64Array>(data, "identity", owners, [&](const Owner& owner) {
        return lineage(owner) ? string(owner).identities[owner.module] : 0;
    });
    add_array<vtkTypeUInt64Array>(data, "parent", owners, [&](const Owner& owner) {
        return lineage(owner) ? string(owner).parents[owner.module] : 0;
    });
    add_array<vtkTypeUInt32Array>(data, "plant", owners,
                                  [&](const Owner& owner) { return plants_[owner.plant].frame->plant; });
    add_array<vtkTypeUInt16Array>(data, "symbol", owners, [&](const Owner& owner) {
        return (*plants_[owner.plant].symbols)[string(owner).letters[owner.module]];
    });
    add_array<vtkTypeInt32Array>(data, "birth", owners, [&](const Owner& owner) {
        return lineage(owner) ? static_cast<std::int32_t>(string(owner).births[owner.module]) : 0;
    });
    add_array<vtkTypeUInt16Array>(data, "order", owners, [](const Owner& owner) { return owner.order; });
    add_array<vtkTypeUInt16Array>(data, "colour", owners, [](const Owner& owner) { return owner.colour; });
    add_array<vtkTypeUInt8Array>(data, "kind", owners,
                                 [](const Owner& owner) { return static_cast<std::uint8_t>(owner.kind); });
}

void AttributeArrays::add_looks(vtkFieldData& data, const Column<Owner>& owners,
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
    add_array<vtkTypeUInt16Array>(data, "texture", owners, [&](const Owner& owner) {
        const std::vector<std::uint16_t>& known = numbers[owner.plant];
        return owner.look.texture < known.size() ? known[owner.look.texture] : std::uint16_t{0};
    });
    add_array<vtkTypeUInt16Array>(data, "back_colour", owners,
                                  [](const Owner& owner) { return owner.look.back_colour; });
}

void AttributeArrays::add_colours(vtkFieldData& data, const Column<Owner>& owners) const {
    using Colour = std::array<std::uint8_t, 3>;
    if (std::none_of(plants_.begin(), plants_.end(), [](const Plant& plant) { return plant.frame->palette; })) return;
    std::size_t colours = 0;
    for (const Owner& owner : owners) colours = std::max(colours, std::size_t{owner.colour} + 1);
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
    vtkNew<vtkTypeUInt8Array> array;
    array->SetName("rgb");
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(owners.size()));
    std::uint8_t* values = array->GetPointer(0);
    for (const Owner& owner : owners) values = std::copy_n(tables[owner.plant][owner.colour].begin(), 3, values);
    data.AddArray(array);
}

void AttributeArrays::add_parameters(vtkFieldData& data, const Column<Owner>& owners) const {
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
        add_array<vtkDoubleArray>(data, chosen_[k].name.c_str(), owners, [&](const Owner& owner) {
            const Plant& plant = plants_[owner.plant];
            const ModuleString& string = *plant.frame->string;
            const int slot = plant.slots[k].find(string, owner.module);
            if (slot < 0) return std::numeric_limits<double>::quiet_NaN();
            return string.parameters[plant.offsets[owner.module] + static_cast<std::size_t>(slot)];
        });
    }
}

}  // namespace espalier

// The columns of the timeline: what is known of the module behind every point and cell.
#pragma once

#include "espalier/timeline/frame.h"

#include "timeline/chosen_parameters.h"
#include "timeline/inline_data.h"
#include "timeline/plant_mesh.h"
#include "timeline/symbol_numbers.h"

#include <span>
#include <string>
#include <vector>

namespace espalier {

/// Arrays with a value for each run of owners. Reused from frame to frame: clear() keeps the memory.
class OwnerArrays {
public:
    void clear() { count_ = 0; }
    template <class T, class Value>
    void add(const std::string& name, const Owners& owners, const Value& value) {
        T* values = append<T>(name, owners, 1);
        for (const Owner& owner : owners.values) *values++ = value(owner);
    }
    /// For arrays of several components; returns room for the values of the first run, then the second, ...
    template <class T>
    T* append(const std::string& name, const Owners& owners, int components) {
        if (count_ == arrays_.size()) arrays_.emplace_back();
        Array& array = arrays_[count_++];
        const std::size_t bytes = sizeof(T) * static_cast<std::size_t>(components);
        array.values.resize(owners.values.size() * bytes);
        array.data = {name, vtk_type<T>(), components, bytes, owners.size(), array.values.data(), owners.ends};
        return reinterpret_cast<T*>(array.values.data());
    }

    std::size_t size() const { return count_; }
    const DataArray& operator[](std::size_t i) const { return arrays_[i].data; }
    /// True if names and values are the same; runs are not compared.
    bool same_values(const OwnerArrays& other) const;

private:
    struct Array {
        DataArray data;
        Column<std::byte> values;
    };

    std::vector<Array> arrays_;  ///< the first `count_` are of this frame
    std::size_t count_ = 0;
};

/// A frame's modules as arrays. The frame outlives it.
class AttributeArrays {
public:
    AttributeArrays(const Frame& frame, SymbolNumbers& symbols, std::span<const ChosenParameter> chosen);

    /// identity, parent, plant, symbol, birth, order, colour, kind; zero where a string keeps no lineage.
    void add_attributes(OwnerArrays& arrays, const Owners& owners) const;
    /// texture (index into `texture_files`) and back_colour.
    void add_looks(OwnerArrays& arrays, const Owners& owners, std::vector<std::string>& texture_files) const;
    /// rgb, as the plants' palettes say, white where a plant has none; nothing if no plant has one.
    void add_colours(OwnerArrays& arrays, const Owners& owners) const;
    /// The chosen parameters, as doubles; NaN where a module has none.
    void add_parameters(OwnerArrays& arrays, const Owners& owners) const;

private:
    struct Plant {
        const PlantFrame* frame;
        const std::vector<std::uint16_t>* symbols;
        std::vector<std::size_t> offsets;   ///< of the parameters, if any are chosen
        std::vector<ParameterSlots> slots;  ///< of each chosen parameter
        bool lineage;
    };

    std::vector<Plant> plants_;
    std::span<const ChosenParameter> chosen_;
};

}  // namespace espalier

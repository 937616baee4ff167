// The columns of the timeline: what is known of the module behind every point and cell.
#pragma once

#include "espalier/timeline/frame.h"

#include "geometry/drawn/plant_mesh.h"
#include "timeline/files/inline_data.h"
#include "timeline/meshes/chosen_parameters.h"
#include "timeline/meshes/symbol_numbers.h"

#include <atomic>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::timeline {

/// Arrays with a value for each run of owners, written anew for every frame over those of the frame before.
class OwnerArrays {
public:
    /// Where the values of an array go, by several threads if need be.
    template <class T>
    class Writing {
    public:
        Writing(T* values, std::atomic<bool>& changed) : values_(values), changed_(changed), compares_(!changed) {}
        void put(std::size_t i, T value) const {
            if (compares_) {
                if (same_bits(values_[i], value)) return;
                if (!changed_.load(std::memory_order_relaxed)) changed_.store(true, std::memory_order_relaxed);
            }
            values_[i] = value;
        }

    private:
        T* values_;
        std::atomic<bool>& changed_;
        bool compares_;
    };

    void begin();
    /// Room for the values of the first run, `components` of them, then the second, ... The owners are whole.
    template <class T>
    Writing<T> append(const std::string& name, const Owners& owners, int components = 1) {
        const std::size_t bytes = sizeof(T) * static_cast<std::size_t>(components);
        Array& array = append(DataArray{name, vtk_type<T>(), components, bytes}, owners);
        return {reinterpret_cast<T*>(array.values.data()), array.changed};
    }

    std::size_t size() const { return count_; }
    DataArray operator[](std::size_t i) const;
    bool changed() const;
    /// Copies an array, a value for each point or cell; an array that is not there is empty.
    template <class T>
    void copy(std::string_view name, Column<T>& values) const {
        values.clear();
        const Array* const array = find(name);
        if (!array) return;
        const T* const of_runs = reinterpret_cast<const T*>(array->values.data());
        values.reserve(array->data.tuples);
        for (std::size_t run = 0; run < array->data.ends.size(); ++run) {
            values.insert(values.end(), array->data.ends[run] - values.size(), of_runs[run]);
        }
    }

private:
    struct Array {
        DataArray data;
        Column<std::byte> values;
        std::atomic<bool> changed = true;
    };

    Array& append(const DataArray& array, const Owners& owners);
    const Array* find(std::string_view name) const;

    std::deque<Array> arrays_;  ///< the first `count_` are of this frame
    std::size_t count_ = 0, count_before_ = 0;
};

/// A frame's modules as arrays. The frame outlives it.
class AttributeArrays {
public:
    AttributeArrays(const Frame& frame, SymbolNumbers& symbols, std::span<const ChosenParameter> chosen);

    /// identity, organ, parent, plant, symbol, birth, order, colour, kind; zero where a string keeps no lineage.
    void add_attributes(OwnerArrays& arrays, const Owners& owners) const;
    /// texture (index into `texture_files`) and back_colour. Files are named from `folder`, so that their names are the
    /// same wherever the folders lie; by their whole paths if there is none.
    void add_looks(OwnerArrays& arrays, const Owners& owners, const std::optional<std::filesystem::path>& folder,
                   std::vector<std::string>& texture_files) const;
    /// rgb, as the plants' palettes say, white where a plant has none; nothing if no plant has one.
    void add_colours(OwnerArrays& arrays, const Owners& owners) const;
    /// The chosen parameters, as doubles; NaN where a module has none.
    void add_parameters(OwnerArrays& arrays, const Owners& owners) const;
    /// What the processes of the environment know of the organs; NaN where they know nothing.
    void add_organs(OwnerArrays& arrays, const Owners& owners, const Environment* environment,
                    std::span<const OrganQuantity> quantities) const;

private:
    struct Plant {
        const PlantFrame* frame;
        const std::vector<std::uint16_t>* symbols;
        std::vector<std::size_t> offsets;   ///< offsets of the parameters, if any are chosen
        std::vector<ParameterSlots> slots;  ///< slots of each chosen parameter
        bool lineage;
    };

    std::vector<Plant> plants_;
    std::span<const ChosenParameter> chosen_;
};

}  // namespace espalier::timeline

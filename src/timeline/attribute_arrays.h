// The columns of the timeline: what is known of the module behind every point and cell.
#pragma once

#include "espalier/timeline/frame.h"

#include "timeline/chosen_parameters.h"
#include "timeline/plant_mesh.h"
#include "timeline/symbol_numbers.h"

#include <map>
#include <span>
#include <string>
#include <vector>

class vtkFieldData;

namespace espalier {

/// A frame's modules as arrays. The frame outlives it.
class AttributeArrays {
public:
    AttributeArrays(const Frame& frame, SymbolNumbers& symbols, std::span<const ChosenParameter> chosen);

    /// identity, parent, plant, symbol, birth, order, colour, kind; zero where a string keeps no lineage.
    void add_attributes(vtkFieldData& data, const Column<Owner>& owners) const;
    /// texture (index into `texture_files`) and back_colour.
    void add_looks(vtkFieldData& data, const Column<Owner>& owners, std::vector<std::string>& texture_files) const;
    /// rgb, as the plants' palettes say, white where a plant has none; nothing if no plant has one.
    void add_colours(vtkFieldData& data, const Column<Owner>& owners) const;
    /// The chosen parameters, as doubles; NaN where a module has none.
    void add_parameters(vtkFieldData& data, const Column<Owner>& owners) const;

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

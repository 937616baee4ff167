// Quantities of a plant's modules: `quantities = { mass = "sum(Stem.2)" }`.
#pragma once

#include "timeline/meshes/chosen_parameters.h"

#include <span>
#include <string>
#include <vector>

namespace espalier::timeline {

/// A sum, mean, least or greatest value of a parameter over the modules of a plant, or their number.
class ModuleQuantities {
public:
    /// Reads the table. Throws UserError for text that is not FUNCTION(SYMBOL.NUMBER).
    explicit ModuleQuantities(const Settings& table);

    std::vector<std::string> names() const;
    /// Throws UserError for symbols that no model has.
    void require_known(std::span<const Model* const> models) const;
    /// In the order of the names. NaN: the mean, least and greatest value where there is no such module.
    std::vector<double> of(const PlantFrame& plant) const;

private:
    enum class Function { sum, mean, min, max, count };

    std::vector<ChosenParameter> parameters_;
    std::vector<Function> functions_;
};

}  // namespace espalier::timeline

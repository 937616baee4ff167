// A turtle symbol: what it is called, how many parameters it may have, what it does. One entry in a file of
// src/turtle/symbols/ is all a new symbol needs.
#pragma once

#include "espalier/turtle/interpretation.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace espalier {

/// The walk a symbol acts upon.
struct Walk {
    const TurtleSettings& settings;
    Interpretation& result;
    TurtleState turtle;
    std::vector<TurtleState> stack;
    std::uint32_t module = 0;  ///< index in the plant's string of the module that is being drawn
    std::uint32_t plant = 0;
    std::vector<std::vector<glm::dvec3>> open_polygons;
    std::size_t polygons_open = 0;
    bool stop = false;  ///< set by `%` when the rest is not drawn
    const Model* model = nullptr;
    const ModuleString* string = nullptr;

    /// Moves by `distance` metres along the heading after the tropisms; draws an internode if asked.
    void move(double distance, bool draw, bool record_vertex);
};

using SymbolAction = void (*)(Walk& walk, std::span<const double> parameters);

/// Defining one registers it. `symbol` is what stands in the string ("F", "@o", "+"); `arities` the numbers of
/// parameters it acts on, others are ignored as cpfg ignores them.
struct Symbol {
    Symbol(std::string symbol, std::vector<int> arities, std::string help, SymbolAction action);

    std::string name;
    std::vector<int> arities;
    std::string help;
    SymbolAction action;
};

/// Every registered symbol, by name, with its help: what `espalier list symbols` prints.
const std::map<std::string, const Symbol*>& symbols();

}  // namespace espalier

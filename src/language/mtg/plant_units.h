// The units of a multiscale tree graph, which most files do not name.
#pragma once

#include "espalier/language/measured_plants.h"

#include "language/measured/notes.h"
#include "language/mtg/graph.h"

namespace espalier::language::mtg {

struct PlantUnits {
    double length = 1, diameter = 1;  ///< metres of one
    std::string words;                ///< "cm, diameters mm"
};

/// What decides between units: numbers of the file.
struct PlantNumbers {
    double extent = 0;    ///< the largest of a plant
    double thickest = 0;  ///< diameter; 0: there are none
    double thin = 0;      ///< the diameter that a fifth of them does not reach
};

/// As the user or the file says, or else as plants are: a guess is told. Throws UserError for a unit that is none.
PlantUnits units_of(const Graph& graph, const PlantNumbers& numbers, const MeasuredOptions& options,
                    const std::string& file, measured::Notes& notes);

}  // namespace espalier::language::mtg

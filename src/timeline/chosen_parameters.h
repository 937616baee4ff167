// Module parameters that become arrays: `parameters = { vigour = "F.2", light = "?E.1" }`.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/timeline/frame.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace espalier {

/// One array: the `number`-th parameter of every module of `symbol` that has as many.
struct ChosenParameter {
    std::string name;
    std::string symbol;
    int number = 1;
    Place place;

    bool of_query() const { return symbol.front() == '?'; }
};

/// Reads the table. Throws UserError for text that is not SYMBOL.NUMBER and for names the timeline uses itself.
std::vector<ChosenParameter> read_chosen_parameters(const Settings& table);

/// Throws UserError for a symbol none of the plants' models has, or a number it has no parameter for.
void require_known(std::span<const ChosenParameter> chosen, std::span<const PlantFrame> plants);

/// Where in its module's parameters a letter keeps the chosen one, -1 if it has none; indexed by letter.
std::vector<int> parameter_slots(const ChosenParameter& chosen, const Alphabet& alphabet);

}  // namespace espalier

// Module parameters that become arrays: `parameters = { vigour = "F.2", light = "?E.1" }`.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/timeline/frame.h"

#include <span>
#include <string>
#include <vector>

namespace espalier::timeline {

/// One array: the `number`-th parameter of every module of `symbol` that has as many.
struct ChosenParameter {
    std::string name;
    std::string symbol;
    int number = 1;
    Place place;

    bool of_query() const { return symbol.front() == '?'; }
};

/// Reads SYMBOL.NUMBER. Throws UserError for other text.
ChosenParameter chosen_parameter(const std::string& text, const std::string& name, const Place& place);

/// Reads the table. Throws UserError for text that is not SYMBOL.NUMBER and for names the timeline uses itself.
std::vector<ChosenParameter> read_chosen_parameters(const Settings& table);

/// Throws UserError for a symbol none of the models has, or a number it has no parameter for.
void require_known(std::span<const ChosenParameter> chosen, std::span<const Model* const> models);

/// Where the modules of one model keep a chosen parameter. Only the last module of a symbol of several characters, as
/// `?E` or `@o`, has parameters; those before it are modules of their own.
class ParameterSlots {
public:
    ParameterSlots(const ChosenParameter& chosen, const Alphabet& alphabet);

    /// Place among the module's parameters, counted from 0; -1 if the module has no such parameter.
    int find(const ModuleString& string, std::size_t module) const;

private:
    int slot_;
    std::vector<char> carries_;        ///< by letter
    std::vector<LetterId> preceding_;  ///< the symbol's modules before the one that carries
};

}  // namespace espalier::timeline

// A turtle symbol: what it is called, how many parameters it may have, what it does. One entry in a file of
// src/turtle/symbols/ is all a new symbol needs.
#pragma once

#include "espalier/base/registry.h"
#include "espalier/base/stations.h"
#include "espalier/turtle/walk.h"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace espalier::turtle {

using SymbolAction = void (*)(Walk& walk, std::span<const double> parameters);

/// `name` is what stands in the string ("F", "@o", "+"); its characters are modules of their own, of which only the
/// last may have parameters. A final `*` stands for any character ("~*"). `arities` are the numbers of parameters it
/// acts on, any if empty; with other numbers it is skipped. A constant `Registered<Symbol>` registers it.
struct Symbol {
    /// Rows of result that are counted before a string is walked: an internode, a query, an answer of the turtle's. A
    /// symbol that says less than it does costs time, nothing else.
    enum class Effect : std::uint8_t { other, draws, asks, answers };

    /// What the loop of every walk does itself, with the turtle in registers. `action` does the same.
    enum class Step : std::uint8_t {
        by_action,
        none,
        draw,
        skip,
        left,
        right,
        down,
        up,
        roll,
        roll_back,
        width,
        open,
        close
    };

    bool accepts(int arity) const;

    std::string name;
    std::vector<int> arities;
    std::string help;
    SymbolAction action;
    Effect effect = Effect::other;
    Step step = Step::by_action;
};

/// The names of all symbols, and the numbers of parameters on which they act; none: on any.
std::map<std::string, std::vector<int>, std::less<>> symbol_arities();

/// Symbols that belong together, as the manual tells of them: one group in each file of src/turtle/symbols/.
struct SymbolGroup {
    std::string name;                  ///< of the file, with hyphens
    std::string summary;               ///< what the symbols do, in a few words
    std::vector<std::string> symbols;  ///< their names, in the order in which the manual has them
    std::string help;                  ///< what holds for all of them: units, defaults, sources
    std::string example;               ///< a small axiom that uses them
};

}  // namespace espalier::turtle

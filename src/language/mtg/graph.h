// A multiscale tree graph as a file of the AMAPmod and OpenAlea programs writes it (Godin & Caraglio 1998).
#pragma once

#include "espalier/base/error.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language::mtg {

struct Vertex {
    std::string label;                     ///< class and index, "I12"
    int scale = 0;                         ///< of its class; the coarsest is 1
    bool follows = false;                  ///< <, its parent's successor; else +, borne by it
    std::optional<std::size_t> parent;     ///< at the same scale
    std::optional<std::size_t> complex;    ///< what it is a part of
    std::optional<std::size_t> last_part;  ///< the last of its own parts
    std::optional<std::size_t> stands_on;  ///< of any scale; where it was attached
    std::vector<std::string> features;     ///< cells of its line; none for those that a line passes
    Place place;
};

struct Graph {
    std::vector<Vertex> vertices;               ///< each after its parent and its complex
    std::map<std::string, std::size_t> column;  ///< of a feature, by its name in small letters
    std::string unit = "m", up = "z";           ///< of lines "# unit: cm" and "# up: y"

    /// A feature as a finite number; nothing if it has none of these names.
    std::optional<double> number(const Vertex& vertex, std::initializer_list<const char*> names) const;
};

/// Throws UserError with the line and column of a mistake.
Graph read(const std::string& text, const std::string& name);

}  // namespace espalier::language::mtg

// A multiscale tree graph as a file of the AMAPmod and OpenAlea programs writes it (Godin & Caraglio 1998).
#pragma once

#include "espalier/base/error.h"

#include "language/mtg/measure_rows.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language::measured {
class Notes;
}

namespace espalier::language::mtg {

constexpr std::uint32_t none = 0xFFFFFFFF;

struct Vertex {
    std::string_view label;          ///< class and index, "I12"; within the graph's labels
    std::uint32_t parent = none;     ///< at the same scale, or a coarser one without parts
    std::uint32_t complex = none;    ///< what it is a part of
    std::uint32_t last_part = none;  ///< the last of its own parts
    std::uint32_t stands_on = none;  ///< of any scale; where it was attached
    std::uint32_t row = none;        ///< of the measures; none for those that a line passes
    std::int32_t line = 0, column = 0;
    std::int16_t scale = 0;  ///< of its class
    bool follows = false;    ///< <, its parent's successor; else +, borne by it
    bool is_first_part = false;
};

struct Graph {
    std::vector<Vertex> vertices;  ///< each after its parent and its complex
    MeasureRows rows;
    std::map<std::uint32_t, std::string> plant_names;  ///< of vertices, from a column "plant"
    std::vector<char> labels;                          ///< of all vertices, one after the other
    std::array<double, 3> origin{};    ///< of a line "# origin: x y z", m, which is added to coordinates
    std::string unit = {}, up = {};    ///< of lines "# unit: cm" and "# up: y"; "" if there is none
    std::string diameter_unit = {};    ///< of the columns of diameters
    std::vector<std::string> columns;  ///< all of them, as they are written
    bool has_times = false;

    double measure(const Vertex& vertex, Measure which) const;
};

/// Throws UserError with the line and column of a mistake.
Graph read(const std::string& text, const std::string& name, measured::Notes& notes);

}  // namespace espalier::language::mtg

// An RSML file as it is written: roots, points and values without units, in the file's own axes.
#pragma once

#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/rsml/vocabulary.h"

#include <glm/vec3.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language::rsml {

enum class Domain { polyline, length, uniform };

/// A value along a root.
struct RawFunction {
    std::string name;
    Term term;
    Domain domain = Domain::polyline;
    double origin = 0;
    std::optional<double> step = {};
    std::vector<double> positions = {};  ///< one for each sample, or none
    std::vector<double> samples = {};    ///< NaN where the file has none
    Place place = {};
};

struct RawProperty {
    std::string name;
    Term term;
    double value;
};

struct RawRoot {
    measured::LooseAxis axis;  ///< without nodes
    std::vector<glm::dvec3> points;
    std::vector<std::size_t> breaks;  ///< points that begin a further polyline
    std::vector<RawFunction> functions;
    std::vector<RawProperty> properties;
};

struct RawFile {
    std::vector<std::string> plants;  ///< their labels
    std::vector<RawRoot> roots;       ///< each after its bearer
    std::optional<std::string> unit, up;
    std::string software;
    double resolution = 1;
    bool is_flat = true;                              ///< z is 0 or absent everywhere
    std::map<std::string, std::string> defined_unit;  ///< of a property
};

/// Notes what is not used. Throws UserError with the place of a mistake.
RawFile read_raw(std::string text, const std::string& name, measured::Notes& notes);

}  // namespace espalier::language::rsml

// What a file of the Root System Markup Language says (Lobet et al. 2015): roots as polylines with what is known of
// their nodes.
#pragma once

#include "espalier/base/error.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace espalier::language::rsml {

struct Node {
    glm::dvec3 at{0};  ///< m, y upwards
    double diameter = 0;
    double day = 0;  ///< of its birth
};

struct Root {
    std::string label;
    std::optional<std::size_t> bearer;   ///< a root before it
    std::optional<std::size_t> on_node;  ///< of the bearer
    int order = 0;
    std::vector<Node> nodes;  ///< one or more
    Place place;
};

struct Document {
    std::vector<Root> roots;  ///< each after its bearer
    bool has_times = false;
};

/// Reads a text. Lengths become metres by the file's unit and resolution. A file's vertical axis is what its metadata
/// calls `up`; else it is z, upwards if the first root of the file ends below its base so, or y of a picture without z,
/// downwards. Throws UserError with the place of a mistake.
Document read(const std::string& text, const std::string& name);

}  // namespace espalier::language::rsml

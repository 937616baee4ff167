// Where a graph wrote the parts of the model that it is translated into.
#pragma once

#include "language/pgraph/graph.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::language::pgraph {

/// Names of an expression, and the text that takes their place.
using Names = std::map<std::string, std::string>;

/// The text with names replaced by other text.
std::string substituted(const std::string& text, const Names& names);

/// The files of a graph; what is marked keeps its place in them.
class Origins {
public:
    explicit Origins(const Graph& graph);

    const std::vector<std::string>& files() const { return files_; }
    /// The text itself if the place is not known.
    std::string marked(const std::string& text, const Place& place) const;
    /// An expression that begins at a place, with names replaced: each of its words keeps its own place.
    std::string written(const std::string& expression, const Place& place, const Names& names) const;

private:
    void add(const Place& place);

    std::vector<std::string> files_;
};

}  // namespace espalier::language::pgraph

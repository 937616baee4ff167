// The values of a graph's keys: checked, and written as expressions of the language of models.
#pragma once

#include "language/pgraph/graph.h"
#include "language/pgraph/origins.h"
#include "language/pgraph/schema.h"
#include "language/pgraph/structure.h"

#include <string>
#include <utility>
#include <vector>

namespace espalier::language::pgraph {

/// Throws UserError for expressions that are none, and for constants that are not in their range.
void check_values(const Graph& graph);

/// The numbers of a list of constants.
std::vector<double> numbers_of(const Graph& graph, const Value& list);

/// Writes the values of one component. Instances are numbered i of n, and `depth` counts the innermost recursion.
class Values {
public:
    Values(const Component& component, const Structure& structure, const Origins& origins);

    /// A number for each instance: the range, then the function, then the noise.
    std::string number(const std::string& key) const;
    /// The same, rounded to a whole number.
    std::string whole(const std::string& key) const;
    /// The parameters that hold a value of an instance, with what they are set to: one, or the two ends along the axis.
    std::vector<std::pair<std::string, std::string>> parameters(const std::string& key) const;
    /// A value along the axis where `part` is 0 at the base and 1 at the tip, from those parameters.
    std::string along(const std::string& key, const std::string& part) const;
    bool is_set(const std::string& key) const { return component_.find(key) != nullptr; }

private:
    /// A part of a value, or what stands behind the parts, with the names of an instance and others replaced.
    std::string expression(const Value& value, std::size_t k, const std::string& text, Names names = {}) const;
    std::string function_of(const Value& value, const std::string& argument) const;

    const Component& component_;
    const Origins& origins_;
    std::string depth_;
};

}  // namespace espalier::language::pgraph

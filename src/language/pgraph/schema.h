// The types of components: their keys with units, ranges and defaults.
#pragma once

#include "language/pgraph/graph.h"

#include <limits>
#include <string>
#include <vector>

namespace espalier::language::pgraph {

enum class KeyKind {
    instance,  ///< a range is spread over the instances
    children,  ///< a range is spread over what the component multiplies
    axis,      ///< a range runs along the axis
    literal,   ///< a whole number that shapes the productions
    list,      ///< numbers between commas
    vector,    ///< three of them
    field,     ///< three functions of a place x, y, z
    word,      ///< one of a few
};

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Key {
    std::string name;
    KeyKind kind;
    std::string unit;  ///< "" for a pure number
    double lowest, highest;
    std::string standard;  ///< the default, as a file would say it
    std::string summary;
};

struct ComponentType {
    std::string name, summary;
    std::vector<Key> keys;
    bool multiplies = false;    ///< its children
    bool has_branches = false;  ///< carries branch links
    bool has_place = true;      ///< knows the keys of place, size and colour

    const Key* find(const std::string& key) const;
};

const std::vector<ComponentType>& component_types();
const ComponentType* find_type(const std::string& name);

/// What a component says of a key, or the key's default.
Value value_of(const Component& component, const std::string& key);

/// The types and keys as a person reads them.
std::string describe_types();

/// True for what is written with commas.
bool is_listed(KeyKind kind);

/// Splits the text of a value; false if it is none of this kind.
bool read_value(const std::string& text, KeyKind kind, Value& value);

}  // namespace espalier::language::pgraph

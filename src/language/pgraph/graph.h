// A graph of component prototypes (p-graph) after Lintermann & Deussen 1997, as its file states it.
#pragma once

#include "espalier/base/error.h"

#include <string>
#include <vector>

namespace espalier::language::pgraph {

/// What a key is set to: a number, a range over instances or along an axis, a list, or a word.
struct Value {
    std::vector<std::string> parts;  ///< expressions: one, the two ends of a range, or a list
    bool is_range = false;           ///< between parts[0] and parts[1]
    std::string function = {};       ///< function of x, applied to what the range gives; may be empty
    std::string noise = {};          ///< largest deviation drawn at last; may be empty
    Place place = {};
    /// Where the parts stand in its line, then the function and the noise; none for a default.
    std::vector<int> columns = {};

    /// Returns the place of a part, or of what stands behind the parts.
    Place place_of(std::size_t k) const {
        return k < columns.size() ? Place{place.file, place.line, columns[k]} : Place{};
    }
    bool operator==(const Value& other) const {
        return parts == other.parts && is_range == other.is_range && function == other.function && noise == other.noise;
    }
};

struct KeyValue {
    std::string key;
    Value value;
    Place place = {};

    bool operator==(const KeyValue& other) const { return key == other.key && value == other.value; }
};

struct Component {
    std::string type;  ///< "Horn"
    std::string name;  ///< "stem"
    std::vector<KeyValue> keys = {};
    Place place = {};

    const Value* find(const std::string& key) const;
    bool operator==(const Component& other) const {
        return type == other.type && name == other.name && keys == other.keys;
    }
};

enum class LinkKind { child, branch, leaf };

struct Link {
    std::string from, to;
    LinkKind kind = LinkKind::child;
    Place place = {};

    bool operator==(const Link& other) const { return from == other.from && to == other.to && kind == other.kind; }
};

/// A line of #define with its comment, which makes it a setting.
struct Define {
    std::string text;
    Place place = {};

    bool operator==(const Define& other) const { return text == other.text; }
};

struct Graph {
    int version = 1;
    std::vector<Define> defines;
    std::vector<Component> components;
    std::vector<Link> links;

    const Component* find(const std::string& name) const;
    bool operator==(const Graph&) const = default;
};

/// The root of every graph: what a picture of the graph draws as a camera. It is in no file as a component.
inline const std::string camera = "camera";

/// Reads a graph; `name` stands in messages. Throws UserError with every mistake at its place.
Graph parse(const std::string& text, const std::string& name);

/// The text that parse() reads as this graph.
std::string print(const Graph& graph);

}  // namespace espalier::language::pgraph

// Graphs of components as pages see and edit them.
#pragma once

#include "studio/protocol/declaration.h"

namespace espalier::studio {

struct ComponentKey {
    static constexpr TypeName type{"ComponentKey", "a value that components of a type have"};
    std::string name, summary, unit, standard, kind;
    Nullable<double> lowest, highest;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "as files write it");
        field("summary", self.summary, "what it is");
        field("unit", self.unit, "empty for a pure number");
        field("lowest", self.lowest, "null if there is no bound");
        field("highest", self.highest, "null if there is no bound");
        field("standard", self.standard, "what holds without it, as a file would say it");
        field("kind", self.kind, "`number` also stands for a range", one_of("number whole list word"));
    }
};

struct ComponentForm {
    static constexpr TypeName type{"ComponentType", "a type of components"};
    std::string name, summary;
    std::vector<ComponentKey> keys;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "as files write it");
        field("summary", self.summary, "what it is");
        field("keys", self.keys, "in the order of the manual");
    }
};

struct GraphComponent {
    static constexpr TypeName type{"GraphComponent", "a component of a graph"};
    std::string name, component_type;
    Nullable<int> line;
    std::map<std::string, std::string> values;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "unique in the graph");
        field("type", self.component_type, "name of its type");
        field("line", self.line, "line of its text; null if another file defines it");
        field("values", self.values, "what its text says of its keys");
    }
};

struct GraphLink {
    static constexpr TypeName type{"GraphLink", "a link between components"};
    static constexpr Allowed kinds = one_of("child branch leaf");
    std::string from, to, kind;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("from", self.from, "name of a component");
        field("to", self.to, "name of a component");
        field("kind", self.kind, "how it is attached", kinds);
    }
};

struct ComponentGraph {
    static constexpr TypeName type{"ComponentGraph", "a text of the language pgraph that can be read"};
    std::string path;
    std::vector<GraphComponent> components;
    std::vector<GraphLink> links;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text");
        field("components", self.components, "in the order of the text");
        field("links", self.links, "in the order of the text");
    }
};

struct GraphEdit {
    static constexpr TypeName type{"GraphEdit", "one change of a graph"};
    std::string edit;
    std::optional<std::string> component, key, component_type, name, from, to, kind;
    std::optional<Nullable<std::string>> text;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("edit", self.edit,
              "`set` with `component`, `key`, `text`; `add` with `type`, `name`, `from`; `remove` with `component`; "
              "`link` and `unlink` with `from`, `to`, `kind`",
              one_of("set add remove link unlink"));
        field("component", self.component, "name of a component");
        field("key", self.key, "name of a key of its type");
        field("text", self.text, "the value as the file writes it; null takes it out");
        field("type", self.component_type, "type of the new component");
        field("name", self.name, "name of the new component");
        field("from", self.from, "component from which the link leads");
        field("to", self.to, "component to which the link leads");
        field("kind", self.kind, "kind of the link", GraphLink::kinds);
    }
};

}  // namespace espalier::studio

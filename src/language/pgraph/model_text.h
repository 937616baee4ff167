// The text of a model as it is put together, section by section.
#pragma once

#include "language/pgraph/graph.h"
#include "language/pgraph/origins.h"
#include "language/pgraph/structure.h"
#include "language/pgraph/values.h"

#include <string>
#include <utility>
#include <vector>

namespace espalier::language::pgraph {

/// Names and values of parameters, in order.
using Parameters = std::vector<std::pair<std::string, std::string>>;

std::string names_of(const Parameters& parameters);
std::string values_of(const Parameters& parameters);

/// What one component adds to the model.
class ComponentText {
public:
    ComponentText(const Graph& graph, const Structure& structure, const Origins& origins, const Component& component);

    /// The component's modules: the bud, and what stays of it. `suffix` makes the names of others.
    std::string bud() const { return component_.name; }
    std::string kept() const;
    /// Parameters that say where an instance stands: "i, n" and the depths of the recursions around.
    std::string place() const {
        return "i, n" + depths_ + (structure_.can_continue(component_.name) ? ", joined" : "");
    }
    const std::string& depths() const { return depths_; }

    /// A module with parameters in parentheses, or without both; declares it on the left of an arrow.
    std::string declared(const std::string& module, const std::string& parameters);
    static std::string call(const std::string& module, const std::string& parameters);

    /// Rolls, turns and moves to where the component begins.
    std::string placing() const;
    /// Turns and scales a child away from the direction of its place.
    std::string direction_of_child() const;
    /// The links of a kind and what stands in for them at the end of a recursion, each between brackets and behind the
    /// given modules.
    std::string followers(LinkKind kind, const std::string& placed = "") const;
    /// The link whose axis goes on the surface of this one, with the end of both; "" if there is none.
    std::string continuation() const;
    /// Turns towards gravity and light, by a share of the strength that the component's keys give.
    std::string pull(const std::string& share) const;
    std::vector<std::string> tropisms() const;
    /// A parameter of the instance for each key.
    Parameters parameters(const std::vector<std::string>& keys) const;

    const Component& component() const { return component_; }
    const Graph& graph() const { return graph_; }
    const Structure& structure() const { return structure_; }
    const Values& values() const { return values_; }
    const Origins& origins() const { return origins_; }

    std::vector<std::string> modules, fields, productions, decomposition, homomorphism, arrays;

private:
    std::string bud_of(const Link& link) const;
    void add_end_of_recursion();
    LinkKind kind_of_leaf_links() const;

    const Graph& graph_;
    const Structure& structure_;
    const Origins& origins_;
    const Component& component_;
    Values values_;
    std::string depths_;
};

// They write the productions of a component: one for each family of types.
void write_horn(ComponentText& text);
void write_tree(ComponentText& text);
void write_leaf(ComponentText& text);
void write_simple(ComponentText& text);
void write_multiplier(ComponentText& text);
void write_world(ComponentText& text);
void write_deformation(ComponentText& text);

}  // namespace espalier::language::pgraph

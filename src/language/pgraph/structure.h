// What follows from the links of a graph: which loops are recursions, how they nest, how long the paths are.
#pragma once

#include "language/pgraph/graph.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace espalier::language::pgraph {

/// Sides of the closed surface of a component's axis; 0: it has none.
int sides_of(const Component& component);

/// The recursion of every component that a link leads back to: its head. Recursions stand apart or inside one another.
class Structure {
public:
    /// Throws UserError for recursions that overlap or have no limit, and for what no link reaches.
    explicit Structure(const Graph& graph);

    /// True if the link leads back to a component on the way to it.
    bool leads_back(const Link& link) const { return back_.contains(&link); }
    /// The heads of the recursions that a component is part of, outermost first.
    const std::vector<std::string>& enclosing_recursions(const std::string& component) const;
    /// Instances of a head on one path.
    int limit(const std::string& head) const;
    std::vector<const Link*> links_from(const std::string& component) const;
    /// The links that a leaf link of this component stands in for once all of them have come to their limit.
    std::vector<const Link*> repeated_by(const std::string& component) const;
    /// The component World that governs a component; null for the usual directions.
    const Component* world_of(const std::string& component) const;
    /// The first child link to an axis with as many sides: the surface goes on there. Null if there is none.
    const Link* continuing_link(const std::string& from) const;
    /// Such a link leads to it.
    bool can_continue(const std::string& component) const;
    /// Steps from the camera to the last instance of the longest path.
    int generations() const;

private:
    void find_back_links(const std::string& component, std::vector<std::string>& path, std::set<std::string>& done);
    std::set<std::string> between(const std::string& head, const std::string& last) const;
    void find_bodies();
    void check_nesting();
    void check_entries();
    void check_keys();
    void order_heads();
    void find_worlds();
    void report(const Place& place, const std::string& message);
    void stop_if_wrong();

    const Graph& graph_;
    std::set<const Link*> back_;
    std::map<std::string, std::set<std::string>> bodies_;  ///< by head
    std::map<std::string, std::vector<std::string>> heads_;
    std::map<std::string, std::set<const Component*>> worlds_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace espalier::language::pgraph

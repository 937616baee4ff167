#include "language/pgraph/structure.h"

#include "language/pgraph/schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace espalier::language::pgraph {
namespace {

bool contains(const std::set<std::string>& outer, const std::set<std::string>& inner) {
    return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
}

bool meet(const std::set<std::string>& a, const std::set<std::string>& b) {
    return std::any_of(a.begin(), a.end(), [&](const std::string& name) { return b.contains(name); });
}

}  // namespace

Structure::Structure(const Graph& graph) : graph_(graph) {
    std::vector<std::string> path;
    std::set<std::string> reached;
    find_back_links(camera, path, reached);
    if (links_from(camera).empty()) {
        const Component& first = graph.components.front();
        report(first.place, fmt::format("no link begins at the camera: write 'camera -> {}'", first.name));
        stop_if_wrong();
    }
    for (const Component& component : graph.components) {
        if (reached.contains(component.name)) continue;
        report(component.place,
               fmt::format("no link leads from the camera to '{}'; without one it has no instances", component.name));
    }
    stop_if_wrong();
    find_bodies();
    check_nesting();
    stop_if_wrong();
    check_entries();
    check_keys();
    stop_if_wrong();
    order_heads();
    find_worlds();
    stop_if_wrong();
}

void Structure::report(const Place& place, const std::string& message) {
    mistakes_.push_back({Diagnostic::Severity::error, place, message});
}

void Structure::stop_if_wrong() {
    if (!mistakes_.empty()) throw UserError(mistakes_);
}

std::vector<const Link*> Structure::links_from(const std::string& component) const {
    std::vector<const Link*> links;
    for (const Link& link : graph_.links) {
        if (link.from == component) links.push_back(&link);
    }
    return links;
}

void Structure::find_back_links(const std::string& component, std::vector<std::string>& path,
                                std::set<std::string>& done) {
    if (!done.insert(component).second) return;
    path.push_back(component);
    for (const Link* link : links_from(component)) {
        if (std::find(path.begin(), path.end(), link->to) != path.end()) {
            back_.insert(link);
        } else {
            find_back_links(link->to, path, done);
        }
    }
    path.pop_back();
}

// What lies on paths from a head to the component that leads back to it, without other links back.
std::set<std::string> Structure::between(const std::string& head, const std::string& last) const {
    std::set<std::string> body;
    std::map<std::string, bool> arrives;
    const std::function<bool(const std::string&)> follow = [&](const std::string& name) {
        if (const auto known = arrives.find(name); known != arrives.end()) return known->second;
        bool found = name == last;
        for (const Link* link : links_from(name)) {
            if (!leads_back(*link) && follow(link->to)) found = true;
        }
        if (found) body.insert(name);
        return arrives[name] = found;
    };
    follow(head);
    return body;
}

void Structure::find_bodies() {
    for (const Link& link : graph_.links) {
        if (leads_back(link)) bodies_[link.to].merge(between(link.to, link.from));
    }
}

void Structure::check_nesting() {
    for (const auto& [head, body] : bodies_) {
        for (const auto& [other, other_body] : bodies_) {
            if (head >= other || !meet(body, other_body)) continue;
            if (contains(body, other_body) || contains(other_body, body)) continue;
            report(graph_.find(other)->place,
                   fmt::format("the recursions of '{}' ({}) and '{}' ({}) overlap; one must lie within the other, or "
                               "they must have no component in common",
                               head, fmt::join(body, ", "), other, fmt::join(other_body, ", ")));
        }
    }
}

void Structure::check_entries() {
    for (const Link& link : graph_.links) {
        for (const auto& [head, body] : bodies_) {
            if (link.to == head || !body.contains(link.to) || body.contains(link.from)) continue;
            report(link.place,
                   fmt::format("this link enters the recursion of '{}' at '{}': it overlaps with what leads "
                               "there; link to '{}' instead",
                               head, link.to, head));
        }
    }
}

void Structure::check_keys() {
    for (const Component& component : graph_.components) {
        const bool is_head = bodies_.contains(component.name);
        const Value* limit = component.find("recursion");
        if (is_head && !limit) {
            report(component.place,
                   fmt::format("a link leads back to '{}': say how often, with 'recursion 3' or so", component.name));
        } else if (!is_head && limit) {
            report(limit->place,
                   fmt::format("no link leads back to '{}'; the key 'recursion' belongs to a component that "
                               "one leads back to",
                               component.name));
        }
    }
    for (const Link& link : graph_.links) {
        if (link.kind == LinkKind::leaf && link.from != camera && repeated_by(link.from).empty()) {
            report(link.place,
                   fmt::format("a leaf link stands in for a link that leads back, and '{}' has none", link.from));
        }
    }
}

std::vector<const Link*> Structure::repeated_by(const std::string& component) const {
    std::vector<const Link*> repeated;
    for (const Link* link : links_from(component)) {
        if (leads_back(*link) && link->kind != LinkKind::leaf) repeated.push_back(link);
    }
    return repeated;
}

void Structure::order_heads() {
    heads_[camera] = {};
    for (const Component& component : graph_.components) {
        std::vector<std::string>& around = heads_[component.name];
        for (const auto& [head, body] : bodies_) {
            if (body.contains(component.name)) around.push_back(head);
        }
        std::sort(around.begin(), around.end(), [&](const std::string& a, const std::string& b) {
            return bodies_.at(a).size() > bodies_.at(b).size();
        });
    }
}

const std::vector<std::string>& Structure::enclosing_recursions(const std::string& component) const {
    return heads_.at(component);
}

int Structure::limit(const std::string& head) const {
    return std::stoi(value_of(*graph_.find(head), "recursion").parts.front());
}

void Structure::find_worlds() {
    const std::function<void(const std::string&, const Component*)> follow = [&](const std::string& name,
                                                                                 const Component* world) {
        const Component* component = graph_.find(name);
        if (component && component->type == "World") world = component;
        if (!worlds_[name].insert(world).second) return;
        for (const Link* link : links_from(name)) follow(link->to, world);
    };
    follow(camera, nullptr);
    for (const auto& [name, worlds] : worlds_) {
        if (worlds.size() == 1 || name == camera) continue;
        const bool has_tropism = find_type(graph_.find(name)->type)->find("gravitropism");
        if (!has_tropism) continue;
        report(graph_.find(name)->place,
               fmt::format("links lead to '{}' from different worlds; write a component for each", name));
    }
}

const Component* Structure::world_of(const std::string& component) const {
    return *worlds_.at(component).begin();
}

int sides_of(const Component& component) {
    const ComponentType& type = *find_type(component.type);
    const bool has_axis = type.find("sides") && type.find("pieces");
    return has_axis ? std::stoi(value_of(component, "sides").parts.front()) : 0;
}

const Link* Structure::continuing_link(const std::string& from) const {
    const Component* component = graph_.find(from);
    const int sides = component ? sides_of(*component) : 0;
    for (const Link* link : links_from(from)) {
        const bool fits = link->kind == LinkKind::child && sides > 0;
        if (fits && sides_of(*graph_.find(link->to)) == sides) return link;
    }
    return nullptr;
}

bool Structure::can_continue(const std::string& component) const {
    return std::any_of(graph_.components.begin(), graph_.components.end(), [&](const Component& each) {
        const Link* link = continuing_link(each.name);
        return link && link->to == component;
    });
}

int Structure::generations() const {
    using Depths = std::map<std::string, int>;
    std::map<std::pair<std::string, Depths>, int> known;
    const std::function<int(const std::string&, const Depths&)> longest = [&](const std::string& name,
                                                                              const Depths& depths) {
        const auto [found, is_new] = known.try_emplace({name, depths}, 0);
        if (!is_new) return found->second;
        int steps = 0;
        for (const Link* link : links_from(name)) {
            Depths next;
            for (const std::string& head : enclosing_recursions(link->to)) {
                const auto here = depths.find(head);
                next[head] = here == depths.end() ? 1 : here->second + (head == link->to);
            }
            const bool refused = next.contains(link->to) && next.at(link->to) > limit(link->to);
            if (!refused) steps = std::max(steps, 1 + longest(link->to, next));
        }
        return known[{name, depths}] = steps;
    };
    return longest(camera, {});
}

}  // namespace espalier::language::pgraph

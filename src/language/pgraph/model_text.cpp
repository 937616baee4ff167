#include "language/pgraph/model_text.h"

#include "language/text/marks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::language::pgraph {

std::string names_of(const Parameters& parameters) {
    std::string text;
    for (const auto& [name, value] : parameters) text += (text.empty() ? "" : ", ") + name;
    return text;
}

std::string values_of(const Parameters& parameters) {
    std::string text;
    for (const auto& [name, value] : parameters) text += (text.empty() ? "" : ", ") + value;
    return text;
}

ComponentText::ComponentText(const Graph& graph, const Structure& structure, const Origins& origins,
                             const Component& component)
    : graph_(graph),
      structure_(structure),
      origins_(origins),
      component_(component),
      values_(component, structure, origins) {
    for (const std::string& head : structure.enclosing_recursions(component.name)) depths_ += ", depth_" + head;
    declared(bud(), place());
    const std::vector<std::string>& heads = structure.enclosing_recursions(component.name);
    if (!heads.empty() && heads.back() == component.name) {
        decomposition.push_back(fmt::format("{}({}) : depth_{} > {} --> *", bud(), place(), component.name,
                                            structure.limit(component.name)));
    }
    add_end_of_recursion();
}

std::string ComponentText::continuation() const {
    const Link* link = structure_.continuing_link(component_.name);
    return link ? fmt::format(" {} @Ge(1)", bud_of(*link)) : "";
}

std::string ComponentText::kept() const {
    std::string name = component_.name;
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    return name;
}

std::string ComponentText::call(const std::string& module, const std::string& parameters) {
    return parameters.empty() ? module : module + "(" + parameters + ")";
}

std::string ComponentText::declared(const std::string& module, const std::string& parameters) {
    const std::string text = call(module, parameters);
    if (std::find(modules.begin(), modules.end(), text) == modules.end()) modules.push_back(text);
    return text;
}

std::string ComponentText::placing() const {
    std::string text;
    for (const auto& [key, symbol] : {std::pair{"roll", "/"},
                                      {"pitch", "&"},
                                      {"turn", "+"},
                                      {"move", "f"},
                                      {"scale", "@Di"},
                                      {"colour", ";"},
                                      {"texture", "@Tx"}}) {
        if (values_.is_set(key)) text += fmt::format("{}({}) ", symbol, values_.number(key));
    }
    return text;
}

std::string ComponentText::direction_of_child() const {
    std::string text;
    const std::string angle = values_.number("angle");
    if (without_marks(angle) != "0") text += fmt::format("&({}) ", angle);
    if (values_.is_set("child_scale")) text += fmt::format("@Di({}) ", values_.number("child_scale"));
    return text;
}

Parameters ComponentText::parameters(const std::vector<std::string>& keys) const {
    Parameters all;
    for (const std::string& key : keys) {
        for (const auto& parameter : values_.parameters(key)) all.push_back(parameter);
    }
    return all;
}

std::vector<std::string> ComponentText::tropisms() const {
    std::vector<std::string> keys;
    for (const char* key : {"gravitropism", "phototropism"}) {
        if (values_.is_set(key)) keys.emplace_back(key);
    }
    return keys;
}

std::string ComponentText::pull(const std::string& share) const {
    const Component* world = structure_.world_of(component_.name);
    std::string turns;
    for (const std::string& tropism : tropisms()) {
        const std::string field = tropism == "gravitropism" ? "gravity" : "light";
        if (world && world->find(field)) {
            turns += fmt::format("@Tv({}_{}, {} * {}) ", field, world->name, tropism, share);
        } else {
            const Value direction = value_of({"World", ""}, field);
            turns += fmt::format("@Th({}, {} * {}) ", fmt::join(direction.parts, ", "), tropism, share);
        }
    }
    return turns;
}

std::string ComponentText::bud_of(const Link& link) const {
    std::string arguments = "i, n";
    const std::vector<std::string>& here = structure_.enclosing_recursions(link.from);
    for (const std::string& head : structure_.enclosing_recursions(link.to)) {
        const bool is_inside = std::find(here.begin(), here.end(), head) != here.end();
        const char* deeper = head == link.to ? " + 1" : "";
        arguments += is_inside ? fmt::format(", depth_{}{}", head, deeper) : ", 1";
    }
    if (structure_.can_continue(link.to)) {
        arguments += &link == structure_.continuing_link(link.from) ? ", 1" : ", 0";
    }
    return call(link.to, arguments);
}

// Leaf links take the place of the links that lead back, so they are as many as those would be.
LinkKind ComponentText::kind_of_leaf_links() const {
    const std::vector<const Link*> repeated = structure_.repeated_by(component_.name);
    const bool branches =
        std::any_of(repeated.begin(), repeated.end(), [](const Link* link) { return link->kind == LinkKind::branch; });
    return branches ? LinkKind::branch : LinkKind::child;
}

std::string ComponentText::followers(LinkKind kind, const std::string& placed) const {
    const Link* continuing = structure_.continuing_link(component_.name);
    std::string text;
    bool has_leaf_links = false;
    for (const Link* link : structure_.links_from(component_.name)) {
        if (link->kind == kind && link != continuing) text += fmt::format(" [ {}{} ]", placed, bud_of(*link));
        has_leaf_links = has_leaf_links || link->kind == LinkKind::leaf;
    }
    if (has_leaf_links && kind == kind_of_leaf_links()) {
        text += fmt::format(" [ {}{}End({}) ]", placed, bud(), place());
    }
    return text;
}

void ComponentText::add_end_of_recursion() {
    std::string condition, buds;
    for (const Link* link : structure_.repeated_by(component_.name)) {
        condition +=
            fmt::format("{}depth_{} >= {}", condition.empty() ? "" : " && ", link->to, structure_.limit(link->to));
    }
    for (const Link* link : structure_.links_from(component_.name)) {
        if (link->kind == LinkKind::leaf) buds += fmt::format("[ {} ] ", bud_of(*link));
    }
    if (buds.empty()) return;
    const std::string end = declared(bud() + "End", place());
    decomposition.push_back(fmt::format("{} : {} --> {}", end, condition, buds));
    decomposition.push_back(fmt::format("{} --> *", end));
}

}  // namespace espalier::language::pgraph

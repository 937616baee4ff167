#include "language/pgraph/graph.h"

#include <fmt/format.h>

namespace espalier::language::pgraph {
namespace {

std::string print(const Value& value) {
    std::string text;
    for (const std::string& part : value.parts) {
        text += (text.empty() ? "" : value.is_range ? " .. " : ", ") + part;
    }
    if (!value.function.empty()) text += " then " + value.function;
    if (!value.noise.empty()) text += " noise " + value.noise;
    return text;
}

const char* arrow(LinkKind kind) {
    return kind == LinkKind::child ? "->" : kind == LinkKind::branch ? "-B->" : "-L->";
}

}  // namespace

std::string print(const Graph& graph) {
    std::string text = fmt::format("pgraph {}\n", graph.version);
    for (const Define& define : graph.defines) text += define.text + "\n";
    for (const Component& component : graph.components) {
        text += fmt::format("\n{} {}\n", component.type, component.name);
        for (const KeyValue& key : component.keys) text += fmt::format("  {} {}\n", key.key, print(key.value));
    }
    if (!graph.links.empty()) text += "\n";
    for (const Link& link : graph.links) text += fmt::format("{} {} {}\n", link.from, arrow(link.kind), link.to);
    return text;
}

}  // namespace espalier::language::pgraph

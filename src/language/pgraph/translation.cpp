#include "language/pgraph/translation.h"

#include "language/pgraph/model_text.h"
#include "language/text/marks.h"

#include <fmt/format.h>

#include <map>

namespace espalier::language::pgraph {
namespace {

// Enough for as many children and for a horn of as many pieces as there may be. Children are born one after the other,
// so that a child's identity and its random numbers do not depend on how many others there are.
constexpr int decomposition_depth = 1000000, homomorphism_depth = 10100;

using Writer = void (*)(ComponentText&);

Writer writer_of(const std::string& type) {
    static const std::map<std::string, Writer> writers{
        {"Simple", write_simple},      {"Horn", write_horn},        {"Tree", write_tree},
        {"Leaf", write_leaf},          {"Hydra", write_multiplier}, {"Ring", write_multiplier},
        {"Phiball", write_multiplier}, {"World", write_world},      {"FFD", write_deformation},
    };
    return writers.at(type);
}

using Lines = std::vector<std::string> ComponentText::*;

std::string section(const std::vector<ComponentText>& texts, Lines lines) {
    std::string result;
    for (const ComponentText& text : texts) {
        if ((text.*lines).empty()) continue;
        result += fmt::format("\n/* {}: {} */\n", text.component().name, text.component().type);
        for (const std::string& line : text.*lines)
            result += text.origins().marked(line, text.component().place) + "\n";
    }
    return result;
}

std::string declarations(const std::vector<ComponentText>& texts) {
    std::string result;
    for (const ComponentText& text : texts) {
        for (const std::string& module : text.modules) result += fmt::format("module {};\n", module);
    }
    return result;
}

std::string arrays(const std::vector<ComponentText>& texts) {
    std::string result;
    for (const ComponentText& text : texts) {
        for (const std::string& line : text.arrays) result += "    " + line + "\n";
    }
    return result.empty() ? "" : "define: {\n" + result + "}\n";
}

std::string axiom(const Structure& structure) {
    std::string text;
    for (const Link* link : structure.links_from(camera)) {
        text += fmt::format(" [ {}(0, 1", link->to);
        for (std::size_t k = 0; k < structure.enclosing_recursions(link->to).size(); ++k) text += ", 1";
        if (structure.can_continue(link->to)) text += ", 0";
        text += ") ]";
    }
    return text;
}

}  // namespace

TranslatedText translate(const Graph& graph) {
    check_values(graph);
    const Structure structure(graph);
    const Origins origins(graph);
    std::vector<ComponentText> texts;
    for (const Component& component : graph.components) {
        texts.emplace_back(graph, structure, origins, component);
        writer_of(component.type)(texts.back());
    }
    std::string text =
        "/* Translated from a p-graph. A module in small letters becomes an instance of its component in the next "
        "step;\n   the same name with a capital is the instance, with its values. */\n\n";
    for (const Define& define : graph.defines) text += origins.marked(define.text, define.place) + "\n";
    text += declarations(texts);
    for (const ComponentText& each : texts) {
        for (const std::string& field : each.fields) text += field + "\n";
    }
    text += fmt::format("\nlsystem: 1\nderivation length: {}\n{}axiom:{}\n", structure.generations(), arrays(texts),
                        axiom(structure));
    text += section(texts, &ComponentText::productions);
    if (const std::string parts = section(texts, &ComponentText::decomposition); !parts.empty()) {
        text += fmt::format("\ndecomposition\nmaximum depth: {}\n{}", decomposition_depth, parts);
    }
    text += fmt::format("\nhomomorphism\nmaximum depth: {}\n{}", homomorphism_depth,
                        section(texts, &ComponentText::homomorphism));
    return unmarked(text + "endlsystem\n", origins.files());
}

}  // namespace espalier::language::pgraph

#include "language/sdl/skeleton.h"

#include "base/text.h"
#include "language/text/marks.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language::sdl {
namespace {

template <class List>
std::string joined(const List& list, const char* between) {
    std::string text;
    for (const auto& item : list) text += (text.empty() ? "" : between) + item;
    return text;
}

std::string list_of(const std::vector<double>& values) {
    std::vector<std::string> texts;
    for (const double value : values) texts.push_back(format_exact(value));
    return joined(texts, ", ");
}

std::string text_of(const Component& component) {
    std::string text = component.constant_ver ? "#const_ver " : "";
    if (component.constant_hor) text += "#const_hor ";
    if (component.is_null) return text + component.name + "[NULL]";
    std::vector<std::string> features;
    for (const Attribute& feature : component.features) {
        features.push_back(without_marks(feature.middle.text));
        if (feature.deviation) features.back() += fmt::format(":{}", without_marks(feature.deviation->text));
    }
    return fmt::format("{}{}[{}]", text, component.name, joined(features, ", "));
}

std::string text_of(const std::vector<Slave>& slaves) {
    std::vector<std::string> texts;
    for (const Slave& slave : slaves) {
        std::string text = slave.component;
        if (slave.count != 1) text += fmt::format("*{}", slave.count);
        if (!slave.slaves.empty()) text += text_of(slave.slaves);
        texts.push_back(text);
    }
    return fmt::format("({})", joined(texts, " "));
}

std::string text_of(const Rule& rule) {
    std::vector<std::string> sides;
    for (const RightSide& side : rule.right_sides) {
        sides.push_back(text_of(side.slaves) + (side.weight ? " : " + without_marks(side.weight->text) : ""));
    }
    return rule.master + " -> " + joined(sides, " | ");
}

std::string text_of(const Fibre& fibre) {
    std::string text = fibre.type == Fibre::Type::leaf ? "  leaf" : "  wooden";
    if (!fibre.components.empty()) text += fmt::format(" {}", joined(fibre.components, ", "));
    text += fmt::format("{{\n    {};\n", fibre.is_flat ? "flat" : "solid");
    text += fmt::format("    cut[{}, {}];\n", without_marks(fibre.width.text), without_marks(fibre.thickness.text));
    for (const std::vector<double>& ring : fibre.rings) text += fmt::format("    ring[{}];\n", list_of(ring));
    if (!fibre.contour.empty()) text += fmt::format("    contour[{}];\n", list_of(fibre.contour));
    if (fibre.correction) {
        text += fmt::format("    correction[{}];\n", list_of({fibre.correction->amplitude, fibre.correction->bumps}));
    }
    text += fmt::format("    quality[{}, {}];\n", fibre.sections, fibre.magnets);
    if (fibre.colour && fibre.texture) text += fmt::format("    material[{}, {}];\n", *fibre.colour, *fibre.texture);
    if (fibre.colour && !fibre.texture) text += fmt::format("    material[{}];\n", *fibre.colour);
    return text + "  }\n";
}

}  // namespace

const Component* Skeleton::component(const std::string& name) const {
    const auto found =
        std::find_if(components.begin(), components.end(), [&](const auto& c) { return c.name == name; });
    return found == components.end() ? nullptr : &*found;
}

const Rule* Skeleton::rule_of(const std::string& master) const {
    const auto found = std::find_if(rules.begin(), rules.end(), [&](const auto& r) { return r.master == master; });
    return found == rules.end() ? nullptr : &*found;
}

const Fibre* Skeleton::fibre_of(const std::string& name) const {
    const Fibre* others = nullptr;
    for (const Fibre& fibre : fibres) {
        if (std::count(fibre.components.begin(), fibre.components.end(), name)) return &fibre;
        if (fibre.components.empty()) others = &fibre;
    }
    return others;
}

const Component& Skeleton::start() const {
    return rules.empty() ? components.front() : *component(rules.front().master);
}

std::string to_text(const Skeleton& skeleton) {
    std::string text = "define{\n";
    for (const Component& component : skeleton.components) text += "  " + text_of(component) + ";\n";
    text += "}\nrules{\n";
    for (const Rule& rule : skeleton.rules) text += "  " + text_of(rule) + ";\n";
    text += "}\n";
    if (!skeleton.fibres.empty()) {
        text += "fibres{\n";
        for (const Fibre& fibre : skeleton.fibres) text += text_of(fibre);
        text += "}\n";
    }
    if (skeleton.says_generations) text += fmt::format("generations {};\n", skeleton.generations);
    return text;
}

}  // namespace espalier::language::sdl

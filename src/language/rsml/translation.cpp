#include "language/rsml/translation.h"

#include "base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace espalier::language::rsml {
namespace {

class ModelText {
public:
    explicit ModelText(const Document& document) : document_(document), borne_(document.roots.size()) {
        for (std::size_t i = 0; i < document.roots.size(); ++i) {
            const Root& root = document.roots[i];
            if (root.bearer) borne_[*root.bearer].push_back({node_on(root), i});
        }
        for (std::vector<Borne>& laterals : borne_) {
            std::stable_sort(laterals.begin(), laterals.end(), [](Borne a, Borne b) { return a.node < b.node; });
        }
    }

    std::string axiom() {
        for (std::size_t i = 0; i < document_.roots.size(); ++i) {
            const Root& root = document_.roots[i];
            if (root.bearer) continue;
            text_ += "\n\t[";
            const glm::dvec3& base = root.nodes[0].at;
            const double distance = glm::length(base);
            if (distance > 0) text_ += fmt::format("@R({}) f({}) ", numbers(base / distance), written(distance));
            add(i, base);
            text_ += "]";
        }
        return std::move(text_);
    }

private:
    struct Borne {
        std::size_t node, root;
    };

    /// Ten digits: the eleventh of a measured root is noise of its unit.
    static std::string written(double value) { return fmt::format("{:.10g}", value); }

    static std::string numbers(const glm::dvec3& vector) {
        return written(vector.x) + ", " + written(vector.y) + ", " + written(vector.z);
    }

    /// Where it stands: the node that the file names, or the nearest one.
    std::size_t node_on(const Root& root) const {
        const std::vector<Node>& nodes = document_.roots[*root.bearer].nodes;
        if (root.on_node && *root.on_node < nodes.size()) return *root.on_node;
        const auto nearer = [&](const Node& a, const Node& b) {
            return glm::distance(a.at, root.nodes[0].at) < glm::distance(b.at, root.nodes[0].at);
        };
        return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end(), nearer) - nodes.begin());
    }

    /// From `from`, where the turtle stands. Orders are limited where the file is read.
    void add(std::size_t number, glm::dvec3 from) {
        const Root& root = document_.roots[number];
        auto lateral = borne_[number].begin();
        for (std::size_t i = 0; i < root.nodes.size(); ++i) {
            segment(from, root.nodes[i]);
            from = root.nodes[i].at;
            for (; lateral != borne_[number].end() && lateral->node == i; ++lateral) {
                text_ += "\n\t[";
                add(lateral->root, from);
                text_ += "]";
            }
        }
        fmt::format_to(std::back_inserter(text_), " Tip({})", root.order);
    }

    void segment(const glm::dvec3& from, const Node& node) {
        const double length = glm::distance(from, node.at);
        if (!(length > 1e-9)) return;
        const std::string heading = numbers((node.at - from) / length);
        const std::string along = written(length), diameter = written(node.diameter);
        text_ += node.day > 0 ? fmt::format(" Node({}, {}, {}, {})", written(node.day), heading, along, diameter)
                              : fmt::format(" !({}) @R({}) F({})", diameter, heading, along);
    }

    const Document& document_;
    std::vector<std::vector<Borne>> borne_;
    std::string text_;
};

double last_day(const Document& document) {
    double last = 0;
    for (const Root& root : document.roots) {
        for (const Node& node : root.nodes) last = std::max(last, node.day);
    }
    return last;
}

}  // namespace

std::string model_of(const Document& document, const std::string& name) {
    std::string text = fmt::format("/* Measured axes: {} */\n\n", escaped(name.substr(name.rfind('/') + 1)));
    if (document.has_times) text += "#define DT 1  /* days in a step; 0.01..100; days */\n";
    text += "module Tip(order)";
    text += document.has_times ? ", Node(day, x, y, z, length, diameter);\n" : ";\n";
    text += fmt::format("\nlsystem: 1\nderivation length: {}\naxiom:",
                        document.has_times ? format_exact(last_day(document)) + " / DT + 0.999" : "0");
    text += ModelText(document).axiom() + "\n";
    if (document.has_times) {
        text +=
            "\n/* a node appears on its day */\n"
            "Node(day, x, y, z, length, diameter) : day <= DT + 0.000001 --> !(diameter) @R(x, y, z) F(length)\n"
            "Node(day, x, y, z, length, diameter) --> Node(day - DT, x, y, z, length, diameter)\n";
    }
    return text + "endlsystem\n";
}

}  // namespace espalier::language::rsml

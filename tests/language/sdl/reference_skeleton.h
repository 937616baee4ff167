// The skeleton that a description stands for, computed step by step from its components and rules, and the one in a
// string of its translation.
#pragma once

#include "language/growing.h"
#include "language/sdl/skeleton.h"
#include "language/sdl/translation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace espalier::test {

namespace sdl = language::sdl;

/// A component with its absolute features.
struct Node {
    std::string name;
    int master = -1;
    double begin = 0, length = 0, vertical = 0, horizontal = 0;
    bool waits = true;
};

/// A description without mutation and with numbers alone, interpreted directly.
class ReferenceSkeleton {
public:
    explicit ReferenceSkeleton(const sdl::Skeleton& skeleton) : skeleton_(skeleton) { add(skeleton.start().name, -1); }

    void step() {
        const std::size_t count = nodes.size();
        for (std::size_t i = 0; i < count; ++i) {
            const sdl::Rule* rule = skeleton_.rule_of(nodes[i].name);
            if (!rule || !nodes[i].waits) continue;
            nodes[i].waits = false;
            add_slaves(rule->right_sides[0].slaves, int(i));
        }
    }

    std::vector<Node> nodes;

private:
    void add_slaves(const std::vector<sdl::Slave>& slaves, int master) {
        for (const sdl::Slave& slave : slaves) {
            for (int i = 0; i < slave.count; ++i) add_slaves(slave.slaves, add(slave.component, master));
        }
    }

    int add(const std::string& name, int at) {
        const sdl::Component& component = *skeleton_.component(name);
        const auto feature = [&](int k) { return *component.features[std::size_t(k)].middle.number; };
        const Node master = at < 0 ? Node{} : nodes[std::size_t(at)];
        Node node{name, at};
        node.begin = master.length > 0 && !component.is_null ? feature(0) : 0;
        node.length = component.is_null ? master.length : std::max(0.0, master.length + feature(1));
        node.vertical = (component.constant_ver ? 0 : master.vertical) + (component.is_null ? 0 : feature(2));
        node.horizontal = (component.constant_hor ? 0 : master.horizontal) + (component.is_null ? 0 : feature(3));
        nodes.push_back(node);
        return int(nodes.size()) - 1;
    }

    const sdl::Skeleton& skeleton_;
};

/// The components in a string: each is the slave of the one in whose branch it stands.
inline std::vector<Node> nodes_of(const ModuleString& string, const Alphabet& alphabet) {
    std::vector<Node> nodes;
    std::vector<int> masters{-1};
    double moved = 0;
    const std::vector<std::size_t> offsets = parameter_offsets(string, alphabet);
    for (std::size_t i = 0; i < string.size(); ++i) {
        std::string name = alphabet.name(string.letters[i]);
        const double* parameters = string.parameters.data() + offsets[i];
        if (name == "[") {
            masters.push_back(masters.back());
            moved = 0;
        } else if (name == "]") {
            masters.pop_back();
        } else if (name == "f") {
            moved = parameters[0];
        } else {
            while (name.ends_with("_")) name.pop_back();
            Node node{name, masters.back(), moved, parameters[0], parameters[1], parameters[2]};
            const double length = node.master < 0 ? 0 : nodes[std::size_t(node.master)].length;
            node.begin = length > 0 ? moved / length : 0;
            masters.back() = int(nodes.size());
            nodes.push_back(node);
        }
    }
    return nodes;
}

/// Skeletons are the same if their texts are: slaves are sorted, because their order has no meaning.
inline std::string canonical(const std::vector<Node>& nodes, int at = 0) {
    std::vector<std::string> slaves;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].master == at) slaves.push_back(canonical(nodes, int(i)));
    }
    std::sort(slaves.begin(), slaves.end());
    const Node& node = nodes[std::size_t(at)];
    const auto shown = [](double value) { return std::round(value * 1e6) / 1e6 + 0.0; };
    std::string text = fmt::format("{}({},{},{},{})", node.name, shown(node.begin), shown(node.length),
                                   shown(node.vertical), shown(node.horizontal));
    for (const std::string& slave : slaves) text += "[" + slave + "]";
    return text;
}

/// The model of a description.
inline std::string model_text(const std::string& description) {
    return sdl::model_of(sdl::parse(description, "test.sdl"), "test.sdl").text;
}

/// "name < master" for every component of the string, in the order of the string.
inline std::string relations(const std::vector<Node>& nodes) {
    std::string text;
    for (const Node& node : nodes) {
        if (node.master >= 0) text += fmt::format("{} < {}; ", node.name, nodes[std::size_t(node.master)].name);
    }
    return text;
}

}  // namespace espalier::test

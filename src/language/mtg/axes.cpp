#include "language/mtg/axes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace espalier::language::mtg {
namespace {

constexpr int most_orders = 60;
constexpr double diameter_if_unknown = 0.005;  ///< m
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// A place among the axes of the document.
struct Spot {
    std::size_t axis = none, node = none;
};

class Axes {
public:
    Axes(const Graph& graph, const std::string& name)
        : graph_(graph), name_(name), chain_of_(graph.vertices.size(), none) {
        if (graph.unit == "cm") metres_ = 0.01;
        if (graph.unit == "mm") metres_ = 0.001;
        if (graph.unit != "m" && metres_ == 1) {
            throw UserError(Place{name, 1, 1},
                            fmt::format("the unit '{}' is not known: write m, cm or mm", graph.unit));
        }
        for (const Vertex& vertex : graph.vertices) {
            if (position(vertex)) scale_ = std::max(scale_, vertex.scale);
        }
        if (scale_ < 0) throw UserError(Place{name, 1, 1}, "no entity of this file has numbers in XX, YY and ZZ");
    }

    rsml::Document document() {
        for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
            if (graph_.vertices[v].scale == scale_) chain(v);
        }
        for (const std::vector<std::size_t>& axis : chains_) add(axis);
        document_.has_times = graph_.column.count("birth") > 0;
        return std::move(document_);
    }

private:
    std::optional<glm::dvec3> position(const Vertex& vertex) const {
        const auto x = graph_.number(vertex, {"xx", "x"}), y = graph_.number(vertex, {"yy", "y"}),
                   z = graph_.number(vertex, {"zz", "z"});
        if (!x || !y || !z) return std::nullopt;
        return metres_ * (graph_.up == "y" ? glm::dvec3(*x, *y, *z) : glm::dvec3(*x, *z, -*y));
    }

    /// One axis goes on from each entity; what else follows it begins another.
    void chain(std::size_t v) {
        const Vertex& vertex = graph_.vertices[v];
        const std::size_t before = vertex.parent && vertex.follows ? chain_of_[*vertex.parent] : none;
        if (before != none && chains_[before].back() == *vertex.parent) {
            chains_[before].push_back(v);
            chain_of_[v] = before;
            return;
        }
        chain_of_[v] = chains_.size();
        chains_.push_back({v});
    }

    void add(const std::vector<std::size_t>& axis) {
        rsml::Root root;
        const Vertex& first = graph_.vertices[axis.front()];
        const Spot bearer = first.parent ? on_[*first.parent] : Spot();
        root.place = first.place;
        root.label = first.label;
        if (bearer.axis != none) {
            root.bearer = bearer.axis;
            root.on_node = bearer.node;
            root.order = document_.roots[bearer.axis].order + 1;
            if (root.order > most_orders) {
                throw UserError(first.place, fmt::format("axes branch more often than {} times", most_orders));
            }
            root.nodes.push_back(document_.roots[bearer.axis].nodes[bearer.node]);
        }
        fill(axis, root, bearer);
        if (root.nodes.size() > (root.bearer ? 1u : 0u)) document_.roots.push_back(std::move(root));
    }

    /// The nodes of an axis, and where each of its entities lies.
    void fill(const std::vector<std::size_t>& axis, rsml::Root& root, const Spot& bearer) {
        const std::size_t number = document_.roots.size();
        std::vector<std::size_t> waiting;  // for the next with coordinates
        for (const std::size_t v : axis) {
            waiting.push_back(v);
            const std::optional<glm::dvec3> end = position(graph_.vertices[v]);
            if (!end) continue;
            if (root.nodes.empty()) add_foot(axis, *end, root);
            const glm::dvec3 begin = root.nodes.empty() ? *end : root.nodes.back().at;
            for (std::size_t k = 0; k < waiting.size(); ++k) {
                const double share = static_cast<double>(k + 1) / static_cast<double>(waiting.size());
                root.nodes.push_back(node(waiting[k], begin + share * (*end - begin), root));
                on_[waiting[k]] = {number, root.nodes.size() - 1};
            }
            waiting.clear();
        }
        // Beyond the last coordinates nothing is known: what stands there stands on the last node.
        const bool is_left_out = root.nodes.size() <= (root.bearer ? 1u : 0u);
        for (const std::size_t v : waiting) on_[v] = is_left_out ? bearer : Spot{number, root.nodes.size() - 1};
    }

    /// A trunk begins a length of its first entity below that, against the direction to the next one.
    void add_foot(const std::vector<std::size_t>& axis, const glm::dvec3& end, rsml::Root& root) const {
        const std::optional<double> length = graph_.number(graph_.vertices[axis.front()], {"length", "len"});
        if (!length || !(*length > 0)) return;
        glm::dvec3 along(0, 1, 0);
        for (std::size_t k = 1; k < axis.size(); ++k) {
            const std::optional<glm::dvec3> next = position(graph_.vertices[axis[k]]);
            if (!next || !(glm::distance(*next, end) > 0)) continue;
            along = glm::normalize(*next - end);
            break;
        }
        root.nodes.push_back(node(axis.front(), end - metres_ * *length * along, root));
    }

    rsml::Node node(std::size_t v, const glm::dvec3& at, const rsml::Root& root) const {
        const Vertex& vertex = graph_.vertices[v];
        const auto diameter = graph_.number(vertex, {"diameter", "diam", "dia", "topdiameter", "topdia"});
        const rsml::Node before = root.nodes.empty() ? rsml::Node{at, diameter_if_unknown, 0} : root.nodes.back();
        const double birth = graph_.number(vertex, {"birth"}).value_or(before.day);
        return {at, diameter && *diameter >= 0 ? metres_ * *diameter : before.diameter, std::max(0.0, birth)};
    }

    const Graph& graph_;
    std::string name_;
    double metres_ = 1;
    int scale_ = -1;
    std::vector<std::size_t> chain_of_;  ///< of each entity
    std::vector<std::vector<std::size_t>> chains_;
    std::map<std::size_t, Spot> on_;  ///< of each entity: an axis of the document, and its node
    rsml::Document document_;
};

}  // namespace

rsml::Document axes_of(const Graph& graph, const std::string& name) {
    return Axes(graph, name).document();
}

}  // namespace espalier::language::mtg

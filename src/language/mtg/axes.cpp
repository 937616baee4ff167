#include "language/mtg/axes.h"

#include "language/measured/joining.h"
#include "language/measured/units.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace espalier::language::mtg {
namespace {

constexpr double diameter_if_unknown = 0.005;  ///< m
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// A place among the axes of the document.
struct Spot {
    std::size_t axis = none, node = none;
};

class Axes {
public:
    Axes(const Graph& graph, const std::string& name, const MeasuredOptions& options)
        : graph_(graph),
          name_(name),
          unit_(options.unit.empty() ? graph.unit : options.unit),
          up_(options.up.empty() ? graph.up : options.up),
          chain_of_(graph.vertices.size(), none) {
        try {
            metres_ = options.pixel ? *options.pixel : measured::metres_of_unit(unit_);
            upright_ = measured::upright(up_);
        } catch (const UserError& error) {
            throw UserError(Place{name, 1, 1}, error.diagnostics().front().message);
        }
        for (const Vertex& vertex : graph.vertices) {
            if (position(vertex)) scale_ = std::max(scale_, vertex.scale);
        }
        if (scale_ < 0) throw UserError(Place{name, 1, 1}, "no entity of this file has numbers in XX, YY and ZZ");
    }

    MeasuredPlants plants() {
        for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
            if (graph_.vertices[v].scale == scale_) chain(v);
        }
        for (const std::vector<std::size_t>& axis : chains_) add(axis);
        MeasuredPlants plants;
        plants.has_times = graph_.column.count("birth") > 0;
        plants.axes = measured::joined(std::move(axes_));
        plants.plants.resize(1);
        plants.unit = unit_;
        plants.up = up_;
        return plants;
    }

private:
    std::optional<glm::dvec3> position(const Vertex& vertex) const {
        const auto x = graph_.number(vertex, {"xx", "x"}), y = graph_.number(vertex, {"yy", "y"}),
                   z = graph_.number(vertex, {"zz", "z"});
        if (!x || !y || !z) return std::nullopt;
        return metres_ * (upright_ * glm::dvec3(*x, *y, *z));
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
        measured::LooseAxis root;
        const Vertex& first = graph_.vertices[axis.front()];
        const Spot bearer = first.parent ? on_[*first.parent] : Spot();
        root.place = first.place;
        root.label = first.label;
        if (bearer.axis != none) {
            root.bearer = bearer.axis;
            root.on_node = bearer.node;
            root.nodes.push_back(axes_[bearer.axis].nodes[bearer.node]);
        }
        fill(axis, root, bearer);
        if (root.nodes.size() > (root.bearer ? 1u : 0u)) axes_.push_back(std::move(root));
    }

    /// The nodes of an axis, and where each of its entities lies.
    void fill(const std::vector<std::size_t>& axis, measured::LooseAxis& root, const Spot& bearer) {
        const std::size_t number = axes_.size();
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
    void add_foot(const std::vector<std::size_t>& axis, const glm::dvec3& end, measured::LooseAxis& root) const {
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

    MeasuredNode node(std::size_t v, const glm::dvec3& at, const measured::LooseAxis& root) const {
        const Vertex& vertex = graph_.vertices[v];
        const auto diameter = graph_.number(vertex, {"diameter", "diam", "dia", "topdiameter", "topdia"});
        const MeasuredNode before = root.nodes.empty() ? MeasuredNode{at, diameter_if_unknown, 0} : root.nodes.back();
        const double birth = graph_.number(vertex, {"birth"}).value_or(before.day);
        return {at, diameter && *diameter >= 0 ? metres_ * *diameter : before.diameter, std::max(0.0, birth)};
    }

    const Graph& graph_;
    std::string name_, unit_, up_;
    double metres_ = 1;
    glm::dmat3 upright_{1};
    int scale_ = -1;
    std::vector<std::size_t> chain_of_;  ///< of each entity
    std::vector<std::vector<std::size_t>> chains_;
    std::map<std::size_t, Spot> on_;  ///< of each entity: an axis of the document, and its node
    std::vector<measured::LooseAxis> axes_;
};

}  // namespace

MeasuredPlants axes_of(const Graph& graph, const std::string& name, const MeasuredOptions& options) {
    return Axes(graph, name, options).plants();
}

}  // namespace espalier::language::mtg

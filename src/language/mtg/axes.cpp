#include "language/mtg/axes.h"

#include "base/text.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/units.h"
#include "language/mtg/graph.h"
#include "language/mtg/plant_units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace espalier::language::mtg {
namespace {

constexpr double diameter_if_unknown = 0.005;  ///< m
constexpr std::size_t columns_shown = 12;

/// A place among the axes of the document.
struct Spot {
    std::uint32_t axis = none, node = none;
};

class Axes {
public:
    Axes(const Graph& graph, const std::string& name, const MeasuredOptions& options, measured::Notes& notes)
        : graph_(graph), name_(name), notes_(notes), up_(options.up) {
        if (up_.empty()) up_ = graph.up;
        is_up_told_ = !up_.empty();
        if (!is_up_told_) up_ = "z";
        upright_ = measured::upright(up_);
        find_scale();
        find_successors();
        find_plants();
        units_ = units_of(graph, numbers(), options, name, notes);
        base_ = upright_ * glm::dvec3(graph.origin[0], graph.origin[1], graph.origin[2]);
        tolerance_ = 1e-6 * extent_ * units_.length;
    }

    MeasuredPlants plants() {
        on_.resize(graph_.vertices.size());
        for (std::size_t i = 0; i < heads_.size(); ++i) add(heads_[i], plant_of_head_[i]);
        tell();
        if (!is_up_told_) check_up();
        MeasuredPlants plants;
        plants.has_times = graph_.has_times && last_day_ > first_day_;
        plants.axes = measured::joined(std::move(axes_));
        plants.plants = std::move(plants_);
        plants.unit = units_.words;
        plants.up = up_;
        return plants;
    }

private:
    const Vertex& vertex(std::uint32_t v) const { return graph_.vertices[v]; }

    std::optional<glm::dvec3> raw(std::uint32_t v) const {
        const Vertex& of = vertex(v);
        if (of.row == none) return std::nullopt;
        const glm::dvec3 at(graph_.rows.at(of.row, x), graph_.rows.at(of.row, y), graph_.rows.at(of.row, z));
        if (std::isnan(at.x) || std::isnan(at.y) || std::isnan(at.z)) return std::nullopt;
        return upright_ * at;
    }

    std::optional<glm::dvec3> position(std::uint32_t v) const {
        const std::optional<glm::dvec3> at = raw(v);
        return at ? std::optional(units_.length * *at + base_) : std::nullopt;
    }

    void find_scale() {
        for (std::uint32_t v = 0; v < graph_.vertices.size(); ++v) {
            if (vertex(v).scale > scale_ && raw(v)) scale_ = vertex(v).scale;
        }
        if (scale_ >= 0) return;
        std::vector<std::string> shown = graph_.columns;
        const bool is_long = shown.size() > columns_shown;
        if (is_long) shown.resize(columns_shown);
        for (std::string& column : shown) column = escaped(column);
        throw UserError(
            Place{name_, 1, 1},
            fmt::format("no entity of this file has numbers in the columns XX, YY and ZZ: it says what "
                        "follows and bears what, and not where; its columns are {}{}",
                        shown.empty() ? "none" : fmt::format("{}", fmt::join(shown, ", ")), is_long ? ", ..." : ""));
    }

    bool is_drawn(std::uint32_t v) const {
        const Vertex& of = vertex(v);
        return of.scale == scale_ || (of.scale < scale_ && of.last_part == none && of.stands_on != none && raw(v));
    }

    /// What is drawn of what an entity stands on.
    std::uint32_t drawn_at(std::uint32_t v) const {
        while (v != none && !is_drawn(v)) {
            const Vertex& of = vertex(v);
            v = of.scale > scale_ ? of.complex : of.parent != none ? of.parent : of.complex;
        }
        return v;
    }

    std::uint32_t bearer_of(std::uint32_t v) const {
        const Vertex& of = vertex(v);
        return drawn_at(of.scale == scale_ ? of.parent : of.stands_on);
    }

    /// One axis goes on from each entity; what else follows it begins another.
    void find_successors() {
        successor_.assign(graph_.vertices.size(), none);
        for (std::uint32_t v = 0; v < graph_.vertices.size(); ++v) {
            if (!is_drawn(v)) continue;
            const std::uint32_t before = vertex(v).follows ? bearer_of(v) : none;
            if (before != none && successor_[before] == none) {
                successor_[before] = v;
            } else {
                heads_.push_back(v);
            }
        }
    }

    /// The coarsest entity around one, except a scene, and the first of those that grew from each other.
    std::uint32_t whole_of(std::uint32_t v) const {
        while (true) {
            const Vertex& of = vertex(v);
            if (of.complex != none && vertex(of.complex).scale > 0) {
                v = of.complex;
            } else if (of.parent != none) {
                v = of.parent;
            } else {
                return v;
            }
        }
    }

    void find_plants() {
        std::unordered_map<std::uint32_t, std::uint32_t> number_of;
        plant_of_head_.reserve(heads_.size());
        std::vector<std::uint32_t> plant_of(graph_.vertices.size(), none);
        for (const std::uint32_t head : heads_) {
            const std::uint32_t bearer = bearer_of(head);
            std::uint32_t plant = bearer == none ? none : plant_of[bearer];
            if (plant == none) {
                const std::uint32_t whole = whole_of(head);
                const auto [found, is_new] = number_of.try_emplace(whole, static_cast<std::uint32_t>(plants_.size()));
                if (is_new) plants_.push_back({std::string(vertex(whole).label)});
                plant = found->second;
            }
            plant_of_head_.push_back(plant);
            for (std::uint32_t v = head; v != none; v = successor_[v]) {
                plant_of[v] = plant;
                const auto named = graph_.plant_names.find(v);
                if (named != graph_.plant_names.end()) plants_[plant].label = named->second;
            }
        }
    }

    /// Of the file: the extent of its largest plant, and diameters.
    PlantNumbers numbers() {
        std::vector<std::array<glm::dvec3, 2>> boxes(plants_.size(), {glm::dvec3(INFINITY), glm::dvec3(-INFINITY)});
        std::vector<double> diameters;
        PlantNumbers numbers;
        for (std::size_t i = 0; i < heads_.size(); ++i) {
            auto& [lower, upper] = boxes[plant_of_head_[i]];
            const auto include = [&, &low = lower, &high = upper](const std::optional<glm::dvec3>& at) {
                if (!at) return;
                low = glm::min(low, *at);
                high = glm::max(high, *at);
            };
            if (const std::uint32_t whole = base_holder(heads_[i]); whole != none) include(raw(whole));
            for (std::uint32_t v = heads_[i]; v != none; v = successor_[v]) {
                include(raw(v));
                const double diameter = diameter_in_file(v);
                if (!(diameter > 0)) continue;
                numbers.thickest = std::max(numbers.thickest, diameter);
                diameters.push_back(diameter);
            }
        }
        if (!diameters.empty()) {
            const auto fifth = diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 5);
            std::nth_element(diameters.begin(), fifth, diameters.end());
            numbers.thin = *fifth;
        }
        for (const auto& [lower, upper] : boxes) {
            const glm::dvec3 size = upper - lower;
            if (lower.x <= upper.x) extent_ = std::max({extent_, size.x, size.y, size.z});
        }
        numbers.extent = extent_;
        return numbers;
    }

    /// In its middle, where a row has both ends. NaN: unknown.
    double diameter_in_file(std::uint32_t v) const {
        const double above = graph_.measure(vertex(v), top), below = graph_.measure(vertex(v), bottom);
        if (std::isnan(above)) return below;
        return std::isnan(below) ? above : (above + below) / 2;
    }

    /// A coarser entity with coordinates, which are where its first part begins.
    std::uint32_t base_holder(std::uint32_t v) const {
        while (vertex(v).is_first_part && vertex(v).complex != none) {
            v = vertex(v).complex;
            if (vertex(v).scale < scale_ && raw(v)) return v;
        }
        return none;
    }

    void add(std::uint32_t head, std::uint32_t plant) {
        measured::LooseAxis axis;
        const std::uint32_t bearer = bearer_of(head), whole = base_holder(head);
        const Spot stand = bearer == none ? Spot() : on_[bearer];
        axis.place = {name_, vertex(head).line, vertex(head).column};
        axis.label = vertex(head).label;
        axis.plant = plant;
        const std::optional<glm::dvec3> base = whole == none ? std::nullopt : position(whole);
        if (stand.axis != none) {
            axis.bearer = stand.axis;
            axis.on_node = stand.node;
            axis.nodes.push_back(axes_[stand.axis].nodes[stand.node]);
            axis.nodes.back().linked = false;
        }
        if (base) {
            axis.nodes.resize(1);
            axis.nodes[0] = node(head, *base, axis);
        }
        const std::size_t foot = axis.nodes.size();
        fill(head, axis, stand);
        axis.nodes.shrink_to_fit();
        if (axis.nodes.size() > foot) axes_.push_back(std::move(axis));
    }

    /// The nodes of an axis, and where each of its entities lies.
    void fill(std::uint32_t head, measured::LooseAxis& axis, const Spot& stand) {
        const auto number = static_cast<std::uint32_t>(axes_.size());
        const std::size_t foot = axis.nodes.size();
        std::vector<std::uint32_t> waiting;  // for the next with coordinates
        for (std::uint32_t v = head; v != none; v = successor_[v]) {
            if (v != head && waiting.empty() && !axis.nodes.empty()) leap_to(v, axis);
            waiting.push_back(v);
            const std::optional<glm::dvec3> end = position(v);
            if (!end) continue;
            if (axis.nodes.empty()) add_foot(head, *end, axis);
            const glm::dvec3 begin = axis.nodes.empty() ? *end : axis.nodes.back().at;
            for (std::size_t k = 0; k < waiting.size(); ++k) {
                const double share = static_cast<double>(k + 1) / static_cast<double>(waiting.size());
                axis.nodes.push_back(node(waiting[k], begin + share * (*end - begin), axis));
                on_[waiting[k]] = {number, static_cast<std::uint32_t>(axis.nodes.size() - 1)};
            }
            waiting.clear();
        }
        // Beyond the last coordinates nothing is known: what stands there stands on the last node.
        const bool is_left_out = axis.nodes.size() <= foot;
        for (const std::uint32_t v : waiting) {
            on_[v] = is_left_out ? stand : Spot{number, static_cast<std::uint32_t>(axis.nodes.size() - 1)};
        }
        if (!waiting.empty() && left_out_ == 0) {
            first_left_out_ = {name_, vertex(waiting[0]).line, vertex(waiting[0]).column};
        }
        left_out_ += waiting.size();
    }

    /// What follows may begin beside the end of what it follows, where a coarser entity says so.
    void leap_to(std::uint32_t v, measured::LooseAxis& axis) {
        const std::uint32_t whole = base_holder(v);
        if (whole == none) return;
        const glm::dvec3 base = *position(whole);
        const std::optional<glm::dvec3> end = position(v);
        if (glm::distance(base, axis.nodes.back().at) <= tolerance_) return;
        if (end && glm::distance(base, *end) <= tolerance_) return;
        MeasuredNode begin = axis.nodes.back();
        begin.at = base;
        begin.linked = true;
        axis.nodes.push_back(begin);
    }

    /// A trunk begins a length of its first entity below that, against the direction to the next one.
    void add_foot(std::uint32_t head, const glm::dvec3& end, measured::LooseAxis& axis) {
        const double length_in_file = graph_.measure(vertex(head), length);
        if (!(length_in_file > 0)) return;
        glm::dvec3 along(0, 1, 0);
        for (std::uint32_t v = successor_[head]; v != none; v = successor_[v]) {
            const std::optional<glm::dvec3> next = position(v);
            if (!next || !(glm::distance(*next, end) > 0)) continue;
            along = glm::normalize(*next - end);
            break;
        }
        axis.nodes.push_back(node(head, end - units_.length * length_in_file * along, axis));
    }

    MeasuredNode node(std::uint32_t v, const glm::dvec3& at, const measured::LooseAxis& axis) {
        const MeasuredNode before = axis.nodes.empty() ? MeasuredNode{at, diameter_if_unknown, 0} : axis.nodes.back();
        const double own = diameter_in_file(v), born = graph_.measure(vertex(v), day);
        if (!(own >= 0)) {
            if (without_diameter_++ == 0) first_without_ = {name_, vertex(v).line, vertex(v).column};
        } else {
            has_diameters_ = true;
        }
        const double birth = std::isnan(born) ? before.day : std::max(0.0, born);
        first_day_ = std::min(first_day_, birth);
        last_day_ = std::max(last_day_, birth);
        return {at, own >= 0 ? units_.diameter * own : before.diameter, birth};
    }

    void tell() {
        if (left_out_ > 0) {
            notes_.warn("entities without coordinates at the end of an axis are left out", first_left_out_, left_out_);
        }
        if (!has_diameters_) {
            notes_.warn("no entity has a diameter: it is taken as 5 mm", Place{name_, 1, 1});
        } else if (without_diameter_ > 0) {
            notes_.warn("entities without diameter have that of the one before; at first 5 mm", first_without_,
                        without_diameter_);
        }
    }

    /// Trunks tell where upwards is: a file that lies on its side is told.
    void check_up() {
        glm::dvec3 along(0);
        for (const measured::LooseAxis& axis : axes_) {
            if (!axis.bearer) along += axis.nodes.back().at - axis.nodes.front().at;
        }
        const glm::dvec3 run = glm::transpose(upright_) * along;  // in the file's axes
        int longest = 0;
        for (int axis = 1; axis < 3; ++axis) {
            if (std::abs(run[axis]) > std::abs(run[longest])) longest = axis;
        }
        if (std::abs(run[longest]) <= 2 * std::max(along.y, 0.0)) return;
        const std::string word = std::string(run[longest] < 0 ? "-" : "") + "xyz"[longest];
        notes_.warn(fmt::format("the file does not say what points upwards: {} is taken, but its trunks run along {}; "
                                "--up={}, or up = \"{}\" in a scene, sets them upright",
                                up_, word, word, word),
                    Place{name_, 1, 1});
    }

    const Graph& graph_;
    std::string name_;
    measured::Notes& notes_;
    std::string up_;
    bool is_up_told_ = false;
    PlantUnits units_;
    double extent_ = 0;     ///< in the file's unit
    double tolerance_ = 0;  ///< m
    glm::dmat3 upright_{1};
    glm::dvec3 base_{0};  ///< m; what the file subtracted from its places
    int scale_ = -1;
    std::vector<std::uint32_t> successor_, heads_, plant_of_head_;
    std::vector<Spot> on_;  ///< of each entity: an axis of the document, and its node
    std::vector<measured::LooseAxis> axes_;
    std::vector<MeasuredPlant> plants_;
    std::size_t left_out_ = 0, without_diameter_ = 0;
    Place first_left_out_, first_without_;
    bool has_diameters_ = false;
    double first_day_ = INFINITY, last_day_ = -INFINITY;
};

}  // namespace

MeasuredPlants read_axes(std::string text, const std::string& name, const MeasuredOptions& options) {
    measured::Notes notes(name);
    try {
        const Graph graph = read(text, name, notes);
        std::string().swap(text);
        MeasuredPlants plants = Axes(graph, name, options, notes).plants();
        plants.warnings = notes.warnings();
        return plants;
    } catch (const UserError& error) {
        if (error.diagnostics().front().place.known()) throw;
        throw UserError(Place{name, 1, 1}, error.diagnostics().front().message);
    }
}

}  // namespace espalier::language::mtg

#include "language/dgf/plants.h"

#include "base/text.h"
#include "language/dgf/grid.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/units.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace espalier::language::dgf {
namespace {

constexpr double diameter_if_unknown = 0.0005;  ///< m
constexpr double centimetre = 0.01;             ///< m; the unit of columns that say none
constexpr double seconds_of_a_day = 86400;

class Building {
public:
    Building(Grid grid, const std::string& name, const MeasuredOptions& options, measured::Notes& notes)
        : grid_(std::move(grid)), name_(name), options_(options), notes_(notes) {}

    MeasuredPlants plants() {
        leave_out_dummies();
        orient();
        MeasuredPlants plants;
        scale_ = metres();
        plants.unit = unit_in_words_;
        plants.up = options_.up.empty() ? "z" : options_.up;
        axes_ = scale_ * measured::upright(plants.up);
        day_ = days();
        find_borne();
        make_axes();
        plants.has_times = has_days_;
        plants.axes = measured::joined(std::move(loose_));
        plants.plants.emplace_back();
        return plants;
    }

private:
    [[noreturn]] void fail(const Segment& segment, const std::string& message) const {
        throw UserError(Place{name_, segment.line, 1}, message);
    }

    Place place(const Segment& segment) const { return {name_, segment.line, 1}; }

    // -- the tree

    /// The piece between the seed and the first root of the shoot, which is no root: order -1.
    void leave_out_dummies() {
        const auto is_dummy = [](const Segment& segment) { return segment.order < 0; };
        for (const Segment& segment : grid_.segments) {
            if (is_dummy(segment)) {
                notes_.warn("a segment of order -1 is no root and is left out", place(segment));
            } else if (segment.organ == 3 || segment.organ == 4) {
                notes_.warn("a segment is of a stem or leaf (organ type 3 or 4), and is read as those of roots are",
                            place(segment));
            }
        }
        const Segment first = grid_.segments.front();
        std::erase_if(grid_.segments, is_dummy);
        if (grid_.segments.empty()) fail(first, "this file has no segments of roots: their orders are below 0");
    }

    /// The segment that leads to each vertex; its number is that of `none` for others.
    std::optional<std::size_t> find_leading() {
        leading_.assign(grid_.vertices.size(), none);
        for (std::size_t i = 0; i < grid_.segments.size(); ++i) {
            std::size_t& leading = leading_[grid_.segments[i].to];
            if (leading != none) return i;
            leading = i;
        }
        return std::nullopt;
    }

    /// Some files have the child first.
    void orient() {
        const std::optional<std::size_t> second = find_leading();
        if (!second) return;
        const auto turn = [&] {
            for (Segment& segment : grid_.segments) std::swap(segment.from, segment.to);
        };
        turn();
        if (!find_leading()) {
            notes_.warn("segments are written from the child to the parent: they are turned");
            return;
        }
        turn();
        const Segment& segment = grid_.segments[*second];
        fail(segment, fmt::format("vertex {} has two segments that lead to it, those of this line and of line {}: the "
                                  "segments are no tree",
                                  segment.to, grid_.segments[leading_of(segment.to)].line));
    }

    std::size_t leading_of(std::size_t vertex) const {
        std::size_t i = 0;
        while (grid_.segments[i].to != vertex) ++i;
        return i;
    }

    /// The segments that begin at each vertex, in the order of the file.
    void find_borne() {
        begin_.assign(grid_.vertices.size() + 1, 0);
        for (const Segment& segment : grid_.segments) ++begin_[segment.from + 1];
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        borne_.resize(grid_.segments.size());
        for (std::size_t i = 0; i < grid_.segments.size(); ++i) borne_[next[grid_.segments[i].from]++] = i;
    }

    // -- units

    /// From what surfaces say of lengths: 2 pi radius length; else from the lengths.
    double metres() {
        if (options_.pixel) return unit_in_words_ = "pixels", *options_.pixel;
        if (!options_.unit.empty()) return unit_in_words_ = options_.unit, measured::metres_of_unit(options_.unit);
        std::vector<double> ratios;  // metres of a coordinate
        for (const Segment& segment : grid_.segments) {
            const double drawn = glm::distance(grid_.vertices[segment.from], grid_.vertices[segment.to]);
            const double surface = segment.surface * square_metres(), radius = segment.radius * radius_metres();
            double length = surface / (2 * std::numbers::pi * radius);
            if (!(length > 0)) length = segment.length * centimetre;
            if (drawn > 0 && length > 0 && std::isfinite(length)) ratios.push_back(length / drawn);
        }
        if (ratios.empty()) {
            notes_.warn("the file does not tell the unit of its coordinates: taken as m; give another as unit");
            unit_in_words_ = "m";
            return 1;
        }
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        return nearest_unit(*middle);
    }

    double nearest_unit(double ratio) {
        double best = 1, distance = INFINITY;
        for (const char* const unit : {"m", "cm", "mm"}) {
            const double metres = measured::metres_of_unit(unit), off = std::max(ratio / metres, metres / ratio);
            if (off < distance) best = metres, distance = off, unit_in_words_ = unit;
        }
        constexpr double tolerance = 1.1;
        notes_.warn(fmt::format(
            "coordinates are taken as {}: by the surfaces and radii of the segments, a unit of theirs is {} m"
            "{}",
            unit_in_words_, format_general(ratio), distance > tolerance ? ", which is none" : ""));
        return best;
    }

    double radius_metres() const { return measured::metres_of(grid_.radius_unit).value_or(centimetre); }

    double square_metres() const {
        std::string unit = grid_.surface_unit;
        while (!unit.empty() && (unit.back() == '2' || unit.back() == '^')) unit.pop_back();
        const double metres = measured::metres_of(unit).value_or(centimetre);
        return metres * metres;
    }

    /// Of a unit of time. A file that says s may mean days.
    double days() {
        double last = 0;
        for (const Segment& segment : grid_.segments) last = std::max(last, segment.birth);
        if (grid_.birth_unit != "s" || !(last > 0)) return 1;
        if (last >= seconds_of_a_day) return 1 / seconds_of_a_day;
        notes_.warn(fmt::format("emergence is said to be in seconds, the last of which is {}: taken as days",
                                format_general(last)));
        return 1;
    }

    // -- axes

    /// A segment from which an axis is to begin.
    struct Begin {
        std::size_t segment;
        std::optional<std::size_t> bearer;
        std::size_t on_node;
    };

    void make_axes() {
        std::vector<Begin> open;
        std::size_t collars = 0;
        for (std::size_t vertex = grid_.vertices.size(); vertex-- > 0;) {
            if (leading_[vertex] != none || begin_[vertex] == begin_[vertex + 1]) continue;
            ++collars;
            for (std::size_t i = begin_[vertex + 1]; i-- > begin_[vertex];)
                open.push_back({borne_[i], std::nullopt, 0});
        }
        std::size_t drawn = 0;
        is_drawn_.assign(grid_.segments.size(), false);
        while (!open.empty()) {
            const Begin begin = open.back();
            open.pop_back();
            drawn += make_axis(begin, open);
        }
        if (drawn < grid_.segments.size()) {
            const auto left = std::find(is_drawn_.begin(), is_drawn_.end(), false) - is_drawn_.begin();
            fail(grid_.segments[static_cast<std::size_t>(left)], "this segment belongs to a loop, or hangs on one");
        }
        if (collars > 1) notes_.warn(fmt::format("{} segments begin at no other: all are of one plant", collars));
    }

    std::size_t make_axis(const Begin& begin, std::vector<Begin>& open) {
        const std::size_t axis = loose_.size();
        measured::LooseAxis& loose = loose_.emplace_back();
        const Segment& first = grid_.segments[begin.segment];
        loose.place = place(first);
        if (std::isfinite(first.branch)) loose.label = format_general(first.branch);
        loose.bearer = begin.bearer;
        if (begin.bearer) loose.on_node = begin.on_node;
        add_node(loose, first, first.from);
        std::size_t segments = 0;
        for (std::size_t at = begin.segment; at != none; ++segments) {
            is_drawn_[at] = true;
            const Segment& segment = grid_.segments[at];
            add_node(loose, segment, segment.to);
            const std::size_t next = continuation(at);
            for (std::size_t i = begin_[segment.to + 1]; i-- > begin_[segment.to];) {
                if (borne_[i] != next) open.push_back({borne_[i], axis, loose.nodes.size() - 1});
            }
            at = next;
        }
        return segments;
    }

    void add_node(measured::LooseAxis& axis, const Segment& segment, std::size_t vertex) {
        MeasuredNode node{axes_ * grid_.vertices[vertex], diameter_if_unknown, 0, false};
        if (segment.radius > 0) {
            node.diameter = 2 * segment.radius * radius_metres();
        } else if (vertex == segment.to) {
            notes_.warn(fmt::format("a segment has no radius: taken as {} mm thick", 1000 * diameter_if_unknown),
                        place(segment));
        }
        if (segment.birth > 0) node.day = segment.birth * day_;
        has_days_ = has_days_ || node.day > 0;
        axis.nodes.push_back(node);
    }

    /// What goes on with the axis of a segment: the same branch, or else the same order, or else the thickest.
    std::size_t continuation(std::size_t at) const {
        const Segment& segment = grid_.segments[at];
        const auto first = borne_.begin() + static_cast<std::ptrdiff_t>(begin_[segment.to]),
                   last = borne_.begin() + static_cast<std::ptrdiff_t>(begin_[segment.to + 1]);
        if (first == last) return none;
        if (std::isfinite(segment.branch)) {
            return number_of(
                std::find_if(first, last,
                             [&](std::size_t other) { return grid_.segments[other].branch == segment.branch; }),
                last);
        }
        if (std::isfinite(segment.order)) {
            return number_of(
                std::find_if(first, last,
                             [&](std::size_t other) { return grid_.segments[other].order == segment.order; }),
                last);
        }
        return *std::max_element(first, last, [&](std::size_t a, std::size_t b) {
            return grid_.segments[a].radius < grid_.segments[b].radius;
        });
    }

    template <class Iterator>
    static std::size_t number_of(Iterator found, Iterator last) {
        return found == last ? none : *found;
    }

    static constexpr std::size_t none = std::size_t(-1);

    Grid grid_;
    std::string name_;
    const MeasuredOptions& options_;
    measured::Notes& notes_;
    std::vector<std::size_t> leading_;        ///< segment that leads to each vertex
    std::vector<std::size_t> begin_, borne_;  ///< segments that begin at each vertex: where they begin in the list
    std::vector<bool> is_drawn_;
    std::vector<measured::LooseAxis> loose_;
    std::string unit_in_words_;
    glm::dmat3 axes_{1};
    double scale_ = 1, day_ = 1;
    bool has_days_ = false;
};

}  // namespace

MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options) {
    measured::Notes notes(name);
    Grid grid = read_grid(text, name, notes);
    std::string().swap(text);
    MeasuredPlants plants = Building(std::move(grid), name, options, notes).plants();
    plants.warnings = notes.warnings();
    return plants;
}

}  // namespace espalier::language::dgf

#include "language/swc/points.h"

#include "base/number.h"
#include "base/text.h"
#include "language/measured/cells.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/parts_tree.h"
#include "language/measured/units.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace espalier::language::swc {
namespace {

constexpr double largest = 1e12;
constexpr std::array<const char*, 7> columns{"n", "type", "x", "y", "z", "radius", "parent"};

struct Point {
    glm::dvec3 at;
    double radius;
};

class Reader {
public:
    Reader(const std::string& name, const MeasuredOptions& options) : name_(name), options_(options), notes_(name) {}

    void read(std::string_view text) {
        for (std::size_t begin = 0; begin < text.size();) {
            const std::string_view line = measured::next_line(text, begin);
            ++line_;
            if (line.starts_with('#')) note(line);
            measured::split_cells(line.substr(0, line.find('#')), ' ', cells_);
            if (!cells_.empty()) read_point();
        }
        if (points_.empty()) fail(1, "this file has no points");
        set_units();
    }

    MeasuredPlants plants() {
        const std::vector<double> reach = reaches();
        // The path to the farthest tip goes on.
        const auto next = [&](std::uint32_t point, const std::vector<std::uint32_t>& borne) {
            const auto length = [&](std::uint32_t each) {
                return reach[each] + glm::distance(points_[point].at, points_[each].at);
            };
            std::size_t best = 0;
            for (std::size_t i = 1; i < borne.size(); ++i) {
                if (length(borne[i]) > length(borne[best])) best = i;
            }
            return best;
        };
        const std::vector<measured::PartAxis> axes = measured::axes_of_parts(parts_, is_root, next, name_);
        std::vector<std::size_t> place_of(points_.size());  // on its axis
        std::vector<measured::LooseAxis> loose;
        MeasuredPlants plants;
        for (const measured::PartAxis& axis : axes) {
            const Place place{name_, parts_[axis.parts[0]].line, 1};
            measured::LooseAxis& out = measured::begin_axis(axis, place, loose, plants);
            if (out.bearer) {
                out.on_node = place_of[axis.on_part];
                out.nodes.push_back(node(axis.on_part));
            }
            out.nodes.reserve(out.nodes.size() + axis.parts.size());
            for (const std::uint32_t point : axis.parts) {
                place_of[point] = out.nodes.size();
                out.nodes.push_back(node(point));
            }
        }
        plants.axes = measured::joined(std::move(loose));
        plants.unit = options_.pixel ? fmt::format("pixels of {} mm", format_general(1000 * metres_)) : unit_;
        plants.up = up_;
        plants.warnings = notes_.warnings();
        return plants;
    }

private:
    [[noreturn]] void fail(int column, const std::string& message) const {
        throw UserError(Place{name_, std::max(line_, 1), column}, message);
    }

    /// Comments may tell what an SWC file has no place for.
    void note(std::string_view line) {
        measured::split_cells(line, ' ', cells_);
        if (cells_.size() != 3) return;
        if (cells_[1] == "unit:") said_unit_ = cells_[2];
        if (cells_[1] == "up:") said_up_ = cells_[2];
    }

    double number(std::size_t column) const {
        const std::optional<double> value = column < cells_.size() ? finite_number(cells_[column]) : std::nullopt;
        if (value && std::abs(*value) < largest) return *value;
        fail(static_cast<int>(column) + 1,
             fmt::format(
                 "a point is 'n type x y z radius parent'; here {} is {}", columns[column],
                 column < cells_.size() ? fmt::format("'{}'", escaped(cells_[column].substr(0, 40))) : "missing"));
    }

    std::int32_t whole(std::size_t column) const {
        const double value = number(column);
        if (std::abs(value) <= measured::NamedPart::largest) return static_cast<std::int32_t>(std::lround(value));
        fail(static_cast<int>(column) + 1,
             fmt::format("{} is a number up to {}", columns[column], measured::NamedPart::largest));
    }

    void read_point() {
        measured::NamedPart part;
        part.id = whole(0);
        part.parent = whole(6);
        part.line = line_;
        points_.push_back({{number(2), number(3), number(4)}, number(5)});
        parts_.push_back(part);
        if (cells_.size() > columns.size()) notes_.unused("a cell behind the parent", {name_, line_, 8});
    }

    void set_units() {
        const Place place{name_, 1, 1};
        notes_.unused("column 'type'", {name_, parts_[0].line, 1}, parts_.size());
        unit_ = options_.unit.empty() ? said_unit_ : options_.unit;
        if (unit_.empty()) unit_ = "um";
        metres_ = options_.pixel ? *options_.pixel : measured::metres_of_unit(unit_);
        if (options_.unit.empty() && said_unit_.empty() && !options_.pixel) {
            notes_.warn(
                "the file says no unit: micrometres, those of neurons, are taken; --unit, or unit = \"...\" in a "
                "scene, says another",
                place);
        }
        up_ = options_.up.empty() ? said_up_ : options_.up;
        if (up_.empty()) {
            up_ = "z";
            notes_.warn(
                "the file does not say what points upwards: z is taken; --up, or up = \"...\" in a scene, says "
                "another",
                place);
        }
        upright_ = measured::upright(up_);
    }

    MeasuredNode node(std::uint32_t point) const {
        const Point& of = points_[point];
        return {metres_ * (upright_ * of.at), 2 * metres_ * std::max(0.0, of.radius), 0, false};
    }

    /// How far the farthest tip above each point is.
    std::vector<double> reaches() const {
        const std::vector<std::uint32_t> bearers = measured::bearers_of(parts_, is_root, name_);
        const std::vector<std::uint32_t> order = measured::bearers_first(parts_, bearers, name_);
        std::vector<double> reach(points_.size(), 0);
        for (auto point = order.rbegin(); point != order.rend(); ++point) {
            const std::uint32_t bearer = bearers[*point];
            if (bearer == measured::PartAxis::none) continue;
            reach[bearer] =
                std::max(reach[bearer], reach[*point] + glm::distance(points_[bearer].at, points_[*point].at));
        }
        return reach;
    }

    static bool is_root(std::int32_t parent) { return parent < 0; }

    std::string name_;
    MeasuredOptions options_;
    measured::Notes notes_;
    std::string said_unit_, said_up_, unit_, up_;
    double metres_ = 1;
    glm::dmat3 upright_{1};
    int line_ = 0;
    std::vector<std::string_view> cells_;
    std::vector<measured::NamedPart> parts_;
    std::vector<Point> points_;
};

}  // namespace

MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options) {
    try {
        Reader reader(name, options);
        reader.read(text);
        std::string().swap(text);
        return reader.plants();
    } catch (const UserError& error) {
        if (error.diagnostics().front().place.known()) throw;
        throw UserError(Place{name, 1, 1}, error.diagnostics().front().message);
    }
}

}  // namespace espalier::language::swc

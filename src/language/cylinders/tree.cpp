#include "language/cylinders/tree.h"

#include "base/number.h"
#include "base/text.h"
#include "language/cylinders/dialect.h"
#include "language/measured/cells.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/parts_tree.h"
#include "language/measured/units.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::language::cylinders {
namespace {

constexpr double largest = 1e12;
constexpr double meets = 2e-6;  ///< m; what tables round

struct Cylinder {
    glm::dvec3 start, end;
    double radius = 0;
    std::int32_t branch = -1;
    std::int32_t goes_on = -1;  ///< the next of its branch or, where a table has no extensions, its order
};

class Reader {
public:
    Reader(const std::string& name, const MeasuredOptions& options) : name_(name), notes_(name) {
        up_ = options.up.empty() ? "z" : options.up;
        unit_ = options.unit.empty() ? "m" : options.unit;
        metres_ = options.pixel ? *options.pixel : measured::metres_of_unit(unit_);
        upright_ = measured::upright(up_);
    }

    void read(std::string_view text) {
        // A row has a number and a separator in each of ten columns or more.
        const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
        parts_.reserve(std::min(lines, text.size() / 20));
        cylinders_.reserve(parts_.capacity());
        for (std::size_t begin = 0; begin < text.size();) {
            const std::string_view line = measured::next_line(text, begin);
            ++line_;
            if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.front() == '#') continue;
            if (is_in_rows_) {
                measured::split_cells(line, header_.separator, cells_);
                read_row();
            } else {
                read_header(line);
            }
        }
        if (cylinders_.empty()) fail(0, "this file has no cylinders");
    }

    MeasuredPlants plants() {
        // The number that means none is one below the first. All tables count from the least number on.
        const std::int32_t before = header_.dialect->counts_from_one ? 0 : -1;
        const auto is_root = [before](std::int32_t of) { return of == before || of < 0; };
        const auto next = [&](std::uint32_t part, const std::vector<std::uint32_t>& borne) {
            return continuing(part, borne);
        };
        const std::vector<measured::PartAxis> axes = measured::axes_of_parts(parts_, is_root, next, name_);
        MeasuredPlants plants;
        std::vector<measured::LooseAxis> loose;
        loose.reserve(axes.size());
        for (const measured::PartAxis& axis : axes) {
            const Place place{name_, parts_[axis.parts[0]].line, 1};
            measured::LooseAxis& out = measured::begin_axis(axis, place, loose, plants);
            const std::int32_t number = cylinders_[axis.parts[0]].branch;
            out.label = number >= 0 ? fmt::format("branch {}", number) : "";
        }
        std::vector<measured::NamedPart>().swap(parts_);
        for (std::size_t i = 0; i < axes.size(); ++i) {
            for (const std::uint32_t part : axes[i].parts) add(cylinders_[part], loose[i].nodes);
            loose[i].nodes.shrink_to_fit();
        }
        std::vector<Cylinder>().swap(cylinders_);
        plants.axes = measured::joined(std::move(loose));
        plants.unit = unit_;
        plants.up = up_;
        tell();
        plants.warnings = notes_.warnings();
        return plants;
    }

private:
    [[noreturn]] void fail(std::size_t column, const std::string& message) const {
        throw UserError(Place{name_, std::max(line_, 1), static_cast<int>(column) + 1}, message);
    }

    void read_header(std::string_view line) {
        const std::optional<Header> header = header_of(line);
        if (!header) {
            fail(0,
                 "this is no header of a cylinder model of TreeQSM (radius, length, start, axis, parent), SimpleForest "
                 "(ID, parentID, startX ... endZ, radius, length) or aRchi (cyl_ID, parent_ID, radius_cyl)");
        }
        header_ = *header;
        is_in_rows_ = true;
        is_read_.assign(header_.names.size(), false);
        filled_.assign(header_.names.size(), 0);
        for (const std::optional<std::size_t>& column : header_.column) {
            if (column) is_read_[*column] = true;
        }
        first_line_ = line_ + 1;
    }

    /// Between semicolons, a comma may stand for the point.
    std::optional<double> number_in(std::string_view cell) const {
        const std::size_t comma = header_.separator == ';' ? cell.find(',') : std::string_view::npos;
        if (comma == std::string_view::npos) return finite_number(cell);
        std::string with_point(cell);
        with_point[comma] = '.';
        return finite_number(with_point);
    }

    double number(Field field) const {
        const std::size_t column = *header_.column[field];
        const std::optional<double> value = column < cells_.size() ? number_in(cells_[column]) : std::nullopt;
        if (value && std::abs(*value) < largest) return *value;
        fail(column, fmt::format("column {} of a cylinder is a number, not '{}'", header_.names[column],
                                 column < cells_.size() ? escaped(cells_[column].substr(0, 40)) : ""));
    }

    std::int32_t whole(Field field) const {
        const double value = number(field);
        if (std::abs(value) <= measured::NamedPart::largest) return static_cast<std::int32_t>(std::lround(value));
        fail(*header_.column[field], fmt::format("column {} of a cylinder is a number up to {}",
                                                 header_.names[*header_.column[field]], measured::NamedPart::largest));
    }

    bool has(Field field) const { return header_.column[field].has_value(); }

    glm::dvec3 vector(Field x, Field y, Field z) const { return {number(x), number(y), number(z)}; }

    void read_row() {
        for (std::size_t i = 0; i < std::min(cells_.size(), filled_.size()); ++i) filled_[i] += !cells_[i].empty();
        if (cells_.size() > header_.names.size() + 1) {
            notes_.unused("a cell below no name of the header", {name_, line_, 1});
        }
        measured::NamedPart part;
        const std::int32_t first = header_.dialect->counts_from_one ? 1 : 0;
        part.id = has(id) ? whole(id) : first + static_cast<std::int32_t>(parts_.size());
        part.parent = whole(parent);
        part.line = line_;
        Cylinder cylinder;
        cylinder.start = vector(start_x, start_y, start_z);
        const double own_length = number(length);
        cylinder.end = has(end_x) ? vector(end_x, end_y, end_z) : end_of(cylinder.start, own_length);
        length_ += own_length;
        drawn_ += glm::distance(cylinder.start, cylinder.end);
        cylinder.radius = number(radius);
        if (cylinder.radius < 0) fail(*header_.column[radius], "a radius is not below 0");
        if (has(branch)) cylinder.branch = whole(branch);
        if (has(order)) cylinder.goes_on = whole(order);
        if (has(extension)) cylinder.goes_on = whole(extension);
        parts_.push_back(part);
        cylinders_.push_back(cylinder);
    }

    glm::dvec3 end_of(const glm::dvec3& start, double own_length) const {
        const glm::dvec3 axis = vector(axis_x, axis_y, axis_z);
        const double size = glm::length(axis);
        if (!(size > 0)) fail(*header_.column[axis_x], "the axis of a cylinder has no direction");
        return start + own_length / size * axis;
    }

    glm::dvec3 placed(const glm::dvec3& at) const { return metres_ * (upright_ * at); }

    /// Each keeps its own length: where it does not begin at the end of the one before, the gap is a link.
    void add(const Cylinder& cylinder, std::vector<MeasuredNode>& nodes) const {
        const double diameter = 2 * metres_ * cylinder.radius;
        const glm::dvec3 start = placed(cylinder.start);
        if (nodes.empty() || glm::distance(nodes.back().at, start) > meets) {
            nodes.push_back({start, diameter, 0, !nodes.empty()});
        }
        nodes.push_back({placed(cylinder.end), diameter, 0, false});
    }

    /// The next of its branch: as the file says, or else the first of the same branch and order.
    std::size_t continuing(std::uint32_t part, const std::vector<std::uint32_t>& borne) const {
        const Cylinder& below = cylinders_[part];
        const auto goes_on = [&](std::uint32_t each) {
            if (has(extension)) return parts_[each].id == below.goes_on;
            return cylinders_[each].branch == below.branch && cylinders_[each].goes_on == below.goes_on;
        };
        return static_cast<std::size_t>(std::find_if(borne.begin(), borne.end(), goes_on) - borne.begin());
    }

    void tell() {
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            if (is_read_[i] || filled_[i] == 0 || header_.names[i].empty()) continue;
            notes_.unused(fmt::format("column '{}'", escaped(header_.names[i])), {name_, first_line_, 1}, filled_[i]);
        }
        if (std::abs(drawn_ - length_) > 1e-3 * length_) {
            notes_.warn(fmt::format("the column of lengths says {} together, the ends of the cylinders {}",
                                    format_general(length_), format_general(drawn_)));
        }
    }

    std::string name_;
    measured::Notes notes_;
    std::string unit_, up_;
    double metres_ = 1;
    glm::dmat3 upright_{1};
    int line_ = 0, first_line_ = 0;
    bool is_in_rows_ = false;
    Header header_;
    std::vector<bool> is_read_;
    std::vector<std::size_t> filled_;  ///< of each column
    std::vector<std::string_view> cells_;
    std::vector<measured::NamedPart> parts_;
    std::vector<Cylinder> cylinders_;
    double length_ = 0, drawn_ = 0;  ///< of all, as the file says them and as their ends have it
};

}  // namespace

MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options) {
    Reader reader(name, options);
    reader.read(text);
    std::string().swap(text);
    return reader.plants();
}

}  // namespace espalier::language::cylinders

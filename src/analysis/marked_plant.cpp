#include "analysis/marked_plant.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/xml.h"
#include "base/text_cursor.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace espalier::analysis {
namespace {

namespace fs = std::filesystem;

/// The numbers of a text and the letters between them.
class SvgText {
public:
    SvgText(std::string_view text, const fs::path& file) : text_(text, file.string()), file_(file) {}

    bool at_end() {
        text_.skip(" \t\r\n,");
        return text_.at_end();
    }
    bool next_is_number() {
        return !at_end() && std::string_view("0123456789+-.").find(text_.next()) != std::string_view::npos;
    }
    char take_letter() {
        const char letter = at_end() ? '\0' : text_.next();
        text_.accept({&letter, 1});
        return letter;
    }
    double take_number() {
        at_end();
        const std::optional<double> number = text_.exact_number();
        if (!number) {
            throw UserError(
                fmt::format("{}: expected a number, found '{}'", file_.string(), text_.rest().substr(0, 20)));
        }
        return *number;
    }
    glm::dvec2 take_point() {
        const double x = take_number();
        return {x, take_number()};
    }

private:
    TextCursor text_;
    const fs::path& file_;
};

using Transform = glm::dmat3;

class SvgReader {
public:
    explicit SvgReader(const fs::path& file) : file_(file) {}

    MarkedPlant read() {
        const std::string text = read_text(file_);
        try {
            read_element(archive::parse_xml(text), Transform(1));
        } catch (const archive::XmlError& error) {
            throw UserError(fmt::format("{} is no SVG that can be read: {}", file_.string(), error.what()));
        }
        for (MarkedAxis& axis : plant_.axes) {
            for (glm::dvec2& node : axis.nodes) node *= glm::dvec2(unit_.value_or(1), -unit_.value_or(1));
        }
        plant_.has_scale = unit_.has_value();
        return std::move(plant_);
    }

private:
    void read_element(const XmlElement& element, const Transform& outer) {
        const Transform here = outer * transform_of(element.attribute("transform"));
        std::vector<glm::dvec2> points = points_of(element);
        for (glm::dvec2& point : points) point = glm::dvec2(here * glm::dvec3(point, 1));
        if (points.size() > 1) {
            const std::string& length = element.attribute("data-length");
            length.empty() ? plant_.axes.push_back({std::move(points), {}, 0, 0}) : set_unit(points, length);
        }
        for (const XmlElement& child : element.children) {
            if (child.name != "defs") read_element(child, here);
        }
    }

    void set_unit(const std::vector<glm::dvec2>& points, const std::string& length) {
        const double metres = SvgText(length, file_).take_number(),
                     drawn = glm::distance(points.front(), points.back());
        if (!(metres > 0) || !(drawn > 0)) {
            throw UserError(fmt::format("{}: data-length=\"{}\" must be metres above 0, on a line with a length",
                                        file_.string(), length));
        }
        unit_ = metres / drawn;
    }

    std::vector<glm::dvec2> points_of(const XmlElement& element) const {
        std::vector<glm::dvec2> points;
        if (element.name == "polyline") {
            for (SvgText text(element.attribute("points"), file_); !text.at_end();) points.push_back(text.take_point());
        } else if (element.name == "line") {
            for (const char* end : {"1", "2"}) {
                const auto number = [&](const std::string& key) {
                    return SvgText(element.attribute(key + end), file_).take_number();
                };
                points.emplace_back(number("x"), number("y"));
            }
        } else if (element.name == "path") {
            points = points_of_path(element.attribute("d"));
        }
        return points;
    }

    std::vector<glm::dvec2> points_of_path(const std::string& path) const {
        std::vector<glm::dvec2> points;
        SvgText text(path, file_);
        for (char command = 'M'; !text.at_end();) {
            if (!text.next_is_number()) command = text.take_letter();
            const bool relative = command >= 'a';
            const glm::dvec2 from = relative && !points.empty() ? points.back() : glm::dvec2(0);
            switch (command) {
                case 'M':
                case 'm':
                case 'L':
                case 'l':
                    points.push_back(from + text.take_point());
                    break;
                case 'H':
                case 'h':
                    points.emplace_back(from.x + text.take_number(), points.empty() ? 0 : points.back().y);
                    break;
                case 'V':
                case 'v':
                    points.emplace_back(points.empty() ? 0 : points.back().x, from.y + text.take_number());
                    break;
                default:
                    throw UserError(
                        fmt::format("{}: a path has '{}'; axes are straight from node to node: draw them "
                                    "with straight pieces (M, L, H, V)",
                                    file_.string(), command));
            }
        }
        return points;
    }

    Transform transform_of(const std::string& attribute) const {
        Transform all(1);
        std::string_view rest = attribute;
        for (std::size_t open; (open = rest.find('(')) != rest.npos;) {
            const std::size_t begin = std::min(rest.find_first_not_of(" ,"), open), close = rest.find(')');
            const std::string_view name = rest.substr(begin, open - begin);
            std::vector<double> n;
            for (SvgText text(rest.substr(open + 1, close - open - 1), file_); !text.at_end();) {
                n.push_back(text.take_number());
            }
            all *= named_transform(name, n);
            rest.remove_prefix(std::min(close, rest.size() - 1) + 1);
        }
        return all;
    }

    Transform named_transform(std::string_view name, const std::vector<double>& n) const {
        Transform made(1);
        if (name == "translate" && !n.empty()) {
            made[2] = {n[0], n.size() > 1 ? n[1] : 0, 1};
        } else if (name == "scale" && !n.empty()) {
            made[0].x = n[0];
            made[1].y = n.size() > 1 ? n[1] : n[0];
        } else if (name == "matrix" && n.size() == 6) {
            made = Transform(n[0], n[1], 0, n[2], n[3], 0, n[4], n[5], 1);
        } else if (name == "rotate" && n.size() == 1) {
            const double c = std::cos(glm::radians(n[0])), s = std::sin(glm::radians(n[0]));
            made = Transform(c, s, 0, -s, c, 0, 0, 0, 1);
        } else {
            throw UserError(
                fmt::format("{}: the transform '{}' is not read; translate, scale, rotate(angle) and matrix "
                            "are",
                            file_.string(), name));
        }
        return made;
    }

    const fs::path& file_;
    MarkedPlant plant_;
    std::optional<double> unit_;  ///< metres
};

MarkedPlant read_csv(const fs::path& file) {
    const RecordedTable table = read_table(file);
    const std::size_t axis = table.column("axis"), x = table.column("x"), y = table.column("y");
    MarkedPlant plant;
    plant.has_scale = true;
    std::map<double, std::size_t> numbers;
    for (const std::vector<double>& row : table.rows) {
        if (!std::isfinite(row[x]) || !std::isfinite(row[y])) {
            throw UserError(fmt::format("{}: a node of axis {} has no x or y", file.string(), row[axis]));
        }
        const auto [at, is_new] = numbers.emplace(row[axis], plant.axes.size());
        if (is_new) plant.axes.emplace_back();
        plant.axes[at->second].nodes.emplace_back(row[x], row[y]);
    }
    std::erase_if(plant.axes, [](const MarkedAxis& marked) { return marked.nodes.size() < 2; });
    return plant;
}

struct Joint {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t axis = 0, node = 0;
};

Joint nearest_node(const std::vector<MarkedAxis>& axes, const std::vector<bool>& joined, const glm::dvec2& base) {
    Joint nearest;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
        if (!joined[axis]) continue;
        // The base of a branch is a node of its parent: what begins there is its sibling.
        for (std::size_t node = axis == 0 ? 0 : 1; node < axes[axis].nodes.size(); ++node) {
            const double distance = glm::distance(axes[axis].nodes[node], base);
            if (distance < nearest.distance) nearest = {distance, axis, node};
        }
    }
    return nearest;
}

/// Means of what falls into the same cell.
class CellMeans {
public:
    void add(const AxisMeasures::Cell& cell, double value) {
        auto& [sum, count] = sums_[cell];
        sum += value;
        ++count;
    }
    std::map<AxisMeasures::Cell, double> means() const {
        std::map<AxisMeasures::Cell, double> means;
        for (const auto& [cell, sum] : sums_) means[cell] = sum.first / sum.second;
        return means;
    }

private:
    std::map<AxisMeasures::Cell, std::pair<double, int>> sums_;
};

double length_of(const MarkedAxis& axis) {
    double length = 0;
    for (std::size_t i = 1; i < axis.nodes.size(); ++i) length += glm::distance(axis.nodes[i - 1], axis.nodes[i]);
    return length;
}

double angle_between(const glm::dvec2& a, const glm::dvec2& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0 ? glm::degrees(std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0, 1.0))) : 0;
}

/// Returns the direction of an axis at a node: that of the internode which ends there; at its base that of the first.
glm::dvec2 direction_at(const MarkedAxis& axis, std::size_t node) {
    const std::size_t tip = std::max<std::size_t>(node, 1);
    return axis.nodes[tip] - axis.nodes[tip - 1];
}

void draw(std::string& svg, const MarkedPlant& plant, const glm::dvec2& origin, double scale, const char* colour) {
    for (const MarkedAxis& axis : plant.axes) {
        svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\" points=\"", colour);
        for (const glm::dvec2& node : axis.nodes) {
            const glm::dvec2 at = (node - origin) * scale;
            svg += fmt::format("{:.2f},{:.2f} ", 400 + at.x, 760 - at.y);
        }
        svg += "\"/>\n";
    }
}

}  // namespace

MarkedPlant read_marked_plant(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension != ".svg" && extension != ".csv") {
        throw UserError(fmt::format("'{}' holds no marks: .svg (polylines) or .csv (axis, x, y)", file.string()));
    }
    MarkedPlant plant = extension == ".svg" ? SvgReader(file).read() : read_csv(file);
    if (plant.axes.empty()) {
        throw UserError(
            fmt::format("{} has no axis: mark each with a polyline of two nodes or more, from its base to its "
                        "tip, the main axis first",
                        file.string()));
    }
    join_axes(plant.axes);
    return plant;
}

MarkedPlant seen_from_the_front(const PlantGeometry& geometry) {
    MarkedPlant plant;
    plant.has_scale = true;
    std::map<std::uint32_t, std::size_t> numbers;  // the internodes of branches lie between those of their axis
    for (const Internode& internode : geometry.internodes) {
        const auto [at, is_new] = numbers.emplace(internode.axis, plant.axes.size());
        if (is_new) plant.axes.push_back({{glm::dvec2(internode.base)}, {}, 0, 0});
        plant.axes[at->second].nodes.emplace_back(internode.tip);
    }
    join_axes(plant.axes);
    return plant;
}

void join_axes(std::vector<MarkedAxis>& axes) {
    std::vector<bool> joined(axes.size());
    if (!axes.empty()) joined[0] = true;
    for (std::size_t rest = 1; rest < axes.size(); ++rest) {
        Joint best;
        std::size_t next = 0;
        for (std::size_t axis = 0; axis < axes.size(); ++axis) {
            if (joined[axis]) continue;
            const Joint joint = nearest_node(axes, joined, axes[axis].nodes.front());
            if (joint.distance < best.distance) best = joint, next = axis;
        }
        axes[next].parent = best.axis;
        axes[next].parent_node = best.node;
        axes[next].order = axes[best.axis].order + 1;
        joined[next] = true;
    }
}

AxisMeasures measures_of(const MarkedPlant& plant, bool in_metres) {
    CellMeans lengths, angles;
    const double unit = in_metres || plant.axes.empty() ? 1 : length_of(plant.axes.front());
    for (const MarkedAxis& axis : plant.axes) {
        for (std::size_t i = 1; i < axis.nodes.size(); ++i) {
            lengths.add({axis.order, i - 1}, glm::distance(axis.nodes[i - 1], axis.nodes[i]) / unit);
        }
        if (!axis.parent) continue;
        const glm::dvec2 bearing = direction_at(plant.axes[*axis.parent], axis.parent_node);
        angles.add({axis.order, axis.parent_node}, angle_between(bearing, direction_at(axis, 0)));
    }
    return {lengths.means(), angles.means()};
}

std::string overlay_of(const MarkedPlant& marks, const MarkedPlant& model) {
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 800\">\n";
    double reach = 0;
    const glm::dvec2 foot = marks.axes.front().nodes.front();
    for (const MarkedAxis& axis : marks.axes) {
        for (const glm::dvec2& node : axis.nodes) {
            reach = std::max({reach, std::abs(node.x - foot.x) * 2, std::abs(node.y - foot.y)});
        }
    }
    const double scale = reach > 0 ? 720 / reach : 1;
    const double ratio = marks.has_scale ? 1 : length_of(marks.axes.front()) / length_of(model.axes.front());
    draw(svg, model, model.axes.front().nodes.front(), scale * ratio, "#3b6fd4");
    draw(svg, marks, foot, scale, "#d43b3b");
    return svg + "</svg>\n";
}

}  // namespace espalier::analysis

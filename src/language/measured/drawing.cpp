#include "language/measured/drawing.h"

#include "espalier/lsystem/alphabet.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <iterator>

namespace espalier::language::measured {
namespace {

class Drawing {
public:
    Drawing(const MeasuredPlants& plants, const DrawingLetters& letters)
        : plants_(plants), letters_(letters), borne_(plants.axes.size()) {
        for (std::size_t i = 0; i < plants.axes.size(); ++i) {
            const MeasuredAxis& axis = plants.axes[i];
            if (axis.bearer) borne_[*axis.bearer].push_back(i);
        }
        const auto lower = [&](std::size_t a, std::size_t b) {
            return plants.axes[a].on_node < plants.axes[b].on_node;
        };
        for (std::vector<std::size_t>& laterals : borne_) std::stable_sort(laterals.begin(), laterals.end(), lower);
    }

    /// From a place; first axes that begin there without a bracket are the only ones.
    ModuleString of(const std::vector<std::size_t>& first_axes, const glm::dvec3& from) && {
        const bool is_alone = first_axes.size() == 1 && plants_.axes[first_axes[0]].nodes[0].at == from;
        for (const std::size_t axis : first_axes) {
            if (!is_alone) {
                string_.append(Alphabet::open_bracket);
                string_.append(letters_.at);
                string_.append(letters_.axis_begin);
                append(letters_.axis, {0});
            }
            add_with_laterals(axis, from);
            if (!is_alone) string_.append(Alphabet::close_bracket);
        }
        return std::move(string_);
    }

private:
    /// An axis that is being drawn, up to a node.
    struct Open {
        std::size_t axis, node = 0;
        std::size_t lateral = 0;  ///< of those it bears
        std::size_t organ = 0;
        glm::dvec3 at;  ///< of the turtle
    };

    void append(lsystem::LetterId letter, std::initializer_list<double> values) {
        string_.append(letter, std::span(values.begin(), values.size()));
    }

    void head(const glm::dvec3& heading) {
        string_.append(letters_.at);
        append(letters_.heading, {heading.x, heading.y, heading.z});
    }

    // Laterals of laterals without recursion: there may be any number of orders.
    void add_with_laterals(std::size_t first, const glm::dvec3& from) {
        std::vector<Open> open{{first, 0, 0, 0, from}};
        link(from, plants_.axes[first].nodes[0]);
        while (!open.empty()) {
            Open& top = open.back();
            const MeasuredAxis& axis = plants_.axes[top.axis];
            const glm::dvec3 here = axis.nodes[top.node].at;
            for (; top.organ < axis.organs.size() && axis.organs[top.organ].on_node == top.node; ++top.organ) {
                draw(axis.organs[top.organ], here);
            }
            if (top.lateral < borne_[top.axis].size()) {
                const std::size_t lateral = borne_[top.axis][top.lateral];
                if (plants_.axes[lateral].on_node == top.node) {
                    ++top.lateral;
                    string_.append(Alphabet::open_bracket);
                    link(here, plants_.axes[lateral].nodes[0]);
                    open.push_back({lateral, 0, 0, 0, here});
                    continue;
                }
            }
            if (top.node + 1 < axis.nodes.size()) {
                const bool is_behind_gap = top.node > 0 && axis.nodes[top.node].linked;
                segment(here, axis.nodes[++top.node], is_behind_gap);
                continue;
            }
            append(letters_.tip, {static_cast<double>(axis.order)});
            open.pop_back();
            if (!open.empty()) string_.append(Alphabet::close_bracket);
        }
    }

    void link(const glm::dvec3& from, const MeasuredNode& node) { move(from, node.at); }

    void move(const glm::dvec3& from, const glm::dvec3& to) {
        const double length = glm::distance(from, to);
        if (!(length > 1e-9)) return;
        head((to - from) / length);
        append(letters_.move, {length});
    }

    /// A polygon for each face: moves within it mark its vertices.
    void draw(const MeasuredOrgan& organ, const glm::dvec3& from) {
        const MeasuredMesh& mesh = plants_.meshes[organ.mesh];
        const std::vector<glm::dvec3> points = points_of(mesh, organ);
        for (const std::vector<std::uint32_t>& face : mesh.faces) {
            string_.append(Alphabet::open_bracket);
            move(from, points[face[0]]);
            string_.append(letters_.open_polygon);
            string_.append(letters_.vertex);
            for (std::size_t i = 1; i < face.size(); ++i) move(points[face[i - 1]], points[face[i]]);
            string_.append(letters_.close_polygon);
            string_.append(Alphabet::close_bracket);
        }
    }

    /// What reads the drawing tells by G that an axis goes on behind a gap.
    void segment(const glm::dvec3& from, const MeasuredNode& node, bool is_behind_gap) {
        const double length = glm::distance(from, node.at);
        if (!(length > 1e-9)) return;
        if (node.linked) return link(from, node);
        const glm::dvec3 heading = (node.at - from) / length;
        if (node.day > 0) {
            append(is_behind_gap ? letters_.node_behind : letters_.node,
                   {node.day, heading.x, heading.y, heading.z, length, node.diameter});
            return;
        }
        append(letters_.width, {node.diameter});
        head(heading);
        append(is_behind_gap ? letters_.forward_behind : letters_.forward, {length});
    }

    const MeasuredPlants& plants_;
    const DrawingLetters& letters_;
    std::vector<std::vector<std::size_t>> borne_;
    ModuleString string_;
};

}  // namespace

DrawingLetters::DrawingLetters(Alphabet& alphabet)
    : at(alphabet.letter("@", 0)),
      width(alphabet.letter("!", 1)),
      heading(alphabet.letter("R", 3)),
      forward(alphabet.letter("F", 1)),
      move(alphabet.letter("f", 1)),
      axis_begin(alphabet.letter("A", 0)),
      axis(alphabet.letter("x", 1)),
      tip(alphabet.letter("Tip", 1)),
      node(alphabet.letter("Node", 6)),
      open_polygon(alphabet.letter("{", 0)),
      vertex(alphabet.letter(".", 0)),
      close_polygon(alphabet.letter("}", 0)),
      forward_behind(alphabet.letter("G", 1)),
      node_behind(alphabet.letter("NodeBehind", 6)) {}

ModuleString drawing_of(const MeasuredPlants& plants, std::optional<std::size_t> plant, const DrawingLetters& letters) {
    std::vector<std::size_t> first_axes;
    for (std::size_t i = 0; i < plants.axes.size(); ++i) {
        if (!plants.axes[i].bearer && (!plant || plants.axes[i].plant == *plant)) first_axes.push_back(i);
    }
    return Drawing(plants, letters).of(first_axes, plant ? plants.plants[*plant].base : glm::dvec3(0));
}

std::string text_of(const ModuleString& string, const Alphabet& alphabet) {
    std::string text = "\n\t";
    std::size_t parameter = 0;
    bool is_glued = true;  // to what comes before
    for (const lsystem::LetterId letter : string.letters) {
        const int arity = alphabet.arity(letter);
        const bool opens = letter == Alphabet::open_bracket, closes = letter == Alphabet::close_bracket;
        if (opens && text.back() != '\t') text += "\n\t";
        if (!opens && !closes && !is_glued) text += ' ';
        text += alphabet.name(letter);
        for (int k = 0; k < arity; ++k) {
            fmt::format_to(std::back_inserter(text), "{}{:.10g}", k == 0 ? "(" : ", ", string.parameters[parameter++]);
        }
        if (arity > 0) text += ')';
        is_glued = arity == 0 && !closes;
    }
    return text;
}

std::string sample_axiom(bool has_times) {
    return std::string(" [@Ax(0) !(1) @R(1, 0, 0) f(1) F(1) G(1) { . f(1) } Tip(0)]") +
           (has_times ? " Node(1, 1, 0, 0, 1, 1) NodeBehind(1, 1, 0, 0, 1, 1)" : "");
}

}  // namespace espalier::language::measured

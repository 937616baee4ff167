// Trees made by hand, with the string that drew them, for tests of geometry stages.
#pragma once

#include "espalier/turtle/geometry_stage.h"

#include "lineage.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <string>
#include <utility>
#include <vector>

namespace espalier::test {

class Tree {
public:
    PlantGeometry geometry;
    ModuleString string;

    /// A module and the internode that it drew.
    Tree& grow(const glm::dvec3& step, double radius = 0.1) {
        const std::uint32_t module = append(alphabet_.letter("F", 0));
        draw(module, step, radius);
        return *this;
    }
    /// One more internode of the last module, as pictures have them.
    Tree& grow_picture(const glm::dvec3& step, double radius = 0.1) {
        draw(std::uint32_t(string.size() - 1), step, radius);
        return *this;
    }
    Tree& open() {
        append(Alphabet::open_bracket);
        branches_.push_back(turtle_);
        turtle_.on_axis = false;
        ++turtle_.order;
        return *this;
    }
    Tree& close() {
        append(Alphabet::close_bracket);
        turtle_ = branches_.back();
        branches_.pop_back();
        return *this;
    }
    /// One of everything that is no internode, all at the turtle.
    Tree& bear() {
        const std::uint32_t module = append(alphabet_.letter("L", 0));
        const glm::dvec3 at = turtle_.position;
        const glm::dvec3 corners[3] = {at, at + glm::dvec3(1, 0, 0), at + glm::dvec3(0, 1, 0)};
        Organ organ{};
        organ.module = module;
        organ.pose.position = at;
        organ.size = glm::dvec3(1);
        geometry.organs.push_back(organ);
        geometry.polygons.push_back({module, std::uint32_t(geometry.vertices.size()), 3, turtle_.order, 0});
        const auto first_corner = std::uint32_t(geometry.mesh.vertices.size());
        const auto first_index = std::uint32_t(geometry.mesh.triangles.size());
        for (std::uint32_t i = 0; i < 3; ++i) {
            geometry.vertices.push_back(corners[i]);
            geometry.mesh.vertices.push_back({corners[i], {0, 0, 1}, {}});
            geometry.mesh.triangles.push_back(first_corner + i);
        }
        geometry.mesh.pieces.push_back({module, first_index, 3, turtle_.order, 0, {}, MeshPiece::Kind::patch});
        geometry.labels.push_back({module, turtle_.order, 0, at, "here"});
        return *this;
    }

    Tree& stage(Settings parameters, double time = 0) {
        const auto read = read_geometry_stage(parameters);
        StagedPlant plant{geometry, string, RandomKey(1, 0, Stream::stage)};
        plant.time = time;
        apply({read}, plant);
        return *this;
    }

    const Internode& operator[](std::size_t i) const { return geometry.internodes[i]; }
    std::size_t size() const { return geometry.internodes.size(); }
    double length(std::size_t i) const { return glm::distance((*this)[i].base, (*this)[i].tip); }
    /// Degrees between an internode and straight down.
    double from_down(std::size_t i) const {
        const glm::dvec3 heading = (*this)[i].tip - (*this)[i].base;
        return glm::degrees(std::atan2(glm::length(glm::cross(heading, {0, -1, 0})), -heading.y));
    }

private:
    struct Turtle {
        glm::dvec3 position{0, 0, 0};
        std::uint16_t order = 0;
        std::uint32_t axis = 0;
        bool on_axis = false;
    };

    std::uint32_t append(LetterId letter) {
        string.append(letter);
        append_lineage(string, mix(string.size()), 0, 0);
        return std::uint32_t(string.size() - 1);
    }
    void draw(std::uint32_t module, const glm::dvec3& step, double radius) {
        if (!std::exchange(turtle_.on_axis, true)) turtle_.axis = geometry.axes++;
        const glm::dvec3 base = turtle_.position;
        turtle_.position += step;
        geometry.internodes.push_back(
            {module, turtle_.axis, turtle_.order, 0, 0, base, turtle_.position, radius, radius});
    }

    Alphabet alphabet_;
    Turtle turtle_;
    std::vector<Turtle> branches_;
};

/// Returns a vector of length 1, so many degrees from straight down.
inline glm::dvec3 from_down(double degrees) {
    return {std::sin(glm::radians(degrees)), -std::cos(glm::radians(degrees)), 0};
}

/// A trunk of three internodes with two branches, which branch again.
inline Tree small_tree() {
    Tree tree;
    tree.grow({0, 1, 0}).open().grow({1, 1, 0}).open().grow({1, 0, 1}).close().grow({1, 0, 0}).bear().close();
    tree.grow({0, 1, 0.1}).open().grow({-1, 0.2, 0}).close().grow({0, 1, 0});
    return tree;
}

inline bool same(const Internode& a, const Internode& b) {
    return a.module == b.module && a.axis == b.axis && a.base == b.base && a.tip == b.tip &&
           a.base_radius == b.base_radius && a.tip_radius == b.tip_radius;
}

inline bool same(const Tree& a, const Tree& b) {
    bool equal = a.size() == b.size() && a.geometry.vertices == b.geometry.vertices;
    for (std::size_t i = 0; equal && i < a.size(); ++i) equal = same(a[i], b[i]);
    for (std::size_t i = 0; equal && i < a.geometry.organs.size(); ++i) {
        equal = a.geometry.organs[i].pose.position == b.geometry.organs[i].pose.position;
    }
    return equal;
}

/// What the stage says of a mistake in its parameters.
inline std::string refusal(const std::string& toml) {
    Settings table = Settings::parse_toml(toml, "stage.toml");
    try {
        read_geometry_stage(table);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

}  // namespace espalier::test

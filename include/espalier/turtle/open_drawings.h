// What a walk has begun to draw and not ended yet: polygons, generalized cylinders, patches, nets.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/turtle/interpretation.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace espalier::turtle {

class Walk;

/// Groups of vertices, one inside the other. Those that are not filled collect their vertices and draw nothing.
class OpenPolygons {
public:
    bool empty() const { return open_.empty(); }
    /// Of the innermost group.
    bool is_filled() const { return !empty() && open_.back().filled; }
    bool is_unfilled() const { return !empty() && !open_.back().filled; }

    void begin(const Walk& walk, bool filled);
    /// Marks a vertex of the innermost group where the turtle is, if there is one.
    void mark(const Walk& walk) {
        if (!empty()) add_vertex(walk, false);
    }
    /// The same where a step ends.
    void end_step(const Walk& walk) {
        if (!empty()) add_vertex(walk, true);
    }
    void end(const Walk& walk);
    void clear();

private:
    struct Open {
        std::size_t first;
        std::uint32_t module;
        bool filled;
        bool after_step;       ///< its last vertex was marked by a step, which may have been none
        std::uint16_t colour;  ///< colour of the first vertex, as the look
        Look look;
    };
    void add_vertex(const Walk& walk, bool by_step);

    std::vector<Open> open_;
    std::vector<glm::dvec3> vertices_;
};

/// Generalized cylinders, by the number that a turtle carries.
class OpenCylinders {
public:
    bool empty() const { return open_.empty(); }
    /// Begins one where the turtle is. `strips`: between control points that do not say.
    void begin(Walk& walk, GeneralizedCylinder::Curve curve, std::optional<double> strips);
    /// A control point of the turtle's cylinder, `strips` from the one before. In a branch the first begins a cylinder
    /// of its own, from the last control point of the axis that bears the branch.
    void mark(Walk& walk, std::optional<double> strips) { record(walk, strips, true); }
    /// The same where a drawn step ends.
    void end_step(Walk& walk) { record(walk, {}, false); }
    void end(Walk& walk, std::optional<double> strips);
    void draw_all(const Walk& walk);
    void clear() { open_.clear(); }

private:
    struct Open {
        GeneralizedCylinder cylinder;
        int strips;
        bool last_is_marked;  ///< by a symbol of its own; the end of an F gives way to one in the same place
    };
    void record(Walk& walk, std::optional<double> strips, bool marked);
    void branch(Walk& walk);
    void draw(const Walk& walk, std::int32_t number);

    std::vector<Open> open_;
};

/// Bicubic patches whose control points are positions of the turtle, by number.
class OpenPatches {
public:
    bool empty() const { return open_.empty(); }
    void begin(const Walk& walk, double id, BicubicPatch::Basis basis);
    void mark(const Walk& walk, double id, double row, double column);
    /// In so many quadrilaterals along each side.
    void draw(const Walk& walk, double id, double rows, double columns) const;
    void clear() { open_.clear(); }

private:
    struct Open {
        BicubicPatch::Basis basis;
        glm::dvec3 origin;
        std::array<std::array<std::optional<glm::dvec3>, 5>, 5> points;  ///< counted from 0 or from 1
    };
    std::map<double, Open> open_;
};

/// Nets of points in rows, between which a surface is drawn; a point belongs to the net begun last.
class OpenNets {
public:
    bool empty() const { return open_.empty(); }
    void begin(const Walk& walk, double columns);
    void mark(const Walk& walk);
    /// Draws the net begun last, and ends it.
    void draw(const Walk& walk);
    void clear() { open_.clear(); }

private:
    struct Open {
        std::size_t columns;
        std::uint32_t module;
        std::uint16_t colour;
        Look look;
        std::vector<glm::dvec3> points;
    };
    std::vector<Open> open_;
};

}  // namespace espalier::turtle

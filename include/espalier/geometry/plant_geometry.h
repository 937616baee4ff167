// What a turtle draws: internodes, polygons, organs and meshes with the module they belong to. Metres, radians.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/shapes.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace espalier::geometry {

/// A place and an orthonormal frame. up = left x heading, as in cpfg: heading (0,1,0), left (-1,0,0), up (0,0,-1).
struct Pose {
    glm::dvec3 position{0, 0, 0};
    glm::dvec3 heading{0, 1, 0};
    glm::dvec3 left{-1, 0, 0};
    glm::dvec3 up{0, 0, -1};
};

/// An axis-aligned box; empty until something is added.
struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    bool empty() const { return lower.x > upper.x; }
    void add(const glm::dvec3& point);
    void add(const Box& box);
};

/// How the two sides of something flat or closed look: the colour index of its back, and a texture (0: none).
struct Look {
    std::uint16_t back_colour = 0;
    std::uint16_t texture = 0;  ///< counted from 1 in Shapes::textures
};

/// One drawn segment. Internodes of one axis follow each other: `axis` counts the axes of the plant.
/// Lines whose width is in pixels, or that have no width, have radius 0.
struct Internode {
    std::uint32_t module;  ///< index of the module in the plant's string
    std::uint32_t axis;
    std::uint16_t order;  ///< depth of branching, 0 = main axis
    std::uint16_t colour;
    float pixels;  ///< the width of lines without radius; 0: none
    glm::dvec3 base, tip;
    double base_radius, tip_radius;
};

/// A filled polygon: `count` vertices from PlantGeometry::vertices[first].
struct Polygon {
    std::uint32_t module;
    std::uint32_t first, count;
    std::uint16_t order;
    std::uint16_t colour;
    Look look = {};
};

/// A thing placed at a pose: a disc, a sphere, a circle's outline, a named surface.
struct Organ {
    enum class Shape : std::uint8_t { disc, sphere, circle, surface };
    std::uint32_t module;
    Shape shape;
    std::uint16_t order;
    std::uint16_t colour;
    std::uint32_t surface;  ///< code point of the surface's id, 0 if none
    Pose pose;
    glm::dvec3 size;  ///< disc, sphere, circle: diameter in x; surface: scale along left, heading, up
    Look look = {};
    std::uint16_t sides = 8;  ///< polygons around a sphere
};

/// A part of PlantGeometry::mesh that one module drew: `count` indices from mesh.triangles[first], three a triangle.
struct MeshPiece {
    enum class Kind : std::uint8_t { cylinder, patch };
    std::uint32_t module;
    std::uint32_t first, count;
    std::uint16_t order;
    std::uint16_t colour;
    Look look;
    Kind kind;
    bool is_open = false;  ///< a cylinder with an open contour: something flat, with two sides
};

/// Triangles in the world's coordinates, their normals outward; pieces of one cylinder share vertices.
struct DrawnMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> triangles;
    std::vector<MeshPiece> pieces;
};

/// A text that the model wrote at a place.
struct Label {
    std::uint32_t module;
    std::uint16_t order;
    std::uint16_t colour;
    glm::dvec3 position;
    std::string text;
};

struct PlantGeometry {
    Column<Internode> internodes;
    std::vector<Polygon> polygons;
    std::vector<glm::dvec3> vertices;
    std::vector<Organ> organs;
    DrawnMesh mesh;  ///< generalized cylinders and patches
    std::vector<Label> labels;
    std::vector<std::uint16_t> textures;   ///< textures of the internodes; shorter where the last ones have none
    std::shared_ptr<const Shapes> shapes;  ///< what surfaces look like; null: unknown
    bool in_pixels = false;                ///< widths of lines are given in pixels
    std::uint32_t axes = 0;
    Box bounds;  ///< bounds of everything drawn, thickness included

    void clear();
    /// Nothing is drawn, not even a label.
    bool is_empty() const;
};

/// Sums over the internodes: lengths, and volumes of the truncated cones they are.
double total_length(const PlantGeometry& geometry);
double total_volume(const PlantGeometry& geometry);

}  // namespace espalier::geometry

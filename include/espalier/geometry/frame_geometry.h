// A frame's plants as plain columns, as drawn in memory or read from a file of the timeline: what is drawn, measured
// and exported of them. Metres.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/index.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/kind.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace espalier::geometry {

/// What is known of the modules behind points or cells: columns of one length.
struct FrameAttributes {
    Column<std::uint64_t> identities, parents;
    Column<std::uint32_t> plants;   ///< number of the plant in the run
    Column<std::uint16_t> symbols;  ///< into `symbol_names`
    Column<std::int32_t> births;
    Column<std::uint16_t> orders, colours;
    Column<Kind> kinds;
    Column<std::array<std::uint8_t, 3>> rgb;  ///< empty where no plant has a colour map
    Column<std::uint64_t>
        organs;  ///< numbers of the modules, from 0 in the order of births; empty in runs without them

    std::size_t size() const { return identities.size(); }

    /// Calls visit(name, column) with the columns that are always there, each by its name in files of the timeline.
    template <class Visit>
    void for_columns(const Visit& visit) {
        visit("identity", identities);
        visit("parent", parents);
        visit("plant", plants);
        visit("symbol", symbols);
        visit("birth", births);
        visit("order", orders);
        visit("colour", colours);
        visit("kind", kinds);
    }
};

/// Cells of one kind: cell i has the points connectivity[offsets[i]] .. connectivity[offsets[i + 1] - 1] and row
/// `first` + i of `of_cells`.
struct FrameCells {
    Column<std::int32_t> offsets{0};
    Column<std::int32_t> connectivity;
    std::size_t first = 0;

    std::size_t size() const { return offsets.size() - 1; }
    std::span<const std::int32_t> operator[](std::size_t i) const {
        return {connectivity.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
    }
};

/// Axes as lines; polygons, organs, cylinders and patches as polygons; queries and labels as vertices.
/// docs/timeline.md explains the columns, which plants/NNNN.vtp holds as arrays. All columns have their full length,
/// all indices are in range.
struct FrameGeometry {
    Column<glm::vec3> points, normals;
    Column<glm::vec2> uvs;
    Column<float> radii;
    Column<float> pixels;  ///< widths of the lines without radius; empty where no view file gives such widths
    FrameCells vertices, lines, polygons;
    FrameAttributes of_points, of_cells;
    Column<std::uint16_t> textures, back_colours;      ///< one a cell; textures index `texture_files`
    std::map<std::string, Column<double>> parameters;  ///< the chosen ones, by point; NaN where a module has none
    std::map<std::string, std::string> units;          ///< units of those that have one
    std::vector<std::string> symbol_names, texture_files;
    std::vector<std::string> label_texts;  ///< texts of the vertices of Kind::label, in their order
};

struct FrameInternode;
using PointIndex = Index<struct FramePoint>;   ///< a row of FrameGeometry::points and of what else is told by point
using LineIndex = Index<struct FrameLine>;     ///< one of FrameGeometry::lines
using InternodeIndex = Index<FrameInternode>;  ///< one of what `internodes_of` returns

/// An internode of a frame: the piece of an axis between two neighbouring points.
struct FrameInternode {
    glm::vec3 base, tip;
    float base_radius, tip_radius;
    std::uint64_t identity, parent;  ///< identities of its module and of that module's parent
    std::uint32_t plant;
    std::uint16_t symbol, order, colour;
    std::int32_t birth;
    LineIndex axis;         ///< the line it belongs to
    InternodeIndex bearer;  ///< the internode it stands on, always an earlier one of its plant; none: the plant's first
    PointIndex base_point;
    PointIndex tip_point;  ///< whose row holds its parameters
};

/// The internodes of all axes, axis after axis, each from its base on; outlines of organs are none.
/// An axis stands on the internode that ends where it begins, of those the last of lower order; failing that, on one
/// that begins there.
std::vector<FrameInternode> internodes_of(const FrameGeometry& geometry);

}  // namespace espalier::geometry

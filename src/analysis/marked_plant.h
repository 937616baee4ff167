// A plant as the user marked it on a picture: axes in a plane, to be compared with those of a model.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/geometry/plant_geometry.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::analysis {

/// An axis from its base to its tip: a node at every branching and every leaf.
struct MarkedAxis {
    std::vector<glm::dvec2> nodes;  ///< y upwards
    std::optional<std::size_t> parent;
    std::size_t parent_node = 0;  ///< where it begins, on its parent
    int order = 0;
};

struct MarkedPlant {
    std::vector<MarkedAxis> axes;  ///< the first is the main axis
    bool has_scale = false;        ///< lengths are metres; without it only their ratios count
};

/// Reads an SVG (polylines, lines and straight paths; an element with `data-length` gives the metres of its own length)
/// or a CSV with the columns axis, x and y in metres. The first axis is the main one. Throws UserError.
MarkedPlant read_marked_plant(const std::filesystem::path& file);

/// The axes of a model as they are seen from the front, along -z.
MarkedPlant seen_from_the_front(const PlantGeometry& geometry);

/// Every axis but the first begins at the node nearest to its base, on an axis that has been joined already; that
/// which is nearest comes first.
void join_axes(std::vector<MarkedAxis>& axes);

/// What is compared of two plants: by order and place along the axis, in means over the axes of an order.
struct AxisMeasures {
    using Cell = std::pair<int, std::size_t>;
    std::map<Cell, double> lengths;  ///< lengths of internodes; in lengths of the main axis if there is no scale
    std::map<Cell, double> angles;   ///< angles of branches that begin there, degrees
};
AxisMeasures measures_of(const MarkedPlant& plant, bool in_metres);

/// Both plants as lines, the marks red and the model blue, scaled onto each other; an SVG.
std::string overlay_of(const MarkedPlant& marks, const MarkedPlant& model);

}  // namespace espalier::analysis

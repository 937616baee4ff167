// The leaves of a frame: what modules show as surfaces.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace espalier::analysis {

/// What one module shows: a polygon, a disc, a surface of many facets, or several of them.
struct Leaf {
    glm::dvec3 position;  ///< mean of its corners, m
    double area;          ///< area of its facets, one side, m2: where they wear a picture, what that leaves opaque
};

struct Leaves {
    std::vector<Leaf> leaves;
    std::vector<glm::dvec3> corners;
};

/// The leaves of each of `plants`, in their order: polygons, organs and patches of the modules with these symbols, of
/// all modules if none is named. `run` is the folder whence their textures are found.
std::vector<Leaves> leaves_of(const FrameGeometry& geometry, std::span<const std::uint32_t> plants,
                              const std::set<std::string>& symbols = {}, const std::filesystem::path& run = {});

double total_area(const Leaves& leaves);

}  // namespace espalier::analysis

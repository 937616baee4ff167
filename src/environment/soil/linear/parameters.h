// What a scene says about water that diffuses, read and checked.
#pragma once

#include "environment/soil/grid/parameters.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

enum class WaterMode { diffusion, relaxation };

/// What contents and rates may be: every sum stays finite.
inline const Range content_range = Range::between(0, 1e30);

/// A side of the domain: closed, or held at a content on its face.
struct WaterSide {
    bool fixed = false;
    double content = 0;
};

struct WaterLayer {
    LayerHeights heights;
    glm::dvec3 diffusion{0};  ///< m2 per time unit, along x, y, z
    glm::dvec3 gravity{0, -1, 0};
    std::optional<double> initial;
};

/// A part of the soil that begins with another content; outside the shape it fades over `edge` metres.
struct WaterRegion {
    std::shared_ptr<const Shape> shape;
    double content = 0;
    double edge = 0;
};

/// A part of the soil that is held at a content, or gains `rate` per time unit.
struct WaterSource {
    std::shared_ptr<const Shape> shape;
    std::optional<double> hold;
    double rate = 0;
    Place place;
};

struct WaterParameters {
    SoilSpace space;
    SoilQuerying querying;
    WaterMode mode = WaterMode::diffusion;
    std::string unit;
    double initial = 0;
    double porosity = std::numeric_limits<double>::infinity();  ///< content of a voxel that is full
    bool steady = false;                                        ///< begin at the steady state of diffusion
    glm::dvec3 diffusion{0};
    int max_substeps = 0;
    int sweeps = 0;
    double relaxation = 0;
    double tolerance = 0;
    std::array<WaterSide, 6> sides;  ///< -x, +x, -y, +y, -z, +z
    std::vector<WaterLayer> layers;
    std::vector<WaterRegion> regions;
    std::vector<WaterSource> sources;

    /// The layer at height y, or null.
    const WaterLayer* layer_at(double y) const;
};

/// Throws UserError.
WaterParameters read_water_parameters(Settings& settings, const EnvironmentContext& context);

/// What `espalier list` prints for process soil-water.
extern const char* const soil_water_help;

}  // namespace espalier::environment

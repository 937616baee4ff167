// A geometry stage changes what is drawn of a plant, not its string. One file in src/turtle/stages/ per stage.
#pragma once

#include "espalier/base/random.h"
#include "espalier/base/registry.h"
#include "espalier/base/settings.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/module_string.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace espalier::turtle {

/// A plant on its way from the turtle to the light that falls on it and to the recorders. Queries are the turtle's own.
struct StagedPlant {
    PlantGeometry& geometry;     ///< a copy, to be changed
    const ModuleString& string;  ///< the string that was interpreted: internodes name its modules
    RandomKey key;  ///< key of the plant; take samples by Identity, so that an organ keeps them as others come
    glm::dvec3 heading{0, 1, 0};  ///< heading of the turtle at the beginning
    double time = 0;              ///< time of the frame, in the scene's unit
};

/// Constructors take (Settings&) and read their parameters; the scene rejects unread ones. Thread safe.
class GeometryStage {
public:
    virtual ~GeometryStage() = default;
    virtual void apply(StagedPlant& plant) const = 0;
};

/// What a file of src/turtle/stages/ registers.
struct GeometryStageType {
    std::string name;     ///< what scenes say: [[plant.stage]] stage = "..."
    std::string summary;  ///< a line
    std::string help;     ///< parameters with units, ranges and defaults; the published source
    std::function<std::unique_ptr<GeometryStage>(Settings&)> make;
};

using GeometryStages = std::vector<std::shared_ptr<const GeometryStage>>;

/// The stage that the table's key `stage` names. Throws UserError for an unknown stage or parameter.
std::shared_ptr<const GeometryStage> read_geometry_stage(Settings& table);

/// One after the other, each on what the one before left.
void apply(const GeometryStages& stages, StagedPlant& plant);

}  // namespace espalier::turtle

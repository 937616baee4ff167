// The content of a brick as an OpenVDB grid that others may read.
#pragma once

#include "espalier/environment/field.h"

#include "environment/water_grid.h"

#include <memory>

namespace espalier {

class WaterField {
public:
    WaterField(std::string name, std::string unit, const WaterGrid& grid);

    /// The voxels that are free from now on; the others are inactive and 0.
    void set_faces(const WaterFaces& faces);
    /// Provides the contents as a new grid; readers of the last one keep it.
    void publish(const WaterBrick& contents, Fields& fields);
    /// Writes the contents into the grid provided last.
    void rewrite(const WaterBrick& contents);

private:
    std::string name_, unit_;
    WaterGrid grid_;
    std::shared_ptr<FieldGrid> topology_;  ///< active voxels without values
    std::shared_ptr<FieldGrid> published_;
};

}  // namespace espalier

// The content of a brick as an OpenVDB grid that others may read.
#pragma once

#include "espalier/geometry/field.h"

#include "environment/soil/grid/grid.h"

#include <functional>
#include <memory>

namespace espalier::environment {

class WaterField {
public:
    WaterField(std::string name, std::string unit, const WaterGrid& grid, std::string meaning = "content of the soil");

    /// The voxels that are free from now on; the others are inactive and 0.
    void set_faces(const WaterFaces& faces);
    /// Provides the contents as a grid, made or written over when it is asked for. A kept pointer keeps its
    /// values.
    void provide(std::function<const WaterBrick&()> contents, Fields& fields, FieldSource* source = nullptr);
    /// The contents are others now.
    void change() { stale_ = true; }

private:
    std::shared_ptr<const FieldGrid> current();

    std::string name_, unit_, meaning_;
    WaterGrid grid_;
    std::shared_ptr<FieldGrid> topology_;  ///< active voxels without values
    std::shared_ptr<FieldGrid> published_;
    std::function<const WaterBrick&()> contents_;
    bool stale_ = true;
};

}  // namespace espalier::environment

// Recorded fields as VTK props: clouds, coloured planes, surfaces of one value.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/picture/picture_style.h"

#include "picture/stage/colouring.h"

#include <vtkProp3D.h>
#include <vtkSmartPointer.h>

namespace espalier::picture {

/// Throws UserError if the run has no such field, or the plane does not meet it. `run` says where fields come from.
void check_field(const RecordedRun& run, const FieldLook& look);

struct FieldProp {
    vtkSmartPointer<vtkProp3D> prop;
    ColourKey key;
};

/// `range`: the values at the ends of the colours. `middle`: of the plants, where slices lie that have no place.
/// A field of one layer is its slice, whatever the look; its surface is a line.
FieldProp field_prop(const RecordedField& field, const FieldLook& look, const std::array<double, 2>& range,
                     const glm::dvec3& middle, std::span<const Rgb> colours);

}  // namespace espalier::picture

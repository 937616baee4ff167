// A picture on a plane, seen as it is: unlit, and through where it is clear.
#pragma once

#include <glm/vec3.hpp>
#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkSmartPointer.h>

namespace espalier::picture {

/// `corner`: of the image's first texel; `right` and `up`: the corners where its first row and its first column end.
vtkSmartPointer<vtkActor> textured_plane(const glm::dvec3& corner, const glm::dvec3& right, const glm::dvec3& up,
                                         vtkImageData& image);

}  // namespace espalier::picture

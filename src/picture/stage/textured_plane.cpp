#include "picture/stage/textured_plane.h"

#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

namespace espalier::picture {

vtkSmartPointer<vtkActor> textured_plane(const glm::dvec3& corner, const glm::dvec3& right, const glm::dvec3& up,
                                         vtkImageData& image) {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(corner.x, corner.y, corner.z);
    plane->SetPoint1(right.x, right.y, right.z);
    plane->SetPoint2(up.x, up.y, up.z);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkTexture> texture;
    texture->SetInputData(&image);
    texture->SetColorModeToDirectScalars();
    texture->InterpolateOn();
    texture->RepeatOff();
    texture->EdgeClampOn();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->SetTexture(texture);
    actor->GetProperty()->LightingOff();
    actor->ForceTranslucentOn();
    return actor;
}

}  // namespace espalier::picture

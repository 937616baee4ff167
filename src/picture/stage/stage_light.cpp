#include "picture/stage/stage_light.h"

#include "picture/stage/ground.h"

#include <tbb/parallel_for.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace espalier::picture {
namespace {

void add_light(vtkRenderer& renderer, const glm::vec3& from, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->PositionalOff();
    light->SetFocalPoint(0, 0, 0);
    light->SetPosition(from.x, from.y, from.z);
    light->SetIntensity(intensity);
    renderer.AddLight(light);
}

vtkSmartPointer<vtkUnsignedCharArray> shaded_colours(const StageMesh& mesh, const MeshDress& dress) {
    const auto points = points_of(mesh), normals = normals_of(mesh);
    auto rgb = vtkSmartPointer<vtkUnsignedCharArray>::New();
    rgb->SetNumberOfComponents(3);
    rgb->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
    unsigned char* const to = rgb->GetPointer(0);
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        float light = 1;
        if (const SkyVisibility* visibility = dress.visibility) {
            light = brightness(visibility->sky(points[i], normals[i], !mesh.is_of_axes), visibility->sun(points[i], 1));
            light = 1 - dress.shade * (1 - light);
        }
        const Rgb& colour = dress.colours[mesh.row_of_point[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            to[3 * i + k] = static_cast<unsigned char>(std::lround(light * static_cast<float>(colour[k])));
        }
    });
    return rgb;
}

// VTK turns normals towards the eye, but then lights the side that is seen alone: leaves and petals against the light
// would be dark. Light goes through them, and both sides get the same.
void light_both_sides(vtkActor& actor) {
    actor.GetShaderProperty()->AddFragmentShaderReplacement(
        "max(0.0, dot(normalVCVSOutput, -lightDirectionVC", /*replaceFirst=*/false,
        "abs(dot(normalVCVSOutput, -lightDirectionVC", /*replaceAll=*/true);
}

}  // namespace

void set_lights(vtkRenderer& renderer, const glm::vec3& sun) {
    renderer.RemoveAllLights();
    renderer.AutomaticLightCreationOff();
    add_light(renderer, sun, 0.8);
    add_light(renderer, glm::vec3(0, 1, 0), 0.25);
    vtkNew<vtkLight> fill_in;
    fill_in->SetLightTypeToHeadlight();
    fill_in->SetIntensity(0.5);
    renderer.AddLight(fill_in);
}

void dress_actor(vtkActor& actor, const StageMesh& mesh, const MeshDress& dress) {
    mesh.data->GetPointData()->SetScalars(shaded_colours(mesh, dress));
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh.data);
    actor.SetMapper(mapper);
    vtkProperty& property = *actor.GetProperty();
    // Some of the light goes through what is thin.
    property.SetAmbient(mesh.is_of_axes ? 0.12 : 0.56);
    property.SetDiffuse(mesh.is_of_axes ? 0.9 : 0.5);
    property.SetSpecular(mesh.is_of_axes ? 0.03 : 0.1);
    property.SetSpecularPower(15);
    property.SetLighting(dress.lit);
    if (mesh.is_thin) light_both_sides(actor);
}

}  // namespace espalier::picture

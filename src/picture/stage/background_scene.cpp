#include "picture/stage/background_scene.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

vtkSmartPointer<vtkUnsignedCharArray> colours_of(const RecordedBackground& background) {
    auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colours->SetNumberOfComponents(4);
    for (std::size_t i = 0; i < background.rgb.size(); ++i) {
        const auto& [red, green, blue] = background.rgb[i];
        const auto alpha =
            static_cast<unsigned char>(std::lround(255 * std::clamp(background.opacities[i], 0.0F, 1.0F)));
        const std::array<unsigned char, 4> colour{red, green, blue, alpha};
        colours->InsertNextTypedTuple(colour.data());
    }
    return colours;
}

vtkSmartPointer<vtkPolyData> mesh_of(const RecordedBackground& background) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> normals;
    vtkNew<vtkCellArray> triangles;
    normals->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < background.points.size(); ++i) {
        points->InsertNextPoint(&background.points[i].x);
        normals->InsertNextTypedTuple(&background.normals[i].x);
    }
    for (std::size_t i = 0; i < background.triangles.size(); ++i) {
        const auto corners = background.triangles[i];
        triangles->InsertNextCell({corners[0], corners[1], corners[2]});
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(points);
    mesh->SetPolys(triangles);
    mesh->GetPointData()->SetNormals(normals);
    mesh->GetCellData()->SetScalars(colours_of(background));
    return mesh;
}

}  // namespace

vtkSmartPointer<vtkActor> background_actor(const RecordedRun& run) {
    const auto background = run.background();
    if (!background) return nullptr;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh_of(*background));
    mapper->SetScalarModeToUseCellData();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->PickableOff();
    actor->GetProperty()->SetAmbient(0.4);
    actor->GetProperty()->SetDiffuse(0.6);
    const bool is_seen_through =
        std::any_of(background->opacities.begin(), background->opacities.end(), [](float one) { return one < 1; });
    is_seen_through ? actor->ForceTranslucentOn() : actor->ForceOpaqueOn();
    return actor;
}

}  // namespace espalier::picture

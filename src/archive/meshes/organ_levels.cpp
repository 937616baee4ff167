#include "archive/meshes/organ_levels.h"

#include <glm/geometric.hpp>
#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace espalier::archive {
namespace {

constexpr std::size_t triangles_of_cards = 4;

bool is_of_one_material(const FrameMesh& mesh, const MeshPart& organ) {
    const auto first = mesh.material_of.begin() + static_cast<std::ptrdiff_t>(organ.first_triangle);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(organ.triangles),
                       [&](std::uint32_t material) { return material == *first; });
}

std::array<std::uint32_t, 3> local(const std::array<std::uint32_t, 3>& corners, const MeshPart& organ) {
    const auto first = static_cast<std::uint32_t>(organ.first_vertex);
    return {corners[0] - first, corners[1] - first, corners[2] - first};
}

/// The organ alone, as large as 1, whose points know their numbers.
vtkSmartPointer<vtkPolyData> shape_of(const FrameMesh& mesh, const MeshPart& organ, double size) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName("vertex");
    for (std::size_t i = 0; i < organ.vertices; ++i) {
        const glm::dvec3 place =
            glm::dvec3(mesh.points[organ.first_vertex + i] - mesh.points[organ.first_vertex]) / size;
        points->InsertNextPoint(place.x, place.y, place.z);
        numbers->InsertNextValue(static_cast<vtkIdType>(i));
    }
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < organ.triangles; ++i) {
        const auto corners = local(mesh.triangles[organ.first_triangle + i], organ);
        const vtkIdType ids[] = {corners[0], corners[1], corners[2]};
        cells->InsertNextCell(3, ids);
    }
    auto shape = vtkSmartPointer<vtkPolyData>::New();
    shape->SetPoints(points);
    shape->SetPolys(cells);
    shape->GetPointData()->AddArray(numbers);
    return shape;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(vtkPolyData& shape) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    auto* numbers = vtkIdTypeArray::SafeDownCast(shape.GetPointData()->GetArray("vertex"));
    for (vtkIdType i = 0; numbers && i < shape.GetNumberOfPolys(); ++i) {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        shape.GetPolys()->GetCellAtId(i, count, ids);
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<std::uint32_t>(numbers->GetValue(ids[k]));
        triangles.push_back(corners);
    }
    return triangles;
}

// Its vertices are those of the organ, so that normals, texture coordinates and colours stay as they are.
std::vector<OrganLevel> levels_of(vtkPolyData& shape) {
    std::vector<OrganLevel> levels;
    auto fewest = static_cast<std::size_t>(shape.GetNumberOfPolys());
    for (const double error : {0.002, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32}) {
        vtkNew<vtkDecimatePro> decimation;
        decimation->SetInputData(&shape);
        decimation->SetTargetReduction(1);
        decimation->SetErrorIsAbsolute(1);
        decimation->SetAbsoluteError(error);
        decimation->AccumulateErrorOn();
        decimation->SetFeatureAngle(180);  // no vertex stays for its angle; the error alone decides
        decimation->SplittingOff();
        decimation->PreserveTopologyOn();
        decimation->Update();
        std::vector<std::array<std::uint32_t, 3>> triangles = triangles_of(*decimation->GetOutput());
        if (triangles.empty() || triangles.size() >= fewest) continue;
        fewest = triangles.size();
        levels.push_back({error, std::move(triangles)});
    }
    return levels;
}

}  // namespace

double organ_size(const FrameMesh& mesh, const MeshPart& organ) {
    float most = 0;
    for (std::size_t i = 1; i < organ.vertices; ++i) {
        most = std::max(most, glm::distance(mesh.points[organ.first_vertex], mesh.points[organ.first_vertex + i]));
    }
    return most;
}

// Alike is what has the same triangles and, to a thousandth, the same distances from the first and the last vertex.
const std::vector<OrganLevel>& OrganLevels::of(const FrameMesh& mesh, const MeshPart& organ) {
    static const std::vector<OrganLevel> none;
    const double size = organ_size(mesh, organ);
    if (organ.triangles <= triangles_of_cards || size <= 0 || !is_of_one_material(mesh, organ)) return none;
    Key key;
    for (std::size_t i = 0; i < organ.triangles; ++i) {
        for (const std::uint32_t corner : local(mesh.triangles[organ.first_triangle + i], organ)) key.push_back(corner);
    }
    const glm::vec3 &first = mesh.points[organ.first_vertex],
                    &last = mesh.points[organ.first_vertex + organ.vertices - 1];
    for (std::size_t i = 0; i < organ.vertices; ++i) {
        const glm::vec3& here = mesh.points[organ.first_vertex + i];
        key.push_back(static_cast<std::uint32_t>(1000 * glm::distance(first, here) / size + 0.5));
        key.push_back(static_cast<std::uint32_t>(1000 * glm::distance(last, here) / size + 0.5));
    }
    const auto [at, is_new] = levels_.emplace(std::move(key), std::vector<OrganLevel>());
    if (is_new) at->second = levels_of(*shape_of(mesh, organ, size));
    return at->second;
}

}  // namespace espalier::archive

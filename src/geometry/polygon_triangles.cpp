#include "espalier/geometry/polygon_triangles.h"

#include <glm/geometric.hpp>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>

namespace espalier {
namespace {

/// Cutting takes the square of the corners.
constexpr std::size_t most_corners = 4096;

/// True if every corner turns the same way about the normal.
bool convex(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 in = corners[(i + 1) % n] - corners[i], out = corners[(i + 2) % n] - corners[(i + 1) % n];
        const double turn = glm::dot(glm::cross(in, out), normal);
        if (turn < -1e-12 * (glm::dot(in, in) + glm::dot(out, out))) return false;
    }
    return true;
}

}  // namespace

std::vector<std::uint32_t> triangles_of(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    if (corners.size() <= 3 || corners.size() > most_corners || convex(corners, normal)) return {};
    vtkNew<vtkPolygon> polygon;
    polygon->GetPointIds()->SetNumberOfIds(vtkIdType(corners.size()));
    polygon->GetPoints()->SetDataTypeToDouble();
    polygon->GetPoints()->SetNumberOfPoints(vtkIdType(corners.size()));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        polygon->GetPointIds()->SetId(vtkIdType(i), vtkIdType(i));
        polygon->GetPoints()->SetPoint(vtkIdType(i), corners[i].x, corners[i].y, corners[i].z);
    }
    vtkNew<vtkIdList> triangles;
    if (!polygon->Triangulate(triangles)) return {};
    return {triangles->begin(), triangles->end()};
}

}  // namespace espalier

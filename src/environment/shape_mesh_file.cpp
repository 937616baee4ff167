#include "shape_mesh_file.h"

#include "espalier/base/file.h"
#include "espalier/base/picture_bytes.h"

#include "shape_mesh_formats.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unistd.h>

namespace espalier {
namespace {

/// VTK reports faults to a window and goes on. While this lives it reports here, and nothing is printed.
class VtkReports {
public:
    VtkReports() : before_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
        vtkOutputWindow::SetInstance(listener_);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~VtkReports() {
        vtkLogger::SetStderrVerbosity(verbosity_);
        vtkOutputWindow::SetInstance(before_);
    }
    VtkReports(const VtkReports&) = delete;
    VtkReports& operator=(const VtkReports&) = delete;

    bool any() const { return listener_->heard; }

private:
    class Listener : public vtkOutputWindow {
    public:
        static Listener* New() { return new Listener; }
        void DisplayText(const char*) override { heard = true; }
        void DisplayErrorText(const char*) override { heard = true; }
        void DisplayWarningText(const char*) override { heard = true; }
        void DisplayGenericWarningText(const char*) override { heard = true; }
        bool heard = false;
    };

    vtkSmartPointer<vtkOutputWindow> before_;
    vtkNew<Listener> listener_;
    vtkLogger::Verbosity verbosity_;
};

std::string lower_case_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void require_file(const std::filesystem::path& file, const Place& place) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        throw UserError(place, fmt::format("there is no file {}", file.string()));
    }
    if (!std::filesystem::is_regular_file(file, error) || access(file.c_str(), R_OK) != 0) {
        throw UserError(place, fmt::format("{} cannot be read", file.string()));
    }
}

PolygonMesh read_polygons(const std::filesystem::path& file, const Place& place) {
    const std::string extension = lower_case_extension(file);
    const auto parse = extension == ".ply"   ? parse_ply
                       : extension == ".stl" ? parse_stl
                       : extension == ".obj" ? parse_obj
                                             : nullptr;
    if (!parse) {
        throw UserError(place, fmt::format("{} is no mesh that can be read: its name must end in .obj, .stl or .ply",
                                           file.string()));
    }
    try {
        return parse(read_text(file));
    } catch (const MeshFormatError& error) {
        throw UserError(place,
                        fmt::format("{} is not a whole {} mesh: {}", file.string(), extension.substr(1), error.what()));
    }
}

/// A file may number points that it does not have, and have points that are nowhere.
void require_sound(const PolygonMesh& mesh, const std::filesystem::path& file, const Place& place) {
    if (mesh.points.empty() || mesh.ends.empty()) {
        throw UserError(place, fmt::format("{} is empty: it has {} points and {} polygons", file.string(),
                                           mesh.points.size(), mesh.ends.size()));
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const glm::dvec3& point = mesh.points[i];
        const auto countable = [](double coordinate) { return std::abs(coordinate) < 1e30; };  // not so NaN
        if (!countable(point.x) || !countable(point.y) || !countable(point.z)) {
            throw UserError(place, fmt::format("point {} of {} is not finite", i + 1, file.string()));
        }
    }
    const auto points = static_cast<std::int64_t>(mesh.points.size());
    for (std::int64_t corner : mesh.corners) {
        if (corner < 0 || corner >= points) {
            throw UserError(place, fmt::format("a polygon of {} has a corner at point {}, but there are {} points",
                                               file.string(), corner + 1, points));
        }
    }
}

vtkSmartPointer<vtkPolyData> to_vtk(const PolygonMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const glm::dvec3& point : mesh.points) points->InsertNextPoint(point.x, point.y, point.z);
    vtkNew<vtkCellArray> polygons;
    std::vector<vtkIdType> corners;
    std::size_t begin = 0;
    for (std::size_t end : mesh.ends) {
        corners.assign(mesh.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                       mesh.corners.begin() + static_cast<std::ptrdiff_t>(end));
        if (corners.size() >= 3) polygons->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
        begin = end;
    }
    vtkSmartPointer<vtkPolyData> surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(points);
    surface->SetPolys(polygons);
    return surface;
}

/// Triangles between points that are merged where they coincide: STL and OBJ repeat them.
TriangleMesh triangulated(vtkPolyData& surface) {
    const VtkReports reports;  // of degenerate polygons, which simply vanish
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputData(&surface);
    triangles->PassVertsOff();
    triangles->PassLinesOff();
    vtkNew<vtkCleanPolyData> merged;
    merged->SetInputConnection(triangles->GetOutputPort());
    merged->SetTolerance(0);
    merged->ConvertPolysToLinesOff();
    merged->ConvertLinesToPointsOff();
    merged->Update();
    vtkPolyData* result = merged->GetOutput();
    TriangleMesh mesh;
    for (vtkIdType i = 0; i < result->GetNumberOfPoints(); ++i) {
        const double* point = result->GetPoint(i);
        mesh.points.push_back({point[0], point[1], point[2]});
    }
    const vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < result->GetNumberOfPolys(); ++i) {
        result->GetPolys()->GetCellAtId(i, corners);
        if (corners->GetNumberOfIds() != 3) continue;
        const auto corner = [&](int k) { return static_cast<std::uint32_t>(corners->GetId(k)); };
        if (corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0)) continue;
        mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    }
    return mesh;
}

/// Edges that an odd number of triangles share: past them one can walk from outside to inside.
std::size_t open_edges(const TriangleMesh& mesh) {
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& corners : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
            edges.push_back(std::uint64_t{low} << 32 | high);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto next = std::upper_bound(edge, edges.end(), *edge);
        open += (next - edge) % 2;
        edge = next;
    }
    return open;
}

/// Flat meshes are closed and hold nothing. Relative to the extent, because metres or millimetres are the user's.
bool has_volume(const TriangleMesh& mesh) {
    const Box box = mesh.bounds();
    const glm::dvec3 extent = box.upper - box.lower;
    double six_volumes = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        six_volumes +=
            glm::dot(mesh.points[a] - box.lower, glm::cross(mesh.points[b] - box.lower, mesh.points[c] - box.lower));
    }
    const double longest = std::max({extent.x, extent.y, extent.z});
    return std::abs(six_volumes) > 1e-9 * longest * longest * longest;
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& file, const Place& place) {
    require_file(file, place);
    const PolygonMesh polygons = read_polygons(file, place);
    require_sound(polygons, file, place);
    TriangleMesh mesh = triangulated(*to_vtk(polygons));
    if (mesh.triangles.empty()) throw UserError(place, fmt::format("{} has no triangle with an area", file.string()));
    if (const std::size_t open = open_edges(mesh)) {
        throw UserError(place, fmt::format("{} is not closed: {} of its edges {} open, so it has no inside",
                                           file.string(), open, open == 1 ? "is" : "are"));
    }
    if (!has_volume(mesh)) throw UserError(place, fmt::format("{} is flat: it encloses no volume", file.string()));
    return mesh;
}

namespace {

// Not by VTK's reader, which libpng's complaints crash.
HeightImage read_height_png(const PictureBytes& bytes) {
    const PngPicture picture = read_png(bytes);
    HeightImage image{picture.width, {}};
    for (std::size_t y = 0; y < picture.height; ++y) {
        for (std::size_t x = 0; x < picture.width; ++x) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += picture.at(x, y, k);
            image.brightness.push_back(sum / (3.0 * picture.greatest));
        }
    }
    return image;
}

}  // namespace

HeightImage read_height_image(const std::filesystem::path& file, const Place& place) {
    require_file(file, place);
    const PictureBytes bytes(file);
    if (file.extension() == ".png" || bytes.begins_with("\x89PNG")) return read_height_png(bytes);
    const VtkReports silence;  // of readers that are asked in turn whether they know this file
    const vtkSmartPointer<vtkImageReader2> reader =
        vtkSmartPointer<vtkImageReader2>::Take(vtkImageReader2Factory::CreateImageReader2(file.c_str()));
    if (!reader) throw UserError(place, fmt::format("{} is no image that can be read", file.string()));
    const VtkReports reports;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkDataArray* values = reader->GetOutput()->GetPointData()->GetScalars();
    if (reports.any() || !values || values->GetNumberOfTuples() == 0) {
        throw UserError(place, fmt::format("{} is not a whole image", file.string()));
    }
    int size[3];
    reader->GetOutput()->GetDimensions(size);
    const bool real = values->GetDataType() == VTK_FLOAT || values->GetDataType() == VTK_DOUBLE;
    const double white = real ? 1 : values->GetDataTypeMax();
    const int colours = std::min(values->GetNumberOfComponents(), 3);
    HeightImage image{static_cast<std::size_t>(size[0]), {}};
    for (int row = size[1] - 1; row >= 0; --row) {  // VTK's first row is the picture's last
        for (int column = 0; column < size[0]; ++column) {
            double sum = 0;
            for (int k = 0; k < colours; ++k) sum += values->GetComponent(vtkIdType{row} * size[0] + column, k);
            image.brightness.push_back(sum / (colours * white));
        }
    }
    return image;
}

}  // namespace espalier

// ParaView 5.11 of Debian 12, with the system's expat as updated since, cannot read appended data: it opened no frame.
#include "timeline/vtk_file.h"

#include "espalier/base/file.h"

#include "catch.h"
#include "temporary_folder.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

using namespace espalier;

TEST_CASE("files for viewers keep their data inline, which every reader understands", "[timeline]") {
    const TemporaryFolder folder;
    vtkNew<vtkPoints> points;
    for (int i = 0; i < 10000; ++i) points->InsertNextPoint(i, 0.5 * i, 0);
    vtkNew<vtkPolyData> plants;
    plants->SetPoints(points);
    vtkNew<vtkImageData> field;
    field->SetDimensions(30, 30, 30);
    field->AllocateScalars(VTK_FLOAT, 1);
    std::fill_n(static_cast<float*>(field->GetScalarPointer()), 30 * 30 * 30, 0.5f);
    write_vtk(folder.path() / "plants.vtp", *plants);
    write_vtk(folder.path() / "field.vti", *field);
    for (const char* name : {"plants.vtp", "field.vti"}) {
        const std::string text = read_text(folder.path() / name);
        CHECK(text.find("<AppendedData") == std::string::npos);
        CHECK(text.find("format=\"binary\"") != std::string::npos);
    }
}

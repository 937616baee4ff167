#include "archive/meshes/texture_file.h"

#include "espalier/base/error.h"

#include "base/picture_file.h"

#include <vtkBMPReader.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNMReader.h>
#include <vtkTIFFReader.h>

#include <algorithm>

namespace espalier::archive {
namespace {

namespace fs = std::filesystem;

// VTK reads no SGI pictures and few Targas.
bool is_ours(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.ends_with("rgb") || name.ends_with("tga");
}

vtkSmartPointer<vtkImageData> read_ours(const fs::path& path) {
    try {
        const Picture picture = read_picture(path);
        if (picture.empty()) return nullptr;
        auto image = vtkSmartPointer<vtkImageData>::New();
        image->SetDimensions(static_cast<int>(picture.width), static_cast<int>(picture.height), 1);
        image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
        auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
        for (const Picture::Colour& colour : picture.pixels) bytes = std::copy(colour.begin(), colour.end(), bytes);
        return image;
    } catch (const UserError&) {
        return nullptr;
    }
}

template <class Reader>
vtkSmartPointer<vtkImageData> read_by(const fs::path& path) {
    vtkNew<Reader> reader;
    if (!reader->CanReadFile(path.c_str())) return nullptr;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != 0 || reader->GetOutput()->GetNumberOfPoints() == 0) return nullptr;
    return reader->GetOutput();
}

// Not by vtkImageReader2Factory, whose reader of Targas takes anything for its own, loudly.
vtkSmartPointer<vtkImageData> read_by_vtk(const fs::path& path) {
    for (const auto read : {read_by<vtkPNGReader>, read_by<vtkJPEGReader>, read_by<vtkTIFFReader>,
                            read_by<vtkBMPReader>, read_by<vtkPNMReader>}) {
        if (const auto image = read(path)) return image;
    }
    return nullptr;
}

}  // namespace

vtkSmartPointer<vtkImageData> texture_image(const fs::path& run, const std::string& file) {
    std::error_code ignored;
    for (const fs::path& path : {fs::path(file), run / file}) {
        if (!fs::is_regular_file(path, ignored)) continue;
        if (const auto image = is_ours(path) ? read_ours(path) : read_by_vtk(path)) return image;
    }
    return nullptr;
}

}  // namespace espalier::archive

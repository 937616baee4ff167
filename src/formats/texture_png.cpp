// Pictures of textures by VTK, which reads and writes them.
#include "archive/meshes/texture_file.h"
#include "formats/textures.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

namespace espalier::formats {
namespace {

vtkSmartPointer<vtkImageData> image_of(const std::filesystem::path& run, const std::string& file, TextureMap map) {
    if (map == TextureMap::colours) return texture_image(run, file);
    const ReliefImages relief = relief_images(run, file);
    return map == TextureMap::normals ? relief.normals : relief.heights;
}

}  // namespace

std::string png_of(const std::filesystem::path& run, const std::string& file, TextureMap map) {
    const auto image = image_of(run, file, map);
    const int type = image ? image->GetScalarType() : VTK_VOID;
    if (type != VTK_UNSIGNED_CHAR && type != VTK_UNSIGNED_SHORT) return "";
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    if (writer->GetErrorCode() != 0 || !bytes) return "";
    return {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

}  // namespace espalier::formats

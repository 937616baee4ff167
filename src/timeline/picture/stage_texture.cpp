#include "timeline/picture/stage_texture.h"

#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>

namespace espalier {

vtkSmartPointer<vtkTexture> texture_of(const std::filesystem::path& run, const std::string& file) {
    std::error_code ignored;
    for (const std::filesystem::path& path : {std::filesystem::path(file), run / file}) {
        if (!std::filesystem::is_regular_file(path, ignored)) continue;
        const auto reader =
            vtkSmartPointer<vtkImageReader2>::Take(vtkImageReader2Factory::CreateImageReader2(path.c_str()));
        if (!reader) continue;
        reader->SetFileName(path.c_str());
        reader->Update();
        if (reader->GetErrorCode() != 0 || reader->GetOutput()->GetNumberOfPoints() == 0) continue;
        auto texture = vtkSmartPointer<vtkTexture>::New();
        texture->SetInputData(reader->GetOutput());
        texture->InterpolateOn();
        texture->MipmapOn();
        texture->RepeatOn();
        return texture;
    }
    return nullptr;
}

}  // namespace espalier

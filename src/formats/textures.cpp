#include "formats/textures.h"

#include "espalier/base/file.h"

#include "archive/meshes/texture_file.h"

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cctype>

namespace espalier::formats {
namespace {

// What OBJ and USD take within a name without quoting it.
std::string plain(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) { return !(std::isalnum(c) || c == '-' || c == '_' || c == '.'); }, '_');
    return name;
}

}  // namespace

std::string png_of(const std::filesystem::path& run, const std::string& file) {
    const auto image = texture_image(run, file);
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

std::string material_name(const MeshMaterial& material) {
    const auto [red, green, blue] = material.rgb;
    const std::string colour = fmt::format("rgb_{:02x}{:02x}{:02x}", red, green, blue);
    if (material.texture.empty()) return colour;
    return fmt::format("{}_{}", colour, plain(std::filesystem::path(material.texture).stem().string()));
}

const std::string& TextureCopies::name(const std::string& file) {
    const auto [at, is_new] = names_.emplace(file, "");
    if (!is_new || file.empty()) return at->second;
    const std::string png = png_of(job_.run.folder(), file);
    if (png.empty()) return at->second;
    const std::string stem = plain(std::filesystem::path(file).stem().string());
    std::string name = plain(fmt::format("{}-{}.png", job_.run.scene(), stem));
    const auto is_taken = [&] {
        return std::any_of(names_.begin(), names_.end(), [&](const auto& known) { return known.second == name; });
    };
    for (int number = 2; is_taken(); ++number)
        name = plain(fmt::format("{}-{}-{}.png", job_.run.scene(), stem, number));
    write_text(job_.folder / name, png);
    return at->second = name;
}

}  // namespace espalier::formats

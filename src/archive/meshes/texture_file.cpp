#include "archive/meshes/texture_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/meshes/bark.h"
#include "base/picture_file.h"

#include <nlohmann/json.hpp>
#include <vtkBMPReader.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNMReader.h>
#include <vtkTIFFReader.h>

#include <algorithm>
#include <vector>

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
    if (!is_readable(path)) return nullptr;
    for (const auto read : {read_by<vtkPNGReader>, read_by<vtkJPEGReader>, read_by<vtkTIFFReader>,
                            read_by<vtkBMPReader>, read_by<vtkPNMReader>}) {
        if (const auto image = read(path)) return image;
    }
    return nullptr;
}

vtkSmartPointer<vtkImageData> read_image(const fs::path& path) {
    return is_ours(path) ? read_ours(path) : read_by_vtk(path);
}

/// Where the scene of a run lies, and where the run was started; "" if it does not say so.
struct RunFolders {
    fs::path scene, command;
};
RunFolders folders_of(const fs::path& run) {
    const fs::path file = run / "run.json";
    if (run.empty() || !is_readable(file)) return {};
    const auto json = nlohmann::json::parse(read_text(file), nullptr, /*allow_exceptions=*/false);
    const auto text = [&](const char* table, const char* key) -> fs::path {
        const auto pointer = nlohmann::json::json_pointer(std::string("/") + table + "/" + key);
        return json.contains(pointer) && json[pointer].is_string() ? json[pointer].get<std::string>() : "";
    };
    const fs::path command = text("command", "folder");
    return {(command / text("scene", "path")).parent_path(), command};
}

/// Where a texture's file may be, of these where one is: it is named from the scene.
std::vector<fs::path> places_of(const fs::path& run, const std::string& file) {
    const RunFolders folders = fs::path(file).is_relative() ? folders_of(run) : RunFolders();
    std::vector<fs::path> places{folders.scene / file, folders.command / file, run / file, file};
    std::erase_if(places, [](const fs::path& path) { return !is_readable(path); });
    return places;
}

/// Opacity is left out.
vtkSmartPointer<vtkImageData> image_of(const OpacityPicture& picture) {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(static_cast<int>(picture.width), static_cast<int>(picture.height), 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
    for (std::size_t y = picture.height; y-- > 0;) {
        for (std::size_t x = 0; x < picture.width; ++x) bytes = std::copy_n(picture.at(x, y).begin(), 3, bytes);
    }
    return image;
}

vtkSmartPointer<vtkImageData> bark_image(const fs::path& path) {
    const Bark bark = read_bark(path);
    if (bark.picture) return read_image(*bark.picture);
    return image_of(shades_of(bark, heights_of(bark)));
}

}  // namespace

vtkSmartPointer<vtkImageData> texture_image(const fs::path& run, const std::string& file) {
    for (const fs::path& path : places_of(run, file)) {
        if (const auto image = is_bark(file) ? bark_image(path) : read_image(path)) return image;
    }
    return nullptr;
}

fs::path texture_path(const fs::path& run, const std::string& file) {
    const std::vector<fs::path> places = places_of(run, file);
    return places.empty() ? fs::path() : places.front();
}

std::optional<BarkRelief> bark_relief(const fs::path& run, const std::string& file) {
    const std::vector<fs::path> places = is_bark(file) ? places_of(run, file) : std::vector<fs::path>();
    if (places.empty()) return std::nullopt;
    const Bark bark = read_bark(places.front());
    return BarkRelief{bark.depth, heights_of(bark)};
}

ReliefImages relief_images(const fs::path& run, const std::string& file) {
    const std::vector<fs::path> places = is_bark(file) ? places_of(run, file) : std::vector<fs::path>();
    if (places.empty()) return {};
    const Bark bark = read_bark(places.front());
    const HeightMap map = heights_of(bark);
    return {image_of(normals_of(bark, map)), image_of(grey_of(map))};
}

}  // namespace espalier::archive

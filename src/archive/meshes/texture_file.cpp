#include "archive/meshes/texture_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/meshes/bark.h"
#include "base/json_text.h"
#include "base/picture_bytes.h"

#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkTIFFReader.h>

#include <algorithm>
#include <vector>

namespace espalier::archive {
namespace {

namespace fs = std::filesystem;

/// Rows from the lowest up, as VTK has them.
vtkSmartPointer<vtkImageData> new_image(std::size_t width, std::size_t height, std::size_t channels) {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(static_cast<int>(width), static_cast<int>(height), 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, static_cast<int>(channels));
    return image;
}

vtkSmartPointer<vtkImageData> image_of(const PngPicture& picture) {
    const auto image = new_image(picture.width, picture.height, picture.channels);
    auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
    const std::size_t row = picture.width * picture.channels;
    const auto as_byte = [&](std::uint16_t sample) {
        return static_cast<std::uint8_t>(picture.greatest > 255 ? sample / 256 : sample);
    };
    for (std::size_t y = picture.height; y-- > 0;) {
        const auto begin = picture.samples.begin() + static_cast<std::ptrdiff_t>(y * row);
        bytes = std::transform(begin, begin + static_cast<std::ptrdiff_t>(row), bytes, as_byte);
    }
    return image;
}

vtkSmartPointer<vtkImageData> image_of(const Picture& picture) {
    const auto image = new_image(picture.width, picture.height, 3);
    auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
    for (const Picture::Colour& colour : picture.pixels) bytes = std::copy(colour.begin(), colour.end(), bytes);
    return image;
}

/// A reader of VTK for what we read not ourselves: its readers of PNG, bitmaps and pixmaps do not bear damaged files.
template <class Reader>
vtkSmartPointer<vtkImageData> read_by(const fs::path& path) {
    vtkNew<Reader> reader;
    if (!reader->CanReadFile(path.c_str())) return nullptr;
    reader->SetFileName(path.c_str());
    reader->UpdateInformation();
    int extent[6];
    reader->GetDataExtent(extent);
    double pixels = 1;
    for (int axis = 0; axis < 3; ++axis) pixels *= double(extent[2 * axis + 1]) - extent[2 * axis] + 1;
    if (!(pixels >= 1 && pixels <= double(most_pixels_of_texture))) return nullptr;
    reader->Update();
    if (reader->GetErrorCode() != 0 || reader->GetOutput()->GetNumberOfPoints() == 0) return nullptr;
    return reader->GetOutput();
}

/// VTK knows no names with ".rgb" and takes anything with ".tga" for its own.
bool is_named_ours(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.ends_with("rgb") || name.ends_with("tga");
}

vtkSmartPointer<vtkImageData> read_image(const fs::path& path) {
    try {
        if (!is_named_ours(path)) {
            const PictureBytes bytes(path);
            if (bytes.begins_with(png_signature)) {
                return image_of(read_png(bytes, PngOpacity::kept, most_pixels_of_texture));
            }
            if (bytes.begins_with("\xff\xd8")) return read_by<vtkJPEGReader>(path);
            if (bytes.begins_with("II") || bytes.begins_with("MM")) return read_by<vtkTIFFReader>(path);
        }
        const Picture picture = read_picture(path);
        return picture.empty() ? nullptr : image_of(picture);
    } catch (const UserError&) {
        return nullptr;
    }
}

/// Where the scene of a run lies, and where the run was started; "" if it does not say so.
struct RunFolders {
    fs::path scene, command;
};
RunFolders folders_of(const fs::path& run) {
    const fs::path file = run / "run.json";
    if (run.empty() || !is_readable(file)) return {};
    const auto json = read_json<nlohmann::json>(read_text(file));
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
    const auto image = new_image(picture.width, picture.height, 3);
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

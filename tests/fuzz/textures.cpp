// Any bytes as the picture of a texture: the first byte chooses the name of its file. It must become a picture or none.
#include "espalier/base/error.h"

#include "../picture_bytes.h"
#include "../temporary_folder.h"
#include "archive/meshes/texture_file.h"
#include "base/picture_file.h"
#include "base/png_file.h"
#include "seeds_on_request.h"

#include <vtkBMPWriter.h>
#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkTIFFWriter.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

constexpr std::size_t longest = 1 << 14;
constexpr std::array names{"a.png", "a.rgb", "a.tga", "a.bmp", "a.ppm", "a.jpg", "a.tif"};

void require(bool condition) {
    if (!condition) std::abort();
}

template <class Writer>
std::string written(vtkImageData* image, const TemporaryFolder& folder) {
    const std::string file = (folder.path() / "seed").string();
    vtkNew<Writer> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image);
    writer->Write();
    return text_of(file);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    write_seeds_if_asked([](const auto& write) {
        const TemporaryFolder folder;
        espalier::OpacityPicture leaf{5, 7, {}};
        for (std::uint8_t i = 0; i < 35; ++i)
            leaf.pixels.push_back({i, std::uint8_t(7 * i), 200, std::uint8_t(255 - i)});
        const std::string png = espalier::png_bytes(leaf);
        std::string pixmap = "P6 5 7 255 ";
        for (int i = 0; i < 105; ++i) pixmap += static_cast<char>(11 * i);
        const auto image = espalier::archive::texture_image({}, folder.write("leaf.ppm", pixmap).string());
        write_png(folder.path() / "palette.png", 3, std::vector<std::uint8_t>{1, 0, 1}, PNG_COLOR_TYPE_PALETTE,
                  {{9, 8, 7}, {4, 5, 6}});
        write_png(folder.path() / "grey.png", 2, std::vector<std::uint16_t>{0, 1, 256, 65535}, PNG_COLOR_TYPE_GRAY);
        const std::string all[] = {png,
                                   sgi(true),
                                   targa(true, false),
                                   written<vtkBMPWriter>(image, folder),
                                   pixmap,
                                   written<vtkJPEGWriter>(image, folder),
                                   written<vtkTIFFWriter>(image, folder)};
        for (std::size_t i = 0; i < names.size(); ++i)
            write(names.at(i), std::string(1, static_cast<char>(i)) + all[i]);
        for (const char* name : {"palette.png", "grey.png"})
            write(name, std::string(1, '\0') + text_of(folder.path() / name));
    });
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const TemporaryFolder folder;
    vtkObject::GlobalWarningDisplayOff();
    if (size < 1 || size > longest) return 0;
    const auto file =
        folder.write(names.at(data[0] % names.size()), std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    espalier::reason_not_to_show(file);
    if (const auto image = espalier::archive::texture_image({}, file.string())) require(image->GetNumberOfPoints() > 0);
    try {
        const espalier::Picture picture = espalier::read_picture(file);
        require(picture.pixels.size() == picture.width * picture.height);
    } catch (const espalier::UserError&) {
    }
    return 0;
}

// Pictures of textures: what is shown of each kind, and what of files that are damaged or claim too much.
#include "archive/meshes/texture_file.h"

#include "espalier/base/file.h"

#include "base/picture_file.h"
#include "base/png_file.h"
#include "catch.h"
#include "picture_bytes.h"
#include "temporary_folder.h"

#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkTIFFWriter.h>

using namespace espalier;
using namespace espalier::archive;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

vtkSmartPointer<vtkImageData> shown(const fs::path& file) {
    return texture_image({}, file.string());
}

/// The channels of a pixel, counted from the lower left corner.
std::vector<int> pixel(vtkImageData& image, int x, int y) {
    std::vector<int> channels;
    for (int k = 0; k < image.GetNumberOfScalarComponents(); ++k) {
        channels.push_back(static_cast<int>(image.GetScalarComponentAsDouble(x, y, 0, k)));
    }
    return channels;
}

template <class Writer>
void write_by_vtk(vtkImageData* image, const fs::path& file) {
    vtkNew<Writer> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image);
    writer->Write();
}

/// The sixteen by nine pixels of a picture in one colour, as P6.
std::string even_pixmap(int red, int green, int blue) {
    std::string bytes = "P6 16 9 255 ";
    for (int i = 0; i < 16 * 9; ++i) bytes += bytes_of({red, green, blue});
    return bytes;
}

/// The head of a PNG that claims so many pixels, with nothing behind it.
std::string png_head(std::uint32_t width, std::uint32_t height) {
    std::string bytes = bytes_of({0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R'});
    for (const std::uint32_t size : {width, height}) {
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(size >> shift & 255u);
    }
    return bytes + bytes_of({8, 2, 0, 0, 0, 1, 2, 3, 4});
}

}  // namespace

TEST_CASE("a texture is shown from the lowest row up, with its opacity", "[textures]") {
    const TemporaryFolder folder;
    OpacityPicture leaf{2, 2, {}};
    leaf.pixels = {{1, 2, 3, 0}, {4, 5, 6, 255}, {7, 8, 9, 10}, {11, 12, 13, 14}};
    const auto image = shown(folder.write("leaf.png", png_bytes(leaf)));
    REQUIRE(image);
    CHECK(pixel(*image, 0, 0) == std::vector<int>{7, 8, 9, 10});
    CHECK(pixel(*image, 1, 1) == std::vector<int>{4, 5, 6, 255});
    write_png(folder.path() / "grey.png", 1, std::vector<std::uint16_t>{513, 65535}, PNG_COLOR_TYPE_GRAY);
    const auto grey = shown(folder.path() / "grey.png");
    REQUIRE(grey);
    CHECK(pixel(*grey, 0, 0) == std::vector<int>{255});
    CHECK(pixel(*grey, 0, 1) == std::vector<int>{2});
}

TEST_CASE("textures are known by what they hold, whatever kind they are", "[textures]") {
    const TemporaryFolder folder;
    const auto pixmap = shown(folder.write("a.ppm", even_pixmap(200, 100, 50)));
    REQUIRE(pixmap);
    CHECK(pixel(*pixmap, 3, 4) == std::vector<int>{200, 100, 50});
    write_by_vtk<vtkJPEGWriter>(pixmap, folder.path() / "a.png");  // whose name says otherwise
    write_by_vtk<vtkTIFFWriter>(pixmap, folder.path() / "a.tif");
    for (const char* name : {"a.png", "a.tif"}) {
        INFO(name);
        const auto image = shown(folder.path() / name);
        REQUIRE(image);
        CHECK(image->GetDimensions()[0] == 16);
        for (int k = 0; k < 3; ++k) CHECK(image->GetScalarComponentAsDouble(3, 4, 0, k) == Approx(200 >> k).margin(3));
        CHECK(reason_not_to_show(folder.path() / name).empty());
    }
    CHECK_FALSE(shown(folder.write("notes.png", "no picture")));
    CHECK_FALSE(shown(folder.path() / "none.png"));
}

TEST_CASE("a texture that is cut short or claims more pixels than a texture may have is not shown", "[textures]") {
    const TemporaryFolder folder;
    OpacityPicture leaf{3, 3, {}};
    leaf.pixels.resize(9, {1, 2, 3, 4});
    const std::string bytes = png_bytes(leaf);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        CHECK_FALSE(shown(folder.write("cut.png", bytes.substr(0, size))));
    }
    CHECK_FALSE(shown(folder.write("wide.png", png_head(8193, 8192))));
    CHECK_THAT(reason_not_to_show(folder.path() / "wide.png"), Contains("8193 x 8192 pixels") && Contains("67108864"));
    CHECK_FALSE(shown(folder.write("empty.png", png_head(0, 8))));
    CHECK_THAT(reason_not_to_show(folder.path() / "empty.png"), Contains("0 x 8 pixels"));
    CHECK(reason_not_to_show(folder.write("whole.png", png_head(8192, 8192))).empty());
    CHECK_THAT(reason_not_to_show(folder.write("short.png", bytes.substr(0, 20))), Contains("ends too early"));
    CHECK_THAT(reason_not_to_show(folder.write("notes.txt", "no picture")), Contains("none of"));
    CHECK_THAT(reason_not_to_show(folder.path() / "nothing.png"), Contains("cannot be read"));
}

#include "base/picture_file.h"

#include "espalier/base/file.h"

#include "base/picture_bytes.h"
#include "base/png_file.h"
#include "catch.h"
#include "picture_bytes.h"
#include "temporary_folder.h"

using namespace espalier;
using Catch::Matchers::Contains;

namespace {

int wrong_pixels(const std::filesystem::path& path) {
    const Picture image = read_picture(path);
    if (image.width != 3 || image.height != 2) return 6;
    int wrong = 0;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                const int read = image.at((x + 0.5) / 3, (y + 0.5) / 2)[static_cast<std::size_t>(channel)];
                wrong += read != shade_at(x, y, channel);
            }
        }
    }
    return wrong;
}

/// The test picture as a PNG.
std::filesystem::path png(const TemporaryFolder& folder) {
    std::vector<std::uint8_t> samples;
    for (int i = 0; i < 18; ++i) samples.push_back(static_cast<std::uint8_t>(shade_at(i / 3 % 3, 1 - i / 9, i % 3)));
    write_png(folder.path() / "colours.png", 3, samples, PNG_COLOR_TYPE_RGB);
    return folder.path() / "colours.png";
}

std::string refusal(const std::filesystem::path& path) {
    try {
        read_picture(path);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

PngPicture whole_png(const std::filesystem::path& path) {
    return read_png(PictureBytes(path));
}

}  // namespace

TEST_CASE("pictures of three kinds, plain and coded, show the same pixels from the lowest row up", "[base]") {
    const TemporaryFolder folder;
    CHECK(wrong_pixels(folder.write("plain.rgb", sgi(false))) == 0);
    CHECK(wrong_pixels(folder.write("coded.rgb", sgi(true))) == 0);
    CHECK(wrong_pixels(folder.write("plain.tga", targa(false, false))) == 0);
    CHECK(wrong_pixels(folder.write("top.tga", targa(false, true))) == 0);
    CHECK(wrong_pixels(folder.write("coded.tga", targa(true, false))) == 0);
    CHECK(wrong_pixels(png(folder)) == 0);
}

TEST_CASE("pictures that are cut short, huge or none are mistakes that name the file", "[base]") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& name, const std::string& bytes) {
        return refusal(folder.write(name, bytes));
    };
    for (const std::string& whole : {sgi(false), sgi(true)}) {
        for (std::size_t length = 0; length + 1 < whole.size(); length += 7) {
            CHECK_THAT(refused("cut.rgb", whole.substr(0, length)), Contains("cut.rgb"));
        }
    }
    const std::string whole = targa(true, false), good = read_text(png(folder));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        CHECK_THAT(refused("cut.tga", whole.substr(0, length)), Contains("cut.tga"));
    }
    for (std::size_t length = 0; length < good.size(); ++length) {
        CHECK_THAT(refused("cut.png", good.substr(0, length)), Contains("cut.png"));
    }
    std::string huge = sgi(false);
    for (const std::size_t i : {6u, 7u, 8u, 9u}) huge[i] = static_cast<char>(255);
    CHECK_THAT(refused("huge.rgb", huge), Contains("cannot be read"));
    huge = good;
    for (std::size_t i = 16; i < 24; ++i) huge[i] = 127;
    CHECK_THAT(refused("huge.png", huge), Contains("cannot be read"));
    CHECK_THAT(refused("ground.gif", "GIF"), Contains("rgb, tga or png"));
}

TEST_CASE("a PNG keeps its 16 bits, its grey and the colours of its palette", "[base]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.png";
    write_png(file, 2, std::vector<std::uint16_t>{0, 1, 256, 65535}, PNG_COLOR_TYPE_GRAY);
    const PngPicture grey = whole_png(file);
    CHECK(grey.width == 2);
    CHECK(grey.height == 2);
    CHECK(grey.channels == 1);
    CHECK(grey.greatest == 65535);
    CHECK(grey.samples == std::vector<std::uint16_t>{0, 1, 256, 65535});
    CHECK(read_picture(file).pixels == std::vector<Picture::Colour>{{1, 1, 1}, {255, 255, 255}, {0, 0, 0}, {0, 0, 0}});
    write_png(file, 3, std::vector<std::uint8_t>{1, 0, 1}, PNG_COLOR_TYPE_PALETTE, {{9, 8, 7}, {4, 5, 6}});
    CHECK(whole_png(file).samples == std::vector<std::uint16_t>{4, 5, 6, 9, 8, 7, 4, 5, 6});
}

TEST_CASE("the opacity of a PNG is read; pictures without one have none", "[base]") {
    const TemporaryFolder folder;
    OpacityPicture picture{2, 2, {{1, 2, 3, 0}, {4, 5, 6, 255}, {7, 8, 9, 128}, {10, 11, 12, 1}}};
    const Picture read = read_picture(folder.write("a.png", png_bytes(picture)));
    CHECK(read.opacity == std::vector<std::uint8_t>{128, 1, 0, 255});  // the lowest row first
    CHECK(read.pixels[0] == Picture::Colour{7, 8, 9});
    CHECK(read_picture(png(folder)).opacity.empty());
}

TEST_CASE("a PNG that is damaged, or uses a colour its palette lacks, is refused", "[base]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.png";
    write_png(file, 3, std::vector<std::uint8_t>{1, 0, 2}, PNG_COLOR_TYPE_PALETTE, {{9, 8, 7}, {4, 5, 6}});
    CHECK_THAT(refusal(file), Contains("a.png") && Contains("a colour that its palette lacks"));
    std::string bytes = read_text(png(folder));
    const std::size_t data = bytes.find("IDAT");
    REQUIRE(data != std::string::npos);
    std::string damaged = bytes;
    damaged[data + 8] = static_cast<char>(damaged[data + 8] ^ 85);
    CHECK_THAT(refusal(folder.write("b.png", damaged)), Contains("b.png") && Contains("the picture is damaged"));
    bytes[24] = 4;  // bits of a channel
    CHECK_THAT(refusal(folder.write("c.png", bytes)), Contains("c.png"));
    CHECK_THAT(refusal(folder.write("d.png", "no picture")), Contains("this is no PNG picture"));
}

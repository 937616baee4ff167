#include "base/picture_file.h"

#include "espalier/base/file.h"

#include "base/picture_bytes.h"
#include "base/png_file.h"
#include "catch.h"
#include "picture_bytes.h"
#include "temporary_folder.h"

using namespace espalier;
using Catch::Contains;

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

/// A bitmap of the test picture, of 8 bits a pixel and a palette or of more; each row fills whole words.
std::string bitmap(int bits, bool top_first) {
    const std::size_t palette = bits == 8 ? 6 * 4 : 0;
    const auto first = static_cast<int>(54 + palette);
    std::string bytes = "BM" + std::string(8, '\0') + bytes_of({first, 0, 0, 0, 40, 0, 0, 0, 3, 0, 0, 0});
    bytes += top_first ? bytes_of({254, 255, 255, 255}) : bytes_of({2, 0, 0, 0});
    bytes += bytes_of({1, 0, bits, 0}) + std::string(24, '\0');
    const auto colour = [](int x, int y) {
        return bytes_of({shade_at(x, y, 2), shade_at(x, y, 1), shade_at(x, y, 0)});
    };
    for (int i = 0; bits == 8 && i < 6; ++i) bytes += colour(i % 3, i / 3) + bytes_of({0});
    for (int row = 0; row < 2; ++row) {
        const int y = top_first ? 1 - row : row;
        std::string pixels;
        for (int x = 0; x < 3; ++x) {
            pixels += bits == 8 ? bytes_of({3 * y + x}) : colour(x, y) + (bits == 32 ? bytes_of({9}) : "");
        }
        bytes += pixels + std::string((4 - pixels.size() % 4) % 4, '\0');
    }
    return bytes;
}

std::string pixmap() {
    std::string bytes = "P6\n# a comment\n3 2\n255\n";
    for (int i = 0; i < 6; ++i) {
        for (int channel = 0; channel < 3; ++channel) bytes += static_cast<char>(shade_at(i % 3, 1 - i / 3, channel));
    }
    return bytes;
}

/// A PNG of grey samples, 3 pixels wide, of less than 8 bits or interlaced.
void write_grey(const std::filesystem::path& path, int bits, bool interlaced,
                const std::vector<std::uint8_t>& samples) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    const auto height = static_cast<png_uint_32>(samples.size() / 3);
    png_set_IHDR(png, info, 3, height, bits, PNG_COLOR_TYPE_GRAY, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_write_info(png, info);
    png_set_packing(png);
    std::vector<png_const_bytep> rows;
    for (png_uint_32 y = 0; y < height; ++y) rows.push_back(samples.data() + 3 * y);
    png_write_image(png, const_cast<png_bytepp>(rows.data()));
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

PngPicture whole_png(const std::filesystem::path& path) {
    return read_png(PictureBytes(path));
}

}  // namespace

TEST_CASE("pictures of five kinds, plain and coded, show the same pixels from the lowest row up", "[base]") {
    const TemporaryFolder folder;
    CHECK(wrong_pixels(folder.write("plain.rgb", sgi(false))) == 0);
    CHECK(wrong_pixels(folder.write("coded.rgb", sgi(true))) == 0);
    CHECK(wrong_pixels(folder.write("plain.tga", targa(false, false))) == 0);
    CHECK(wrong_pixels(folder.write("top.tga", targa(false, true))) == 0);
    CHECK(wrong_pixels(folder.write("coded.tga", targa(true, false))) == 0);
    CHECK(wrong_pixels(png(folder)) == 0);
    for (const int bits : {8, 24, 32}) {
        for (const bool top_first : {false, true}) {
            INFO(bits);
            CHECK(wrong_pixels(folder.write("plain.bmp", bitmap(bits, top_first))) == 0);
        }
    }
    CHECK(wrong_pixels(folder.write("plain.ppm", pixmap())) == 0);
    const Picture grey = read_picture(folder.write("grey.pgm", "P5 2 1 255 " + bytes_of({7, 200})));
    CHECK(grey.pixels == std::vector<Picture::Colour>{{7, 7, 7}, {200, 200, 200}});
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
    for (const auto& [name, all] : {std::pair("cut.bmp", bitmap(8, false)), std::pair("cut.ppm", pixmap())}) {
        for (std::size_t length = 0; length < all.size() - 1; ++length) {
            CHECK_THAT(refused(name, all.substr(0, length)), Contains(name));
        }
    }
    CHECK_THAT(refused("huge.ppm", "P6 100000 100000 255 "), Contains("cannot be read"));
    CHECK_THAT(refused("deep.ppm", "P6 3 2 65535 "), Contains("greatest value is 255"));
    CHECK_THAT(refused("long.ppm", "P6 1234567890 2 255 "), Contains("header"));
    std::string odd = bitmap(24, false);
    odd[30] = 1;
    CHECK_THAT(refused("coded.bmp", odd), Contains("not compressed"));
    std::string huge = sgi(false);
    for (const std::size_t i : {6u, 7u, 8u, 9u}) huge[i] = static_cast<char>(255);
    CHECK_THAT(refused("huge.rgb", huge), Contains("cannot be read"));
    huge = good;
    for (std::size_t i = 16; i < 24; ++i) huge[i] = 127;
    CHECK_THAT(refused("huge.png", huge), Contains("cannot be read"));
    CHECK_THAT(refused("ground.gif", "GIF"), Contains("ground.gif") && Contains("PNG"));
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

TEST_CASE("PNG pictures of less than 8 bits, and interlaced ones, are whole", "[base]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.png";
    write_grey(file, 1, false, {0, 1, 1, 1, 0, 0});
    CHECK(whole_png(file).samples == std::vector<std::uint16_t>{0, 255, 255, 255, 0, 0});
    write_grey(file, 4, true, {0, 15, 5, 1, 2, 3});
    CHECK(whole_png(file).samples == std::vector<std::uint16_t>{0, 255, 85, 17, 34, 51});
    std::vector<std::uint8_t> many(3 * 17);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::uint8_t>(5 * i);
    write_grey(file, 8, true, many);
    CHECK(whole_png(file).samples == std::vector<std::uint16_t>(many.begin(), many.end()));
}

TEST_CASE("opacity is kept where it is asked for", "[base]") {
    const TemporaryFolder folder;
    OpacityPicture picture{2, 1, {}};
    picture.pixels = {{1, 2, 3, 4}, {5, 6, 7, 255}};
    const std::filesystem::path file = folder.write("leaf.png", png_bytes(picture));
    CHECK(whole_png(file).samples == std::vector<std::uint16_t>{1, 2, 3, 5, 6, 7});
    const PngPicture kept = read_png(PictureBytes(file), PngOpacity::kept);
    CHECK(kept.channels == 4);
    CHECK(kept.samples == std::vector<std::uint16_t>{1, 2, 3, 4, 5, 6, 7, 255});
    CHECK_THROWS_WITH(read_png(PictureBytes(file), PngOpacity::kept, 1), Contains("2 x 1 pixels cannot be read"));
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

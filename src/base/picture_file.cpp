#include "base/picture_file.h"

#include "base/picture_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace espalier {
namespace {

Picture black(const PictureBytes& bytes, std::size_t width, std::size_t height) {
    bytes.require_size(width, height, 512);  // no run-length code says more
    Picture image{width, height, {}, {}};
    image.pixels.resize(width * height);
    return image;
}

Picture from_png(const PngPicture& picture) {
    Picture image{picture.width, picture.height, {}, {}};
    const auto eight_bits = [&](int sample) {
        return static_cast<std::uint8_t>(picture.greatest > 255 ? sample / 256 : sample);
    };
    for (std::size_t y = picture.height; y-- > 0;) {
        for (std::size_t x = 0; x < picture.width; ++x) {
            Picture::Colour& colour = image.pixels.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) colour[k] = eight_bits(picture.at(x, y, k));
            if (!picture.has_opacity()) continue;
            const std::size_t pixel = y * picture.width + x;
            image.opacity.push_back(eight_bits(picture.samples[(pixel + 1) * picture.channels - 1]));
        }
    }
    return image;
}

// --- SGI: planes of rows, the lowest first, plain or run-length coded (Haeberli, SGI image file format 1.00) ---

void read_sgi_run_lengths(const PictureBytes& bytes, std::size_t at, Picture& image, std::size_t row,
                          std::size_t channel) {
    for (std::size_t x = 0; x < image.width;) {
        const std::uint8_t code = bytes.at(at++);
        const std::size_t count = code & 127u;
        if (count == 0) return;  // the rest of the row stays 0
        for (std::size_t k = 0; k < count && x < image.width; ++k, ++x) {
            image.pixels[row * image.width + x][channel] = bytes.at(code & 128u ? at + k : at);
        }
        at += code & 128u ? count : 1;
    }
}

Picture read_sgi(const PictureBytes& bytes) {
    if (bytes.big(0) != 474) bytes.fail("this is no SGI picture");
    const bool coded = bytes.at(2) == 1;
    if (bytes.at(3) != 1) bytes.fail("only SGI pictures of 8 bits a channel can be read");
    const std::size_t dimensions = bytes.big(4);
    const std::size_t height = dimensions > 1 ? bytes.big(8) : 1;
    const std::size_t planes = dimensions > 2 ? bytes.big(10) : 1;
    Picture image = black(bytes, bytes.big(6), height);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t plane = planes >= 3 ? channel : 0;  // grey in all three
        for (std::size_t row = 0; row < height; ++row) {
            const std::size_t line = plane * height + row;
            if (coded) {
                read_sgi_run_lengths(bytes, bytes.big4(512 + 4 * line), image, row, channel);
                continue;
            }
            for (std::size_t x = 0; x < image.width; ++x) {
                image.pixels[row * image.width + x][channel] = bytes.at(512 + line * image.width + x);
            }
        }
    }
    return image;
}

// --- Targa: blue, green, red, plain or run-length coded (Truevision TGA 2.0) ---

Picture::Colour targa_pixel(const PictureBytes& bytes, std::size_t at, std::size_t channels) {
    if (channels == 1) return {bytes.at(at), bytes.at(at), bytes.at(at)};
    return {bytes.at(at + 2), bytes.at(at + 1), bytes.at(at)};
}

Picture read_targa(const PictureBytes& bytes) {
    const int kind = bytes.at(2);
    const std::size_t channels = bytes.at(16) / 8u;
    const bool coded = kind == 10 || kind == 11;
    const bool grey = kind == 3 || kind == 11;
    if ((kind != 2 && kind != 3 && !coded) || (grey ? channels != 1 : channels != 3 && channels != 4)) {
        bytes.fail(
            fmt::format("only Targa pictures in true colours or grey can be read, not of type {} with {} bits a "
                        "pixel",
                        kind, int{bytes.at(16)}));
    }
    Picture image = black(bytes, bytes.little(12), bytes.little(14));
    const bool top_first = bytes.at(17) & 32u;
    std::size_t at = 18u + bytes.at(0) + bytes.little(5) * ((bytes.at(7) + 7u) / 8u);
    std::size_t left = 0;  // pixels left of the packet
    bool repeats = false;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (coded && left == 0) {
            const std::uint8_t code = bytes.at(at++);
            left = 1 + (code & 127u);
            repeats = code & 128u;
        }
        const std::size_t row = i / image.width;
        const std::size_t line = top_first ? image.height - 1 - row : row;
        image.pixels[line * image.width + i % image.width] = targa_pixel(bytes, at, channels);
        if (coded) --left;
        if (!(coded && repeats && left > 0)) at += channels;
    }
    return image;
}

std::string head_of(const std::filesystem::path& path) {
    std::string head(32, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    return head;
}

std::string reason_of_png(std::string_view head) {
    constexpr std::size_t header = png_signature.size() + 8, end = header + 10;
    if (head.size() < end) return "it ends too early";
    const auto number = [&](std::size_t at) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<std::uint8_t>(head[at + i]);
        return value;
    };
    const std::uint64_t width = number(header), height = number(header + 4);
    if (width > 0 && height > 0 && width <= most_pixels_of_texture / height) return "";
    return fmt::format("it says that it is {} x {} pixels large, and may have {}", width, height,
                       most_pixels_of_texture);
}

}  // namespace

const Picture::Colour& Picture::at(double u, double v) const {
    const auto index = [](double part, std::size_t count) {
        const double scaled = std::clamp(part, 0.0, 1.0) * static_cast<double>(count);
        return std::min(static_cast<std::size_t>(scaled), count - 1);
    };
    return pixels[index(v, height) * width + index(u, width)];
}

Picture read_picture(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    const PictureBytes bytes(path);
    if (name.ends_with("rgb")) return read_sgi(bytes);
    if (name.ends_with("tga")) return read_targa(bytes);
    if (name.ends_with("png") || bytes.begins_with(png_signature)) {
        return from_png(read_png(bytes, PngOpacity::kept));
    }
    if (bytes.begins_with("BM")) return read_bitmap(bytes);
    if (bytes.begins_with("P5") || bytes.begins_with("P6")) return read_pixmap(bytes);
    bytes.fail("a picture is a file in SGI's (rgb), Targa's (tga), PNG's, Microsoft's (bmp) or netpbm's (ppm) format");
}

std::string reason_not_to_show(const std::filesystem::path& path) {
    if (!is_readable(path)) return "it cannot be read";
    const std::string name = path.filename().string(), head = head_of(path);
    if (head.starts_with(png_signature)) return reason_of_png(head);
    constexpr std::string_view kinds[] = {"BM", "P5", "P6", "\xff\xd8\xff", "II*", "MM"};
    const bool is_known =
        name.ends_with("tga") || (name.ends_with("rgb") && head.starts_with("\x01\xda")) ||
        std::any_of(std::begin(kinds), std::end(kinds), [&](std::string_view kind) { return head.starts_with(kind); });
    return is_known ? "" : "it is none of SGI's (.rgb), Targa's (.tga), PNG, JPEG, TIFF, BMP and PPM pictures";
}

}  // namespace espalier

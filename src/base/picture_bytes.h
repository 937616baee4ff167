// What the readers of pictures share.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/picture_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

constexpr std::size_t most_pixels = std::size_t{1} << 28;

/// The bytes of a file; reading beyond the end is the file's mistake.
class PictureBytes {
public:
    explicit PictureBytes(const std::filesystem::path& path) : name_(path.string()), bytes_(read_text(path)) {}

    std::size_t size() const { return bytes_.size(); }
    const char* data() const { return bytes_.data(); }
    bool begins_with(std::string_view start) const { return std::string_view(bytes_).starts_with(start); }
    std::uint8_t at(std::size_t i) const {
        if (i >= bytes_.size()) fail("the picture ends too early");
        return static_cast<std::uint8_t>(bytes_[i]);
    }
    std::size_t little(std::size_t i) const { return at(i) + 256u * at(i + 1); }
    std::size_t big(std::size_t i) const { return 256u * at(i) + at(i + 1); }
    std::size_t big4(std::size_t i) const { return 65536u * big(i) + big(i + 2); }
    std::size_t little4(std::size_t i) const { return little(i) + 65536u * little(i + 2); }
    [[noreturn]] void fail(const std::string& message) const { throw UserError({name_, 0, 0}, message); }

    /// A file of some bytes cannot ask for `most_per_byte` times as many pixels, and none for more than `most`.
    void require_size(std::size_t width, std::size_t height, std::size_t most_per_byte,
                      std::size_t most = most_pixels) const {
        if (width == 0 || height == 0 || width > most / height) {
            fail(fmt::format("a picture of {} x {} pixels cannot be read", width, height));
        }
        if (width * height / most_per_byte > size()) fail("the picture ends too early");
    }

private:
    std::string name_;
    std::string bytes_;
};

/// What a PNG file shows, from the highest row down; palettes are looked up.
struct PngPicture {
    std::size_t width = 0, height = 0;
    std::size_t channels = 0;  ///< grey or red, green, blue; and opacity, if it was asked for and is there
    int greatest = 255;        ///< what white is
    std::vector<std::uint16_t> samples;

    bool has_opacity() const { return channels % 2 == 0; }
    int at(std::size_t x, std::size_t y, std::size_t channel) const {
        return samples[(y * width + x) * channels + (channels >= 3 ? channel : 0)];
    }
};

enum class PngOpacity { left_out, kept };

/// Portable Network Graphics (ISO/IEC 15948). Channels of less than 8 bits are given as 8. Throws UserError, also for
/// more than `most` pixels.
PngPicture read_png(const PictureBytes& bytes, PngOpacity opacity = PngOpacity::left_out,
                    std::size_t most = most_pixels);

/// Microsoft's bitmaps, uncompressed, of 8, 24 or 32 bits a pixel. Throws UserError.
Picture read_bitmap(const PictureBytes& bytes);

/// Portable pixmaps and greymaps as bytes: P6 and P5 of netpbm. Throws UserError.
Picture read_pixmap(const PictureBytes& bytes);

constexpr std::string_view png_signature("\x89PNG\r\n\x1a\n", 8);

}  // namespace espalier

// Small pictures as bytes of files, for tests.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <png.h>
#include <string>
#include <vector>

inline std::string bytes_of(std::initializer_list<int> values) {
    std::string bytes;
    for (const int value : values) bytes += static_cast<char>(value);
    return bytes;
}

/// Returns a shade of the test pictures, 3 x 2 pixels: red is 10 x + y, green 100 + red, blue 200 + red, y from below.
inline int shade_at(int x, int y, int channel) {
    return 100 * channel + 10 * x + y;
}

inline std::string sgi(bool coded) {
    std::string bytes = bytes_of({1, 218, coded, 1, 0, 3, 0, 3, 0, 2, 0, 3});
    bytes.resize(512);
    std::string rows, starts, lengths;
    for (int channel = 0; channel < 3; ++channel) {
        for (int y = 0; y < 2; ++y) {
            const std::string row =
                bytes_of({shade_at(0, y, channel), shade_at(1, y, channel), shade_at(2, y, channel)});
            starts += bytes_of({0, 0, 2, 0}).substr(0, 2) +
                      bytes_of({(560 + int(rows.size())) / 256, (560 + int(rows.size())) % 256});
            // One run of a single pixel and two pixels as they are, then the end of the row.
            rows += coded ? bytes_of({1}) + row.substr(0, 1) + bytes_of({130}) + row.substr(1) + bytes_of({0}) : row;
            lengths += bytes_of({0, 0, 0, 6});
        }
    }
    return bytes + (coded ? starts + lengths : "") + rows;
}

inline std::string targa(bool coded, bool top_first) {
    std::string bytes = bytes_of({2, 0, coded ? 10 : 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 24, top_first ? 32 : 0});
    bytes += "id";
    for (int row = 0; row < 2; ++row) {
        const int y = top_first ? 1 - row : row;
        for (int x = 0; x < 3; ++x) {
            if (coded && x == 0) bytes += bytes_of({2});        // three pixels as they are,
            if (coded && x == 0 && row == 1) bytes.pop_back();  // but
            if (coded && row == 1) bytes += bytes_of({128});    // runs of one in the second row
            bytes += bytes_of({shade_at(x, y, 2), shade_at(x, y, 1), shade_at(x, y, 0)});
        }
    }
    return bytes;
}

/// A PNG file of 8 bits a channel, or 16 if `Sample` has them; the highest row first.
template <class Sample>
void write_png(const std::filesystem::path& path, std::uint32_t width, const std::vector<Sample>& samples,
               std::uint8_t colour_type, const std::vector<png_color>& palette = {}) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    const std::size_t row = width * (colour_type == PNG_COLOR_TYPE_RGB ? 3 : 1);
    png_set_IHDR(png, info, width, static_cast<std::uint32_t>(samples.size() / row), 8 * sizeof(Sample), colour_type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_set_check_for_invalid_index(png, 0);  // tests write such files, too, which later versions of libpng refuse
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    png_write_info(png, info);
    if (sizeof(Sample) == 2) png_set_swap(png);
    for (std::size_t at = 0; at < samples.size(); at += row) {
        png_write_row(png, reinterpret_cast<const png_byte*>(samples.data() + at));
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

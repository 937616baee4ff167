#include "espalier/base/picture_bytes.h"

#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkZLibDataCompressor.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace espalier {
namespace {

/// What the chunks of a file say, the picture still compressed.
struct Chunks {
    std::size_t width = 0, height = 0, channels = 0, bytes = 1;  ///< bytes of a channel
    bool has_palette = false;
    std::vector<Picture::Colour> palette;
    std::string data;
};

std::size_t channels_of(int colour_type) {
    switch (colour_type) {
        case 0:
        case 3:
            return 1;  // grey, palette
        case 4:
            return 2;  // grey and opacity
        case 2:
            return 3;
        case 6:
            return 4;
        default:
            return 0;
    }
}

void read_header(const PictureBytes& bytes, std::size_t at, Chunks& chunks) {
    chunks.width = bytes.big4(at);
    chunks.height = bytes.big4(at + 4);
    chunks.channels = channels_of(bytes.at(at + 9));
    chunks.has_palette = bytes.at(at + 9) == 3;
    const int bits = bytes.at(at + 8);
    chunks.bytes = bits == 16 ? 2 : 1;
    if ((bits != 8 && bits != 16) || chunks.channels == 0 || bytes.at(at + 12) != 0) {
        bytes.fail("only PNG pictures of 8 or 16 bits a channel that are not interlaced can be read");
    }
}

Chunks read_chunks(const PictureBytes& bytes) {
    Chunks chunks;
    for (std::size_t at = 8;;) {
        const std::size_t length = bytes.big4(at);
        std::string kind;
        for (std::size_t i = 4; i < 8; ++i) kind += static_cast<char>(bytes.at(at + i));
        if (length > bytes.size() || at + 12 + length > bytes.size()) bytes.fail("the picture ends too early");
        const std::size_t begin = at + 8;
        if (kind == "IHDR") read_header(bytes, begin, chunks);
        if (kind == "PLTE") {
            for (std::size_t i = 0; i + 2 < length; i += 3) {
                chunks.palette.push_back({bytes.at(begin + i), bytes.at(begin + i + 1), bytes.at(begin + i + 2)});
            }
        }
        if (kind == "IDAT") {
            for (std::size_t i = 0; i < length; ++i) chunks.data += static_cast<char>(bytes.at(begin + i));
        }
        if (kind == "IEND") return chunks;
        at = begin + length + 4;
    }
}

std::vector<std::uint8_t> inflated(const PictureBytes& bytes, const std::string& data, std::size_t size) {
    std::vector<std::uint8_t> whole(size);
    vtkNew<vtkZLibDataCompressor> zlib;
    const int warns = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    const std::size_t got =
        zlib->Uncompress(reinterpret_cast<const unsigned char*>(data.data()), data.size(), whole.data(), size);
    vtkObject::SetGlobalWarningDisplay(warns);
    if (got != size) bytes.fail("the picture is damaged");
    return whole;
}

int paeth(int left, int above, int corner) {
    const int guess = left + above - corner;
    const int a = std::abs(guess - left), b = std::abs(guess - above), c = std::abs(guess - corner);
    return a <= b && a <= c ? left : b <= c ? above : corner;
}

// Undoes what a row's filter took away, from its neighbours to the left and above.
void unfilter(int filter, std::uint8_t* row, const std::uint8_t* above, std::size_t length, std::size_t step) {
    for (std::size_t i = 0; i < length; ++i) {
        const int left = i >= step ? row[i - step] : 0;
        const int over = above ? above[i] : 0;
        const int corner = above && i >= step ? above[i - step] : 0;
        const std::array<int, 5> taken{0, left, over, (left + over) / 2, paeth(left, over, corner)};
        row[i] = static_cast<std::uint8_t>(row[i] + taken[static_cast<std::size_t>(filter)]);
    }
}

void add_pixel(const PictureBytes& bytes, const Chunks& chunks, const std::uint8_t* pixel, PngPicture& picture) {
    if (chunks.has_palette) {
        if (pixel[0] >= chunks.palette.size()) bytes.fail("the picture uses a colour that its palette lacks");
        const Picture::Colour& colour = chunks.palette[pixel[0]];
        picture.samples.insert(picture.samples.end(), colour.begin(), colour.end());
        return;
    }
    for (std::size_t k = 0; k < picture.channels; ++k) {
        const int sample = chunks.bytes == 2 ? 256 * pixel[2 * k] + pixel[2 * k + 1] : pixel[k];
        picture.samples.push_back(static_cast<std::uint16_t>(sample));
    }
}

}  // namespace

PngPicture read_png(const PictureBytes& bytes) {
    for (std::size_t i = 0; i < 8; ++i) {
        if (bytes.at(i) != static_cast<std::uint8_t>("\x89PNG\r\n\x1a\n"[i])) bytes.fail("this is no PNG picture");
    }
    const Chunks chunks = read_chunks(bytes);
    bytes.require_size(chunks.width, chunks.height, 1100);  // zlib packs 1032 bytes into one at most
    PngPicture picture{chunks.width,
                       chunks.height,
                       chunks.channels >= 3 || chunks.has_palette ? 3U : 1U,
                       chunks.bytes == 2 ? 65535 : 255,
                       {}};
    const std::size_t step = chunks.channels * chunks.bytes, length = chunks.width * step;
    std::vector<std::uint8_t> rows = inflated(bytes, chunks.data, (length + 1) * chunks.height);
    const std::uint8_t* above = nullptr;
    for (std::size_t y = 0; y < chunks.height; ++y) {
        std::uint8_t* row = rows.data() + y * (length + 1) + 1;
        if (row[-1] > 4) bytes.fail("the picture is damaged");
        unfilter(row[-1], row, above, length, step);
        above = row;
        for (std::size_t x = 0; x < chunks.width; ++x) add_pixel(bytes, chunks, row + x * step, picture);
    }
    return picture;
}

}  // namespace espalier

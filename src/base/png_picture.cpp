#include "base/picture_bytes.h"

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <png.h>

namespace espalier {
namespace {

/// What libpng asks for while it decodes. libpng reports errors by longjmp, so nothing here has a destructor.
struct Source {
    const PictureBytes* bytes;
    std::size_t at;
    bool ended;
};

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (count > source.bytes->size() - source.at) {
        source.ended = true;
        png_error(png, "");
    }
    std::memcpy(out, source.bytes->data() + source.at, count);
    source.at += count;
}

[[noreturn]] void jump_back(png_structp png, png_const_charp) {
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// libpng's state for one picture.
class Decoder {
public:
    explicit Decoder(const PictureBytes& bytes)
        : source_{&bytes, 0, false},
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, ignore_warning)) {
        if (!png_) throw std::bad_alloc();
        info_ = png_create_info_struct(png_);
        png_set_read_fn(png_, &source_, read_bytes);
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // `require_size` limits the pixels
    }
    ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    /// Calls `read`, which must hold nothing with a destructor; an error of libpng is one of the file.
    template <class Read>
    void guarded(const Read& read) {
        if (setjmp(png_jmpbuf(png_)) == 0) {
            read(png_, info_);
            return;
        }
        source_.bytes->fail(source_.ended ? "the picture ends too early" : "the picture is damaged");
    }

    png_const_structp png() const { return png_; }
    png_const_infop info() const { return info_; }

private:
    Source source_;
    png_structp png_;
    png_infop info_ = nullptr;
};

/// Appends the pixels of a row; indices of a palette are looked up here, because libpng takes any index.
class RowReader {
public:
    RowReader(const PictureBytes& bytes, Decoder& decoder, PngPicture& picture)
        : bytes_(bytes),
          picture_(picture),
          stored_(png_get_channels(decoder.png(), decoder.info())),
          has_palette_(png_get_color_type(decoder.png(), decoder.info()) == PNG_COLOR_TYPE_PALETTE) {
        decoder.guarded([&](png_structp png, png_infop info) {
            if (!has_palette_) return;
            png_get_PLTE(png, info, &palette_, &colours_);
            png_get_tRNS(png, info, &opacities_, &given_opacities_, nullptr);
        });
    }

    void add(const png_byte* row, std::size_t size) {
        const std::size_t sample_size = picture_.greatest > 255 ? 2 : 1;
        for (std::size_t at = 0; at < size; at += stored_ * sample_size) {
            if (has_palette_) {
                add_colour(row[at]);
                continue;
            }
            for (std::size_t k = 0; k < picture_.channels; ++k) {
                const png_byte* sample = row + at + k * sample_size;
                const int value = sample_size == 2 ? 256 * sample[0] + sample[1] : sample[0];
                picture_.samples.push_back(static_cast<std::uint16_t>(value));
            }
        }
    }

private:
    void add_colour(int index) {
        if (index >= colours_) bytes_.fail("the picture uses a colour that its palette lacks");
        for (const png_byte channel : {palette_[index].red, palette_[index].green, palette_[index].blue}) {
            picture_.samples.push_back(channel);
        }
        if (picture_.channels == 4) picture_.samples.push_back(index < given_opacities_ ? opacities_[index] : 255);
    }

    const PictureBytes& bytes_;
    PngPicture& picture_;
    std::size_t stored_;
    bool has_palette_;
    png_colorp palette_ = nullptr;
    png_bytep opacities_ = nullptr;
    int colours_ = 0, given_opacities_ = 0;
};

/// Reads the head, and asks for channels of 8 or 16 bits. Returns how often the rows must be read: more than once if
/// they are interlaced.
int begin(Decoder& decoder, PngOpacity opacity, PngPicture& picture) {
    int passes = 1;
    decoder.guarded([&](png_structp png, png_infop info) {
        png_read_info(png, info);
        const int colour_type = png_get_color_type(png, info);
        const bool has_palette = colour_type == PNG_COLOR_TYPE_PALETTE;
        const bool has_key = png_get_valid(png, info, PNG_INFO_tRNS) != 0;
        if (png_get_bit_depth(png, info) < 8) png_set_packing(png);
        if (colour_type == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
        if (!has_palette && has_key && opacity == PngOpacity::kept) png_set_tRNS_to_alpha(png);
        passes = png_set_interlace_handling(png);
        png_read_update_info(png, info);
        const bool has_opacity = has_palette ? has_key : (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0;
        picture.width = png_get_image_width(png, info);
        picture.height = png_get_image_height(png, info);
        picture.channels =
            (colour_type & PNG_COLOR_MASK_COLOR ? 3u : 1u) + (has_opacity && opacity == PngOpacity::kept ? 1u : 0u);
        picture.greatest = png_get_bit_depth(png, info) == 16 ? 65535 : 255;
    });
    return passes;
}

constexpr std::size_t most_packed = 1100;  // zlib packs 1032 bytes into one at most

/// As the header says, from 1 to 64.
std::size_t bits_of_pixel(const PictureBytes& bytes) {
    constexpr std::size_t depth = 24, colour_type = 25;
    const unsigned type = bytes.at(colour_type);
    const bool has_colours = (type & PNG_COLOR_MASK_COLOR) && !(type & PNG_COLOR_MASK_PALETTE);
    const std::size_t channels = (has_colours ? 3u : 1u) + (type & PNG_COLOR_MASK_ALPHA ? 1u : 0u);
    return std::clamp<std::size_t>(bytes.at(depth) * channels, 1, 64);
}

}  // namespace

PngPicture read_png(const PictureBytes& bytes, PngOpacity opacity, std::size_t most) {
    if (!bytes.begins_with(png_signature)) bytes.fail("this is no PNG picture");
    // Before libpng, whose messages do not say the size.
    constexpr std::size_t header = png_signature.size() + 8;
    bytes.require_size(bytes.big4(header), bytes.big4(header + 4), most_packed * 8 / bits_of_pixel(bytes), most);
    Decoder decoder(bytes);
    PngPicture picture;
    const int passes = begin(decoder, opacity, picture);
    RowReader rows(bytes, decoder, picture);
    const std::size_t size = png_get_rowbytes(decoder.png(), decoder.info());
    // The rows of an interlaced picture are complete after the last pass.
    std::vector<png_byte> read(passes > 1 ? size * picture.height : size);
    for (int pass = 1; pass <= passes; ++pass) {
        for (std::size_t y = 0; y < picture.height; ++y) {
            png_byte* const row = read.data() + (passes > 1 ? y * size : 0);
            decoder.guarded([&](png_structp png, png_infop) { png_read_row(png, row, nullptr); });
            if (pass == passes) rows.add(row, size);
        }
    }
    decoder.guarded([](png_structp png, png_infop) { png_read_end(png, nullptr); });
    return picture;
}

}  // namespace espalier

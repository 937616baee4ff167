#include "base/picture_bytes.h"

#include <csetjmp>
#include <cstring>
#include <png.h>

namespace espalier {
namespace {

constexpr std::size_t signature_size = 8;

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

void require_readable(const PictureBytes& bytes, const Decoder& decoder) {
    const int bits = png_get_bit_depth(decoder.png(), decoder.info());
    if ((bits != 8 && bits != 16) || png_get_interlace_type(decoder.png(), decoder.info()) != PNG_INTERLACE_NONE) {
        bytes.fail("only PNG pictures of 8 or 16 bits a channel that are not interlaced can be read");
    }
}

/// Appends the pixels of a row; indices of a palette are looked up here, because libpng takes any index.
class RowReader {
public:
    RowReader(const PictureBytes& bytes, Decoder& decoder, PngPicture& picture)
        : bytes_(bytes),
          picture_(picture),
          stored_(png_get_channels(decoder.png(), decoder.info())),
          has_palette_(png_get_color_type(decoder.png(), decoder.info()) == PNG_COLOR_TYPE_PALETTE) {
        decoder.guarded([&](png_structp png, png_infop info) {
            if (has_palette_) png_get_PLTE(png, info, &palette_, &colours_);
            png_get_tRNS(png, info, &opacities_, &transparent_, &colour_);
        });
    }

    void add(const std::vector<png_byte>& row) {
        const std::size_t sample_size = picture_.greatest > 255 ? 2 : 1;
        for (std::size_t at = 0; at < row.size(); at += stored_ * sample_size) {
            if (has_palette_) {
                add_colour(row[at]);
                continue;
            }
            const auto sample = [&](std::size_t k) {
                const png_byte* bytes = row.data() + at + k * sample_size;
                return static_cast<std::uint16_t>(sample_size == 2 ? 256 * bytes[0] + bytes[1] : bytes[0]);
            };
            for (std::size_t k = 0; k < picture_.channels; ++k) picture_.samples.push_back(sample(k));
            if (stored_ > picture_.channels) {
                picture_.opacity.push_back(sample(picture_.channels));
            } else if (colour_) {
                const bool is_clear =
                    picture_.channels == 1
                        ? sample(0) == colour_->gray
                        : sample(0) == colour_->red && sample(1) == colour_->green && sample(2) == colour_->blue;
                picture_.opacity.push_back(static_cast<std::uint16_t>(is_clear ? 0 : picture_.greatest));
            }
        }
    }

private:
    void add_colour(int index) {
        if (index >= colours_) bytes_.fail("the picture uses a colour that its palette lacks");
        for (const png_byte channel : {palette_[index].red, palette_[index].green, palette_[index].blue}) {
            picture_.samples.push_back(channel);
        }
        if (opacities_) picture_.opacity.push_back(index < transparent_ ? opacities_[index] : png_byte{255});
    }

    const PictureBytes& bytes_;
    PngPicture& picture_;
    std::size_t stored_;
    bool has_palette_;
    png_colorp palette_ = nullptr;
    int colours_ = 0;
    png_bytep opacities_ = nullptr;   ///< of the first colours of the palette
    int transparent_ = 0;             ///< how many these are
    png_color_16p colour_ = nullptr;  ///< the one that is clear, of pictures without opacities or palette
};

}  // namespace

PngPicture read_png(const PictureBytes& bytes) {
    if (!bytes.begins_with(std::string_view("\x89PNG\r\n\x1a\n", signature_size))) bytes.fail("this is no PNG picture");
    // Before libpng, whose messages do not say the size.
    constexpr std::size_t header = signature_size + 8;
    bytes.require_size(bytes.big4(header), bytes.big4(header + 4), 1100);  // zlib packs 1032 bytes into one at most
    Decoder decoder(bytes);
    decoder.guarded([](png_structp png, png_infop info) { png_read_info(png, info); });
    require_readable(bytes, decoder);
    PngPicture picture;
    picture.width = png_get_image_width(decoder.png(), decoder.info());
    picture.height = png_get_image_height(decoder.png(), decoder.info());
    picture.channels = png_get_color_type(decoder.png(), decoder.info()) & PNG_COLOR_MASK_COLOR ? 3 : 1;
    picture.greatest = png_get_bit_depth(decoder.png(), decoder.info()) == 16 ? 65535 : 255;
    RowReader rows(bytes, decoder, picture);
    std::vector<png_byte> row(png_get_rowbytes(decoder.png(), decoder.info()));
    for (std::size_t y = 0; y < picture.height; ++y) {
        decoder.guarded([&](png_structp png, png_infop) { png_read_row(png, row.data(), nullptr); });
        rows.add(row);
    }
    decoder.guarded([](png_structp png, png_infop) { png_read_end(png, nullptr); });
    return picture;
}

}  // namespace espalier

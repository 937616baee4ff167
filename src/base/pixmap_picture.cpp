#include "base/picture_bytes.h"

#include <cctype>

namespace espalier {
namespace {

/// The words of the header, between blanks and comments.
class Header {
public:
    explicit Header(const PictureBytes& bytes) : bytes_(bytes) {}

    /// A whole number of at most nine digits.
    std::size_t number() {
        skip_blanks();
        std::size_t value = 0, digits = 0;
        for (; std::isdigit(bytes_.at(at_)) != 0; ++at_, ++digits)
            value = 10 * value + (bytes_.at(at_) - std::size_t{'0'});
        if (digits == 0 || digits > 9) bytes_.fail("the header of the pixmap is damaged");
        return value;
    }
    /// Behind the one blank that ends the header.
    std::size_t end() const { return at_ + 1; }

private:
    void skip_blanks() {
        for (;; ++at_) {
            if (bytes_.at(at_) == '#') {
                while (bytes_.at(at_) != '\n') ++at_;
            }
            if (std::isspace(bytes_.at(at_)) == 0) return;
        }
    }

    const PictureBytes& bytes_;
    std::size_t at_ = 2;
};

}  // namespace

Picture read_pixmap(const PictureBytes& bytes) {
    const std::size_t channels = bytes.begins_with("P6") ? 3 : 1;
    if (channels == 1 && !bytes.begins_with("P5")) bytes.fail("this is no pixmap of bytes (P5 or P6)");
    Header header(bytes);
    Picture image{header.number(), header.number(), {}, {}};
    if (header.number() != 255) bytes.fail("only pixmaps whose greatest value is 255 can be read");
    bytes.require_size(image.width, image.height, 1);
    image.pixels.resize(image.width * image.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const std::size_t row = image.height - 1 - i / image.width, at = header.end() + i * channels;
        for (std::size_t k = 0; k < 3; ++k) {
            image.pixels[row * image.width + i % image.width][k] = bytes.at(at + (channels == 3 ? k : 0));
        }
    }
    return image;
}

}  // namespace espalier

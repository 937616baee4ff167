#include "base/picture_bytes.h"

namespace espalier {

PngPicture read_png(const PictureBytes& bytes, PngOpacity, std::size_t) {
    bytes.fail("a page cannot read PNG pictures: SGI and Targa pictures can be read, or the program that is installed");
}

}  // namespace espalier

#include "picture_options.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <charconv>

namespace espalier {

PictureOptions::PictureOptions(CLI::App& command) {
    command.add_option("--size", size_, "WIDTHxHEIGHT in pixels; default: what fits");
    command.add_flag("--dark", dark_, "on a dark background");
}

PictureSize PictureOptions::size(const PictureSize& otherwise) const {
    if (size_.empty()) return otherwise;
    PictureSize size;
    const char* end = size_.data() + size_.size();
    const auto [cross, wrong_width] = std::from_chars(size_.data(), end, size.width);
    if (wrong_width == std::errc() && cross != end && *cross == 'x') {
        const auto [rest, wrong_height] = std::from_chars(cross + 1, end, size.height);
        if (wrong_height == std::errc() && rest == end && size.width > 0 && size.height > 0) return size;
    }
    throw UserError(fmt::format("--size {}: WIDTHxHEIGHT is expected, as 1200x800", size_));
}

}  // namespace espalier

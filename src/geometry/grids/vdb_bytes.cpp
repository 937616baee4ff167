#include "geometry/grids/vdb_bytes.h"

#include <algorithm>

namespace espalier::geometry {

VdbBytes::VdbBytes(std::istream& in) : in_(in) {
    in_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, in_.tellg()));
    seek(0);
}

void VdbBytes::require(std::uint64_t bytes) const {
    if (bytes > size_ - at_) throw VdbError("it is cut short, or a length in it is wrong");
}

void VdbBytes::seek(std::uint64_t position) {
    if (position > size_) throw VdbError("a place in it lies behind its end");
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(position));
    at_ = position;
}

// Not a search: that would forget what is read ahead.
void VdbBytes::skip(std::uint64_t bytes) {
    require(bytes);
    in_.ignore(static_cast<std::streamsize>(bytes));
    at_ += bytes;
}

void VdbBytes::take(void* to, std::uint64_t bytes) {
    require(bytes);
    if (!in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) throw VdbError("it cannot be read");
    at_ += bytes;
}

std::string VdbBytes::text() {
    return text(get<std::uint32_t>());
}

std::string VdbBytes::text(std::uint64_t length) {
    require(length);
    std::string text(length, '\0');
    take(text.data(), length);
    return text;
}

}  // namespace espalier::geometry

// The bytes of an OpenVDB file, never read beyond their end.
#pragma once

#include <cstdint>
#include <istream>
#include <stdexcept>
#include <string>

namespace espalier::geometry {

/// Why a file is not read.
struct VdbError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Everything throws VdbError for what does not lie in the file.
class VdbBytes {
public:
    /// `in` can be searched, and lasts.
    explicit VdbBytes(std::istream& in);

    std::istream& stream() { return in_; }
    std::uint64_t position() const { return at_; }
    std::uint64_t size() const { return size_; }
    void seek(std::uint64_t position);
    void skip(std::uint64_t bytes);

    template <class T>
    T get() {
        T value{};
        take(&value, sizeof value);
        return value;
    }
    /// Its length comes before it.
    std::string text();
    std::string text(std::uint64_t length);
    void take(void* to, std::uint64_t bytes);

    /// So many lie ahead.
    void require(std::uint64_t bytes) const;

private:
    std::istream& in_;
    std::uint64_t size_ = 0, at_ = 0;
};

}  // namespace espalier::geometry

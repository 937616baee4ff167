// Bytes that are kept in a file until they are asked for again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::studio {

/// Several threads may write and read. The file is gone with the spool.
class Spool {
public:
    static constexpr std::uint64_t most_bytes = std::uint64_t(8) << 30;

    struct Place {
        std::uint64_t offset = 0, size = 0;
    };

    /// Throws RunError if the file cannot be made.
    explicit Spool(std::filesystem::path file);
    ~Spool();
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;

    /// Throws RunError if the disk is full, or the file would be longer than `most_bytes`.
    Place add(std::string_view bytes);
    std::string text(Place place) const;

    template <class T>
    Place add_all(std::span<const T> values) {
        return add({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
    }
    template <class Column>
    void read(Place place, Column& values) const {
        values.resize(place.size / sizeof(values[0]));
        read(place, reinterpret_cast<char*>(values.data()));
    }

private:
    void read(Place place, char* at) const;

    std::filesystem::path path_;
    mutable std::mutex mutex_;
    mutable std::fstream file_;
    std::uint64_t size_ = 0;
};

}  // namespace espalier::studio

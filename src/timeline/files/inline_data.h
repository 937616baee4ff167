// Arrays as VTK's XML files hold them inline: compressed blocks, written in base64.
#pragma once

#include "espalier/base/column.h"
#include "espalier/timeline/compression.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace espalier::timeline {

/// An array of a file, over memory that the caller keeps until the file is written.
struct DataArray {
    std::string name;
    const char* type = "";  ///< VTK's name of it, see vtk_type
    int components = 1;
    std::size_t tuple_bytes = 0;
    std::size_t tuples = 0;
    const void* values = nullptr;              ///< values of the tuples, or of the runs if there are any
    std::span<const std::uint32_t> ends = {};  ///< where runs of equal tuples end; empty: every tuple has its own value
    bool changed = true;                       ///< values or runs, since the file before

    std::size_t bytes() const { return tuples * tuple_bytes; }
};

template <class T>
constexpr const char* vtk_type() {
    if constexpr (std::is_same_v<T, char>) return "String";
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "UInt16";
    if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "UInt32";
    if constexpr (std::is_same_v<T, std::uint64_t>) return "UInt64";
}

/// An array over plain values, `components` of them a tuple.
template <class T>
DataArray data_array(std::string name, std::span<const T> values, int components = 1) {
    const auto width = static_cast<std::size_t>(components);
    return {std::move(name), vtk_type<T>(), components, sizeof(T) * width, values.size() / width, values.data(), {}};
}

/// Writes the array's data as VTK's readers expect them: the blocks' sizes, then the blocks.
void encode(const DataArray& array, Compression compression, Column<char>& text);

}  // namespace espalier::timeline

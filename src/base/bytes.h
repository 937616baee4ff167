// Plain values as bytes, in the machine's own byte order: checkpoints do not travel.
#pragma once

#include "espalier/base/error.h"

#include <algorithm>
#include <cstdint>
#include <istream>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace espalier {

template <class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T get(std::istream& in, T value = {}) {
    if (!in.read(reinterpret_cast<char*>(&value), sizeof value)) throw RunError("the checkpoint ends too early");
    return value;
}

/// As many plain values as are claimed, making room as they come: what is not in the file takes no memory. False if the
/// file ends too early.
template <class Values>
bool read_claimed(std::istream& in, Values& values, std::uint64_t claimed) {
    constexpr std::uint64_t at_once = (std::uint64_t{1} << 24) / sizeof(values[0]);
    values.clear();
    while (values.size() < claimed) {
        const std::size_t before = values.size();
        const std::size_t more = std::min(claimed - before, std::max<std::uint64_t>(at_once, before));
        values.resize(before + more);
        if (!in.read(reinterpret_cast<char*>(values.data() + before),
                     static_cast<std::streamsize>(more * sizeof(values[0])))) {
            return false;
        }
    }
    return true;
}

inline void put_text(std::ostream& out, const std::string& text) {
    put(out, static_cast<std::uint64_t>(text.size()));
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

/// Throws RunError if the text is longer than `most`.
inline std::string get_text(std::istream& in, std::uint64_t most) {
    const auto size = get<std::uint64_t>(in);
    if (size > most) throw RunError("the checkpoint is damaged");
    std::string text;
    if (!read_claimed(in, text, size)) throw RunError("the checkpoint ends too early");
    return text;
}

/// A vector of plain values, whatever its allocator.
template <class Values>
void put_column(std::ostream& out, const Values& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(values[0])));
}

template <class Values>
void get_column(std::istream& in, Values& values) {
    if (!read_claimed(in, values, get<std::uint64_t>(in))) throw RunError("a column ends too early");
}

/// Numbers without their count, which the reader knows.
inline void write_doubles(std::ostream& out, std::span<const double> values) {
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
}

inline void read_doubles(std::istream& in, std::span<double> values) {
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
    if (!in) throw RunError("the checkpoint ends too early");
}

inline void put_values(std::ostream& out, const std::vector<double>& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    write_doubles(out, values);
}

/// Throws RunError if there are not as many values as `values` holds.
inline void get_values(std::istream& in, std::vector<double>& values) {
    if (get<std::uint64_t>(in) != values.size()) throw RunError("the checkpoint belongs to another model");
    read_doubles(in, values);
}

}  // namespace espalier

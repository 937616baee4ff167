// VTK's XML files as the timeline writes them, read without VTK's own reader: that one trusts the counts in a file, and
// a damaged one brings the program down.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/error.h"

#include "archive/xml.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

namespace espalier::archive {

/// One of a file's arrays, its bytes as they were written.
struct VtkArray {
    std::string type;  ///< "Float32", "UInt64", ...
    std::size_t components = 1;
    std::vector<char> bytes;
};

/// A file's text, its elements, and its arrays by request. Whatever is wrong throws UserError naming the file.
class VtkXmlFile {
public:
    /// `type` is VTK's name of the kind of data set, "PolyData" or "ImageData".
    VtkXmlFile(const std::filesystem::path& path, const std::string& type);
    VtkXmlFile(const VtkXmlFile&) = delete;
    VtkXmlFile& operator=(const VtkXmlFile&) = delete;

    const XmlElement& data_set() const { return *data_set_; }
    const XmlElement& piece() const;
    /// An element below `parent`.
    const XmlElement& child(const XmlElement& parent, std::string_view name) const;
    /// A number that an element says of itself, such as NumberOfPoints.
    std::size_t count(const XmlElement& element, std::string_view attribute) const;

    /// Null if `section` holds no array of that name.
    static const XmlElement* find(const XmlElement& section, std::string_view name);
    VtkArray array(const XmlElement& element) const;
    /// The array's values, `count` tuples of as many T as it has components.
    template <class T>
    Column<T> values(const XmlElement& element, std::size_t count, std::size_t components = 1) const;
    /// The same, of the array of that name, which must be there.
    template <class T>
    Column<T> values(const XmlElement& section, std::string_view name, std::size_t count,
                     std::size_t components = 1) const;
    /// A string array of the data set's field data; empty if there is none.
    std::vector<std::string> texts(std::string_view name) const;

    [[noreturn]] void fail(const std::string& what) const;

private:
    const XmlElement& needed(const XmlElement& section, std::string_view name) const;

    std::filesystem::path path_;
    std::string text_;
    XmlElement root_;
    const XmlElement* data_set_ = nullptr;
};

namespace detail {

/// Values of type From, as T.
template <class From, class T>
void convert(const std::vector<char>& bytes, Column<T>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        From value;
        std::memcpy(&value, bytes.data() + i * sizeof(From), sizeof(From));
        values[i] = static_cast<T>(value);
    }
}

template <class T>
struct Conversion {
    std::string_view type;
    std::size_t size;
    void (*convert)(const std::vector<char>&, Column<T>&);
};

/// Whole numbers from whole numbers only: a fraction has no meaning there, and may not fit.
template <class T>
const Conversion<T>* conversion(std::string_view type) {
    static constexpr Conversion<T> all[] = {
        {"Int8", 1, convert<std::int8_t, T>},   {"UInt8", 1, convert<std::uint8_t, T>},
        {"Int16", 2, convert<std::int16_t, T>}, {"UInt16", 2, convert<std::uint16_t, T>},
        {"Int32", 4, convert<std::int32_t, T>}, {"UInt32", 4, convert<std::uint32_t, T>},
        {"Int64", 8, convert<std::int64_t, T>}, {"UInt64", 8, convert<std::uint64_t, T>},
    };
    for (const Conversion<T>& known : all) {
        if (known.type == type) return &known;
    }
    if constexpr (std::is_floating_point_v<T>) {
        static constexpr Conversion<T> floats[] = {{"Float32", 4, convert<float, T>},
                                                   {"Float64", 8, convert<double, T>}};
        for (const Conversion<T>& known : floats) {
            if (known.type == type) return &known;
        }
    }
    return nullptr;
}

}  // namespace detail

template <class T>
Column<T> VtkXmlFile::values(const XmlElement& element, std::size_t count, std::size_t components) const {
    const VtkArray raw = array(element);
    const auto* conversion = detail::conversion<T>(raw.type);
    const std::string& name = element.attribute("Name");
    if (!conversion || raw.components != components) {
        fail(fmt::format("array '{}' is of another type than a run writes", name));
    }
    if (raw.bytes.size() / conversion->size / components != count ||
        raw.bytes.size() % (conversion->size * components) != 0) {
        fail(fmt::format("array '{}' has not the {} values that are expected", name, count));
    }
    Column<T> values(count * components);
    conversion->convert(raw.bytes, values);
    return values;
}

template <class T>
Column<T> VtkXmlFile::values(const XmlElement& section, std::string_view name, std::size_t count,
                             std::size_t components) const {
    return values<T>(needed(section, name), count, components);
}

}  // namespace espalier::archive

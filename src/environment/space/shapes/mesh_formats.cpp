#include "environment/space/shapes/mesh_formats.h"

#include "base/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

namespace espalier::environment {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

/// Takes the first word off `text`; empty at the end.
std::string_view take_word(std::string_view& text) {
    const auto begin = std::find_if_not(text.begin(), text.end(), is_blank);
    const auto end = std::find_if(begin, text.end(), is_blank);
    const std::string_view word = text.substr(std::size_t(begin - text.begin()), std::size_t(end - begin));
    text.remove_prefix(std::size_t(end - text.begin()));
    return word;
}

/// Whether a word is this keyword, in letters of either size.
bool is_keyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

/// "nan" and "inf" are numbers here: what to think of them is the caller's.
double number_of(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = read_number(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return std::nan("");
    if (error != std::errc() || end != word.data() + word.size()) {
        throw MeshFormatError(word.empty() ? std::string("it ends where a number is expected")
                                           : fmt::format("'{}' is not a number", word.substr(0, 40)));
    }
    return value;
}

glm::dvec3 take_point(std::string_view& text) {
    glm::dvec3 point;
    for (int i = 0; i < 3; ++i) point[i] = number_of(take_word(text));
    return point;
}

/// A number laid out in bytes, of the type of `T`.
template <class T>
double take_binary(std::string_view& bytes, std::endian order) {
    if (bytes.size() < sizeof(T)) throw MeshFormatError("it ends too early");
    char raw[sizeof(T)];
    std::copy_n(bytes.data(), sizeof(T), raw);
    if (order != std::endian::native) std::reverse(std::begin(raw), std::end(raw));
    bytes.remove_prefix(sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return static_cast<double>(value);
}

// --- PLY (Turk 1994) ----------------------------------------------------------------------------------

using TakeBinary = double (*)(std::string_view&, std::endian);

TakeBinary ply_type(std::string_view name) {
    if (name == "char" || name == "int8") return take_binary<std::int8_t>;
    if (name == "uchar" || name == "uint8") return take_binary<std::uint8_t>;
    if (name == "short" || name == "int16") return take_binary<std::int16_t>;
    if (name == "ushort" || name == "uint16") return take_binary<std::uint16_t>;
    if (name == "int" || name == "int32") return take_binary<std::int32_t>;
    if (name == "uint" || name == "uint32") return take_binary<std::uint32_t>;
    if (name == "float" || name == "float32") return take_binary<float>;
    if (name == "double" || name == "float64") return take_binary<double>;
    throw MeshFormatError(fmt::format("'{}' is no type of a PLY property", name.substr(0, 40)));
}

struct PlyProperty {
    TakeBinary count = nullptr;  ///< reads the count of a list; null for a single value
    TakeBinary value = nullptr;
    std::string_view name;
};

struct PlyElement {
    std::string_view name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    std::optional<std::endian> order;  ///< none: text
    std::vector<PlyElement> elements;
};

std::optional<std::endian> ply_format(std::string_view name) {
    if (name == "ascii") return std::nullopt;
    if (name == "binary_little_endian") return std::endian::little;
    if (name == "binary_big_endian") return std::endian::big;
    throw MeshFormatError(fmt::format("'{}' is no format of PLY", name.substr(0, 40)));
}

PlyProperty ply_property(std::string_view line) {
    PlyProperty property;
    std::string_view type = take_word(line);
    if (type == "list") {
        property.count = ply_type(take_word(line));
        type = take_word(line);
    }
    property.value = ply_type(type);
    property.name = take_word(line);
    return property;
}

PlyHeader take_ply_header(std::string_view& bytes) {
    std::string_view first = take_line(bytes);
    if (take_word(first) != "ply") throw MeshFormatError("it does not begin with 'ply'");
    PlyHeader header;
    bool has_format = false;
    while (!bytes.empty()) {
        std::string_view line = take_line(bytes);
        const std::string_view keyword = take_word(line);
        if (keyword == "end_header") {
            if (!has_format) throw MeshFormatError("its header has no format");
            return header;
        }
        if (keyword == "format") {
            header.order = ply_format(take_word(line));
            has_format = true;
        } else if (keyword == "element") {
            const std::string_view name = take_word(line);
            const double count = number_of(take_word(line));
            if (!(count >= 0 && count < 4e9)) throw MeshFormatError(fmt::format("it claims {:g} elements", count));
            header.elements.push_back({name, static_cast<std::size_t>(count), {}});
        } else if (keyword == "property") {
            if (header.elements.empty()) throw MeshFormatError("a property comes before any element");
            header.elements.back().properties.push_back(ply_property(line));
        }
    }
    throw MeshFormatError("its header has no end");
}

class PlyBody {
public:
    PlyBody(std::string_view bytes, std::optional<std::endian> order) : bytes_(bytes), order_(order) {}

    PolygonMesh read(const std::vector<PlyElement>& elements) {
        for (const PlyElement& element : elements) {
            if (element.properties.empty()) continue;
            for (std::size_t i = 0; i < element.count; ++i) read_element(element);
        }
        return std::move(mesh_);
    }

private:
    void read_element(const PlyElement& element) {
        const bool vertex = element.name == "vertex", face = element.name == "face";
        glm::dvec3 point(0);
        for (const PlyProperty& property : element.properties) {
            if (property.count) {
                read_list(property, face && (property.name == "vertex_indices" || property.name == "vertex_index"));
                continue;
            }
            const double value = take(property.value);
            if (property.name == "x") point.x = value;
            if (property.name == "y") point.y = value;
            if (property.name == "z") point.z = value;
        }
        if (vertex) mesh_.points.push_back(point);
    }

    void read_list(const PlyProperty& property, bool is_polygon) {
        const double count = take(property.count);
        if (!(count >= 0 && count < 1e6)) throw MeshFormatError(fmt::format("a list claims {:g} values", count));
        for (int i = 0; i < static_cast<int>(count); ++i) {
            const double value = take(property.value);
            if (is_polygon) mesh_.corners.push_back(std::abs(value) < 1e15 ? static_cast<std::int64_t>(value) : -1);
        }
        if (is_polygon) mesh_.ends.push_back(mesh_.corners.size());
    }

    double take(TakeBinary binary) { return order_ ? binary(bytes_, *order_) : number_of(take_word(bytes_)); }

    std::string_view bytes_;
    std::optional<std::endian> order_;
    PolygonMesh mesh_;
};

// --- STL ------------------------------------------------------------------------------------------------

void add_triangle(PolygonMesh& mesh) {
    for (int i = 0; i < 3; ++i) mesh.corners.push_back(static_cast<std::int64_t>(mesh.points.size()) - 3 + i);
    mesh.ends.push_back(mesh.corners.size());
}

PolygonMesh parse_binary_stl(std::string_view bytes) {
    bytes.remove_prefix(80);
    const auto count = static_cast<std::size_t>(take_binary<std::uint32_t>(bytes, std::endian::little));
    if (bytes.size() < 50 * count) throw MeshFormatError(fmt::format("it is too short for its {} triangles", count));
    PolygonMesh mesh;
    for (std::size_t triangle = 0; triangle < count; ++triangle) {
        bytes.remove_prefix(12);  // the normal; the corners say the same
        for (int corner = 0; corner < 3; ++corner) {
            glm::dvec3 point;
            for (int i = 0; i < 3; ++i) point[i] = take_binary<float>(bytes, std::endian::little);
            mesh.points.push_back(point);
        }
        bytes.remove_prefix(2);  // attributes
        add_triangle(mesh);
    }
    return mesh;
}

PolygonMesh parse_text_stl(std::string_view text) {
    PolygonMesh mesh;
    bool ended = false;
    while (!text.empty()) {
        std::string_view line = take_line(text);
        const std::string_view keyword = take_word(line);
        ended |= is_keyword(keyword, "endsolid");
        if (!is_keyword(keyword, "vertex")) continue;
        mesh.points.push_back(take_point(line));
        if (mesh.points.size() % 3 == 0) add_triangle(mesh);
    }
    if (!ended) throw MeshFormatError("it has no 'endsolid'");
    return mesh;
}

}  // namespace

PolygonMesh parse_stl(std::string_view bytes) {
    // Some binary files begin with "solid" too; those whose length fits their count are binary.
    constexpr std::size_t head = 84;
    if (bytes.size() >= head) {
        std::string_view count = bytes.substr(80, 4);
        const double triangles = take_binary<std::uint32_t>(count, std::endian::little);
        if (static_cast<double>(bytes.size() - head) == 50 * triangles) return parse_binary_stl(bytes);
    }
    std::string_view text = bytes;
    if (is_keyword(take_word(text), "solid")) return parse_text_stl(bytes);
    if (bytes.size() < head) throw MeshFormatError("it is neither a text nor a binary STL");
    return parse_binary_stl(bytes);
}

PolygonMesh parse_ply(std::string_view bytes) {
    const PlyHeader header = take_ply_header(bytes);
    return PlyBody(bytes, header.order).read(header.elements);
}

}  // namespace espalier::environment

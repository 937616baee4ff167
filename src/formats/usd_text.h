// Values and prims of USD as text.
#pragma once

#include "archive/meshes/surface_mesh.h"
#include "formats/colour.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace espalier::formats::usd {

/// An attribute's value at each frame, as text.
class Samples {
public:
    /// `declaration` is as in "point3f[] points"; `metadata` may be "".
    Samples(std::string declaration, std::string metadata)
        : declaration_(std::move(declaration)), metadata_(std::move(metadata)) {}

    void add(int step, std::string value);
    void append_to(std::string& text, std::size_t indent = 12) const;

private:
    std::string declaration_, metadata_;
    std::vector<std::pair<int, std::string>> values_;
};

template <class Range, class Format>
std::string list(const Range& range, const Format& format) {
    std::string text = "[";
    for (const auto& value : range) {
        if (text.size() > 1) text += ", ";
        format(text, value);
    }
    return text + "]";
}

inline void put_vector(std::string& text, const glm::vec3& v) {
    fmt::format_to(std::back_inserter(text), "({}, {}, {})", v.x, v.y, v.z);
}

std::string numbers(const auto& range) {
    return list(range,
                [](std::string& text, const auto& value) { fmt::format_to(std::back_inserter(text), "{}", value); });
}

std::string vectors(const std::vector<glm::vec3>& range);
/// Writes the values of a quath[]: w first.
std::string turns_as_text(const std::vector<glm::quat>& range);
std::string places(const std::vector<glm::vec2>& uvs);
std::string colours(const std::vector<Rgb>& range);
std::string corners(const std::vector<std::array<std::uint32_t, 3>>& triangles);
std::string extent(const std::vector<glm::vec3>& points, float margin);
const char* visibility(bool visible);

}  // namespace espalier::formats::usd

#include "formats/usd_text.h"

#include <glm/common.hpp>

namespace espalier::formats::usd {

void Samples::add(int step, std::string value) {
    // Between three equal ones the middle one says nothing.
    const std::size_t count = values_.size();
    if (count >= 2 && values_[count - 1].second == value && values_[count - 2].second == value) values_.pop_back();
    values_.emplace_back(step, std::move(value));
}

void Samples::append_to(std::string& text, std::size_t indent) const {
    const std::string margin(indent, ' ');
    const auto add = [&](fmt::string_view format, const auto&... values) {
        fmt::vformat_to(std::back_inserter(text), fmt::format("{}{}\n", margin, format),
                        fmt::make_format_args(values...));
    };
    const std::string metadata =
        metadata_.empty() ? "" : fmt::format(" (\n{0}    interpolation = \"{1}\"\n{0})", margin, metadata_);
    if (values_.size() == 1) return add("{} = {}{}", declaration_, values_[0].second, metadata);
    add("{}.timeSamples = {{", declaration_);
    for (const auto& [step, value] : values_) add("    {}: {},", step, value);
    text += margin + "}\n";
    // For programs that know no time: what there is at the end. The reader of three.js 0.187 forgets what it is told of
    // an attribute before its samples, and would show the first of them, which is often nothing.
    add("{} = {}{}", declaration_, values_.back().second, metadata);
}

std::string vectors(const std::vector<glm::vec3>& range) {
    return list(range, put_vector);
}

std::string turns_as_text(const std::vector<glm::quat>& range) {
    return list(range, [](std::string& text, const glm::quat& q) {
        fmt::format_to(std::back_inserter(text), "({}, {}, {}, {})", q.w, q.x, q.y, q.z);
    });
}

std::string places(const std::vector<glm::vec2>& uvs) {
    return list(uvs, [](std::string& text, const glm::vec2& uv) {
        fmt::format_to(std::back_inserter(text), "({}, {})", uv.x, uv.y);
    });
}

std::string colours(const std::vector<Rgb>& range) {
    return list(range, [](std::string& text, const Rgb& rgb) { put_vector(text, linear_light(rgb)); });
}

std::string corners(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    return list(triangles, [](std::string& text, const auto& corners) {
        fmt::format_to(std::back_inserter(text), "{}, {}, {}", corners[0], corners[1], corners[2]);
    });
}

std::string extent(const std::vector<glm::vec3>& points, float margin) {
    if (points.empty()) return "[(0, 0, 0), (0, 0, 0)]";
    glm::vec3 lower = points.front(), upper = lower;
    for (const glm::vec3& point : points) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    return vectors({lower - margin, upper + margin});
}

const char* visibility(bool visible) {
    return visible ? "\"inherited\"" : "\"invisible\"";
}

}  // namespace espalier::formats::usd

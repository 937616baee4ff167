#include "studio/packets/packet_parts.h"

#include "studio/packets/message_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace espalier::studio {
namespace {

constexpr std::size_t most_label = 200;  ///< bytes

Normal normal_of(const glm::dvec3& v) {
    const auto part = [](double x) { return static_cast<std::int8_t>(std::lround(127 * std::clamp(x, -1.0, 1.0))); };
    return {part(v.x), part(v.y), part(v.z), 0};
}

void put_textures(const PacketParts& parts, MessageBytes& out) {
    struct Range {
        std::uint32_t texture, first, count;  ///< indices
    };
    std::vector<Range> ranges;
    const std::vector<std::uint32_t>& textures = parts.triangles.textures;
    for (std::uint32_t i = 0; i < textures.size(); ++i) {
        if (textures[i] == 0) continue;
        if (ranges.empty() || ranges.back().texture != textures[i]) ranges.push_back({textures[i], 3 * i, 0});
        ranges.back().count += 3;
    }
    const bool has_limbs =
        std::any_of(parts.limb_textures.begin(), parts.limb_textures.end(), [](auto t) { return t > 0; });
    std::vector<std::uint16_t> of_limbs;
    if (has_limbs) {
        of_limbs = parts.limb_textures;
        of_limbs.resize((parts.internodes.size() + 1) / 2 * 2);  // a multiple of 4 bytes
    }
    out.put(static_cast<std::uint32_t>(ranges.size()), static_cast<std::uint32_t>(parts.labels.size()),
            static_cast<std::uint32_t>(has_limbs));
    out.put_all(std::span<const Range>(ranges));
    if (!ranges.empty()) out.put_all(std::span(parts.triangles.uvs));
    out.put_all(std::span<const std::uint16_t>(of_limbs));
}

void put_labels(const std::vector<ShownLabel>& labels, MessageBytes& out) {
    for (const ShownLabel& label : labels) {
        out.put(label.position, label.colour, label.module);
        out.put_text(label.text->substr(0, most_label));
    }
}

}  // namespace

Point point_of(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::uint32_t Triangles::add(const SurfaceVertex& vertex, Rgba colour, std::uint32_t module) {
    points.push_back(point_of(vertex.position));
    normals.push_back(normal_of(vertex.normal));
    colours.push_back(colour);
    uvs.push_back({static_cast<float>(vertex.uv.x), static_cast<float>(vertex.uv.y)});
    modules.push_back(module);
    return static_cast<std::uint32_t>(points.size() - 1);
}

void Triangles::sort() {
    set_texture(0);
    if (std::is_sorted(textures.begin(), textures.end())) return;
    std::vector<std::uint32_t> order(textures.size()), sorted;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return textures[a] < textures[b]; });
    for (const std::uint32_t triangle : order) {
        for (std::size_t k = 0; k < 3; ++k) sorted.push_back(indices[3 * std::size_t{triangle} + k]);
    }
    indices = std::move(sorted);
    std::sort(textures.begin(), textures.end());
}

std::string column_message(std::uint32_t growth, int step, const std::string& name, std::span<const float> values) {
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    for (const float value : values) {
        if (std::isnan(value)) continue;
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    if (lowest > highest) lowest = highest = 0;
    MessageBytes out("ESC1");
    out.put(growth, static_cast<std::int32_t>(step), static_cast<std::uint32_t>(values.size()), lowest, highest);
    out.put_text(name);
    out.put_all(values);
    return out.take();
}

float number_in(const std::string& column_message, std::size_t module) {
    constexpr std::size_t count_at = 12;
    std::uint32_t count = 0;
    std::memcpy(&count, column_message.data() + count_at, sizeof count);
    if (module >= count) return no_number;
    float value = no_number;
    std::memcpy(&value, column_message.data() + column_message.size() - sizeof value * (count - module), sizeof value);
    return value;
}

std::string PacketParts::bytes(std::uint32_t growth, int step) const {
    const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    const Box box = extent.box.empty() ? Box{glm::dvec3(0), glm::dvec3(0)} : extent.box;
    MessageBytes out("ESP1");
    std::size_t in_groups = 0;
    for (const auto& [shape, group] : groups) in_groups += 8 + 56 * group.places.size();
    out.reserve(128 + 4 * first_modules.size() + 24 * internodes.size() + 28 * triangles.points.size() +
                4 * triangles.indices.size() + in_groups);
    out.put(growth, static_cast<std::int32_t>(step), count(first_modules), count(internodes), count(triangles.points),
            count(triangles.indices), count(groups), point_of(box.lower), point_of(box.upper),
            static_cast<float>(extent.radius));
    out.put_all(std::span(first_modules));
    out.put_all(std::span(internodes));
    out.put_all(std::span(triangles.points));
    out.put_all(std::span(triangles.normals));
    out.put_all(std::span(triangles.colours));
    out.put_all(std::span(triangles.modules));
    out.put_all(std::span(triangles.indices));
    for (const auto& [shape, group] : groups) {
        out.put(shape, count(group.places));
        out.put_all(std::span(group.places));
        out.put_all(std::span(group.colours));
        out.put_all(std::span(group.modules));
    }
    put_textures(*this, out);
    put_labels(labels, out);
    return out.take();
}

std::string PacketParts::of_step(int step, std::string bytes) {
    constexpr std::size_t place = 4 + sizeof(std::uint32_t);  // behind the letters and the growth
    const auto number = static_cast<std::int32_t>(step);
    return bytes.replace(place, sizeof number, reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace espalier::studio

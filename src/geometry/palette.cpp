#include "espalier/geometry/palette.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::geometry {
namespace {

constexpr int set_size = 256;
constexpr std::size_t bytes_of_colour = 3, bytes_of_material = 15;

/// Three bytes from `at` as shares of 255.
glm::dvec4 colour_at(const std::string& bytes, std::size_t at, double opacity) {
    const auto share = [&](std::size_t i) { return static_cast<unsigned char>(bytes[at + i]) / 255.0; };
    return {share(0), share(1), share(2), opacity};
}

std::string read_bytes(const std::filesystem::path& path, std::size_t entry, const char* what) {
    std::string bytes = read_text(path);
    if (bytes.size() >= entry) return bytes;
    throw UserError(fmt::format("{} is no {}: it has {} bytes, fewer than one entry's {}", path.string(), what,
                                bytes.size(), entry));
}

}  // namespace

Material Palette::material(int colour) const {
    const int index = colour < set_size ? set_size + colour : colour;
    if (const auto found = entries.find(index); found != entries.end()) return found->second;
    Material material;
    const auto of_set = entries.lower_bound(index - index % set_size);
    const bool given = of_set != entries.end() && of_set->first / set_size == index / set_size;
    if (!given) material.diffuse = {200 / 255.0, 200 / 255.0, 200 / 255.0, 1};
    return material;
}

void read_colour_map(const std::filesystem::path& path, int set, Palette& palette) {
    const std::string bytes = read_bytes(path, bytes_of_colour, "colour map");
    palette.of_materials = false;
    const int count = int(std::min(std::size_t(set_size), bytes.size() / bytes_of_colour));
    for (int i = 0; i < count; ++i) {
        Material material;
        material.diffuse = colour_at(bytes, std::size_t(i) * bytes_of_colour, 1);
        palette.entries[set * set_size + i] = material;
    }
}

std::array<std::uint8_t, 3> shown_colour(const Material& material) {
    std::array<std::uint8_t, 3> colour{};
    for (int k = 0; k < 3; ++k) {
        const double light = std::clamp(material.diffuse[k] + material.emissive[k], 0.0, 1.0);
        colour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(255 * light));
    }
    return colour;
}

void read_materials(const std::filesystem::path& path, int set, Palette& palette) {
    const std::string bytes = read_bytes(path, bytes_of_material, "material file");
    palette.of_materials = true;
    for (std::size_t at = 0; at + bytes_of_material <= bytes.size(); at += bytes_of_material) {
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[at + i]); };
        const double opacity = 1 - byte(1) / 255.0;
        Material material;
        material.ambient = colour_at(bytes, at + 2, opacity);
        material.diffuse = colour_at(bytes, at + 5, opacity);
        material.emissive = colour_at(bytes, at + 8, opacity);
        material.specular = colour_at(bytes, at + 11, opacity);
        material.shininess = byte(14);
        palette.entries[set * set_size + byte(0)] = material;
    }
}

}  // namespace espalier::geometry

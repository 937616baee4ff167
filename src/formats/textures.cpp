#include "formats/textures.h"

#include "espalier/base/file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace espalier::formats {
namespace {

// What OBJ and USD take within a name without quoting it.
std::string plain(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) { return !(std::isalnum(c) || c == '-' || c == '_' || c == '.'); }, '_');
    return name;
}

const char* suffix_of(TextureMap map) {
    return map == TextureMap::colours ? "" : map == TextureMap::normals ? "-normal" : "-height";
}

}  // namespace

std::string material_name(const MeshMaterial& material) {
    const auto [red, green, blue] = material.rgb;
    const std::string colour = fmt::format("rgb_{:02x}{:02x}{:02x}", red, green, blue);
    if (material.texture.empty()) return colour;
    return fmt::format("{}_{}", colour, plain(std::filesystem::path(material.texture).stem().string()));
}

bool is_transparent(const std::string& png) {
    constexpr std::size_t colour_type = 25;  // bit 2: there is an alpha channel
    return png.size() > colour_type && (png[colour_type] & 4) != 0;
}

std::string hint_of_missing(const std::vector<std::string>& textures) {
    if (textures.empty()) return "";
    return fmt::format(
        "no picture is in the texture file{} '{}': what wears it has its colour alone; put the file there, as a path "
        "or "
        "beside the run",
        textures.size() > 1 ? "s" : "", fmt::join(textures, "', '"));
}

std::string joined_hints(const std::vector<std::string>& hints) {
    std::string text;
    for (const std::string& hint : hints) {
        if (!hint.empty()) text += (text.empty() ? "" : "\n") + hint;
    }
    return text;
}

const TextureCopy& TextureCopies::copy(const std::string& file, TextureMap map) {
    const auto [at, is_new] = copies_.emplace(std::pair(file, map), TextureCopy());
    if (!is_new || file.empty()) return at->second;
    const std::string png = png_of(job_.run.folder(), file, map);
    if (png.empty()) {
        if (map == TextureMap::colours) missing_.push_back(file);
        return at->second;
    }
    const std::string name = free_name(std::filesystem::path(file).stem().string() + suffix_of(map), png);
    write_text(job_.folder / name, png);
    return at->second = {name, is_transparent(png)};
}

const TextureCopy& TextureCopies::add(const std::string& file, const std::string& png) {
    const std::string name = plain(fmt::format("{}-{}.png", job_.name, file));
    write_text(job_.folder / name, png);
    return copies_[{file, TextureMap::colours}] = {name, is_transparent(png)};
}

std::string TextureCopies::free_name(const std::string& stem, const std::string& png) const {
    const auto is_taken = [&](const std::string& name) {
        const bool is_ours =
            std::any_of(copies_.begin(), copies_.end(), [&](const auto& known) { return known.second.name == name; });
        if (is_ours || !job_.keep || !std::filesystem::exists(job_.folder / name)) return is_ours;
        return read_text(job_.folder / name) != png;
    };
    std::string name = plain(fmt::format("{}-{}.png", job_.run.scene(), stem));
    for (int number = 2; is_taken(name); ++number)
        name = plain(fmt::format("{}-{}-{}.png", job_.run.scene(), stem, number));
    return name;
}

}  // namespace espalier::formats

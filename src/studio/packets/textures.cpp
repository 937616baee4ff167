#include "studio/packets/textures.h"

#include "espalier/base/file.h"
#include "espalier/base/read_log.h"

#include "archive/meshes/bark.h"
#include "formats/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

bool is_shown_by_browsers(const fs::path& file) {
    const std::string extension = file.extension().string();
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

// Changes with a picture, without reading it.
std::uint64_t digest_of_file(const fs::path& file, std::uint64_t before) {
    std::error_code ignored;
    const auto written = fs::last_write_time(file, ignored).time_since_epoch().count();
    return digest(fmt::format("{} {} {}", file.string(), fs::file_size(file, ignored), written), before);
}

// Returns the digest of all that decides what the picture looks like.
std::uint64_t digest_of(const fs::path& file) {
    if (!is_bark(file.string())) return digest_of_file(file, digest(""));
    const Bark bark = read_bark(file);
    std::uint64_t result = digest(read_text(file));
    for (const std::optional<fs::path>& picture : {bark.heights, bark.picture}) {
        if (picture) result = digest_of_file(*picture, result);
    }
    return result;
}

fs::path written(const fs::path& place, const fs::path& file, formats::TextureMap map) {
    std::error_code ignored;
    if (fs::exists(place, ignored)) return place;
    const std::string png = formats::png_of({}, file.string(), map);
    if (png.empty()) return {};
    write_text(place, png);
    return place;
}

void require_readable_if_there(const fs::path& file) {
    std::error_code ignored;
    if (fs::exists(file, ignored)) require_readable(file);
}

void note_texture_file(const fs::path& file) {
    require_readable_if_there(file);
    if (!is_bark(file.string()) || !is_readable(file)) return;
    const Bark bark = read_bark(file);
    for (const std::optional<fs::path>& picture : {bark.heights, bark.picture}) {
        if (picture) require_readable_if_there(*picture);
    }
}

}  // namespace

void note_texture_files(const Scene& scene) {
    for (const Plant& plant : scene.plants) {
        if (!plant.turtle.shapes) continue;
        for (const Texture& texture : plant.turtle.shapes->textures) note_texture_file(texture.file);
    }
}

std::uint32_t BrowserTextures::number(const fs::path& file) {
    const auto known =
        std::find_if(pictures_.begin(), pictures_.end(), [&](const BrowserTexture& one) { return one.file == file; });
    const auto number = static_cast<std::uint32_t>(known - pictures_.begin()) + 1;
    if (known == pictures_.end()) pictures_.push_back(texture_of(file));
    return number;
}

BrowserTexture BrowserTextures::texture_of(const fs::path& file) const {
    if (!fs::is_regular_file(file)) return {file, {}, {}};
    if (is_shown_by_browsers(file)) return {file, file, {}};
    const std::string name = fmt::format("picture-{:016x}", digest_of(file));
    return {file, written(folder_ / (name + ".png"), file, formats::TextureMap::colours),
            written(folder_ / (name + "-normal.png"), file, formats::TextureMap::normals)};
}

}  // namespace espalier::studio

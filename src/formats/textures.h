// Textures of a run as PNG, which every program reads.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace espalier::formats {

/// What a texture says of a surface.
enum class TextureMap { colours, normals, heights };

/// The picture of a texture's file as the bytes of a .png; "" if it is gone or no picture, or has no relief: what wears
/// it then has its own colour, or is flat. Normals are those of tangent space.
std::string png_of(const std::filesystem::path& run, const std::string& file, TextureMap map = TextureMap::colours);

/// What a material looks like, as a name: "rgb_7a5c3e", with the name of its texture's file behind it.
std::string material_name(const MeshMaterial& material);

/// Whether the bytes of a PNG have an alpha channel.
bool is_transparent(const std::string& png);

/// What to say of textures that are gone or no pictures; "" if there are none.
std::string hint_of_missing(const std::vector<std::string>& textures);

/// Those that say something, a line each.
std::string joined_hints(const std::vector<std::string>& hints);

struct TextureCopy {
    std::string name{};  ///< "SCENE-NAME.png", with "-normal" or "-height"; "" where `png_of` gives nothing
    bool is_transparent = false;
};

/// Copies textures beside what a job writes, each once.
class TextureCopies {
public:
    explicit TextureCopies(const ExportJob& job) : job_(job) {}

    /// Throws RunError.
    const TextureCopy& copy(const std::string& file, TextureMap map = TextureMap::colours);
    /// Writes a picture that is in no file yet as "NAME-FILE.png", with the name of the job; it is the texture `file`
    /// from now on. Throws RunError.
    const TextureCopy& add(const std::string& file, const std::string& png);
    /// Names the textures that were asked for and are missing.
    std::string hint() const { return hint_of_missing(missing_); }

private:
    std::string free_name(const std::string& stem, const std::string& png) const;

    const ExportJob& job_;
    std::map<std::pair<std::string, TextureMap>, TextureCopy> copies_;
    std::vector<std::string> missing_;
};

}  // namespace espalier::formats

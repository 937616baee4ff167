// Textures of a run as PNG, which every program reads.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace espalier::formats {

/// The file's picture as the bytes of a .png; "" if it is gone or no picture: what wears it then has its own colour.
std::string png_of(const std::filesystem::path& run, const std::string& file);

/// What a material looks like, as a name: "rgb_7a5c3e", with the name of its texture's file behind it.
std::string material_name(const MeshMaterial& material);

/// Whether the bytes of a PNG have an alpha channel.
bool is_transparent(const std::string& png);

/// What to say of textures that are gone or no pictures; "" if there are none.
std::string hint_of_missing(const std::vector<std::string>& textures);

/// Those that say something, a line each.
std::string joined_hints(const std::vector<std::string>& hints);

struct TextureCopy {
    std::string name{};  ///< "SCENE-NAME.png"; "" for no texture and for one that is no picture
    bool is_transparent = false;
};

/// Copies textures beside what a job writes, each once.
class TextureCopies {
public:
    explicit TextureCopies(const ExportJob& job) : job_(job) {}

    /// Throws RunError.
    const TextureCopy& copy(const std::string& file);
    /// Of those that were asked for and are missing.
    std::string hint() const { return hint_of_missing(missing_); }

private:
    std::string free_name(const std::string& file, const std::string& png) const;

    const ExportJob& job_;
    std::map<std::string, TextureCopy> copies_;
    std::vector<std::string> missing_;
};

}  // namespace espalier::formats

// Textures of a run as PNG, which every program reads.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"

#include <filesystem>
#include <map>
#include <string>

namespace espalier::formats {

/// The file's picture as the bytes of a .png; "" if it is gone or no picture: what wears it then has its own colour.
std::string png_of(const std::filesystem::path& run, const std::string& file);

/// What a material looks like, as a name: "rgb_7a5c3e", with the name of its texture's file behind it.
std::string material_name(const MeshMaterial& material);

/// Copies textures beside what a job writes, each once.
class TextureCopies {
public:
    explicit TextureCopies(const ExportJob& job) : job_(job) {}

    /// The copy's name, "SCENE-NAME.png"; "" for no texture and for one that is no picture. Throws RunError.
    const std::string& name(const std::string& file);

private:
    const ExportJob& job_;
    std::map<std::string, std::string> names_;
};

}  // namespace espalier::formats

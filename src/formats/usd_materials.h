// Materials of a USD file: one for each texture and colour that goes with it, and one for all else.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"
#include "formats/textures.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace espalier::formats {

class UsdMaterials {
public:
    /// The material of what wears no texture: it has its displayColor.
    static constexpr const char* of_colours = "colours";

    explicit UsdMaterials(const ExportJob& job) : copies_(job) {}

    /// The name of its prim below /world/materials; "" for what has no texture, or one that is no picture.
    const std::string& name(const MeshMaterial& look);
    /// The scope of all that were asked for: a UsdPreviewSurface each, whose picture is read by `st` and times the
    /// colour.
    void append_to(std::string& text) const;
    /// Of textures that are missing.
    std::string hint() const { return copies_.hint(); }

private:
    TextureCopies copies_;
    std::map<MeshMaterial, std::string> names_;
    std::vector<std::pair<const MeshMaterial*, std::string>> looks_;  ///< by number, with the copied picture
};

}  // namespace espalier::formats

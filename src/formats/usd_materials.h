// Materials of a USD file: one for each colour, and for each texture and colour that goes with it; and one for curves,
// whose colour may change from point to point. Some programs take one displayColor for a whole mesh.
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
    /// The material of curves: it has their displayColor.
    static constexpr const char* of_colours = "colours";

    explicit UsdMaterials(const ExportJob& job) : run_(job.run), copies_(job) {}

    /// A picture that is in no file yet; materials name it by `texture`. Throws RunError.
    void add_picture(const std::string& texture, const std::string& png) { copies_.add(texture, png); }
    /// The name of its prim below /world/materials.
    const std::string& name(const MeshMaterial& look);
    /// The scope of all that were asked for: a UsdPreviewSurface each, whose picture is read by `st` and times the
    /// colour.
    void append_to(std::string& text) const;
    /// Names the textures that are missing.
    std::string hint() const { return copies_.hint(); }

private:
    std::string surface(const MeshMaterial& look, bool has_picture) const;
    static std::string relief(const std::string& name, const std::string& normals);

    const RecordedRun& run_;
    TextureCopies copies_;
    std::map<MeshMaterial, std::string> names_;
    struct Look {
        const MeshMaterial* look;
        std::string picture, normals;  ///< copies, or ""
    };
    std::vector<Look> looks_;  ///< by number
};

}  // namespace espalier::formats

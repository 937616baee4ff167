// A frame as what stands in the light of a traced picture.
#pragma once

#include "espalier/archive/recorded_run.h"

#include "archive/meshes/surface_mesh.h"
#include "picture/light/lit_scene.h"
#include "picture/stage/stage_mesh.h"

#include <span>
#include <string>

namespace espalier::picture {

/// What a mesh looks like.
struct LitDress {
    std::span<const Rgb> colours;         ///< one for each point of the frame
    std::string texture;                  ///< a file; "": none
    bool has_colours_of_texture = false;  ///< or those of the points are multiplied with them
    bool has_materials = true;            ///< what glows or is seen through does so
};

/// The mesh must outlive it. Files that are no pictures are left out, as `texture_image` says.
LitPart lit_part(const RecordedRun& run, const StageMesh& mesh, const LitDress& dress);

/// What stands around the plants.
LitPart lit_background(const RecordedBackground& background);

}  // namespace espalier::picture

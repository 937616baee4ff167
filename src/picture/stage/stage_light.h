// The lights of a stage, and how what stands on it takes them.
#pragma once

#include "picture/palette.h"
#include "picture/stage/sky_visibility.h"
#include "picture/stage/stage_mesh.h"

#include <glm/vec3.hpp>
#include <vtkActor.h>
#include <vtkRenderer.h>

#include <vector>

namespace espalier::picture {

/// The sun, the sky above, and a little light from where one looks. `sun`: the unit vector to it.
void set_lights(vtkRenderer& renderer, const glm::vec3& sun);

struct MeshDress {
    const std::vector<Rgb>& colours;  ///< colours of the frame's points
    const SkyVisibility* visibility;  ///< null: no shadows
    float shade;                      ///< how much shadows darken: 1 as much as they do, 0 not at all
    bool lit;
};

/// Gives an actor a mesh, its colours with their shadows, and its material.
void dress_actor(vtkActor& actor, const StageMesh& mesh, const MeshDress& dress);

}  // namespace espalier::picture

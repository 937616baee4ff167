// The ground that plants stand on: a disc that fades away, with their shadows.
#pragma once

#include "espalier/picture/picture_style.h"

#include "picture/stage/sky_visibility.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

namespace espalier::picture {

/// Opacity of a ground through which roots are seen, where there is more of them than the foot of a trunk.
inline constexpr float clear_ground = 0.5F;

/// At height 0, round a middle. `visibility`: whose shadows lie on it; null: none. `opacity`: in the middle.
vtkSmartPointer<vtkActor> ground_actor(const glm::dvec3& middle, double radius, const SkyVisibility* visibility,
                                       const PictureBackground& background, float opacity = 1);

/// The colour of the ground, from 0 to 255: it suits the background.
std::array<float, 3> soil_of(const PictureBackground& background);

/// How bright something is, as a share of what it would be in the open.
float brightness(float sky, float sun);

}  // namespace espalier::picture

// Pictures as the author of a model saw it: what its view file says of camera and light.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/stations.h"
#include "espalier/picture/picture_style.h"

namespace espalier::picture {

/// From where its author looked at the plant; everything fits.
CameraPlace camera_of(const RecordedView& view);

/// Lets the sun shine from the author's first light, if there is one.
void light_as(const RecordedView& view, PictureStyle& style);

}  // namespace espalier::picture

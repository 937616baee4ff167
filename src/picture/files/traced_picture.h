// A picture by light paths, sample after sample.
#pragma once

#include "espalier/picture/chart_page.h"
#include "espalier/picture/picture_style.h"

#include "base/png_file.h"
#include "picture/light/path_tracer.h"
#include "picture/stage/camera_fit.h"

#include <functional>

namespace espalier::picture {

/// Rays through the places of a picture.
class RayCamera {
public:
    RayCamera(const CameraView& view, const PictureSize& size);

    struct Ray {
        glm::vec3 origin, direction;
    };
    /// (0, 0) is the upper left corner, (1, 1) the middle of the pixel beside the first one of the second row.
    Ray through(const glm::dvec2& place) const;

private:
    CameraView view_;
    glm::dvec3 right_, ahead_;
    double width_, height_, half_height_;
};

/// Told while a picture is made: its share that is done, from 0 to 1. May throw, to end it.
using TraceProgress = std::function<void(double share)>;

/// The same bytes with any number of threads. Samples are Sobol's, Owen-scrambled by pixel; each pixel is the mean over
/// a tent that reaches to the middles of its neighbours.
OpacityPicture traced_picture(const PathTracer& tracer, const SkyLight& light, const CameraView& view,
                              const PictureSize& size, const PictureLight& wanted, const TraceProgress& progress);

/// The light that a picture shows as 1, of which tones above 0.8 are compressed: that of a level surface in the open
/// that reflects 60 %.
float exposed_for(const SkyLight& light);

}  // namespace espalier::picture

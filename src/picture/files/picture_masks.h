// What each pixel of a picture shows, as numbers: how far it is away, how it is turned, and which organ it is.
#pragma once

#include "espalier/picture/chart_page.h"

#include "archive/frame_organs.h"
#include "picture/files/traced_picture.h"
#include "picture/light/lit_scene.h"
#include "picture/stage/stage.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace espalier::picture {

/// Rows of pixels, the highest first.
struct PictureMasks {
    static constexpr std::int32_t none = -1;

    std::size_t width = 0, height = 0;
    std::vector<float> depths;         ///< m along the direction in which the camera looks; 0: nothing is there
    std::vector<glm::vec3> normals;    ///< of length 1, towards the camera, in the axes of the run; 0: nothing is there
    std::vector<std::int32_t> organs;  ///< numbers as FrameOrgans has them; `none`: no organ
};

/// What a stage shows, until it shows something else.
class MaskScene {
public:
    explicit MaskScene(const Stage& stage);

    const archive::FrameOrgans& organs() const { return organs_; }
    /// As the camera of the stage sees it now. As a pixel of a picture is the mean of four, each pixel has the organ
    /// that most of four rays meet if half of them or more meet plants; depth and normal are those of the ray through
    /// its middle, or, where that meets another organ, of one of the four. What lets more than half of the light
    /// through is not there.
    PictureMasks masks(const PictureSize& size) const;

private:
    const Stage& stage_;
    archive::FrameOrgans organs_;
    LitScene scene_;
};

/// Beside NAME.png: NAME-depth.npy, NAME-normal.npy, NAME-organ.npy, NAME-plant.png, NAME-symbol.png, NAME-organs.csv
/// and NAME-camera.json, as docs/render.md tells. Each complete or not at all. Returns their paths. Throws RunError.
std::vector<std::filesystem::path> write_masks(const PictureMasks& masks, const archive::FrameOrgans& organs,
                                               const RecordedRun& run, const Stage& stage,
                                               const std::filesystem::path& picture);

}  // namespace espalier::picture

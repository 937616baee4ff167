// Pictures, films and contact sheets of a recorded run.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/stations.h"
#include "espalier/picture/chart_page.h"
#include "espalier/picture/picture_style.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace espalier::picture {

struct RenderJob {
    const RecordedRun& run;
    std::vector<const RecordedFrame*> frames;  ///< at least one; a film may show one several times
    PictureStyle style;
    CameraPlace camera;
    double orbit = 0;  ///< degrees that the camera goes round while the frames pass
    /// None: where it cuts through nothing that is drawn, and no field is; with paths of light, where not more grows
    /// below it than above.
    std::optional<bool> ground;
    bool follow = false;  ///< the camera frames each frame anew, instead of all together
    PictureSize size{1200, 900};
    /// Told after each frame that was drawn.
    std::function<void(std::size_t drawn, std::size_t all)> progress;
    /// Told while light paths draw: the share of all frames that is done. Either may throw; nothing is left half
    /// written.
    std::function<void(double share)> trace_progress{};
    /// Sun and sky of each frame; none: those of the style's `light`.
    std::function<PictureSky(const RecordedFrame&)> sky_at{};
    /// Instead of the style's background that of the author, else a dark one where most colours are hardly seen on
    /// white.
    bool chooses_background = false;
    /// In a film, pictures between two frames that follow each other, in which the plants unfold.
    int between = 0;
    /// Of pictures, not of films and sheets: files beside each that tell of every pixel how far away, how turned, and
    /// which organ it is.
    bool masks = false;
    /// Several pictures of each frame: `camera` is at these azimuths, degrees, one after the other. Files of the second
    /// frame's first are NAME-0012-0.png.
    std::vector<double> azimuths{};
};

// Files appear complete or not at all; the same job gives the same pictures. All throw UserError for arrays and fields
// that the run has not, RunError where nothing can be drawn or written.

/// A PNG; of several frames one each, "NAME-0012.png" by its step. With `masks`, each is followed by NAME-depth.npy,
/// NAME-normal.npy, NAME-organ.npy, NAME-plant.png, NAME-symbol.png, NAME-organs.csv and NAME-camera.json. Returns the
/// files.
std::vector<std::filesystem::path> render_pictures(const RenderJob& job, const std::filesystem::path& path);

/// .webm (VP9) is written here, .mp4 and .gif by ffmpeg, if it is in PATH. Throws UserError for other extensions.
void render_film(const RenderJob& job, double pictures_per_second, const std::filesystem::path& path);
/// True if `render_film` knows the extension.
bool is_film(const std::filesystem::path& path);
/// Throws RunError saying what to install if the film's extension needs a program that is not in PATH.
void require_film_writer(const std::filesystem::path& path);
/// Throws UserError unless it is a .png.
void require_png(const std::filesystem::path& path);
/// What organs of every run can be coloured by, "natural" first.
std::vector<std::string> colours_of_every_run();

/// One PNG with frames side by side, row after row, each of `job.size` and with its time beneath.
void render_sheet(const RenderJob& job, int columns, const std::filesystem::path& path);

/// So many of the frames, evenly from the first to the last; repeated where there are fewer.
std::vector<const RecordedFrame*> evenly(const std::vector<const RecordedFrame*>& frames, std::size_t count);

}  // namespace espalier::picture

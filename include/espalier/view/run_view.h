// A window on a run: look at it from all sides and at all times, also while it grows.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/picture/chart_page.h"
#include "espalier/picture/picture_style.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace espalier::view {

/// How the program that writes the run is getting on.
struct SimulationState {
    bool running = false;
    bool failed = false;
    std::string text;  ///< "running", "done", why it failed
};

struct ViewOptions {
    PictureSize size{1280, 800};
    PictureStyle style;
    std::optional<CameraPlace> camera;  ///< none: as the view file of the run's plants says, if there is one
    bool chooses_background = false;    ///< as RenderJob's
    std::optional<int> step;            ///< the frame to begin with; none: the last, and the newest while the run grows
    std::filesystem::path screenshot;   ///< draws this picture of the window and ends
    std::string script;                 ///< what to do, line by line, and end; docs/view.md
    std::function<void(const std::string&)> print;  ///< where `print` of a script goes
    std::function<SimulationState()> simulation;    ///< asked twice a second; none: the run's own word counts
    std::function<bool()> interrupted;              ///< true: the window closes
};

/// Opens a window on the folder of a run and returns when it is closed. Without a display a screenshot and a script are
/// drawn off screen. Throws UserError if there is no run, for a mistake in style or script, RunError where no window
/// opens.
void view_run(const std::filesystem::path& folder, const ViewOptions& options);

/// Why no window opens here, and what to do; "" if one does.
std::string why_no_window();

}  // namespace espalier::view

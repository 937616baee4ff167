// The sky of a recorded run's light process, for pictures of it.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/picture/picture_style.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace espalier::environment {
class DaylightSeries;
}

namespace espalier::app {

/// The light of a process with a table `sky`.
class SceneSky {
public:
    /// `days`: of one unit of the run's time. `dt`: length of a step in these units.
    SceneSky(std::shared_ptr<const environment::DaylightSeries> light, PictureSky::Kind kind, double days, double dt);

    /// With the sun where it stands when the step has most of its light.
    PictureSky at(const RecordedFrame& frame) const;

private:
    std::shared_ptr<const environment::DaylightSeries> light_;
    PictureSky::Kind kind_;
    double days_, dt_;
};

/// Of the first process that has one, as run.json says it. Throws UserError if a file that it needs is gone.
std::optional<SceneSky> sky_of_scene(const std::filesystem::path& run);

}  // namespace espalier::app

// The sky of a scene's light process, step by step, for pictures of its plants.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

namespace espalier::environment {

class DaylightSeries;

/// The light of a step as a picture shows it, with one sun for all that shine during the step.
struct StepSky {
    /// Unit vector to that which brings most light to level ground; none: there is light of the sky alone.
    std::optional<glm::dvec3> sun;
    double diffuse = 1;  ///< share of the sky in the step's light on open level ground
    double par = 0;  ///< umol m-2 s-1 of photosynthetically active photons there while there is light; 0: it is dark
};

/// The light of a process with a table `sky`.
class SceneSky {
public:
    enum class Kind : std::uint8_t { clear, overcast, uniform };

    /// `days`: of one unit of the scene's time. `dt`: length of a step in these units.
    SceneSky(std::shared_ptr<const DaylightSeries> light, Kind kind, double days, double dt);

    Kind kind() const { return kind_; }
    /// Throws RunError if the light was not measured so long.
    StepSky at_step(int step) const;

private:
    std::shared_ptr<const DaylightSeries> light_;
    Kind kind_;
    double days_, dt_;
};

/// Of the first of `processes` that has one; they are as run.json has them. Names of files are relative to `folder`.
/// Throws UserError if a file that it needs is gone.
std::optional<SceneSky> sky_of_processes(const nlohmann::ordered_json& processes, double dt,
                                         const std::filesystem::path& folder);

/// Of the run in a folder. The files that it has read lie below `root` by their absolute paths.
std::optional<SceneSky> sky_of_run(const std::filesystem::path& run, const std::filesystem::path& root = {});

}  // namespace espalier::environment

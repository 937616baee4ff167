// Growing a model with chosen values of its parameters, in memory: what is compared with measurements.
#pragma once

#include "espalier/geometry/frame_geometry.h"
#include "espalier/simulation/scene.h"
#include "espalier/turtle/interpretation.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace espalier::study {

/// What a comparison reads of what has grown; what nobody reads is not made.
struct Needs {
    bool geometry = false;  ///< the last frame
    bool course = false;    ///< statistics of every step
    Needs operator|(const Needs& other) const { return {geometry || other.geometry, course || other.course}; }
};

/// The plants of one world at its end.
struct Grown {
    std::shared_ptr<const FrameGeometry> geometry;  ///< null unless needed
    std::shared_ptr<const Interpretation> first;    ///< of the first plant
    std::vector<std::uint32_t> plants;              ///< the numbers of those that are measured
    std::vector<std::string> columns;               ///< of statistics.csv, after `name`
    std::vector<int> steps;                         ///< of each row of `course`
    std::vector<double> times;
    std::vector<std::vector<double>> course;  ///< a row a step, the last always: means over the plants
};

/// What is grown: a model or a scene, and what is fixed about it.
struct Subject {
    std::filesystem::path file;
    std::vector<std::pair<std::string, std::string>> values =
        {};  ///< those that are not sought, as for the sought ones
    std::optional<int> steps = {};
    std::optional<std::uint64_t> seed = {};  ///< of the first world; default: the scene's, or 0
    std::string plant = {};                  ///< the one that is measured; "": all
    /// Makes the scene instead of reading `file`: values are replaced where the caller keeps them. Throws UserError.
    std::function<Scene(std::span<const std::pair<std::string, double>> values)> read = {};

    bool is_scene() const { return file.extension() == ".toml"; }
};

/// "ANGLE" is a #define of a model alone, a key with dots one of a scene, as for `espalier sweep`.
class Growth {
public:
    explicit Growth(Subject subject) : subject_(std::move(subject)) {}

    const Subject& subject() const { return subject_; }
    /// The scene with these values. Throws UserError.
    Scene scene(std::span<const std::pair<std::string, double>> values) const;
    /// World number `number`: the same number has the same random numbers, whatever the values are. Nothing if it
    /// becomes larger than a million modules. Throws UserError and RunError.
    std::optional<Grown> grow(const Scene& scene, std::uint64_t number, const Needs& needs) const;
    /// Options of `espalier run` that grow the same.
    std::vector<std::string> options(std::span<const std::pair<std::string, double>> values) const;

private:
    bool is_define(const std::string& key) const;

    Subject subject_;
};

}  // namespace espalier::study

// Fitting what a studio has open to what was measured. Who runs the studio says how it is done: pages without a program
// have no library that searches.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/scene.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace espalier::studio {

struct MeasuredValue {
    std::string name;
    double value = 0;
    double scale = 1;  ///< the difference that counts as 1
};

/// A value of a column of the statistics at a step or a time.
struct CourseValue {
    std::string column;
    double at = 0, value = 0;
};

/// What a file holds of measured plants.
struct Measurement {
    std::vector<MeasuredValue> values;  ///< what is compared
    std::vector<std::string> notes;     ///< what is not used, what was guessed
    std::vector<glm::dvec3> points;     ///< m, y upwards, the plant's foot at 0
    std::vector<std::vector<glm::dvec3>> lines;
    bool has_scale = true;  ///< false: only ratios of lengths count
    std::vector<CourseValue> course;
    bool course_is_by_step = true;          ///< else by time
    std::shared_ptr<const void> read = {};  ///< what the fit compares with; known to whoever reads and fits
};

/// A number of the document that is sought. Both bounds are finite.
struct SoughtNumber {
    std::string name;
    double start = 0, lowest = 0, highest = 1;
    bool is_whole = false;
};

struct BestSoFar {
    std::size_t done = 0, all = 0;  ///< comparisons
    std::vector<double> values;     ///< of the sought numbers
    double residual = 0;            ///< root mean square, in the scales of what was measured
};

struct FittedNumber {
    double value = 0;
    double error = 0;         ///< standard error; NaN: a small change moves nothing
    bool is_decided = false;  ///< by what was measured
};

struct FitOutcome {
    std::vector<FittedNumber> numbers;  ///< as they were sought
    std::vector<double> predicted;      ///< beside the values of all measurements, one after the other
    std::vector<std::string> remarks;
    double residual = 0;
    std::size_t worlds = 0;  ///< that were grown
};

struct FitOrder {
    std::vector<std::shared_ptr<const void>> measured;  ///< as it was read
    std::vector<SoughtNumber> sought;
    std::size_t search = 0;  ///< comparisons of the search over the whole ranges; 0: what is usual
    /// The document with other values of these numbers; called on the thread that fits. Throws UserError.
    std::function<Scene(std::span<const std::pair<std::string, double>>)> scene;
    std::function<void(const BestSoFar&)> progress;
};

struct Fitting {
    /// Throws UserError for a file that cannot be compared with.
    std::function<Measurement(const std::filesystem::path&)> read;
    /// Ends with Stopped when it is asked to. Throws UserError and RunError.
    std::function<FitOutcome(const FitOrder&)> fit;

    explicit operator bool() const { return read && fit; }
};

}  // namespace espalier::studio

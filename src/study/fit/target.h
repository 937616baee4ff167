// What was measured, and what of grown plants is compared with it. One file per kind of target.
#pragma once

#include "espalier/base/registry.h"

#include "study/fit/growth.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::study {

/// A number that was measured, and the difference that counts as 1.
struct Statistic {
    std::string name;
    double value = 0;
    double scale = 1;
};

/// Where what was measured lies: metres, y upwards, the plant's foot at 0.
struct MeasuredPlaces {
    std::vector<glm::dvec3> points;
    std::vector<std::vector<glm::dvec3>> lines;  ///< axes, or pieces of them
    bool has_scale = true;                       ///< false: only ratios of lengths count
};

/// A value of a column of statistics.csv at a step or a time.
struct Observation {
    std::string column;
    double at = 0, value = 0;
};
struct MeasuredCourse {
    bool is_by_step = true;  ///< else by time
    std::vector<Observation> observations;
};

class Target {
public:
    virtual ~Target() = default;

    /// What is compared; finite numbers, one at least.
    virtual const std::vector<Statistic>& statistics() const = 0;
    /// How many worlds stand for what was measured: as many as plants were.
    virtual std::size_t worlds() const { return 1; }
    virtual Needs needs() const { return {}; }
    /// The same statistics of grown worlds; NaN for what they lack. Called from several threads.
    virtual std::vector<double> of(std::span<const Grown> worlds) const = 0;
    /// What can be shown beside a plant; empty: numbers alone were measured.
    virtual MeasuredPlaces places() const { return {}; }
    /// What can be shown beside charts; empty: it was not followed.
    virtual MeasuredCourse course() const { return {}; }
    /// An SVG of what was measured and what has grown, on each other; "": there is none.
    virtual std::string overlay(const Grown&) const { return ""; }
    /// What the file holds and is not used, what was guessed.
    std::vector<std::string> notes;
};

/// A kind of file that plants are compared with.
struct TargetType {
    std::string name;
    std::string summary;
    /// Nothing if the file is of another kind. Throws UserError for one of this kind that is wrong.
    std::function<std::shared_ptr<Target>(const std::filesystem::path&)> read;
};

/// Throws UserError for a file that is none of the registered kinds.
std::shared_ptr<Target> read_target(const std::filesystem::path& file);

/// A table of plants, a row each, as statistics: the mean of each column, and of three measured plants or more its
/// standard deviation where it has one. Their scale is the standard deviation of the mean, or 5 % of the value of a
/// single plant.
class RowStatistics {
public:
    RowStatistics(const std::vector<std::string>& names, const std::vector<std::vector<double>>& measured);

    const std::vector<Statistic>& measured() const { return statistics_; }
    /// The same numbers of other plants.
    std::vector<double> of(const std::vector<std::vector<double>>& rows) const;

private:
    std::size_t columns_;
    std::vector<std::size_t> deviating_;  ///< columns whose deviations count
    std::vector<Statistic> statistics_;
};

}  // namespace espalier::study

// A number that changes with time, as a scene gives it: constant, or a column of a table.
#pragma once

#include "espalier/base/settings.h"

#include <functional>
#include <string>
#include <vector>

namespace espalier::environment {

/// A value holds from its time until the next; the last one holds for as long as the one before it did.
class TimeSeries {
public:
    using Convert = std::function<double(double)>;

    TimeSeries() = default;
    explicit TimeSeries(double value) : values_{value} {}

    /// A number, or { file = "weather.csv", column = "rain" }. The file has a column `date`, or `time` with its unit,
    /// or in the first the days from the beginning of the run; times rise. Throws UserError with the line of the file
    /// for a gap, a word or a value out of `range`.
    static TimeSeries read(const Settings& settings, const std::string& key, double fallback, Range range);
    /// A column of the file that `table` names by `file`; `convert` makes its numbers what `range` bounds.
    static TimeSeries column(const Settings& table, const std::string& name, Range range, const Convert& convert = {});
    /// What another gives by time: a number at a day, and when it changes next.
    static TimeSeries of(std::function<double(double)> at, std::function<double(double)> next_change);

    bool is_constant() const { return times_.empty() && !given_; }
    void set(double value) { values_ = {value}; }
    double& constant() { return values_[0]; }
    /// Throws RunError before the first time and after the last.
    double at(double day) const;
    /// The first change after `day`; infinite if there is none.
    double next_change(double day) const;

private:
    std::string name_;  ///< "weather.csv: rain"
    std::function<double(double)> given_, given_change_;
    std::vector<double> times_, values_{0};  ///< days
};

}  // namespace espalier::environment

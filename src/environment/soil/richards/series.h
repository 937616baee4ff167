// A number that changes with time, as a scene gives it: constant, or a column of a CSV file.
#pragma once

#include "espalier/base/settings.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace espalier::environment {

/// A value holds from its time until the next; the last one holds for as long as the one before it did.
class SoilSeries {
public:
    SoilSeries() = default;
    explicit SoilSeries(double value) : values_{value} {}

    /// A number, or { file = "weather.csv", column = "rain" }: the first column of the file is the time in days from
    /// the beginning of the run, rising. Throws UserError with the line of the file for a gap, a word or a value out of
    /// `range`.
    static SoilSeries read(const Settings& settings, const std::string& key, double fallback, Range range);
    /// A pressure head: a number of cm, a text with a unit, or a file, which may say the unit of its column: { file,
    /// column, unit = "hPa" }. The range is in cm.
    static SoilSeries read_head(const Settings& settings, const std::string& key, Range range);

    /// What another gives by time: a number at a day, and when it changes next.
    static SoilSeries of(std::function<double(double)> at, std::function<double(double)> next_change);

    bool is_constant() const { return times_.empty() && !given_; }
    void set(double value) { values_ = {value}; }
    double& constant() { return values_[0]; }
    /// Throws RunError before the first time and behind the last.
    double at(double day) const;
    /// The first change behind `day`; infinite if there is none.
    double next_change(double day) const;

    /// A column of heads of the file that `table` names by `file`, with `unit`.
    static SoilSeries read_head_column(const Settings& table, const std::string& column, Range range);

private:
    using Convert = std::function<double(double)>;
    static SoilSeries read_file(const Settings& table, const std::string& column, Range range, const Convert& convert);

    std::string name_;  ///< "weather.csv: rain"
    std::function<double(double)> given_, given_change_;
    std::vector<double> times_, values_{0};
};

}  // namespace espalier::environment

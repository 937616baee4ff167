// --field and --profile of `analyse`: a recorded field over one axis, as a table and a chart.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/picture/chart_page.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::app {

class FieldProfile {
public:
    explicit FieldProfile(CLI::App& app);

    /// Options that make no sense beside --field.
    void exclude(std::initializer_list<const char*> options);

    bool is_asked() const { return !field_.empty(); }
    /// "water-y"
    std::string name() const { return field_ + "-" + axis_; }
    /// Throws UserError if no frame has the field.
    RecordedTable table(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames) const;
    /// The means of a few steps, the first and the last among them; heights upwards, other places to the right.
    ChartPage page(const RecordedRun& run, const RecordedTable& table, bool dark) const;

private:
    CLI::App& app_;
    std::string field_, axis_ = "y";
};

std::string csv_of(const RecordedTable& table);

}  // namespace espalier::app

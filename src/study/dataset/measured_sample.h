// One sample of a data set: a world grown in memory, and the files of its scan and its pictures.
#pragma once

#include "espalier/archive/recorded_run.h"

#include "study/dataset/dataset_plan.h"

#include <optional>
#include <string>
#include <vector>

namespace espalier::study {

/// A world at its end.
struct GrownSample {
    std::optional<RecordedRun> run;          ///< with one frame; none: it failed
    std::string failure;                     ///< why
    std::vector<std::vector<double>> forms;  ///< form_names() of each plant
};

/// Throws Stopped if it is asked to end, UserError for values that the model refuses.
GrownSample grown_sample(const DatasetPlan& plan, const DatasetSample& sample);

/// Writes points, organs.csv, pictures and masks into the folder of the sample. Returns how many points and pictures
/// there are. Throws UserError where there is nothing to draw, RunError.
struct MeasuredSample {
    std::size_t points = 0, pictures = 0;
};
MeasuredSample measure(const DatasetPlan& plan, const DatasetSample& sample, const GrownSample& grown,
                       const std::filesystem::path& folder);

}  // namespace espalier::study

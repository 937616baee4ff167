// The folder of a data set: samples that were grown, scanned and drawn, and a card that describes them.
#pragma once

#include "study/dataset/dataset_plan.h"

#include <functional>

namespace espalier::study {

/// Which of the samples a process makes: every `of`-th.
struct DatasetPart {
    std::size_t number = 0, of = 1;
};

class Dataset {
public:
    /// Makes the folder, and a copy of the file in it. Throws UserError if it holds another data set, RunError if it
    /// cannot be written.
    Dataset(DatasetPlan plan, std::filesystem::path folder);

    const DatasetPlan& plan() const { return plan_; }
    const std::vector<DatasetSample>& samples() const { return samples_; }
    std::filesystem::path folder_of(const DatasetSample& sample) const;
    /// Those of a part that are not there.
    std::vector<const DatasetSample*> to_do(const DatasetPart& part) const;

    using Progress = std::function<void(std::size_t done, std::size_t all)>;
    /// Makes what is to do. The files of a sample are complete when its sample.json is there, so a data set that was
    /// interrupted goes on to the same bytes. A plant that cannot be grown or drawn becomes a sample that says why.
    /// Throws Stopped if it is asked to end; samples that are whole then stay. Throws UserError and RunError.
    void make(const DatasetPart& part, const Progress& progress) const;

    struct Summary {
        std::size_t samples = 0, failed = 0, points = 0, pictures = 0;
    };
    /// dataset.csv, card.json and README.md of the samples, all of which are there.
    Summary write_card() const;

private:
    DatasetPlan plan_;
    std::filesystem::path folder_;
    std::vector<DatasetSample> samples_;
};

}  // namespace espalier::study

// A data set as its file says it: what grows, with which values, and how it is measured.
#pragma once

#include "espalier/picture/render.h"

#include "study/fit/growth.h"
#include "study/fit/prior.h"
#include "study/scan/scan_plan.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::study {

/// Pictures of every sample.
struct PicturePlan {
    PictureSize size{640, 480};
    std::vector<double> azimuths{30};  ///< degrees: a picture for each
    CameraPlace camera;
    PictureStyle style;
    bool ground = false, masks = true;
};

struct DatasetPlan {
    std::filesystem::path file;
    std::string text;  ///< of the file
    std::string title, licence;
    Growth growth;
    std::vector<Unknown> parameters;
    std::size_t samples = 100;
    std::uint64_t seed = 0;
    std::vector<std::pair<std::string, double>> splits;  ///< names, and their shares, which add up to 1
    std::optional<ScanPlan> scan;
    std::optional<PicturePlan> pictures;

    std::vector<std::pair<std::string, double>> named(const std::vector<double>& values) const;
    /// Changes with everything that the samples depend on: files that are read, values, the program's version.
    std::uint64_t digest() const;
};

/// Values in place of the file's.
struct DatasetChoice {
    std::optional<std::size_t> samples;
    std::optional<std::uint64_t> seed;
};

/// Throws UserError naming file, line and column for what the file says wrongly.
DatasetPlan read_dataset(const std::filesystem::path& file, const DatasetChoice& choice = {});

/// One world that grows.
struct DatasetSample {
    std::size_t number = 0;
    std::uint64_t seed = 0;      ///< of the world: each sample has its own
    std::string split;           ///< the name of the part that it belongs to
    std::vector<double> values;  ///< of the parameters; six digits, so that a command line says them whole
};

/// Values are drawn for each sample by itself; the samples in the order of other random numbers are divided among the
/// splits, as exactly as whole numbers let.
std::vector<DatasetSample> samples_of(const DatasetPlan& plan);

}  // namespace espalier::study

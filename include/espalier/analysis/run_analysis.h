// The form of the plants of a recorded run, measured: branching, widths, fractal dimension, crowns, profiles.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/stations.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace espalier::analysis {

struct AnalysisOptions {
    std::set<std::string> leaf_symbols;  ///< whose surfaces are leaves; empty: everything with a surface
    double layer = 0;                    ///< thickness, m; 0: chosen for the run
    double low = 0, high = 0;            ///< heights that the layers cover at least, m
    double ground = 0;                   ///< area of the ground, m2; 0: that of the run's domain
    double voxel = 0;                    ///< m; 0: chosen for each plant
};

/// A column of the table of measures.
struct MeasureDescription {
    std::string name, unit, meaning;
};
const std::vector<MeasureDescription>& measure_descriptions();

struct WaterStress;

class RunAnalysis {
public:
    /// Measures `plants` (their numbers) in `frames` of `run`. Each thread holds one file of a frame at a time. Throws
    /// UserError for a leaf symbol no frame knows.
    RunAnalysis(const RecordedRun& run, std::span<const RecordedFrame* const> frames,
                std::span<const std::uint32_t> plants, const AnalysisOptions& options = {});
    ~RunAnalysis();
    RunAnalysis(const RunAnalysis&) = delete;
    RunAnalysis& operator=(const RunAnalysis&) = delete;

    /// A row per step and plant: step, time, plant, then the measures. NaN where a plant has none.
    RecordedTable table() const;

    /// Of plants that transpire, a row each: plant, first_time (the end of the first step in which it transpired less
    /// than its demand; NaN: none), time (of all such steps), transpired, demanded (sums over the run). Of all steps of
    /// the run, whatever frames there are.
    RecordedTable stress() const;

    /// The layers of the last frame's plants: step, plant, height (of the layer's middle), length, surface, leaf_area,
    /// density, ground_density, uptake (cm3/d). All plants of all frames have the same layers.
    RecordedTable last_layers() const;

    /// analysis.csv (the table), orders.csv, ramification.csv, layers.csv, internodes.csv and, where plants transpire,
    /// stress.csv, each complete or not at all. Throws RunError.
    void write_csv(const std::filesystem::path& folder) const;
    /// analysis.json: all of it in one. Throws RunError.
    void write_json(const std::filesystem::path& folder) const;

private:
    struct Frame;
    void align_layers(const AnalysisOptions& options);
    std::string stress_text() const;

    std::string scene_;
    double ground_ = 0;
    std::vector<std::string> names_;     ///< of all plants, by number
    std::vector<RecordedPlant> plants_;  ///< those that are measured
    std::vector<Frame> frames_;
    std::vector<WaterStress> stress_;
};

}  // namespace espalier::analysis

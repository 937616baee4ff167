// A small run exported, and what the files hold.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/recorded_folder.h"

#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace espalier {

using namespace espalier::formats;

/// RecordedFolder's run, written in one format; the files go with it.
struct Exported {
    RecordedFolder recorded;
    RecordedRun run{recorded.folder.path};
    std::vector<ExportedFile> files;

    /// `steps` of {0, 4}; the last by default.
    explicit Exported(const std::string& format, MeshOptions options = {}, const std::vector<int>& steps = {4},
                      const std::string& settings = "", const std::function<void(ExportJob&)>& change = {})
        : recorded(settings) {
        std::vector<const RecordedFrame*> frames;
        for (const int step : steps) frames.push_back(&run.frame(step));
        ExportJob job{run, frames, options, recorded.folder.path / "export",
                      [this](const ExportedFile& file) { files.push_back(file); }};
        if (change) change(job);
        export_run(job, std::vector{format});
    }

    std::filesystem::path path() const { return files.at(0).path; }
    std::string text() const { return bytes_of(path()); }
};

/// One frame of one plant, without fields, written in one format.
struct ExportedPlant {
    RunFolder folder;
    std::vector<ExportedFile> files;

    ExportedPlant(const HandmadePlant& plant, const std::string& format,
                  const std::function<void(ExportJob&)>& change = {}) {
        Timeline timeline(folder.path, timeline_table(), 0);
        record(timeline, 0, {&plant});
        timeline.finish();
        timeline.write_run(run_json);
        const RecordedRun run(folder.path);
        const RecordedFrame* const frames[] = {&run.frame(0)};
        ExportJob job{
            run, frames, {}, folder.path / "export", [this](const ExportedFile& file) { files.push_back(file); }};
        if (change) change(job);
        export_run(job, std::vector{format});
    }
};

/// Returns the area of a ring with so many corners, by the square of its radius.
inline double ring_area(int sides) {
    return sides / 2.0 * std::sin(2 * std::numbers::pi / sides);
}

inline double frustum_volume(double length, double a, double b, double area) {
    return area * length / 3 * (a * a + a * b + b * b);
}

/// The axes of branched_plant(): a stem that tapers and goes on, and a branch.
inline double branched_volume(int sides) {
    const double area = ring_area(sides);
    return frustum_volume(1, 0.1, 0.05, area) + frustum_volume(2, 0.05, 0.05, area) +
           frustum_volume(std::sqrt(1.25), 0.1, 0.05, area);
}

}  // namespace espalier

// Grows what is open once more, and writes it for another program; on a thread of its own.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"
#include "espalier/studio/studio.h"

#include "studio/growth/workers.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

struct ExportOrder {
    Opened opened;
    UnsavedTexts unsaved;
    std::string format;
    int step = -1;           ///< -1: the last; the growth ends there
    bool is_film = false;    ///< every step, in formats that have animations or a file a step
    bool is_smooth = false;  ///< limbs have one skin
    std::optional<std::size_t> triangles = std::nullopt;  ///< so many at most, of limbs that are tubes
    bool has_instances = false;                           ///< organs that look alike are one shape
    std::filesystem::path scratch;
    std::function<Scene(const Opened&)> read;
    std::optional<ReadPermission> permission = {};  ///< none: it may read everything
    std::size_t memory = 0;                         ///< most bytes that growing may take; 0: the default
};

/// Below which the files of an export lie.
std::filesystem::path export_folder(const std::filesystem::path& scratch);

class ExportRun {
public:
    /// Both are called on the job's thread. `done` with an empty list says why it failed. Files of one export lie below
    /// one folder; the first is the one that names the others.
    using Progressed = std::function<void(double share)>;
    using Done = std::function<void(std::vector<std::filesystem::path> files, std::string why)>;

    ExportRun(ExportOrder order, Workers& workers, Progressed progressed, Done done);
    /// Ends it at once.
    ~ExportRun();
    ExportRun(const ExportRun&) = delete;
    ExportRun& operator=(const ExportRun&) = delete;

    bool has_ended() const { return running_.has_ended(); }

private:
    void work();
    bool needs_folder() const;
    RecordedRun grow();
    std::vector<std::filesystem::path> write();

    const ExportOrder order_;
    const Progressed progressed_;
    const Done done_;
    StopRequest stop_;
    RunningWork running_;  ///< the last: it uses all others
};

}  // namespace espalier::studio

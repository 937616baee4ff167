// The timeline of a run: a folder, its recorders, and which steps they see.
#pragma once

#include "espalier/base/file.h"
#include "espalier/timeline/recorder.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace espalier {

class Timeline {
public:
    /// Locks the folder (two runs into one are refused) and makes the recorders `table` asks for.
    /// A folder that already holds a timeline is refused, unless `overwrite`: then that timeline's files are removed.
    /// Throws UserError for settings that mean nothing.
    Timeline(const std::filesystem::path& folder, Settings table, int last_step, bool overwrite = false);
    ~Timeline();

    const std::filesystem::path& folder() const { return folder_; }
    /// Frames come in the order of their steps. Recorders see those that `every` divides and the last one planned.
    void record(const Frame& frame);
    /// Every recorder finishes, whatever becomes of the others; then the first failure is thrown.
    void finish();

    /// Writes run.json (complete or not at all). `json` is what the run says of itself.
    void write_run(const std::string& json) const;

private:
    std::filesystem::path folder_;
    FolderLock lock_;
    int every_ = 1;
    int last_step_ = 0;
    std::vector<std::unique_ptr<Recorder>> recorders_;
};

}  // namespace espalier

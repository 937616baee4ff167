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
    /// Locks the folder (two runs into one are refused), removes nothing, and makes the recorders `table` asks for.
    /// A folder that already holds a finished timeline is refused unless `overwrite`.
    Timeline(const std::filesystem::path& folder, Settings table, int last_step, bool overwrite = false);
    ~Timeline();

    const std::filesystem::path& folder() const { return folder_; }
    void record(const Frame& frame);
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

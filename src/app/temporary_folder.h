// A folder of its own that is gone afterwards, also after a kill: then the next who needs one removes it.
#pragma once

#include "espalier/base/file.h"

#include <filesystem>
#include <optional>
#include <string>

namespace espalier::app {

class TemporaryFolder {
public:
    /// `espalier-<purpose>-XXXXXX` where the system keeps such folders, absolute whatever TMPDIR says; only its owner
    /// may look into it. Removes those of this purpose whose programs were killed. Throws RunError.
    explicit TemporaryFolder(const std::string& purpose);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path home_, path_;  ///< what is worked with lies in a folder below the one that is locked
    std::optional<FolderLock> lock_;
};

}  // namespace espalier::app

// A folder of its own that is gone afterwards.
#pragma once

#include <filesystem>
#include <string>

namespace espalier::app {

class TemporaryFolder {
public:
    /// `espalier-<purpose>-XXXXXX` where the system keeps such folders, absolute whatever TMPDIR says. Throws RunError.
    explicit TemporaryFolder(const std::string& purpose);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace espalier::app

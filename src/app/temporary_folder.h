// A folder of its own that is gone afterwards.
#pragma once

#include <filesystem>
#include <string>

namespace espalier {

class TemporaryFolder {
public:
    /// `/tmp/espalier-<purpose>-XXXXXX`, absolute whatever TMPDIR says. Throws RunError.
    explicit TemporaryFolder(const std::string& purpose);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace espalier

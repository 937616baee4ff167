// A run's folder, read again whenever it has more.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <filesystem>
#include <memory>
#include <string>

namespace espalier::view {

class RunFollower {
public:
    /// Throws UserError if there is no run.
    explicit RunFollower(std::filesystem::path folder);

    const std::shared_ptr<const RecordedRun>& run() const { return run_; }
    /// Reads the indices again if they changed; true if they did. What cannot be read stays as it was: error() says
    /// why.
    bool look();
    /// True if the run that was found by the last look is not the one before with more frames, but another.
    bool is_another() const { return is_another_; }
    const std::string& error() const { return error_; }

private:
    /// What changes when the run goes on, ends or is killed.
    struct Stamp {
        std::array<std::filesystem::file_time_type, 3> written;
        bool locked;

        bool operator==(const Stamp&) const = default;
    };
    Stamp stamp() const;

    std::filesystem::path folder_;
    std::shared_ptr<const RecordedRun> run_;
    Stamp stamp_;
    std::string error_;
    bool is_another_ = false;
};

}  // namespace espalier::view

// How much a run writes.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace espalier::simulation {

/// What lies in a folder grows by what a run writes there, whoever writes it: recorders, models, checkpoints.
class DiskBudget {
public:
    /// What is there already does not count, unless it is the beginning of a resumed run.
    DiskBudget(const std::filesystem::path& folder, std::uintmax_t bytes, bool resumed);

    /// Looks at the folder when asked for the 1st, 2nd, 4th, 8th ... time, so that no run is too short to be looked at;
    /// else only if that takes no more than a fiftieth of the time since it last did.
    bool is_spent();
    std::uintmax_t written() const { return written_; }  ///< when it last looked

private:
    void look();

    std::filesystem::path folder_;
    std::uintmax_t bytes_, before_ = 0, written_ = 0;
    std::uint64_t asked_ = 0;
    std::chrono::steady_clock::time_point next_;
};

/// "20 GiB", "1.5 MiB", "512 bytes".
std::string size_text(std::uintmax_t bytes);

}  // namespace espalier::simulation

// The life of one organ, frame by frame, from a run as it lies on disk.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/stations.h"

#include <compare>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::archive {

/// A module for life: its identity within its plant.
struct OrganKey {
    std::uint32_t plant = 0;
    std::uint64_t identity = 0;

    auto operator<=>(const OrganKey&) const = default;
};

/// An organ as one frame shows it: all that its module draws.
struct OrganMoment {
    int step = 0;
    double time = 0;
    glm::vec3 base{0}, tip{0};  ///< where it begins; the end of its last internode, or its corner farthest from `base`
    double length = 0;          ///< sum over its internodes; for other organs from `base` to `tip`
    double base_radius = 0, tip_radius = 0;  ///< radii of internodes
    double area = 0;                         ///< area of its surfaces, one side
    std::vector<double> parameters;          ///< the chosen ones, as OrganHistory::parameters names them; NaN: none
};

struct OrganHistory {
    OrganKey organ;
    std::string symbol;
    Kind kind = Kind::axis;
    std::uint64_t parent = 0;  ///< its module
    int order = 0;
    int birth = 0;
    /// The steps between which it went: seen at the first, not at the second. None: the last frame read has it.
    std::optional<std::pair<int, int>> gone;
    std::vector<std::string> parameters;
    std::vector<OrganMoment> moments;  ///< one for each frame that has it, in the order of time

    /// The first step without it, if the frames tell it exactly.
    std::optional<int> death() const {
        return gone && gone->second == gone->first + 1 ? std::optional(gone->second) : std::nullopt;
    }
};

/// Reads histories, and keeps what it read of frames for the next, up to so many bytes. One thread at a time.
class OrganReader {
public:
    explicit OrganReader(std::size_t most_bytes = std::size_t{256} << 20);
    ~OrganReader();
    OrganReader(const OrganReader&) = delete;
    OrganReader& operator=(const OrganReader&) = delete;

    /// Called after each frame with what is known so far; returns false to stop.
    using Progress = std::function<bool(const OrganHistory& so_far, std::size_t frames_done, std::size_t frames)>;

    /// Frames before its birth are not read, if `seen_at` is a step whose frame has it. None if no frame has it; what
    /// was known when `progress` said stop. Throws UserError if a file is damaged.
    std::optional<OrganHistory> history(const RecordedRun& run, const OrganKey& organ, std::optional<int> seen_at = {},
                                        const Progress& progress = {});

private:
    class Cache;
    std::unique_ptr<Cache> cache_;
};

/// What people want to know of it, name and value: who it is, how long it lives, and how it is at the last frame that
/// has it up to `step`.
std::vector<std::pair<std::string, std::string>> described(const OrganHistory& history, const RecordedRun& run,
                                                           int step);

}  // namespace espalier::archive

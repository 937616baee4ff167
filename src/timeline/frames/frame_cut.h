// Where a frame of many points is cut into pieces, a file each.
#pragma once

#include <cstddef>

namespace espalier::timeline {

/// Cuts between plants, which come in the order of the scene.
class FrameCut {
public:
    explicit FrameCut(std::size_t most_points) : most_(most_points) {}

    /// True if a piece begins with the next plant, which has so many points, and is not the first.
    bool is_before(std::size_t points) {
        const bool is_cut = has_plants_ && points_ + points > most_;
        points_ = is_cut ? points : points_ + points;
        has_plants_ = true;
        return is_cut;
    }

private:
    std::size_t most_;  ///< of a piece of several plants
    std::size_t points_ = 0;
    bool has_plants_ = false;
};

}  // namespace espalier::timeline

// The limbs of a step as pictures have them: tubes that run into each other or one smooth skin, with bark.
#pragma once

#include "studio/packets/limb_axes.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace espalier::studio {

/// Told which part is done; false: it is not wanted any more.
using ContinueCallback = std::function<bool(double share)>;

struct LimbOrder {
    LimbAxes axes;
    std::uint32_t growth = 0;
    int step = 0;
    bool smooth = false;
};

/// The message `ESM1` of docs/developer/studio-protocol.md; "" if it was not wanted any more. Throws UserError as
/// `skin_voxel` does.
std::string limb_mesh(const LimbOrder& order, const ContinueCallback& may_continue);

/// Makes one on a thread of its own.
class LimbRun {
public:
    /// Called on the job's thread. Without bytes, `why` says what is wrong.
    using Done = std::function<void(std::string bytes, std::string why)>;

    LimbRun(std::shared_ptr<const LimbOrder> order, std::function<void(double share)> progressed, Done done);
    /// Waits for the plant at hand.
    ~LimbRun();
    LimbRun(const LimbRun&) = delete;
    LimbRun& operator=(const LimbRun&) = delete;

    /// It says nothing any more, and ends after the plant at hand.
    void cancel() { cancelled_ = true; }
    bool has_ended() const { return ended_; }

private:
    void work();

    const std::shared_ptr<const LimbOrder> order_;
    const std::function<void(double)> progressed_;
    const Done done_;
    std::atomic<bool> cancelled_ = false, ended_ = false;
    std::thread thread_;  ///< the last: it uses all others
};

}  // namespace espalier::studio

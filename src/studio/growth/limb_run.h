// Limbs with bark or a skin, made beside the thread that serves.
#pragma once

#include "studio/growth/workers.h"
#include "studio/packets/limb_mesh.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>

namespace espalier::studio {

class LimbRun {
public:
    /// Called by the worker. Without bytes, `why` says what is wrong.
    using Done = std::function<void(std::string bytes, std::string why)>;

    LimbRun(std::shared_ptr<const LimbOrder> order, Workers& workers, std::function<void(double share)> progressed,
            Done done);
    /// Waits for the plant at hand.
    ~LimbRun();
    LimbRun(const LimbRun&) = delete;
    LimbRun& operator=(const LimbRun&) = delete;

    /// It says nothing any more, and ends after the plant at hand.
    void cancel() { cancelled_ = true; }
    bool has_ended() const { return running_.has_ended(); }

private:
    void work();

    const std::shared_ptr<const LimbOrder> order_;
    const std::function<void(double)> progressed_;
    const Done done_;
    std::atomic<bool> cancelled_ = false;
    RunningWork running_;  ///< the last: it uses all others
};

}  // namespace espalier::studio

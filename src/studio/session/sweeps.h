// Sweeps of a setting that pages asked for.
#pragma once

#include "studio/growth/sweep_run.h"
#include "studio/session/pages.h"
#include "studio/session/posted_listener.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace espalier::studio {

class Sweeps {
public:
    /// All outlive it. `post` does work on the session's thread.
    Sweeps(Pages& pages, Workers& workers, Post post) : pages_(pages), workers_(workers), post_(std::move(post)) {}

    /// Instead of what the page asked for before. Returns the number of the first growth.
    std::uint32_t begin(const Page& page, SweepOrder order);
    /// Ends that of a page, dropping the plant at hand.
    void forget(const Page& page);

private:
    void tell(const Page* page, std::uint32_t sweep, const SweptPlant& plant);

    struct Run {
        std::uint32_t first = 0;
        std::unique_ptr<SweepRun> run;
    };

    Pages& pages_;
    Workers& workers_;
    const Post post_;
    std::uint32_t next_ = std::uint32_t(1) << 31;  ///< above the numbers of growths that pages share
    std::map<const Page*, Run> runs_;
    std::vector<std::unique_ptr<SweepRun>> ending_;  ///< nobody waits for them
};

}  // namespace espalier::studio

// A recorded run as one page that needs no server: what the studio shares, made without a browser.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace espalier::studio {

struct SharedPage {
    std::string title;
    bool is_dark = false;
    std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< frames that were packed; may be none
};

/// HTML that shows the frames, the last at first; they can be turned and played. It has the viewer of the studio in it,
/// and loads nothing.
std::string shared_page(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames,
                        const SharedPage& page);

}  // namespace espalier::studio

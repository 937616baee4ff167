// Work that a page asked for and that takes longer than a request: exports, and limbs with bark or a skin.
#pragma once

#include "studio/growth/export_job.h"
#include "studio/growth/limb_run.h"
#include "studio/session/handed_files.h"
#include "studio/session/pages.h"
#include "studio/session/posted_listener.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace espalier::studio {

class Jobs {
public:
    /// All outlive it. `post` does work on the session's thread.
    Jobs(Pages& pages, HandedFiles& files, Workers& workers, Post post)
        : pages_(pages), files_(files), workers_(workers), post_(std::move(post)) {}

    /// Its files go into a folder of its own below the order's scratch. Throws UserError while another export goes on.
    void begin_export(ExportOrder order);

    /// Instead of what the page asked for before.
    void begin_limbs(Viewer& viewer, LimbOrder order);
    void stop_limbs(const Page& page);

    void forget(const Page& page) { waiting_limbs_.erase(&page); }
    void tick() { begin_waiting_limbs(); }

private:
    void note_exported(const std::vector<std::filesystem::path>& files, const std::filesystem::path& folder,
                       const std::string& why);
    void begin_waiting_limbs();
    /// From any thread: sends to a page, on the session's thread and if it is still here.
    void send_later(const Page* page, std::function<void(Page&)> send);

    Pages& pages_;
    HandedFiles& files_;
    Workers& workers_;
    const Post post_;
    int exports_ = 0;
    std::unique_ptr<ExportRun> export_;
    std::map<const Page*, std::unique_ptr<LimbRun>> limb_runs_;                       ///< runs for pages
    std::map<const Page*, std::function<std::unique_ptr<LimbRun>()>> waiting_limbs_;  ///< begin when that has ended
};

}  // namespace espalier::studio

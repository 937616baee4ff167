// What was measured, beside the document, and the fit of its numbers to that.
#pragma once

#include "espalier/base/stop.h"
#include "espalier/studio/studio.h"

#include "studio/growth/workers.h"
#include "studio/session/open_document.h"
#include "studio/session/pages.h"
#include "studio/session/posted_listener.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

class Fits {
public:
    /// All outlive it. `post` does work on the session's thread.
    Fits(const StudioOptions& options, Pages& pages, const OpenDocument& document, Workers& workers, Post post);
    /// Ends what it does at once.
    ~Fits();
    Fits(const Fits&) = delete;
    Fits& operator=(const Fits&) = delete;

    bool can_fit() const { return bool(options_.fitting); }
    /// Throws UserError if the studio cannot fit.
    void require_fitting() const;
    /// A file of what was measured, which is read meanwhile: pages are told what it holds, or why it cannot be used.
    void add(const std::filesystem::path& file);
    /// The same, of a file that a page has sent: it is kept in the scratch folder, and may read nothing but itself.
    void add_sent(const std::string& name, const std::string& bytes);
    void remove(std::uint32_t number);

    /// Seeks numbers of the document as it is now: name, lowest, highest. Throws UserError if one is none, if nothing
    /// was measured, and while another fit goes on.
    struct Range {
        std::string name;
        double lowest = 0, highest = 1;
    };
    void begin(const std::vector<Range>& ranges, std::size_t search);
    void stop();

    void send_to(Viewer& viewer) const;

private:
    struct Measured {
        std::filesystem::path file;
        Measurement content;
    };

    void read(const std::filesystem::path& file, std::optional<ReadPermission> permission);
    void note_read(const std::filesystem::path& file, Measurement content);
    /// Beside what goes on.
    void run(std::function<void()> work);
    SoughtNumber sought(const Range& range, const DocumentTexts::Placed& number) const;
    void work(const FitOrder& order);
    Json list_message() const;
    Json state_message() const;

    const StudioOptions& options_;
    Pages& pages_;
    const OpenDocument& document_;
    Workers& workers_;
    const Post post_;
    std::map<std::uint32_t, Measured> measured_;  ///< in the order in which they came
    std::uint32_t last_number_ = 0;
    int sent_ = 0;

    bool is_fitting_ = false;
    std::vector<std::string> names_;  ///< that are sought
    BestSoFar best_;
    StopRequest stop_, stop_reading_;
    std::vector<RunningWork> running_;  ///< the last: it uses all others
};

}  // namespace espalier::studio

// The growths of the document: the one that pages see, the next one that reads its files, and those that end.
#pragma once

#include "espalier/studio/studio.h"

#include "studio/growth/growth.h"
#include "studio/session/document_disk.h"
#include "studio/session/handed_files.h"
#include "studio/session/open_document.h"
#include "studio/session/pace.h"
#include "studio/session/pages.h"
#include "studio/session/posted_listener.h"
#include "studio/session/printed_note.h"
#include "studio/session/retired_growths.h"
#include "studio/session/shown_growth.h"
#include "studio/session/statistics.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

class Growths final : private GrowthNotes {
public:
    /// All outlive it. `post` does work on the session's thread.
    Growths(const StudioOptions& options, Pages& pages, OpenDocument& document, DocumentDisk& disk, HandedFiles& files,
            Workers& workers, Post post);

    /// The document has changed, or a file that it may read.
    void begin(const DocumentChange& change);
    void tick();
    /// Grows on to a step, with what has grown if that can be.
    void grow_to(int step);
    /// After the step at hand.
    void stop();
    /// A growth that asks, and later ones of this document, may be large. Throws UserError if none asks.
    void go_on();

    /// The newest step that can be shown.
    int newest_step() const { return progress_.newest.step; }
    /// The number of the growth that pages see; none: nothing has started.
    std::optional<std::uint32_t> number() const { return shown_ ? std::optional(shown_->number()) : std::nullopt; }
    /// The growth of this number. Throws UserError if another has begun.
    const ShownGrowth& shown(std::uint32_t number) const;
    /// Sends the step that a page looks at.
    void show(Viewer& viewer) const;
    /// What a new page is told.
    void send_to(Viewer& viewer) const;

private:
    void note_started(std::uint32_t growth, GrowthStart start) override;
    void note_grown(std::uint32_t growth, const GrownStep& step) override;
    void note_drawn(std::uint32_t growth, int step, const std::string& statistics) override;
    void note_printed(std::uint32_t growth, const std::string& text) override;
    void note_stopped(std::uint32_t growth) override;
    void note_asking(std::uint32_t growth, std::size_t modules) override;
    void note_failed(std::uint32_t growth, const std::vector<Diagnostic>& why) override;

    void begin_next();
    GrowthOrder next_order();
    bool is_shown(std::uint32_t growth) const { return shown_ && shown_->number() == growth; }
    void show_step(const GrownStep& step);
    void note_going();
    void allow_more();
    void rest(const char* state, const std::string& reason);
    void broadcast_progress() const { pages_.broadcast(shown_->progress_message(progress_)); }
    void note_opened(std::uint32_t growth);
    void broadcast_statistics();

    const StudioOptions& options_;
    Pages& pages_;
    OpenDocument& document_;
    DocumentDisk& disk_;
    HandedFiles& files_;
    PostedListener listener_;
    Statistics statistics_;
    PrintedNote printed_;
    Workers& workers_;
    std::uint32_t last_number_ = 0;
    bool waits_ = false;                 ///< a growth of the newest version is to begin
    std::unique_ptr<PlantSource> next_;  ///< reads its files; the present growth goes on if it cannot
    std::optional<ShownGrowth> shown_;   ///< the one that pages see
    RetiredGrowths retired_;
    GrowthProgress progress_;
    Pace pace_;
    int follow_from_ = 0;                 ///< pages that look at the last step see every one from here on
    bool is_opening_ = false;             ///< no growth of the document has shown anything yet
    std::filesystem::path opened_;        ///< the last document of which one has
    std::filesystem::path may_be_large_;  ///< the document whose growths need not ask
    bool has_asked_ = false;              ///< the present growth has, and was not told to go on
    bool is_busy_ = false;                ///< the newest growth has not come to its end
};

}  // namespace espalier::studio

// The document that the pages of a session share: what is open, its changes, and what pages are told of it.
#pragma once

#include "espalier/base/error.h"
#include "espalier/studio/studio.h"

#include "studio/document/document.h"
#include "studio/growth/plant_source.h"
#include "studio/session/document_texts.h"
#include "studio/session/pages.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace espalier::studio {

/// A change of what is open: what grows must follow.
struct DocumentChange {
    bool is_other = false;           ///< another document was opened
    std::optional<int> follow_from;  ///< pages that look at the last step see every one from here on
};

/// What the files say, unless the user says more.
struct OwnValues {
    std::uint64_t seed = 0;
    int steps = 0;
    bool operator==(const OwnValues&) const = default;
};

class OpenDocument {
public:
    /// The options and the pages outlive it.
    OpenDocument(const StudioOptions& options, Pages& pages);

    /// Called after each change; none before it is set.
    void on_change(std::function<void(const DocumentChange&)> changed) { changed_ = std::move(changed); }

    bool is_open() const { return document_.is_open(); }
    /// Throws UserError if nothing is open.
    void require_open() const;
    /// For the disk: what the program keeps and restores, and texts that are about to be written. Pages are not told.
    Document& history() { return document_; }
    std::uint64_t version() const { return document_.version(); }
    const DocumentState& now() const { return document_.now(); }
    const std::filesystem::path& path() const { return now().opened.path; }
    /// What a change begins with: of a run, what that grew from. Throws UserError if there is nothing to edit.
    const DocumentState& edited() const;
    std::uint64_t seed() const { return edited().opened.seed.value_or(own_.seed); }
    int steps() const { return edited().opened.steps.value_or(own_.steps); }
    const DocumentTexts& texts() const { return texts_; }
    /// Returns the path. Throws UserError if it is no text that pages may edit.
    std::filesystem::path require_text(const std::string& path) const;

    void apply(DocumentState state, const std::string& label, bool transient);
    void undo();
    void redo();
    /// Grows to another step: what has grown up to `known` stays, and is not told to have changed if the growth goes
    /// on.
    void set_steps(int steps, int known, bool goes_on);

    /// A growth has read its files.
    void note_started(const Opened& grown, const GrowthStart& start);
    void set_problems(std::vector<Diagnostic> problems);
    void set_disputed(std::set<std::filesystem::path> files);
    const std::set<std::filesystem::path>& disputed() const { return disputed_; }

    void broadcast();
    /// Pages know nothing of another document before its files have been read, or could not be.
    void broadcast_if_untold();
    void send_to(Viewer& viewer) const;

    /// True if the newest state has not been kept.
    bool take_unkept() { return std::exchange(is_unkept_, false); }

private:
    void note_changed(const std::filesystem::path& before, std::optional<int> follow_from = {});
    bool has_texts() const;
    Json message() const;
    Json problems_message() const;

    const StudioOptions& options_;
    Pages& pages_;
    std::function<void(const DocumentChange&)> changed_;
    Document document_;
    DocumentTexts texts_;
    std::optional<DocumentState> recorded_from_;  ///< what the open run grew from
    std::set<std::filesystem::path> disputed_;    ///< written by another program while they had unsaved changes
    OwnValues own_;
    std::vector<Diagnostic> problems_;
    bool is_told_ = true;  ///< pages know the newest version
    bool is_unkept_ = false;
};

}  // namespace espalier::studio

// The document on disk: what other programs do to its files, and what of it the program keeps until its next start.
#pragma once

#include "studio/document/disk_watch.h"
#include "studio/session/open_document.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace espalier::studio {

class DocumentDisk {
public:
    /// All outlive it.
    DocumentDisk(const StudioOptions& options, Pages& pages, OpenDocument& document)
        : options_(options), pages_(pages), document_(document) {}
    ~DocumentDisk();
    DocumentDisk(const DocumentDisk&) = delete;
    DocumentDisk& operator=(const DocumentDisk&) = delete;

    /// Opens what was open when the program ended, or what it was started with. What was being opened just then is not
    /// opened again: it may be what ended the program.
    void restore();
    /// What is open begins to be read; until `note_opened` a mark on disk says so.
    void note_opening();
    /// It was read and shown, or could not be.
    void note_opened();
    /// Looks what other programs have written, twice a second, and keeps what has changed.
    void tick();
    void look();

    /// Watches what a growth has read.
    void watch(const DocumentTexts::Files& files);
    void forget() { watch_.forget(); }
    /// The studio has written a file.
    void note_saved(const std::filesystem::path& file, const std::string& text);
    /// Settles which text of a file stays that was written by another program while it had unsaved changes: that on
    /// disk or the unsaved one.
    void settle(const std::filesystem::path& file, bool takes_disk);

    /// The path in its plainest form. Throws UserError if it leads out of the opened folder.
    std::filesystem::path below_folder(const std::filesystem::path& path) const;
    /// The same for what the studio does not write.
    std::filesystem::path writable(const std::filesystem::path& path) const;

private:
    void open(const Opened& opened);
    void leave_closed(const Opened& opened);
    std::filesystem::path mark_of_opening() const;
    bool ended_while_opening(const std::filesystem::path& document) const;
    void keep();
    void restore_kept();
    void read_again(const std::vector<std::filesystem::path>& files);

    const StudioOptions& options_;
    Pages& pages_;
    OpenDocument& document_;
    DiskWatch watch_;
    std::uint32_t note_ = 0;  ///< that says what was read again; 0: none so far
    std::chrono::steady_clock::time_point looked_{};
};

}  // namespace espalier::studio

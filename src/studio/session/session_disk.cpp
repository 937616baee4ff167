// What other programs do to the files of the document.
#include "studio/document/document_files.h"
#include "studio/session/session.h"

#include <fmt/format.h>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_looks(500);

}  // namespace

// Watches what a growth has read. Texts that pages have changed were not read from the disk.
void Session::watch(const std::map<fs::path, ReadLog::File>& files) {
    for (const auto& [file, read] : files) {
        if (watch_.knows(file)) continue;
        if (document_.now().unsaved.contains(file)) {
            watch_.accept(file);
        } else {
            watch_.know(file, read.digest);
        }
    }
}

void Session::look_at_disk_sometimes() {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_at_disk_ < between_looks) return;
    looked_at_disk_ = now;
    look_at_disk();
}

void Session::look_at_disk() {
    if (!document_.is_open() || is_run(document_.now().opened.path)) return;
    std::vector<fs::path> unedited;
    std::set<fs::path> disputed;
    for (const fs::path& file : watch_.changed()) {
        const auto unsaved = document_.now().unsaved.find(file);
        const bool is_edited =
            unsaved != document_.now().unsaved.end() && digest(unsaved->second) != watch_.digest_of(file);
        if (is_edited && text_on_disk(file) != unsaved->second) {
            disputed.insert(file);
        } else {
            unedited.push_back(file);
        }
    }
    if (!unedited.empty()) read_again(unedited);
    if (std::exchange(disputed_, disputed) != disputed_) broadcast_document();
}

// As a change, which can be undone.
void Session::read_again(const std::vector<fs::path>& files) {
    DocumentState state = document_.now();
    std::string names;
    for (const fs::path& file : files) {
        const auto read = read_.find(file);
        const bool is_known = read != read_.end() && read->second.kept && read->second.digest == watch_.digest_of(file);
        if (is_known && (is_palette(file) || is_text(read->second.bytes)))
            document_.keep_text(file, read->second.bytes);
        state.unsaved.erase(file);
        watch_.accept(file);
        names += (names.empty() ? "" : ", ") + file.filename().string();
    }
    if (read_again_message_ == 0) read_again_message_ = ++last_message_;
    notify_as(read_again_message_, "note",
              fmt::format("Another program has written {}: it has been read again.", names));
    apply(std::move(state), fmt::format("read {} again", names), false);
}

// Settles which text of a file stays that was written by another program while it had unsaved changes.
Session::Json Session::settle(Viewer&, const Json& request) {
    const fs::path file = request.at("path").get<std::string>();
    const std::string take = request.at("take").get<std::string>();
    if (take != "disk" && take != "mine") throw UserError("take is 'disk' or 'mine'");
    if (disputed_.erase(file) == 0) throw UserError(fmt::format("no other program has written {}", file.string()));
    watch_.accept(file);
    if (take == "mine") {
        broadcast_document();
    } else {
        DocumentState state = edited();
        state.unsaved.erase(file);
        apply(std::move(state), fmt::format("read {} again", file.filename().string()), false);
    }
    return {{"version", document_.version()}};
}

}  // namespace espalier::studio

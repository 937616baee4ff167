#include "studio/session/document_disk.h"

#include "espalier/base/file.h"

#include "base/folder.h"
#include "base/json_text.h"
#include "base/reason.h"
#include "studio/document/document_files.h"
#include "studio/document/plain_name.h"

#include <fmt/format.h>

#include <set>
#include <system_error>
#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_looks(500);

}  // namespace

DocumentDisk::~DocumentDisk() {
    note_opened();
}

void DocumentDisk::restore() {
    if (!options_.state.empty() && fs::exists(options_.state)) restore_kept();
    const bool is_suspect = document_.is_open() && ended_while_opening(document_.path());
    note_opened();
    Opened opened = options_.opened;
    if (!opened.path.empty()) opened.path = fs::absolute(opened.path).lexically_normal();
    if (is_suspect) {
        leave_closed(opened);
    } else if (!opened.path.empty() && (options_.is_named || !document_.is_open()) && document_.path() != opened.path) {
        watch_.forget();
        open(opened);
    }
}

void DocumentDisk::open(const Opened& opened) {
    document_.history().change({opened, {}}, fmt::format("open {}", opened.path.filename().string()), false);
}

// It lies one step back in the history, with its unsaved texts: the same would end the program again at every start.
void DocumentDisk::leave_closed(const Opened& opened) {
    const std::string name = document_.path().filename().string();
    pages_.notify("warning", fmt::format("The studio ended while it was opening {}, which it therefore does not open "
                                         "again by itself. Undo opens it, with its unsaved texts.",
                                         name));
    watch_.forget();
    if (opened.path.empty() || (!options_.is_named && opened.path == document_.path())) {
        document_.history().change({}, fmt::format("leave {} closed", name), false);
    } else {
        open(opened);
    }
}

// Beside the kept state, which is much longer and written now and then.
fs::path DocumentDisk::mark_of_opening() const {
    return fs::path(options_.state).concat(".opening");
}

bool DocumentDisk::ended_while_opening(const fs::path& document) const {
    try {
        return !options_.state.empty() && is_readable(mark_of_opening()) &&
               read_text(mark_of_opening()) == document.string();
    } catch (const UserError&) {
        return false;
    }
}

void DocumentDisk::note_opening() {
    if (options_.state.empty()) return;
    try {
        fs::create_directories(options_.state.parent_path());
        write_private_text(mark_of_opening(), document_.path().string());
    } catch (const std::exception&) {
        // Whoever cannot keep what is open does not open it again either.
    }
}

void DocumentDisk::note_opened() {
    std::error_code ignored;
    if (!options_.state.empty()) fs::remove(mark_of_opening(), ignored);
}

void DocumentDisk::restore_kept() {
    try {
        const Json state = read_json<Json>(read_text(options_.state));
        document_.history() = Document::from_json(state);
        const Json on_disk = state.value("on_disk", Json::object());
        for (const auto& [file, digest] : on_disk.items()) watch_.know(file, digest);
    } catch (const std::exception&) {
        pages_.notify("warning",
                      fmt::format("what {} kept of the last session cannot be read", options_.state.string()));
    }
}

void DocumentDisk::keep() {
    if (options_.state.empty()) return;
    try {
        fs::create_directories(options_.state.parent_path());
        Json state = document_.history().to_json();
        for (const auto& [file, text] : document_.now().unsaved) {
            if (watch_.knows(file)) state["on_disk"][file.string()] = watch_.digest_of(file);
        }
        write_private_text(options_.state, json_text(state, -1));
    } catch (const std::exception& error) {
        pages_.notify("warning", fmt::format("unsaved work cannot be kept: {}", reason_of(error)));
    }
}

void DocumentDisk::tick() {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ >= between_looks) {
        looked_ = now;
        look();
    }
    if (document_.take_unkept()) keep();
}

// Texts that pages have changed were not read from the disk.
void DocumentDisk::watch(const DocumentTexts::Files& files) {
    for (const auto& [file, read] : files) {
        if (watch_.knows(file)) continue;
        if (document_.now().unsaved.contains(file)) {
            watch_.accept(file);
        } else {
            watch_.know(file, read.digest);
        }
    }
}

void DocumentDisk::note_saved(const fs::path& file, const std::string& text) {
    watch_.know(file, digest(text));
}

void DocumentDisk::look() {
    if (!document_.is_open() || is_run(document_.path())) return;
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
    document_.set_disputed(std::move(disputed));
}

// As a change, which can be undone.
void DocumentDisk::read_again(const std::vector<fs::path>& files) {
    DocumentState state = document_.now();
    std::string names;
    for (const fs::path& file : files) {
        const DocumentTexts::Files& read_files = document_.texts().files();
        const auto read = read_files.find(file);
        const bool is_known =
            read != read_files.end() && read->second.kept && read->second.digest == watch_.digest_of(file);
        if (is_known && (is_palette(file) || is_text(read->second.bytes)))
            document_.history().keep_text(file, read->second.bytes);
        state.unsaved.erase(file);
        watch_.accept(file);
        names += (names.empty() ? "" : ", ") + file.filename().string();
    }
    note_ = pages_.replace_note(note_, "note",
                                fmt::format("Another program has written {}: it has been read again.", names));
    document_.apply(std::move(state), fmt::format("read {} again", names), false);
}

void DocumentDisk::settle(const fs::path& file, bool takes_disk) {
    std::set<fs::path> disputed = document_.disputed();
    if (disputed.erase(file) == 0) throw UserError(fmt::format("no other program has written {}", file.string()));
    watch_.accept(file);
    document_.set_disputed(std::move(disputed));
    if (!takes_disk) return;
    DocumentState state = document_.edited();
    state.unsaved.erase(file);
    document_.apply(std::move(state), fmt::format("read {} again", file.filename().string()), false);
}

fs::path DocumentDisk::below_folder(const fs::path& path) const {
    if (path.native().find('\0') != std::string::npos) throw UserError("the path holds a zero byte");
    std::error_code unknown;
    if (resolved_below(path, options_.folder, unknown).empty()) {
        throw UserError(fmt::format("{} is not below {}: the studio writes nowhere else. Save it under another name",
                                    path.string(), options_.folder.string()));
    }
    return path.lexically_normal();
}

fs::path DocumentDisk::writable(const fs::path& path) const {
    const fs::path place = below_folder(path);
    require_plain_name(place.lexically_relative(options_.folder));
    return place;
}

}  // namespace espalier::studio

// Writing files: saving the document, here or elsewhere, new side files, and what other programs have written.
#include "espalier/base/file.h"

#include "studio/document/document_files.h"
#include "studio/document/saved_places.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

#include <fmt/format.h>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

struct NewFileRequest {
    static constexpr TypeName type{"NewFileRequest", "a side file"};
    std::string name, content;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "of a model, a scene or a side file, without hidden parts");
        field("content", self.content, "its text, or its bytes in base64 if it is a colour map or materials");
    }
};

struct NewFile {
    static constexpr TypeName type{"NewFile", "where it stands"};
    std::string path;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "beside the document");
    }
};

struct SaveRequest {
    static constexpr TypeName type{"SaveRequest", "where the document is to be saved"};
    std::optional<std::string> path;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "below the opened folder; without it, the files that have changed are written");
    }
};

struct Saved {
    static constexpr TypeName type{"Saved", "what has been written"};
    std::uint64_t version = 0;
    std::string path;
    std::vector<std::string> files;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("version", self.version, "version of the document");
        field("path", self.path, "of the document");
        field("files", self.files, "all that were written");
    }
};

struct SettleRequest {
    static constexpr TypeName type{"SettleRequest", "which text of a disputed file stays"};
    std::string path, take;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "of a text that is `disputed`");
        field("take", self.take, "that on disk, or the unsaved one", one_of("disk mine"));
    }
};

// Beside the document, whose texts may then name it.
NewFile new_file(SessionParts& session, Viewer&, const NewFileRequest& request) {
    session.document.require_open();
    const fs::path main = session.document.path(), name = fs::path(request.name).filename();
    const fs::path path = session.disk.writable((fs::is_directory(main) ? main : main.parent_path()) / name);
    if (request.content.size() > most_text) throw UserError("the text is too long");
    if (fs::exists(path)) throw UserError(fmt::format("{} is there already", path.string()));
    write_text(path, bytes_of(path, request.content));
    session.growths.begin({});
    return {path.string()};
}

std::vector<fs::path> save_changes(SessionParts& session) {
    const UnsavedTexts unsaved = session.document.now().unsaved;
    std::vector<fs::path> written;
    for (const auto& [file, text] : unsaved) {
        if (text_on_disk(file) != text) written.push_back(session.disk.writable(file));
    }
    session.disk.look();
    for (const fs::path& file : written) {
        if (!session.document.disputed().contains(file)) continue;
        throw UserError(
            fmt::format("another program has written {}: say first which text is to stay", file.filename().string()));
    }
    for (const fs::path& file : written) {
        if (const std::optional<std::string> before = text_on_disk(file))
            session.document.history().keep_text(file, *before);
        write_text(file, unsaved.at(file));
        session.disk.note_saved(file, unsaved.at(file));
    }
    session.document.broadcast();
    return written;
}

// The files that are not there yet go to their places. Throws UserError if another file has one of these.
std::vector<fs::path> write_copies(const SessionParts& session, const fs::path& main,
                                   const std::map<fs::path, std::string>& files,
                                   const std::map<fs::path, fs::path>& places) {
    std::vector<fs::path> written;
    for (const auto& [file, place] : places) {
        const std::optional<std::string> there = text_on_disk(session.disk.writable(place));
        if (fs::exists(place) && (file == main || there != files.at(file))) {
            throw UserError(fmt::format("{} is there already{}", place.string(),
                                        file == main ? "" : ", and is another file: save into another folder"));
        }
        if (!there) written.push_back(file);
    }
    for (fs::path& file : written) {
        const fs::path place = places.at(file);
        fs::create_directories(place.parent_path());
        write_text(place, files.at(file));
        file = place;
    }
    return written;
}

// With the files that it reads, at the same places beside it.
std::vector<fs::path> save_as(SessionParts& session, const fs::path& path) {
    OpenDocument& document = session.document;
    const DocumentState now = document.edited();
    const fs::path main = now.opened.path;
    if (kind_of(main) == "object") throw UserError("save the folder of an object under its own name");
    const std::map<fs::path, std::string> files = document.texts().contents(now);
    const std::map<fs::path, fs::path> places = saved_places(main, files, path, session.options.folder);
    if (!places.contains(main)) throw UserError(fmt::format("{} is there already", path.string()));
    std::vector<fs::path> written = write_copies(session, main, files, places);
    DocumentState saved{now.opened, {}};
    saved.opened.path = places.at(main);
    for (const auto& [file, text] : now.unsaved) {
        if (!places.contains(file)) saved.unsaved[file] = text;
    }
    document.apply(std::move(saved), fmt::format("save as {}", path.filename().string()), false);
    return written;
}

Saved save(SessionParts& session, Viewer&, const SaveRequest& request) {
    session.document.require_open();
    const std::vector<fs::path> written =
        request.path ? save_as(session, session.disk.writable(session.options.folder / *request.path))
                     : save_changes(session);
    Saved saved{session.document.version(), session.document.path().string(), {}};
    for (const fs::path& file : written) saved.files.push_back(file.string());
    return saved;
}

NewVersion settle(SessionParts& session, Viewer&, const SettleRequest& request) {
    session.disk.settle(request.path, request.take == "disk");
    return {session.document.version()};
}

const Registered<RequestType> new_file_entry{
    request("new-file", "writes a side file beside the document, which grows anew", new_file)};
const Registered<RequestType> save_entry{request(
    "save",
    "writes the document. Under another `path` the files that it reads come along, to the same places beside it; where "
    "those would lead out of the opened folder, it gets a folder of its own, named after it",
    save)};
const Registered<RequestType> settle_entry{
    request("settle", "settles which text stays: the unsaved one is dropped, or kept", settle)};

}  // namespace
}  // namespace espalier::studio

// Opening documents: files, and what came by a link.
#include "espalier/base/file.h"

#include "studio/document/sharing.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

struct OpenRequest {
    static constexpr TypeName type{"OpenRequest", "a document"};
    std::string path;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "of the library, or below the opened folder");
    }
};

struct LinkedFile {
    static constexpr TypeName type{"LinkedFile", "a file that a link would write"};
    std::string path;
    std::size_t bytes = 0;
    Nullable<std::string> library;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "below the folder");
        field("bytes", self.bytes, "its size");
        field("library", self.library, "its name in the library; null if it is not of it");
    }
};

struct LinkContents {
    static constexpr TypeName type{"LinkContents", "what a link would write, and where"};
    std::string folder;
    std::vector<LinkedFile> files;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("folder", self.folder, "a new one below the opened folder");
        field("files", self.files, "pages show them and ask");
    }
};

struct OpenedLink {
    static constexpr TypeName type{"OpenedLink", "what a link has written"};
    std::uint64_t version = 0;
    std::string path;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("version", self.version, "version of the document");
        field("path", self.path, "of the document");
    }
};

NewVersion open(SessionParts& session, Viewer&, const OpenRequest& request) {
    const fs::path path = fs::absolute(request.path).lexically_normal();
    const std::vector<LibraryEntry> entries = session.options.library();
    const bool is_of_library = std::any_of(
        entries.begin(), entries.end(), [&](const LibraryEntry& entry) { return entry.path == path && !entry.is_own; });
    if (!is_of_library) session.disk.below_folder(path);
    if (!fs::exists(path)) throw UserError(fmt::format("{} does not exist", path.string()));
    session.document.apply({{path, {}, {}}, {}}, fmt::format("open {}", path.filename().string()), false);
    return {session.document.version()};
}

LinkContents read_link(SessionParts& session, Viewer&, const SharedModel& request) {
    const SharedDocument shared = read_shared(request, session.options.library_folder);
    LinkContents contents{place_of_shared(shared, session.options.folder).string(), {}};
    for (const auto& [path, bytes] : shared.files) {
        LinkedFile& file = contents.files.emplace_back();
        file.path = path.generic_string();
        file.bytes = bytes.size();
        const auto known = shared.of_library.find(path);
        if (known != shared.of_library.end()) file.library = known->second.generic_string();
    }
    return contents;
}

// Texts of another user's become files of a folder of their own.
OpenedLink open_text(SessionParts& session, Viewer&, const SharedModel& request) {
    const SharedDocument shared = read_shared(request, session.options.library_folder);
    const fs::path path = write_shared(shared, session.options.folder);
    session.document.apply({{path, request.steps, request.seed}, {}}, fmt::format("open {}", path.filename().string()),
                           false);
    return {session.document.version(), path.string()};
}

SharedModel share(SessionParts& session, Viewer&, const Nothing&) {
    const DocumentState& state = session.document.edited();
    if (fs::is_directory(state.opened.path)) throw UserError("a link holds a model or a scene, not a folder of files");
    const DocumentTexts& texts = session.document.texts();
    SharedModel shared = shared_files(state.opened.path, texts.contents(state), session.options.library_folder);
    shared.seed = session.document.seed();
    if (state.opened.steps) shared.steps = *state.opened.steps;  // otherwise the texts say it
    return shared;
}

const Registered<RequestType> open_entry{
    request("open", "starts another document; the old one stays in the history", open)};
const Registered<RequestType> read_link_entry{request("read-link", "what `open-text` would write where", read_link)};
const Registered<RequestType> open_text_entry{request("open-text",
                                                      "opens what a link holds: its files are written to `shared/NAME` "
                                                      "below the opened folder, and read nothing but that "
                                                      "and the library",
                                                      open_text)};
const Registered<RequestType> share_entry{request(
    "share", "what a link holds: the files lie below one folder; one of the library that has not changed is only named",
    share)};

}  // namespace
}  // namespace espalier::studio
